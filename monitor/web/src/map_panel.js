// The collision map of one command: where on its way, and when, it would touch somebody; and the start that avoids it.
import {h, s, setText} from './dom.js';
import {commandName, mm} from './format.js';
import {areaAt, chosenWindow, inSight, relative, summary} from './map_view.js';
import {robotColour} from './palette.js';
import {linear, ticks} from './scale.js';
import {robotIndex} from './store.js';

const height = 270; // [px]
const margin = {left: 52, right: 12, top: 8, bottom: 58};
const standing = 0.06; // of the length: the strip above it shows the robot at its goal

/** One path for all areas of a neighbour. */
function areasPath(areas, x, y, view) {
  const parts = [];
  for (const area of areas) {
    const t0 = Math.max(area.t0, view.from);
    const t1 = Math.min(area.t1, view.until);
    if (t1 <= t0) continue;
    const high = area.l1 >= view.length ? view.length * (1 + standing) : area.l1;
    parts.push(`M${x(t0).toFixed(1)},${y(area.l0).toFixed(1)}H${x(t1).toFixed(1)}V${y(high).toFixed(1)}H${x(t0).toFixed(1)}Z`);
  }
  return parts.join('');
}

function trajectory(view, start, x, y) {
  const points = [[view.from, 0], [start, 0], ...view.line.map(([t, length]) => [start + t, length]), [view.until, view.length]];
  return points.map(([t, length], i) => `${i === 0 ? 'M' : 'L'}${x(t).toFixed(1)},${y(length).toFixed(1)}`).join('');
}

export class MapPanel {
  constructor(root, about, legend) {
    this.root = root;
    this.about = about;
    this.tip = h('div', {class: 'tip', hidden: true});
    this.holder = h('div');
    root.append(this.holder, this.tip);
    root.addEventListener('pointermove', (event) => this.hover(event));
    root.addEventListener('pointerleave', () => (this.tip.hidden = true));
    this.legend = legend;
    new ResizeObserver(() => (this.drawn = null)).observe(root);
  }

  draw(picture, selected) {
    const {map} = picture;
    const command = picture.commands.get(selected);
    if (!map || map.command !== selected || !command) {
      setText(this.about, selected ? '' : 'Once a command has to wait, its map is shown here. You can also pick a command in the chart or in the table.');
      return;
    }
    if (map.why_not) {
      setText(this.about, `${commandName(command)}: ${map.why_not}.`);
      this.holder.replaceChildren();
      this.legend.replaceChildren();
      this.drawn = null;
      return;
    }
    const width = this.root.clientWidth;
    const moment = map.start === null ? picture.t : map.t; // without a start the axis follows the time
    if (this.drawn === map && moment === map.t && this.width === width) return this.drawNow(picture);
    this.drawn = map;
    this.width = width;
    this.view = relative(map, moment);
    setText(this.about, summary(this.view, commandName(command)));
    this.holder.replaceChildren(this.picture(width, picture, commandName(command)));
    this.showLegend(picture);
    this.drawNow(picture);
  }

  picture(width, picture, name) {
    const {view} = this;
    const x = linear(view.from, view.until, margin.left, width - margin.right);
    const y = linear(0, view.length * (1 + standing) || 1, height - margin.bottom, margin.top);
    Object.assign(this, {x, y});
    const chosen = chosenWindow(view);
    const svg = s('svg', {width, height, role: 'img', 'aria-label': summary(view, name), dataset: {start: view.start ?? '', window: chosen ? chosen.join(' ') : ''}});
    for (const t of ticks(view.from, view.until, width / 80)) {
      svg.append(s('line', {class: 'gridline', x1: x(t), x2: x(t), y1: margin.top, y2: y(0)}));
      svg.append(s('text', {class: 'tick', x: x(t), y: y(0) + 14, 'text-anchor': 'middle'}, `${+t.toFixed(2)}`));
    }
    for (const l of ticks(0, 1000 * view.length, 5)) {
      svg.append(s('line', {class: 'gridline', x1: margin.left, x2: width - margin.right, y1: y(l / 1000), y2: y(l / 1000)}));
      svg.append(s('text', {class: 'tick', x: margin.left - 6, y: y(l / 1000) + 4, 'text-anchor': 'end'}, `${+l.toFixed(1)}`));
    }
    svg.append(s('defs', {}, s('pattern', {id: 'p-before', width: 7, height: 7, patternUnits: 'userSpaceOnUse'}, s('path', {class: 'pattern', d: 'M-2,2 l4,-4 M0,7 l7,-7 M5,9 l4,-4'}))));
    for (const neighbour of view.before) {
      svg.append(s('path', {class: 'area-before', d: areasPath(neighbour.areas, x, y, view), fill: 'url(#p-before)', dataset: {robot: neighbour.robot}}));
    }
    for (const neighbour of view.neighbours) {
      const colour = robotColour(robotIndex(picture, neighbour.robot));
      svg.append(s('path', {class: 'area', d: areasPath(neighbour.areas, x, y, view), fill: colour, dataset: {robot: neighbour.robot}}));
    }
    svg.append(s('line', {class: 'goal', x1: margin.left, x2: width - margin.right, y1: y(view.length), y2: y(view.length)}));
    if (view.start === null || view.start > 0.05) svg.append(s('path', {class: 'at-once', d: trajectory(view, 0, x, y)}));
    if (view.start !== null) svg.append(s('path', {class: 'chosen-line', dataset: {line: 'chosen'}, d: trajectory(view, view.start, x, y)}));
    if (view.before.length > 0) {
      svg.append(s('line', {class: 'judged', x1: x(view.judged), x2: x(view.judged), y1: margin.top, y2: y(0)}));
      svg.append(s('text', {class: 'tick', x: x(view.judged) - 4, y: y(0) - 6, 'text-anchor': 'end'}, 'decided'));
    }
    this.now = s('line', {class: 'now', y1: margin.top, y2: y(0)});
    svg.append(this.now, ...this.windows(x, y(0) + 22, width));
    svg.append(s('text', {class: 'axis', x: (margin.left + width) / 2, y: height - 6, 'text-anchor': 'middle'}, `seconds after ${name} could have started`));
    svg.append(s('text', {class: 'axis', 'text-anchor': 'middle', transform: `translate(12 ${(y(0) + margin.top) / 2}) rotate(-90)`}, 'way of its TCP [mm]'));
    return svg;
  }

  /** The bar of start windows below the map, with the one that was chosen marked. */
  windows(x, y, width) {
    const {view} = this;
    const elements = [s('rect', {class: 'no-window', x: x(0), y, width: Math.max(0, width - margin.right - x(0)), height: 9})];
    for (const [from, to] of view.windows) {
      const [x0, x1] = [x(Math.max(0, from)), x(Math.min(to, view.until))];
      if (x1 > x0) elements.push(s('rect', {class: 'free-window', dataset: {window: `${from} ${to}`}, x: x0, y, width: x1 - x0, height: 9}));
    }
    if (view.start !== null) elements.push(s('path', {class: 'start-mark', dataset: {mark: 'start'}, d: `M${x(view.start)},${y - 3} l6,14 h-12 z`}));
    return elements;
  }

  drawNow(picture) {
    if (!this.x || !this.drawn) return;
    const t = picture.t - this.drawn.ready;
    const shown = t >= this.view.from && t <= this.view.until;
    this.now.setAttribute('visibility', shown ? 'visible' : 'hidden');
    for (const end of ['x1', 'x2']) this.now.setAttribute(end, shown ? this.x(t) : 0);
  }

  showLegend(picture) {
    const sample = (...parts) => s('svg', {width: 30, height: 14, 'aria-hidden': 'true'}, ...parts);
    const {view} = this;
    const areas = view.neighbours.filter((neighbour) => inSight(view, neighbour)).map((neighbour) => {
      const colour = robotColour(robotIndex(picture, neighbour.robot));
      return h('span', {class: 'key'}, sample(s('rect', {class: 'area', x: 2, y: 1, width: 26, height: 12, fill: colour})), `would touch ${neighbour.robot}`);
    });
    const blocked = view.before.filter((neighbour) => inSight(view, neighbour)).map((neighbour) => neighbour.robot);
    const before = blocked.length > 0 ? [h('span', {class: 'key'}, sample(s('rect', {class: 'area-before', x: 2, y: 1, width: 26, height: 12, fill: 'url(#p-before)'})), `as it looked first: ${blocked.join(' and ')} in the way`)] : [];
    this.legend.replaceChildren(
      ...areas,
      ...before,
      h('span', {class: 'key'}, sample(s('path', {class: 'at-once', d: 'M0,12 L30,2'})), 'started at once'),
      h('span', {class: 'key'}, sample(s('path', {class: 'chosen-line', d: 'M0,12 L30,2'})), 'as chosen'),
      h('span', {class: 'key'}, sample(s('rect', {class: 'free-window', x: 0, y: 3, width: 30, height: 9})), 'start windows'),
    );
  }

  hover(event) {
    const box = this.holder.getBoundingClientRect();
    const [px, py] = [event.clientX - box.left, event.clientY - box.top];
    const inside = this.x && this.drawn && py <= height - margin.bottom && px >= margin.left;
    const found = inside ? areaAt(this.view, this.x.inverse(px), Math.min(this.y.inverse(py), this.view.length)) : null;
    this.tip.hidden = !found;
    if (!found) return;
    const {area, robot} = found;
    const time = (t) => (Number.isFinite(t) ? `${t.toFixed(2)} s` : 'always');
    const when = Number.isFinite(area.t0) && Number.isFinite(area.t1) ? `${time(area.t0)} to ${time(area.t1)}` : Number.isFinite(area.t0) ? `from ${time(area.t0)} on` : `until ${time(area.t1)}`;
    const depth = area.clearance <= 0 ? `${mm(-area.clearance, 1)} deep` : `${mm(area.clearance, 1)} near`;
    this.tip.textContent = `its ${area.own} and ${robot}'s ${area.other}, ${when}, ${depth}`;
    this.tip.style.left = `${Math.min(px + 12, box.width - 230)}px`;
    this.tip.style.top = `${py + 14}px`;
  }
}
