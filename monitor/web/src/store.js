// The picture of a cell as the page knows it, made of frames alone (docs/monitor.md): live ones and those of a recording are the same. Pure.

export const curveSpan = 90; // [s]
const curvePeriod = 0.1; // [s]
const mostCommands = 5000;

/** Nothing known yet. */
export function emptyState() {
  return {
    cell: null,
    bodies: new Map(), // robot → {links, radii}
    commands: new Map(), // id → command, in the order they were heard of
    motions: new Map(), // robot and id → ghost
    alarms: [],
    curves: {times: [], pairs: []},
    state: null,
    pose: null,
    map: null,
    player: null, // of a recording: what it does
    skipped: 0,
    t: 0, // of the newest frame [s]
  };
}

function addPose(picture, frame) {
  picture.pose = frame;
  const {times, pairs} = picture.curves;
  if (times.length > 0 && frame.t - times[times.length - 1] < curvePeriod) return;
  times.push(frame.t);
  pairs.forEach((values, k) => values.push(frame.pairs[k] ?? null));
  let old = 0;
  while (times[old] < frame.t - curveSpan) ++old;
  if (old === 0) return;
  times.splice(0, old);
  for (const values of pairs) values.splice(0, old);
}

const handlers = {
  cell(picture, frame) {
    Object.assign(picture, emptyState(), {cell: frame, skipped: picture.skipped, player: picture.player});
    for (const robot of frame.robots) picture.bodies.set(robot.name, {links: robot.links, radii: robot.radii});
    picture.curves.pairs = frame.pairs.map(() => []);
  },
  bodies(picture, frame) {
    picture.bodies.set(frame.robot, {links: frame.links, radii: frame.radii});
  },
  command(picture, frame) {
    picture.commands.set(frame.id, frame);
    if (picture.commands.size > mostCommands) picture.commands.delete(picture.commands.keys().next().value);
  },
  motion(picture, frame) {
    picture.motions.set(`${frame.robot} ${frame.id}`, frame);
  },
  motion_over(picture, frame) {
    picture.motions.delete(`${frame.robot} ${frame.id}`);
  },
  alarms(picture, frame) {
    picture.alarms = frame.alarms;
  },
  curves(picture, frame) {
    picture.curves = {times: [...frame.times], pairs: frame.pairs.map((values) => [...values])};
  },
  state(picture, frame) {
    picture.state = frame;
  },
  pose: addPose,
  map(picture, frame) {
    picture.map = frame;
  },
  player(picture, frame) {
    picture.player = frame;
  },
  skipped(picture, frame) {
    picture.skipped += frame.frames;
  },
  snapshot(picture, frame) {
    for (const part of frame.frames) apply(picture, part);
  },
};

/** Puts one frame into the picture; frames of kinds that are not known are left out. Returns the kind. */
export function apply(picture, frame) {
  const handler = Object.hasOwn(handlers, frame.type) ? handlers[frame.type] : null;
  if (!handler) return null;
  handler(picture, frame);
  if (typeof frame.t === 'number') picture.t = frame.t;
  return frame.type;
}

/** Index of a robot in the order of the cell; −1: there is none. */
export function robotIndex(picture, name) {
  return picture.cell ? picture.cell.robots.findIndex((robot) => robot.name === name) : -1;
}
