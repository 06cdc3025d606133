// What a collision map says, before it is drawn. Pure. Times are seconds after the command could have started.

/** Windows, areas and lines of a map frame on the axis of the command itself. */
export function relative(map, now) {
  const shift = (t) => (t === null ? null : t - map.ready);
  const start = map.start === null ? null : shift(map.start);
  const areaOf = (links, [t0, t1, l0, l1, own, other, clearance]) => ({
    t0: t0 === null ? -Infinity : shift(t0),
    t1: t1 === null ? Infinity : shift(t1),
    l0,
    l1,
    own: map.links[own],
    other: links[other],
    clearance,
  });
  const neighbourOf = ({robot, links, areas}) => ({robot, areas: areas.map((area) => areaOf(links, area))});
  const until = Math.max(start ?? shift(now), 0) + map.duration + 0.6;
  return {
    start,
    until,
    from: Math.min(-0.4, -0.03 * until),
    now: shift(now),
    length: map.length_m,
    line: map.line,
    windows: map.windows.map(([from, to]) => [shift(from), to === null ? Infinity : shift(to)]),
    judged: shift(map.judged),
    neighbours: map.neighbours.map(neighbourOf),
    before: map.before.map(neighbourOf),
  };
}

/** The area at (t, length), the deepest of several, with its neighbour; null: there is none. */
export function areaAt(view, t, length) {
  return deepest(view.neighbours, t, length) ?? deepest(view.before, t, length);
}

function deepest(neighbours, t, length) {
  let found = null;
  for (const neighbour of neighbours) {
    for (const area of neighbour.areas) {
      if (t < area.t0 || t > area.t1 || length < area.l0 || length > Math.max(area.l1, area.l0)) continue;
      if (!found || area.clearance < found.area.clearance) found = {robot: neighbour.robot, area};
    }
  }
  return found;
}

/** Whether the chosen start lies in a start window; null: there is none. */
export function chosenWindow(view) {
  if (view.start === null) return null;
  const slack = 0.005; // frames are rounded [s]
  return view.windows.find(([from, to]) => view.start >= from - slack && view.start <= to + slack) ?? null;
}

/** Whether a neighbour has areas inside the picture. */
export function inSight(view, neighbour) {
  return neighbour.areas.some((area) => area.t1 > view.from && area.t0 < view.until);
}

/** The map in one sentence. */
export function summary(view, name) {
  const against = [...new Set([...view.before, ...view.neighbours].filter((neighbour) => inSight(view, neighbour)).map((neighbour) => neighbour.robot))];
  const s = (t) => `${t.toFixed(1)} s`;
  const windows = view.windows.map(([from, to]) => (to === Infinity ? `from ${s(from)} on` : `${s(from)} to ${s(to)}`));
  const free = windows.length === 0 ? 'no start is free as things are' : `free to start ${windows.join(', ')}`;
  const chosen = view.start === null ? 'no start chosen yet' : view.start < 0.05 ? 'it starts at once' : `it starts after ${s(view.start)}`;
  const meets = against.length === 0 ? 'meets nobody' : `would touch ${against.join(' and ')} at the wrong time`;
  return `${name} ${meets}; ${free}; ${chosen}.`;
}
