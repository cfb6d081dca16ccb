// Babble: a mouth that moves while somebody speaks whose mouth shapes nobody knows.

import { BANK, FIRST } from "./memory.js";
import * as c from "./structs.js";
import { at, TEN_THOUSAND } from "./words.js";

/** The power of a voice that nobody measures. */
export const UNMEASURED = 0.75;

export class Babble {
  #memory;
  #fields;

  constructor(memory, fields) {
    this.#memory = memory;
    this.#fields = fields;
  }

  get name() {
    return this.#memory.string(this.#fields.name);
  }

  /** How far lips and jaw are moved, so long after somebody has begun to speak, at a power of the voice from 0 to 1. */
  at(elapsed, power = UNMEASURED) {
    const [unit, ...args] = at(elapsed);
    const babble = this.#memory.put(FIRST, c.lipz_babble, this.#fields);
    const slot = this.#memory.slot(BANK);
    const { ooh, aah } = this.#memory.ask(c.lipz_weights, `lipz_babble_at_${unit}`, slot, babble, ...args, power);
    return { ooh: ooh / TEN_THOUSAND, aah: aah / TEN_THOUSAND };
  }
}
