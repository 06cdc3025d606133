import assert from 'node:assert/strict';
import {test} from 'node:test';
import {apply, curveSpan, emptyState, robotIndex} from '../src/store.js';
import {cellFrame, commandFrame, poseFrame} from './frames.js';

function picture(...frames) {
  const state = emptyState();
  for (const frame of frames) apply(state, frame);
  return state;
}

test('a snapshot is its frames, and begins from nothing', () => {
  const state = picture(cellFrame(), commandFrame({id: 'old'}));
  apply(state, {type: 'snapshot', t: 5, frames: [cellFrame(), commandFrame({id: 'new'}), poseFrame(5, 0.2)]});
  assert.deepEqual([...state.commands.keys()], ['new']);
  assert.equal(state.t, 5);
  assert.equal(robotIndex(state, 'r2'), 1);
  assert.equal(robotIndex(state, 'nobody'), -1);
});

test('what was skipped is counted across snapshots', () => {
  const state = picture(cellFrame(), {type: 'skipped', frames: 7}, cellFrame(), {type: 'skipped', frames: 2});
  assert.equal(state.skipped, 9);
});

test('what a recording does is kept across snapshots, and moves the time', () => {
  const player = {type: 'player', t: 12.5, playing: true, speed: 2, seeking: false, error: null};
  const state = picture(cellFrame(), player);
  assert.equal(state.t, 12.5);
  apply(state, {type: 'snapshot', t: 3, frames: [cellFrame(), poseFrame(3, 0.2)]});
  assert.deepEqual(state.player, player);
  assert.equal(state.t, 3);
});

test('frames of kinds that are not known change nothing', () => {
  const state = picture(cellFrame());
  for (const type of ['later', '__proto__', 'constructor', 'toString', undefined]) assert.equal(apply(state, {type, t: 9}), null);
  assert.equal(state.t, 0);
});

test('curves keep one point in a tenth of a second and forget what is old', () => {
  const state = picture(cellFrame());
  for (let i = 0; i <= 300 * 30; ++i) apply(state, poseFrame(i / 30, 0.3));
  const {times, pairs} = state.curves;
  assert.equal(times.length, pairs[0].length);
  assert.ok(times[0] >= 300 - curveSpan - 0.2);
  assert.ok(times.length <= curveSpan * 10 + 2, `${times.length} points`);
});

test('a motion is shown until it is over', () => {
  const state = picture(cellFrame(), {type: 'motion', t: 1, robot: 'r1', id: 'c'});
  assert.equal(state.motions.size, 1);
  apply(state, {type: 'motion_over', t: 2, robot: 'r1', id: 'c'});
  assert.equal(state.motions.size, 0);
});
