// Texts of a clip while its segments are divided and joined, and which of them a person should review.

import { Mouth } from "./mouth.js";
import { count, dividedAt, dividedByShare, dividedEvents, joined, leading } from "./split.js";

const EVENTS = "events";

export class Division {
  /** The segments to be reviewed, by the name of their element. */
  #review = new Map();

  /** Returns the elements to change with the mouth: the visemes, and the texts of a segment that it divides or joins. */
  of(edits, mouth, clip) {
    const before = Mouth.read(edits.get("visemes") ?? "");
    const elements = { visemes: mouth.toString() };
    const differs = (one, other) => one.starts.findIndex((start, index) => start !== other.starts[index]);
    const followers = edits.segmented.filter((name) => count(edits.get(name)) === before.starts.length + 1);
    const difference = mouth.starts.length - before.starts.length;
    if (Math.abs(difference) !== 1) return elements;
    const segment = difference === 1 ? differs(mouth, before) : differs(before, mouth);
    for (const name of followers) {
      const text = edits.get(name);
      elements[name] = difference === 1 ? this.#divided(edits, name, text, segment, mouth, clip) : this.#joined(name, text, segment);
    }
    return elements;
  }

  /** Returns the segments of an element to be reviewed, or undefined. */
  review(name) {
    return this.#review.get(name);
  }

  /** Takes note that a person looks at a text. Returns whether it was to be reviewed. */
  looked(name, segment) {
    return this.#review.get(name)?.delete(segment) ?? false;
  }

  /** Shows which texts are to be reviewed. */
  tell(element) {
    const lists = Array.from(this.#review, ([name, segments]) => [name, Array.from(segments, (segment) => segment + 1).sort((a, b) => a - b)]);
    const parts = lists.filter(([, segments]) => segments.length > 0).map(([name, segments]) => `${name} (segment ${segments.join(", ")})`);
    element.textContent = parts.length > 0 ? `Divided in proportion. Check these texts: ${parts.join("; ")}` : "";
    element.hidden = parts.length === 0;
  }

  #divided(edits, name, text, segment, mouth, clip) {
    if (name === EVENTS) return dividedEvents(text, segment);
    this.#shift(name, segment, 1);
    const frame = mouth.starts[segment];
    const place = positionOf(edits, name, text, segment, clip?.startOfFrame(frame));
    if (place !== undefined) return dividedAt(text, segment, place);
    if (text.split("|")[segment].trim() !== "") {
      const review = this.#review.get(name) ?? new Set();
      this.#review.set(name, review.add(segment).add(segment + 1));
    }
    const whole = new Mouth(mouth.codes, mouth.starts.toSpliced(segment, 1));
    return dividedByShare(text, segment, whole.shareBefore(segment, frame));
  }

  #joined(name, text, segment) {
    this.#shift(name, segment + 1, -1);
    return joined(text, segment + 1, name === EVENTS ? ", " : " ");
  }

  /** Moves what is noted about the segments after one. */
  #shift(name, after, by) {
    const segments = Array.from(this.#review.get(name) ?? []);
    this.#review.set(name, new Set(segments.map((segment) => (segment > after ? segment + by : segment))));
  }
}

/** Returns where the spoken text is at a time, in a segment whose words have times; otherwise undefined. */
function positionOf(edits, name, text, segment, time) {
  const { spoken, words, elements } = edits.page;
  const isAsHeard = name === spoken && Object.fromEntries(elements)[name] === text;
  if (!isAsHeard || time === undefined) return undefined;
  const start = text.split("|").slice(0, segment).reduce((sum, part) => sum + part.length + 1, 0);
  const end = start + text.split("|")[segment].length;
  const own = words.filter(({ at }) => start <= at && at < end);
  if (own.length === 0) return undefined;
  const next = own.find(({ start_ms, end_ms }) => (start_ms + end_ms) / 2000 >= time);
  return next === undefined ? end : next.at - leading(text.slice(start, next.at));
}
