// The keys of variants of texts.

/** The plural categories of Unicode's CLDR, which come first in a key. */
const PLURAL_CATEGORIES = ["zero", "one", "two", "few", "many", "other"];

/** The key and its beginnings, from long to short: `few-fem`, `few`. */
function beginnings(names) {
  return names.map((_, index) => names.slice(0, names.length - index).join("-"));
}

/** The keys that a game's key finds, in order: its beginnings, then those without the leading plural category. */
export function foundKeys(key) {
  const names = key.split("-");
  const behind = PLURAL_CATEGORIES.includes(names[0]) ? names.slice(1) : [];
  return [...beginnings(names), ...beginnings(behind)];
}
