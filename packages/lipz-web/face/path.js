// Numbers and paths as short text.

/** A number with one or two digits behind the point, as short as it can be. */
export function px(value) {
  return Math.abs(value) < 1.05 ? Number(value.toFixed(2)) + 0 : Number(value.toFixed(1)) + 0;
}

/** A path whose numbers are rounded: path`M${x} ${y}`. */
export function path(texts, ...values) {
  return texts.reduce((all, text, index) => `${all}${px(values[index - 1])}${text}`);
}
