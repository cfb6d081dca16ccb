// Texts that follow their segments when these are divided or joined, and which of the texts a person should review.

import { Mouth } from "./mouth.js";
import { count, dividedAt, dividedByShare, dividedEvents, joined, leading } from "./split.js";

const EVENTS = "events";

/**
 * Returns the elements to change with the mouth: the visemes, and the texts of a segment that it divides or joins. The
 * `review` has the segments to be reviewed, by the name of their element.
 */
export function followed(edits, mouth, clip) {
  const before = Mouth.read(edits.get("visemes") ?? "");
  const elements = { visemes: mouth.toString() };
  const review = { ...edits.review };
  const differs = (one, other) => one.starts.findIndex((start, index) => start !== other.starts[index]);
  const followers = edits.segmented.filter((name) => count(edits.get(name)) === before.starts.length + 1);
  const difference = mouth.starts.length - before.starts.length;
  if (Math.abs(difference) !== 1) return { elements, review };
  const segment = difference === 1 ? differs(mouth, before) : differs(before, mouth);
  for (const name of followers) {
    const text = edits.get(name);
    const marked = review[name] ?? [];
    const moved = marked.map((at) => (at > segment ? at + difference : at));
    if (difference === -1) {
      elements[name] = joined(text, segment + 1, name === EVENTS ? ", " : " ");
      // A single segment has the whole text.
      review[name] = mouth.starts.length === 0 ? [] : distinct(moved);
      continue;
    }
    const { divided, isCertain } = dividedWith(edits, name, text, segment, mouth, clip);
    elements[name] = divided;
    review[name] = isCertain && !marked.includes(segment) ? moved : distinct([...moved, segment, segment + 1]);
  }
  return { elements, review };
}

/** Lists the texts to be reviewed. */
export function listReview(element, review) {
  const lists = Object.entries(review).filter(([, segments]) => segments.length > 0);
  const parts = lists.map(([name, segments]) => {
    const numbers = segments.map((segment) => segment + 1).sort((a, b) => a - b);
    return `${name} (segment${numbers.length > 1 ? "s" : ""} ${numbers.join(", ")})`;
  });
  element.textContent = parts.length > 0 ? `Divided in proportion. Check these texts: ${parts.join("; ")}` : "";
  element.hidden = parts.length === 0;
}

/** Returns an element whose segment is divided like the mouth, and whether the place is certain. */
function dividedWith(edits, name, text, segment, mouth, clip) {
  if (name === EVENTS) return { divided: dividedEvents(text, segment), isCertain: true };
  const frame = mouth.starts[segment];
  const place = positionOf(edits, name, text, segment, clip?.startOfFrame(frame));
  if (place !== undefined) return { divided: dividedAt(text, segment, place), isCertain: true };
  const whole = new Mouth(mouth.codes, mouth.starts.toSpliced(segment, 1));
  const divided = dividedByShare(text, segment, whole.shareBefore(segment, frame));
  return { divided, isCertain: text.split("|")[segment].trim() === "" };
}

/** Returns where the spoken text is at a time, in a segment whose words have times; otherwise undefined. */
function positionOf(edits, name, text, segment, time) {
  const { spoken, words, elements } = edits.page;
  if (name !== spoken || time === undefined) return undefined;
  const places = moved(Object.fromEntries(elements)[name], text);
  if (places === undefined) return undefined;
  const start = text.split("|").slice(0, segment).reduce((sum, part) => sum + part.length + 1, 0);
  const end = start + text.split("|")[segment].length;
  const own = words.map((word) => ({ ...word, at: places.get(word.at) })).filter(({ at }) => start <= at && at < end);
  if (own.length === 0) return undefined;
  const next = own.find(({ start_ms, end_ms }) => (start_ms + end_ms) / 2000 >= time);
  return next === undefined ? end : next.at - leading(text.slice(start, next.at));
}

/**
 * Returns the position in a text for each position in the text of the file, if the texts differ only in the places of
 * their segments and in spaces; otherwise undefined.
 */
function moved(inFile, text) {
  const [from, to] = [inFile, text].map((one) => Array.from(one.matchAll(/[^|\s]/g), ({ index }) => index));
  const isSame = from.length === to.length && from.every((at, number) => inFile[at] === text[to[number]]);
  return isSame ? new Map(from.map((at, number) => [at, to[number]])) : undefined;
}

const distinct = (values) => [...new Set(values)];
