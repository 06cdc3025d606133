// Frames as the server sends them, for the tests of the page.

export function cellFrame() {
  const robot = (name, y) => ({name, model: 'arm', links: ['base', 'eef'], radii: [0.1, 0.05], base: {p: [0, y, 0], q: [1, 0, 0, 0]}});
  return {type: 'cell', version: 1, t: 0, cell: 'two', robots: [robot('r1', 0.25), robot('r2', -0.25)], fixtures: [], pairs: [['r1', 'r2']]};
}

export function poseFrame(t, clearance) {
  return {type: 'pose', t, robots: [null, null], pairs: [clearance]};
}

export function commandFrame(more) {
  return {
    type: 'command', t: 0, id: 'c', robot: 'r1', number: 1, escape: false, serves: null, state: 'queued', reason: 'none', text: '',
    submitted: 0, waiting_since: null, start: null, end: null, delay: 0, window: null, ...more,
  };
}
