// What of a command is seen in the chart. Pure.

const atOnce = 0.05; // [s]: a shorter delay is not shown

/**
 * Bars of `command` at the time `now`: {kind, from, to}, kind one of waiting (cannot start, no end known), delayed (its start is later than it
 * could be), planned (will move), moving (moves or moved), failed, rejected. Of an escape all of them carry escape: true.
 */
export function barsOf(command, now) {
  const bars = [];
  const add = (kind, from, to) => {
    if (to > from || kind === 'rejected') bars.push({kind, from, to, escape: command.escape});
  };
  const {state, start, end} = command;
  if (state === 'rejected') add('rejected', command.submitted, command.submitted);
  if (state === 'waiting' && command.waiting_since !== null) add('waiting', command.waiting_since, now);
  if (state === 'waiting' || start === null) return bars;
  if (state === 'cancelled') return bars;
  if (command.delay > atOnce) add('delayed', start - command.delay, start);
  if (state === 'scheduled') add('planned', start, end ?? start);
  if (state === 'started') {
    add('moving', start, Math.min(now, end ?? now));
    if (end !== null) add('planned', Math.max(start, now), end);
  }
  if (state === 'completed') add('moving', start, end ?? start);
  if (state === 'failed') add('failed', start, end ?? now);
  return bars;
}

/** The command the map shows when nobody has chosen one: the one that waits now, else the newest that was delayed; null: none. */
export function latestDelay(commands) {
  let found = null;
  for (const command of commands) {
    if (command.escape) continue;
    const waits = command.state === 'waiting' || (command.state === 'scheduled' && command.delay > atOnce);
    const was = command.delay > atOnce && command.start !== null && (command.state === 'started' || command.state === 'completed');
    if (!waits && !was) continue;
    const rank = waits ? 1 : 0;
    const at = command.start ?? command.waiting_since ?? command.submitted;
    if (!found || rank > found.rank || (rank === found.rank && at > found.at)) found = {command, rank, at};
  }
  return found ? found.command : null;
}
