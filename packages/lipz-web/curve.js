// Curves of a clip: numbers that change while it plays, such as blend shapes and emotions.

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
  #ask;
  #fields;

  /** @param ask calls a function whose first arguments are the bank, the clip and this curve */
  constructor(ask, name, fields) {
    this.#ask = ask;
    this.#fields = fields;
    this.name = name;
  }

  get keyCount() {
    return this.#fields.key_count;
  }

  get keys() {
    const key = (index) => this.#ask(c.lipz_curve_key, "lipz_clip_curve_key", this.#fields, index);
    return Array.from({ length: this.keyCount }, (_, index) => key(index))
      .filter((found) => found !== undefined)
      .map(({ frame, thousandths }) => ({ frame, value: thousandths / THOUSAND }));
  }

  value(frame) {
    return this.#ask(c.i32, "lipz_clip_curve_value", this.#fields, frame) / THOUSAND;
  }

  valueAt(time) {
    const [unit, ...args] = at(time);
    const thousandths = this.#ask(c.i32, `lipz_clip_curve_value_at_${unit}`, this.#fields, ...args);
    return thousandths === undefined ? undefined : thousandths / THOUSAND;
  }
}
