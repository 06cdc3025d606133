// The command chart: one row per robot, what its commands do over time.
import {barsOf} from './bars.js';
import {h, s} from './dom.js';
import {clock, commandName, seconds} from './format.js';
import {robotColour} from './palette.js';
import {linear, ticks} from './scale.js';

const past = 40; // [s]
const future = 10; // [s]
const leastRow = 46; // [px]
const mostRow = 74;
const left = 46;
const top = 6;
const bottom = 24;

const kinds = {
  waiting: 'waits, no end known',
  delayed: 'delayed: lets others pass',
  planned: 'decided, still to come',
  moving: 'moves',
  escape: 'escape: out of the way of another',
  failed: 'failed',
};

const idleKinds = new Set(['waiting', 'delayed']);

/** Patterns that tell the kinds apart without colour. */
function patterns() {
  const lines = (id, path) =>
    s('pattern', {id, width: 8, height: 8, patternUnits: 'userSpaceOnUse'}, s('path', {d: path, class: 'pattern'}));
  return s('defs', {}, lines('p-waiting', 'M-2,2 l4,-4 M0,8 l8,-8 M6,10 l4,-4'), lines('p-escape', 'M0,0 l8,8 M0,8 l8,-8'));
}

function barElements(bar, x0, x1, y, colour) {
  const width = Math.max(x1 - x0, 1.5);
  const kind = bar.escape && bar.kind === 'moving' ? 'escape' : bar.kind;
  const box = (attributes) => s('rect', {x: x0, y, width, height: 24, rx: 3, ...attributes});
  switch (kind) {
    case 'waiting':
      return [box({class: 'bar waiting'}), box({fill: 'url(#p-waiting)'})];
    case 'delayed':
      return [box({class: 'bar delayed'}), s('path', {class: 'delayed-edge', d: `M${x0},${y + 12} H${x1 - 4} m-4,-4 l4,4 l-4,4`})];
    case 'planned':
      return [box({class: bar.escape ? 'bar planned escape-to-come' : 'bar planned', stroke: colour})];
    case 'escape':
      return [box({fill: colour}), box({fill: 'url(#p-escape)'}), s('path', {class: 'escape-mark', d: `M${(x0 + x1) / 2},${y - 4} l5,5 l-5,5 l-5,-5 z`})];
    case 'failed':
      return [box({fill: colour}), s('path', {class: 'failed-mark', d: `M${x1 - 14},${y + 6} l12,12 m-12,0 l12,-12`})];
    case 'rejected':
      return [s('path', {class: 'failed-mark', d: `M${x0 - 5},${y + 7} l10,10 m-10,0 l10,-10`})];
    default:
      return [box({fill: colour})];
  }
}

export class Chart {
  constructor(root, legend, choose) {
    this.root = root;
    this.choose = choose;
    this.hits = [];
    this.tip = h('div', {class: 'tip', hidden: true});
    this.holder = h('div', {class: 'fill'});
    this.row = leastRow;
    root.append(this.holder, this.tip);
    root.addEventListener('pointermove', (event) => this.hover(event));
    root.addEventListener('pointerleave', () => (this.tip.hidden = true));
    root.addEventListener('click', (event) => {
      const hit = this.at(event);
      if (hit) this.choose(hit.command.id);
    });
    legend.append(
      ...Object.entries(kinds)
        .filter(([kind]) => kind !== 'failed')
        .map(([kind, text]) => {
          const sample = s('svg', {width: 28, height: 20, viewBox: '0 -6 36 36', 'aria-hidden': 'true'}, ...barElements({kind: kind === 'escape' ? 'moving' : kind, escape: kind === 'escape'}, 1, 35, 0, '#5b7a94'));
          return h('span', {class: 'key'}, sample, text);
        }),
      h('span', {class: 'key'}, s('svg', {width: 14, height: 18, 'aria-hidden': 'true'}, s('path', {class: 'window', d: 'M3,4 v10 M3,9 h8 M11,4 v10'})), 'start window'),
    );
  }

  draw(picture, selected) {
    const width = this.root.clientWidth;
    if (!picture.cell || width === 0) return;
    const now = picture.t;
    const names = picture.cell.robots.map((robot) => robot.name);
    this.root.style.minHeight = `${top + names.length * leastRow + bottom}px`;
    const row = Math.min(mostRow, Math.max(leastRow, (this.root.clientHeight - top - bottom) / names.length));
    this.row = row;
    const height = top + names.length * row + bottom;
    const begin = Math.max(0, now - past);
    const end = begin + past + future;
    const x = linear(begin, end, left, width - 8);
    const svg = s('svg', {width, height, role: 'img', 'aria-label': this.describe(picture, now)}, patterns());
    for (const t of ticks(begin, end, width / 90)) {
      svg.append(s('line', {class: 'gridline', x1: x(t), x2: x(t), y1: top, y2: height - bottom}));
      svg.append(s('text', {class: 'tick', x: Math.min(x(t), width - 22), y: height - 8, 'text-anchor': 'middle'}, clock(t).replace(/\.\d$/, '')));
    }
    names.forEach((name, i) => {
      svg.append(s('text', {class: 'name', x: 6, y: top + (i + 0.5) * row + 5}, name));
      svg.append(s('rect', {x: left - 10, y: top + (i + 0.5) * row - 12, width: 4, height: 24, rx: 2, fill: robotColour(i)}));
    });
    this.hits = [];
    // A robot may escape while its own command waits: what moves lies above what waits.
    for (const idle of [true, false]) {
      for (const command of picture.commands.values()) {
        const bars = barsOf(command, now).filter((bar) => idleKinds.has(bar.kind) === idle);
        this.drawCommand(svg, command, bars, names.indexOf(command.robot), x, command.id === selected);
      }
    }
    svg.append(s('line', {class: 'now', x1: x(now), x2: x(now), y1: top, y2: height - bottom}));
    svg.append(s('text', {class: 'now-text', x: x(now) + 4, y: top + 8}, 'now'));
    this.holder.replaceChildren(svg);
  }

  drawCommand(svg, command, bars, index, x, selected) {
    if (index < 0) return;
    const y = top + (index + 0.5) * this.row - 12;
    const limit = (t) => Math.min(Math.max(t, x.from), x.to);
    for (const bar of bars) {
      if (bar.to < x.from || bar.from > x.to) continue;
      const [x0, x1] = [x(limit(bar.from)), x(limit(bar.to))];
      const group = s('g', {dataset: {kind: bar.escape ? `escape-${bar.kind}` : bar.kind, command: command.id}});
      group.append(...barElements(bar, x0, x1, y, robotColour(index)));
      if (selected) group.append(s('rect', {class: 'chosen', x: x0 - 1, y: y - 2, width: Math.max(x1 - x0, 1.5) + 2, height: 28, rx: 4}));
      const label = bar.escape ? `e${command.number}` : `${command.number}`;
      if (bar.kind === 'moving' && x1 - x0 > 18) group.append(s('text', {class: 'bar-text', x: (x0 + x1) / 2, y: y + 16, 'text-anchor': 'middle'}, label));
      svg.append(group);
      this.hits.push({x0, x1, y, bar, command});
    }
    if (bars.length > 0 && command.window && command.window[1] > x.from && command.window[0] < x.to && command.start !== null) {
      const [w0, w1] = command.window.map((t) => x(limit(t)));
      svg.append(s('path', {class: 'window', dataset: {kind: 'window'}, d: `M${w0},${y - 3} v30 M${w1},${y - 3} v30 M${w0},${y - 3} H${Math.max(w1, w0 + 2)}`}));
    }
  }

  /** The chart in words. */
  describe(picture, now) {
    const count = {};
    for (const command of picture.commands.values()) {
      for (const bar of barsOf(command, now)) if (bar.to > now - past) count[bar.kind] = (count[bar.kind] ?? 0) + 1;
    }
    const words = Object.entries(count).map(([kind, n]) => `${n} ${kind}`);
    return `What the commands of each robot did in the last ${past} seconds: ${words.join(', ') || 'nothing'}. The table of commands has the same.`;
  }

  at(event) {
    const box = this.holder.getBoundingClientRect();
    const [px, py] = [event.clientX - box.left, event.clientY - box.top];
    return this.hits.findLast((hit) => px >= hit.x0 - 3 && px <= hit.x1 + 3 && py >= hit.y - 2 && py <= hit.y + 28);
  }

  hover(event) {
    const hit = this.at(event);
    this.tip.hidden = !hit;
    this.root.style.cursor = hit ? 'pointer' : 'default';
    if (!hit) return;
    const {bar, command} = hit;
    const what = bar.escape && bar.kind === 'moving' ? kinds.escape : (kinds[bar.kind] ?? bar.kind);
    this.tip.textContent = `${commandName(command)}: ${what}, ${clock(bar.from)} to ${clock(bar.to)} (${seconds(bar.to - bar.from)})`;
    const box = this.root.getBoundingClientRect();
    this.tip.style.left = `${Math.min(event.clientX - box.left + 12, box.width - 230)}px`;
    this.tip.style.top = `${event.clientY - box.top + 14}px`;
  }
}
