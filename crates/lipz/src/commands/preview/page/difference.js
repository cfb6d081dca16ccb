// Two versions of a file as `diff -u` shows them, with the differences within lines marked.

import { made } from "./list.js";

/** Shows a diff in an element. */
export function showDifference(element, text) {
  const lines = text.split("\n");
  element.replaceChildren();
  for (let at = 0; at < lines.length; ) {
    const [removed, added] = pairs(lines, at);
    // Removed and added lines are paired in order.
    for (const [own, other] of [[removed, added], [added, removed]]) {
      own.forEach((line, index) => element.append(...marked(line, other[index]), "\n"));
    }
    at += removed.length + added.length;
    if (removed.length + added.length === 0) element.append(lines[at++], "\n");
  }
  element.querySelector("mark")?.scrollIntoView({ block: "nearest" });
}

/** Returns the lines removed from `at` on, and the added lines after them, without the lines with file names. */
function pairs(lines, at) {
  const run = (from, sign) => {
    const isOther = (line) => !line.startsWith(sign) || line.startsWith(sign.repeat(3));
    const length = lines.slice(from).findIndex(isOther);
    return lines.slice(from, length < 0 ? undefined : from + length);
  };
  const removed = run(at, "-");
  return [removed, run(at + removed.length, "+")];
}

/** Returns a line with a mark around the part that differs from the other line, if there is one. */
function marked(line, other) {
  if (other === undefined) return [line];
  const [a, b] = [line, other].map((text) => Array.from(text));
  const most = Math.min(a.length, b.length);
  let start = 1;
  while (start < most && a[start] === b[start]) start += 1;
  let end = 0;
  while (end < most - start && a.at(-1 - end) === b.at(-1 - end)) end += 1;
  const part = (from, to) => a.slice(from, to).join("");
  const differs = part(start, a.length - end);
  return [part(0, start), ...(differs ? [made("mark", "", differs)] : []), part(a.length - end)];
}
