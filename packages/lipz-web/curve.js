// Curves of a clip: numbers that change while it plays, such as blend shapes and emotions.

import { FIRST, SECOND } from "./memory.js";
import * as c from "./structs.js";
import { THOUSAND } from "./words.js";

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

/** The emotions of a character, from the fields of a result. */
export function emotionsOf({ thousandths, strongest, sum }) {
  const values = Object.fromEntries(EMOTIONS.map((name, place) => [name, thousandths[place] / THOUSAND]));
  return { values, strongest: EMOTIONS[strongest], sum: sum / THOUSAND };
}

export class Curve {
  #memory;
  #fields;
  /** The last position in the curve, so that the next rendered frame needs no search. */
  #cursor = { key: 0 };

  constructor(memory, fields) {
    this.#memory = memory;
    this.#fields = fields;
    this.name = memory.string(fields.name);
  }

  /** Calls a function whose first arguments are the dialogue and this curve. */
  #ask(type, name, ...args) {
    return this.#memory.ask(type, name, this.#memory.put(FIRST, c.lipz_curve, this.#fields), ...args);
  }

  get keyCount() {
    return this.#fields.key_count;
  }

  get keys() {
    return Array.from({ length: this.keyCount }, (_, index) => this.#ask(c.lipz_curve_key_t, "lipz_curve_key", index))
      .filter((found) => found !== undefined)
      .map(({ frame, thousandths }) => ({ frame, value: thousandths / THOUSAND }));
  }

  /** The value at the start of a frame. */
  value(frame) {
    const thousandths = this.#ask(c.i32, "lipz_curve_value", frame);
    return thousandths === undefined ? undefined : thousandths / THOUSAND;
  }

  /** The value at a time; undefined without a frame rate. */
  valueAt(time) {
    const memory = this.#memory;
    const cursor = memory.put(SECOND, c.lipz_curve_cursor, this.#cursor);
    const thousandths = this.#ask(c.i32, "lipz_curve_value_at", memory.time(time), cursor);
    const moved = memory.read(cursor, c.lipz_curve_cursor);
    // New values need a new struct, because `put` compares the identity of structs.
    if (moved.key !== this.#cursor.key) this.#cursor = moved;
    return thousandths === undefined ? undefined : thousandths / THOUSAND;
  }
}
