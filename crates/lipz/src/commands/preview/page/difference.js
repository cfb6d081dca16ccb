// Two versions of a file as `diff -u` shows them, with what differs within their lines marked.

import { made } from "./list.js";

/** Shows a difference, from where it is. */
export function showDifference(element, text) {
  const lines = text.split("\n");
  element.replaceChildren();
  for (let at = 0; at < lines.length; ) {
    const [removed, added] = pairs(lines, at);
    // Lines belong to each other in their order.
    for (const [own, other] of [[removed, added], [added, removed]]) {
      own.forEach((line, index) => element.append(...marked(line, other[index]), "\n"));
    }
    at += removed.length + added.length;
    if (removed.length + added.length === 0) element.append(lines[at++], "\n");
  }
  element.querySelector("mark")?.scrollIntoView({ block: "nearest" });
}

/** The lines from a place that were removed, and those behind them that were added; the names of files are neither. */
function pairs(lines, at) {
  const run = (from, sign) => {
    const isOther = (line) => !line.startsWith(sign) || line.startsWith(sign.repeat(3));
    const length = lines.slice(from).findIndex(isOther);
    return lines.slice(from, length < 0 ? undefined : from + length);
  };
  const removed = run(at, "-");
  return [removed, run(at + removed.length, "+")];
}

/** A line with a mark around what the other one does not have; without one, if there is no other. */
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
