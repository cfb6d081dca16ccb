// A set of banks: its index says which of them has a clip, and that one is loaded when it is asked for.

import { FIRST, LipzError } from "./memory.js";
import * as c from "./structs.js";

/** The status of a bank that is not the one that the index names. */
const OTHER_BANK = 44;

export class BankSet {
  #memory;
  #set;
  #load;
  #info;
  /** The banks that were asked for, as promises. */
  #opened = new Map();
  #banks;

  /** `load` gives the bank of a file name, with its length and the checksum in its header. */
  constructor(memory, index, load) {
    this.#memory = memory;
    this.#load = load;
    this.#set = memory.slot(FIRST);
    memory.check("lipz_set_open", memory.add(index), index.byteLength, this.#set);
    this.#info = memory.ask(c.lipz_set_info_t, "lipz_set_info", this.#set);
    this.#banks = Array.from({ length: this.#info.bank_count }, (_, number) => {
      const bank = memory.ask(c.lipz_set_bank, "lipz_set_bank_at", this.#set, number);
      return Object.freeze({
        fileName: memory.string(bank.file_name),
        clipCount: bank.clip_count,
        lengthBytes: bank.length_bytes,
        fingerprint: bank.fingerprint,
        checksum: bank.checksum,
      });
    });
  }

  /** What the index says about each bank, in order. */
  get banks() {
    return [...this.#banks];
  }

  get clipCount() {
    return Number(this.#info.clip_count);
  }

  get fingerprint() {
    return this.#info.fingerprint;
  }

  /** The number of the bank that has the clip with this key or id, if any bank has it. */
  bankNumberOf(keyOrId) {
    const memory = this.#memory;
    const id = typeof keyOrId === "bigint" ? keyOrId : memory.ask(c.u64, "lipz_clip_id_of_key", ...memory.text(keyOrId));
    return memory.ask(c.u32, "lipz_set_bank_of", this.#set, id);
  }

  /** The bank with this number, verified. It is loaded once, and again only if that fails. */
  bank(number) {
    const entry = this.#banks[number];
    if (entry === undefined) return Promise.reject(new LipzError(`the set has no bank ${number}`));
    if (!this.#opened.has(number)) {
      const opened = this.#open(entry);
      this.#opened.set(number, opened);
      opened.catch(() => this.#opened.delete(number));
    }
    return this.#opened.get(number);
  }

  /** The clip with this key, or with this id if it is a bigint: of a bank that is loaded if it is not there yet. */
  async clip(keyOrId) {
    const bank = await this.bank(this.bankNumberOf(keyOrId));
    return bank.clip(keyOrId);
  }

  async #open(entry) {
    const { bank, lengthBytes, checksum } = await this.#load(entry.fileName);
    // The bank has a memory of its own, so that a set may be larger than one. What the index says of it is here.
    const isNamed = checksum === entry.checksum && lengthBytes === entry.lengthBytes;
    if (!isNamed || bank.fingerprint !== entry.fingerprint || bank.clipCount !== entry.clipCount) {
      this.#memory.refuse(OTHER_BANK);
    }
    return bank.verify();
  }
}
