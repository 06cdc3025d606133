import assert from 'node:assert/strict';
import {test} from 'node:test';
import {clock, commandName, mm, place} from '../src/format.js';
import {clearanceColour, clearanceStops, pairStyle, robotColour} from '../src/palette.js';
import {linear, ticks} from '../src/scale.js';

test('colours run from contact to far without a jump', () => {
  assert.deepEqual(clearanceColour(-0.1), clearanceColour(0));
  assert.deepEqual(clearanceColour(null), clearanceColour(10));
  for (let d = 0; d < 0.3; d += 0.001) {
    const [a, b] = [clearanceColour(d), clearanceColour(d + 0.001)];
    a.forEach((c, i) => assert.ok(Math.abs(c - b[i]) < 0.05, `at ${d}`));
  }
  for (const [d, rgb] of clearanceStops) assert.deepEqual(clearanceColour(d).map((c) => Math.round(255 * c)), rgb);
});

test('no two of eight robots and of 28 curves look alike', () => {
  assert.equal(new Set([...Array(8).keys()].map(robotColour)).size, 8);
  assert.equal(new Set([...Array(28).keys()].map((k) => JSON.stringify(pairStyle(k)))).size, 28);
  assert.equal(robotColour(-1), robotColour(7));
});

test('numbers are written as people read them', () => {
  assert.equal(clock(65.23), '1:05.2');
  assert.equal(clock(null), '–');
  assert.equal(mm(0.1364), '136 mm');
  assert.equal(place([0.4, 0, 0.15]), '(400, 0, 150) mm');
  assert.equal(commandName({robot: 'r2', number: 3, escape: false}), 'r2-3');
  assert.equal(commandName({robot: 'r2', number: 1, escape: true}), 'r2 escape 1');
});

test('axes', () => {
  const x = linear(10, 20, 0, 100);
  assert.equal(x(15), 50);
  assert.equal(x.inverse(50), 15);
  assert.deepEqual(ticks(0, 50, 6), [0, 10, 20, 30, 40, 50]);
  assert.deepEqual(ticks(-0.4, 1.2, 4), [0, 0.5, 1]);
});
