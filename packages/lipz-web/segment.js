// A segment of a clip: its frames, texts and events.

import { Locale, handleOf } from "./handle.js";
import { FIRST, SECOND } from "./memory.js";
import * as c from "./structs.js";
import { eventOf } from "./words.js";

export class Segment {
  #memory;
  #fields;

  constructor(memory, fields) {
    this.#memory = memory;
    this.#fields = fields;
  }

  /** Calls a function whose first arguments are the dialogue and this segment. */
  #ask(type, name, ...args) {
    return this.#memory.ask(type, name, this.#address, ...args);
  }

  get #address() {
    return this.#memory.put(FIRST, c.lipz_segment, this.#fields);
  }

  get index() {
    return this.#fields.index;
  }

  get startFrame() {
    return this.#fields.start_frame;
  }

  get endFrame() {
    return this.#fields.end_frame;
  }

  /** The text in a locale; undefined without a locale, or if the clip has no text even by fallback. */
  text(locale) {
    if (locale === undefined) return undefined;
    const memory = this.#memory;
    const found = this.#ask(c.lipz_text, "lipz_segment_text", handleOf(Locale, locale).put(memory, SECOND));
    return found && { text: memory.string(found), isFallback: found.is_fallback !== 0 };
  }

  /** The event string; undefined if the file has no events. */
  get event() {
    const string = this.#ask(c.lipz_string, "lipz_segment_event_string");
    return string && this.#memory.string(string);
  }

  /** The events, if they are in Character Event Syntax. */
  get events() {
    const found = this.#memory.askAll(c.lipz_event, "lipz_segment_event", this.#address);
    return found.map((event) => eventOf(this.#memory, event));
  }
}

/** The segment with these fields, if there are any. */
export function segmentOf(memory, fields) {
  return fields && new Segment(memory, fields);
}
