// "Did you mean": the known name that is nearest to a misspelt one, by the rule of lipz_diagnostics::suggest.

import { lettersOf } from "./shape-names.js";

/** The number of letters of a known name per letter that may differ. */
const LETTERS_PER_CHANGE = 3;

/** The name from a list that is nearest to a known name; undefined if too many letters differ. */
export function nearest(known, names) {
  const letters = Array.from(lettersOf(known));
  let best = { name: undefined, distance: Math.floor(letters.length / LETTERS_PER_CHANGE) + 1 };
  for (const name of names) {
    const distance = distanceOf(Array.from(lettersOf(name)), letters);
    if (distance < best.distance) best = { name, distance };
  }
  return best.name;
}

/** The number of letters that are missing, wrong, extra or swapped with the next. */
function distanceOf(a, b) {
  let [before, last] = [[], Array.from({ length: b.length + 1 }, (_, index) => index)];
  for (let i = 1; i <= a.length; i++) {
    const row = [i];
    for (let j = 1; j <= b.length; j++) {
      const isEqual = a[i - 1] === b[j - 1];
      row[j] = Math.min(last[j] + 1, row[j - 1] + 1, last[j - 1] + (isEqual ? 0 : 1));
      if (a[i - 1] === b[j - 2] && a[i - 2] === b[j - 1]) row[j] = Math.min(row[j], before[j - 2] + 1);
    }
    [before, last] = [last, row];
  }
  return last[b.length];
}
