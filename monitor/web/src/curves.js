// Least clearance of each pair of robots over time, with the line at which they touch.
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import {h, s, setText} from './dom.js';
import {clock, mm} from './format.js';
import {pairStyle} from './palette.js';
import {curveSpan} from './store.js';

const height = 230; // [px]
const most = 600; // [mm]: what is farther is not worth looking at

function css(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/** The line at zero, and below it the ground that nobody may enter. */
function drawZero(plot) {
  const {ctx, bbox} = plot;
  const y = plot.valToPos(0, 'y', true);
  ctx.save();
  ctx.fillStyle = css('--forbidden');
  ctx.fillRect(bbox.left, y, bbox.width, Math.max(0, bbox.top + bbox.height - y));
  ctx.strokeStyle = css('--danger');
  ctx.lineWidth = 2 * devicePixelRatio;
  ctx.beginPath();
  ctx.moveTo(bbox.left, y);
  ctx.lineTo(bbox.left + bbox.width, y);
  ctx.stroke();
  ctx.restore();
}

export class Curves {
  constructor(root, legend) {
    this.root = root;
    this.legend = legend;
    this.values = [];
    new ResizeObserver(() => this.plot?.setSize({width: root.clientWidth, height})).observe(root);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.picture && this.build(this.picture));
  }

  build(picture) {
    this.picture = picture;
    this.plot?.destroy();
    const axis = {stroke: css('--text-soft'), grid: {stroke: css('--grid'), width: 1}, ticks: {show: false}, font: '12px system-ui, sans-serif'};
    const {pairs} = picture.cell;
    this.plot = new uPlot(
      {
        width: Math.max(this.root.clientWidth, 200),
        height,
        legend: {show: false},
        cursor: {drag: {x: false, y: false}},
        scales: {
          x: {time: false, range: () => [Math.max(0, this.picture.t - curveSpan), Math.max(this.picture.t, 10)]},
          y: {range: (plot, low, high) => [Math.min(-40, (low ?? 0) - 20), Math.min(most, Math.max(200, (high ?? 0) + 20))]},
        },
        axes: [
          {...axis, values: (plot, values) => values.map((t) => clock(t).replace(/\.\d$/, '')), incrs: [1, 2, 5, 10, 20, 30, 60], space: 70},
          {...axis, label: 'clearance [mm]', labelFont: '12px system-ui, sans-serif', labelSize: 18, size: 46},
        ],
        series: [{}, ...pairs.map((pair, k) => ({label: pair.join(' – '), stroke: pairStyle(k).colour, dash: pairStyle(k).dash, width: 2, points: {show: false}, spanGaps: false}))],
        hooks: {drawAxes: [drawZero]},
      },
      [[], ...pairs.map(() => [])],
      this.root,
    );
    this.root.querySelector('canvas').setAttribute('aria-hidden', 'true');
    this.legend.replaceChildren(...pairs.map((pair, k) => this.key(pair, k)));
  }

  /** A pair in the legend: show or hide it, and its newest and least values. */
  key(pair, k) {
    const {colour, dash} = pairStyle(k);
    const line = s('line', {x1: 0, y1: 6, x2: 26, y2: 6, stroke: colour, 'stroke-width': 3, 'stroke-dasharray': dash.join(' ')});
    const box = h('input', {type: 'checkbox', checked: true, change: () => this.plot.setSeries(k + 1, {show: box.checked})});
    this.values[k] = h('small');
    return h('label', {class: 'key'}, box, s('svg', {width: 26, height: 12, 'aria-hidden': 'true'}, line), pair.join(' – '), ' ', this.values[k]);
  }

  draw(picture) {
    if (!this.plot) return;
    this.picture = picture;
    const {times, pairs} = picture.curves;
    this.plot.setData([times, ...pairs.map((values) => values.map((d) => (d === null ? null : 1000 * d)))]);
    picture.cell.pairs.forEach((pair, k) => {
      const now = picture.pose?.pairs[k];
      const least = picture.state?.least.find((each) => each.robots.join() === pair.join());
      setText(this.values[k], `${mm(now)}${least ? `, least ${mm(least.clearance_m)} (${least.links.join(' to ')})` : ''}`);
    });
  }
}
