// Colours that people with any colour vision can tell apart: Okabe and Ito's set. Never the only sign of anything. Pure.

const robots = ['#0072b2', '#e69f00', '#009e73', '#cc79a7', '#56b4e9', '#d55e00', '#8c7a00', '#7f7f7f'];

/** Of the robot number `index` in the order of the cell. */
export function robotColour(index) {
  return robots[((index % robots.length) + robots.length) % robots.length];
}

const pairs = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9', '#8c7a00'];
const dashes = [[], [8, 4], [2, 3], [10, 3, 2, 3]];

/** Colour and dashes of a curve: no two of the first 28 are the same. */
export function pairStyle(index) {
  return {colour: pairs[index % pairs.length], dash: dashes[Math.floor(index / pairs.length) % dashes.length]};
}

/** Stops of the clearance scale: clearance [m] and colour. */
export const clearanceStops = [
  [0, [0xd5, 0x5e, 0x00]],
  [0.04, [0xe6, 0x9f, 0x00]],
  [0.12, [0xf0, 0xd8, 0x42]],
  [0.25, [0xa3, 0xb8, 0xc8]],
];

/** Red, green and blue 0 … 1 for a clearance [m]; contact is the first stop, unknown counts as far. */
export function clearanceColour(clearance) {
  const d = clearance === null || clearance === undefined ? Infinity : clearance;
  const first = clearanceStops[0];
  const last = clearanceStops[clearanceStops.length - 1];
  if (d <= first[0]) return first[1].map((c) => c / 255);
  if (d >= last[0]) return last[1].map((c) => c / 255);
  const above = clearanceStops.findIndex((stop) => stop[0] > d);
  const [d0, low] = clearanceStops[above - 1];
  const [d1, high] = clearanceStops[above];
  const f = (d - d0) / (d1 - d0);
  return low.map((c, i) => (c + f * (high[i] - c)) / 255);
}
