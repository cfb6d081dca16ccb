// Babble: mouth movement for a voice without visemes.

import { FIRST } from "./memory.js";
import { lipz_babble, lipz_weights } from "./structs.js";
import { TEN_THOUSAND } from "./words.js";

/** The power for a voice that the program does not measure. */
export const UNMEASURED = 0.75;

export class Babble {
  #memory;
  #fields;

  constructor(memory, fields) {
    this.#memory = memory;
    this.#fields = fields;
    this.name = memory.string(fields.name);
  }

  /** Returns the movement of lips and jaw at a time since the start of speech, for a power from 0 to 1. */
  at(elapsed, power = UNMEASURED) {
    const memory = this.#memory;
    const babble = memory.put(FIRST, lipz_babble, this.#fields);
    const { ooh, aah } = memory.ask(lipz_weights, "lipz_babble_at", babble, memory.time(elapsed), power);
    return { ooh: ooh / TEN_THOUSAND, aah: aah / TEN_THOUSAND };
  }
}
