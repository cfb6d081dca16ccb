// What is looked up once and passed to queries: locales and voices. They are those of one dialogue.

import { lipz_locale, lipz_voice } from "./structs.js";

class Handle {
  #type;
  #fields;

  constructor(memory, type, fields) {
    this.#type = type;
    this.#fields = fields;
    this.tag = memory.string(fields.tag);
  }

  /** Writes it into a slot of a memory and returns its address. In that of another dialogue, it leads to nothing. */
  put(memory, slot) {
    return memory.put(slot, this.#type, this.#fields);
  }
}

export class Locale extends Handle {
  // Not the name of the class, which bundlers shorten.
  static kind = "locale";

  constructor(memory, fields) {
    super(memory, lipz_locale, fields);
    this.isDefault = fields.is_default !== 0;
  }
}

export class Voice extends Handle {
  static kind = "voice";

  constructor(memory, fields) {
    super(memory, lipz_voice, fields);
    this.isOriginal = fields.is_original !== 0;
  }
}

/** A handle of this kind; an error that says how to get one for anything else, such as its tag. */
export function handleOf(type, value) {
  if (value instanceof type) return value;
  throw new TypeError(`${String(value)} is not a ${type.kind}: look it up once, with dialogue.${type.kind}(tag)`);
}
