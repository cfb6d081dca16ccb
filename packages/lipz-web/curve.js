// Curves of a clip: numbers that change while it plays, such as blend shapes and emotions.

import { SECOND, THIRD } from "./memory.js";
import * as c from "./structs.js";
import { at } from "./words.js";

const THOUSAND = 1000;

/** The attributes of emotion, in the order of lipz.h. */
export const EMOTIONS = [
  "sadness",
  "anger",
  "joy",
  "fear",
  "disgust",
  "surprise",
  "shock",
  "perplexed",
  "asleep",
  "pain",
  "exertion",
  "shout",
];

/** What somebody feels, of the fields of an answer. */
export function emotionsOf({ thousandths, strongest, sum }) {
  const values = Object.fromEntries(EMOTIONS.map((name, place) => [name, thousandths[place] / THOUSAND]));
  return { values, strongest: EMOTIONS[strongest], sum: sum / THOUSAND };
}

export class Curve {
  #ofClip;
  #memory;
  #fields;
  /** Where the curve was read last: the next picture needs no search. */
  #cursor = { key: 0 };

  /** @param ofClip calls a function whose first arguments are the bank and the clip */
  constructor(ofClip, memory, fields) {
    this.#ofClip = ofClip;
    this.#memory = memory;
    this.#fields = fields;
    this.name = memory.string(fields.name);
  }

  /** Calls a function whose first arguments are the bank, the clip and this curve. */
  #ask(type, name, ...args) {
    return this.#ofClip(type, name, this.#memory.put(SECOND, c.lipz_curve, this.#fields), ...args);
  }

  /** Calls a function that moves the cursor and gives a value. */
  #value(name, ...args) {
    const memory = this.#memory;
    const thousandths = this.#ask(c.i32, name, memory.put(THIRD, c.lipz_curve_cursor, this.#cursor), ...args);
    this.#cursor = memory.read(THIRD, c.lipz_curve_cursor);
    return thousandths === undefined ? undefined : thousandths / THOUSAND;
  }

  get keyCount() {
    return this.#fields.key_count;
  }

  get keys() {
    const key = (index) => this.#ask(c.lipz_curve_key, "lipz_clip_curve_key", index);
    return Array.from({ length: this.keyCount }, (_, index) => key(index))
      .filter((found) => found !== undefined)
      .map(({ frame, thousandths }) => ({ frame, value: thousandths / THOUSAND }));
  }

  value(frame) {
    return this.#value("lipz_clip_curve_value", frame);
  }

  valueAt(time) {
    const [unit, ...args] = at(time);
    return this.#value(`lipz_clip_curve_value_at_${unit}`, ...args);
  }
}
