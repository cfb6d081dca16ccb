// Babble: a mouth that moves while a character speaks whose mouth shapes are not known.

import { FIRST } from "./memory.js";
import { lipz_babble, lipz_weights } from "./structs.js";
import { TEN_THOUSAND } from "./words.js";

/** The power of a voice that a program does not measure. */
export const UNMEASURED = 0.75;

export class Babble {
  #memory;
  #fields;

  constructor(memory, fields) {
    this.#memory = memory;
    this.#fields = fields;
    this.name = memory.string(fields.name);
  }

  /** How far lips and jaw are moved, a time after the character began to speak, at a power of the voice from 0 to 1. */
  at(elapsed, power = UNMEASURED) {
    const memory = this.#memory;
    const babble = memory.put(FIRST, lipz_babble, this.#fields);
    const { ooh, aah } = memory.ask(lipz_weights, "lipz_babble_at", babble, memory.time(elapsed), power);
    return { ooh: ooh / TEN_THOUSAND, aah: aah / TEN_THOUSAND };
  }
}
