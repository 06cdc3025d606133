import assert from 'node:assert/strict';
import {test} from 'node:test';
import {barsOf, latestDelay} from '../src/bars.js';
import {ordered} from '../src/command_table.js';
import {commandFrame} from './frames.js';

const kinds = (command, now) => barsOf(commandFrame(command), now).map((bar) => `${bar.kind} ${bar.from}-${bar.to}`);

test('a command is seen from the moment it is held up', () => {
  assert.deepEqual(kinds({state: 'queued'}, 5), []);
  assert.deepEqual(kinds({state: 'waiting', waiting_since: 2}, 5), ['waiting 2-5']);
  assert.deepEqual(kinds({state: 'scheduled', start: 8, end: 10, delay: 5}, 5), ['delayed 3-8', 'planned 8-10']);
  assert.deepEqual(kinds({state: 'started', start: 8, end: 10, delay: 5}, 9), ['delayed 3-8', 'moving 8-9', 'planned 9-10']);
  assert.deepEqual(kinds({state: 'completed', start: 8, end: 10, delay: 0}, 20), ['moving 8-10']);
  assert.deepEqual(kinds({state: 'failed', start: 8, end: null}, 9), ['failed 8-9']);
  assert.deepEqual(kinds({state: 'cancelled', start: 8, end: 10}, 9), []);
  assert.deepEqual(kinds({state: 'rejected', submitted: 3}, 9), ['rejected 3-3']);
});

test('a motion that takes longer than predicted does not run ahead of the time', () => {
  assert.deepEqual(kinds({state: 'started', start: 8, end: 10}, 12), ['moving 8-10']);
});

test('the bars of an escape say so', () => {
  assert.ok(barsOf(commandFrame({state: 'completed', start: 1, end: 2, escape: true}), 3).every((bar) => bar.escape));
});

test('the latest delay is who waits now, else who was delayed last', () => {
  const was = commandFrame({id: 'was', state: 'completed', start: 9, end: 10, delay: 4});
  const waits = commandFrame({id: 'waits', state: 'waiting', waiting_since: 3});
  const prompt = commandFrame({id: 'prompt', state: 'started', start: 11, end: 12, delay: 0});
  const escape = commandFrame({id: 'escape', state: 'waiting', waiting_since: 12, escape: true});
  assert.equal(latestDelay([prompt, escape]), null);
  assert.equal(latestDelay([was, prompt]).id, 'was');
  assert.equal(latestDelay([was, waits, prompt]).id, 'waits');
});

test('the table begins with what is in work', () => {
  const command = (id, state, number, end) => commandFrame({id, state, number, end});
  const order = ordered([command('done', 'completed', 1, 3), command('later', 'completed', 2, 5), command('next', 'queued', 4), command('runs', 'started', 3)]);
  assert.deepEqual(order.map((each) => each.id), ['runs', 'next', 'later', 'done']);
});
