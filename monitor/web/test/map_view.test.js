import assert from 'node:assert/strict';
import {test} from 'node:test';
import {areaAt, chosenWindow, relative, summary} from '../src/map_view.js';

const map = {
  command: 'c', robot: 'r1', ready: 100, judged: 100, start: 104, duration: 3, length_m: 0.3, t: 100.1,
  line: [[0, 0], [3, 0.3]],
  links: ['base', 'eef'],
  windows: [[103.5, null]],
  neighbours: [{robot: 'r2', links: ['base', 'link2'], parts: [], areas: [[101, 103, 0.1, 0.2, 1, 1, -0.02], [null, null, 0.25, 0.3, 0, 1, -0.001]]}],
  before: [],
};

test('times count from when the command could have started, and no end is no end', () => {
  const view = relative(map, 100);
  assert.equal(view.start, 4);
  assert.deepEqual(view.windows, [[3.5, Infinity]]);
  assert.deepEqual([view.neighbours[0].areas[1].t0, view.neighbours[0].areas[1].t1], [-Infinity, Infinity]);
});

test('a place in the map knows whose links meet there', () => {
  const view = relative(map, 100);
  const found = areaAt(view, 2, 0.15);
  assert.equal(found.robot, 'r2');
  assert.deepEqual([found.area.own, found.area.other, found.area.clearance], ['eef', 'link2', -0.02]);
  assert.equal(areaAt(view, 0.5, 0.15), null);
  assert.equal(areaAt(view, 50, 0.27).area.own, 'base');
});

test('the chosen start lies in a window or the map says so', () => {
  assert.deepEqual(chosenWindow(relative(map, 100)), [3.5, Infinity]);
  assert.equal(chosenWindow(relative({...map, start: 102}, 100)), null);
  assert.equal(chosenWindow(relative({...map, start: null}, 100)), null);
});

test('the map in words', () => {
  assert.equal(summary(relative(map, 100), 'r1-3'), 'r1-3 would touch r2 at the wrong time; free to start from 3.5 s on; it starts after 4.0 s.');
  const stuck = relative({...map, start: null, windows: []}, 101);
  assert.match(summary(stuck, 'r1-3'), /no start is free as things are; no start chosen yet/);
});

test('what it looked like first can be asked for too', () => {
  const view = relative({...map, neighbours: [], before: map.neighbours}, 100);
  assert.equal(areaAt(view, 2, 0.15).robot, 'r2');
});
