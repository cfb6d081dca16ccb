// Locales and voices, which you look up once and pass to queries. They belong to one dialogue.

import { lipz_locale, lipz_voice } from "./structs.js";

class Handle {
  #type;
  #fields;

  constructor(memory, type, fields) {
    this.#type = type;
    this.#fields = fields;
    this.tag = memory.string(fields.tag);
  }

  /** Writes it into a slot of a memory and returns its address. It is not valid in a different dialogue. */
  put(memory, slot) {
    return memory.put(slot, this.#type, this.#fields);
  }
}

export class Locale extends Handle {
  // The name of the class would not do, because bundlers shorten it.
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

/** Returns a handle of this kind. For any other value, such as a tag, throws an error that explains how to get one. */
export function handleOf(type, value) {
  if (value instanceof type) return value;
  throw new TypeError(`${String(value)} is not a ${type.kind}: look it up once, with dialogue.${type.kind}(tag)`);
}
