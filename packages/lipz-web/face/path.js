// Numbers and paths as short text.

/** A number with one decimal, or with two if it is small, such as an opacity. */
export function px(value) {
  const steps = Math.abs(value) < 1.05 ? 100 : 10;
  // Adding 0 removes the sign of a zero.
  return Math.round(value * steps) / steps + 0;
}

/** A path whose numbers are rounded: path`M${x} ${y}`. */
export function path(texts, ...values) {
  let all = texts[0];
  for (let index = 0; index < values.length; index++) all += px(values[index]) + texts[index + 1];
  return all;
}
