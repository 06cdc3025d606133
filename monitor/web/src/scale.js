// Axes: from values to pixels, and round numbers to write beside them. Pure.

/** Maps [from, to] to [low, high], linearly; `inverse` the other way, `from` and `to` as given. */
export function linear(from, to, low, high) {
  const factor = (high - low) / (to - from);
  const scale = (value) => low + (value - from) * factor;
  scale.inverse = (pixel) => from + (pixel - low) / factor;
  return Object.assign(scale, {from, to});
}

/** Round values inside [from, to], at most `most` of them. */
export function ticks(from, to, most) {
  const rough = (to - from) / Math.max(1, most);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((f) => f * power).find((candidate) => candidate >= rough * 0.999);
  const values = [];
  for (let i = Math.ceil(from / step - 1e-9); i * step <= to + step * 1e-9; ++i) values.push(i * step + 0); // no negative zero
  return values;
}
