// Numbers as people read them. Pure.

/** Time on the observer's line, "1:05.2". */
export function clock(t) {
  if (t === null || t === undefined) return '–';
  const minutes = Math.floor(Math.max(0, t) / 60);
  const rest = Math.max(0, t) - 60 * minutes;
  return `${minutes}:${rest.toFixed(1).padStart(4, '0')}`;
}

/** A length [m] in millimetres, "136 mm". */
export function mm(length, places = 0) {
  return length === null || length === undefined ? '–' : `${(1000 * length).toFixed(places)} mm`;
}

export function seconds(t, places = 1) {
  return t === null || t === undefined ? '–' : `${t.toFixed(places)} s`;
}

/** "(400, 0, 150) mm". */
export function place(p) {
  return p ? `(${p.map((x) => (1000 * x).toFixed(0)).join(', ')}) mm` : '–';
}

/** What a command is called on the page: the third of r2 is "r2-3", its first escape "r2 escape 1". */
export function commandName(command) {
  return command.escape ? `${command.robot} escape ${command.number}` : `${command.robot}-${command.number}`;
}

/** The reason codes of the wire contract in words. */
export const reasons = {
  none: '',
  bad_request: 'not a possible request',
  unreachable: 'out of reach',
  joint_limit: 'joint limit on the way',
  joint_speed: 'a joint would be too fast',
  joint_jump: 'the posture would jump',
  self_collision: 'the arm would touch itself',
  base_collision: "a neighbour's base is in the way",
  queue_full: 'queue is full',
  blocked: 'another arm stands in the way',
  delayed: 'lets others pass first',
  robot_unknown: 'a robot is not heard from',
  not_ready: 'its robot is not ready',
  refused_by_proxy: 'start was refused, planned again',
  controller_fault: 'controller fault',
  on_request: 'cancelled',
  unknown_id: 'no such command',
  escape: 'makes room for another command',
  deadlock: 'needs a person',
  fixture_collision: 'a fixture is in the way',
  tool: 'tool is not there',
};
