// The memory of one instance of the module, which has one dialogue. Files, strings and structs are written to it, and
// results are read from it.

import { LipzError, NONE, OK, remedyFor } from "./error.js";
import { isSampleRate } from "./frame-time.js";
import { lipz_problem, lipz_string, lipz_time } from "./structs.js";

const PAGE_BYTES = 65536;
/** The alignment of every allocation, which is sufficient for any struct. */
const ALIGN_BYTES = 64;
/** Room for the first strings. */
const TEXT_BYTES = 1024;

/** Slots for the structs that are passed to functions, and for their results. */
export const FIRST = 0;
export const SECOND = 1;
export const THIRD = 2;
export const FOURTH = 3;
/** Slots for results that the next function reads, without objects in between. */
export const KEPT_MOUTH = 4;
export const KEPT_EMOTIONS = 5;
export const KEPT_FACE = 6;
const TIME = 7;
const PROBLEM = 8;
const ANSWER = 9;
const SLOTS = 10;

/** The `rate_hz` of a time in seconds. */
const SECONDS = 0xffffffff;

const DECODER = new TextDecoder("utf-8", { ignoreBOM: true });
const ENCODER = new TextEncoder();

export class Memory {
  /** The size of a slot, larger than any struct that is passed in one. */
  static SLOT_BYTES = 256;

  /** The address of the dialogue, once it is open. */
  dialogue = 0;
  #functions;
  #memory;
  /** The first free byte. No later byte is in use. */
  #end;
  #slots;
  #text;
  /** Whether the last time was in seconds, so that only the number changes. */
  #isInSeconds = false;
  /** The struct in each slot, to avoid writing it again. */
  #held = [];
  /** The whole memory, as bytes and as numbers. */
  #bytes;
  #view;

  constructor({ exports: { memory, ...functions } }) {
    this.#memory = memory;
    this.#functions = functions;
    this.#renewViews();
    // Rust owns the memory that exists at the start, for its stack and its constants.
    this.#end = memory.buffer.byteLength;
    this.#slots = this.allocate(SLOTS * Memory.SLOT_BYTES);
    this.#text = { at: this.allocate(TEXT_BYTES), capacity: TEXT_BYTES };
  }

  /** Allocates a number of bytes permanently, and returns their address. */
  allocate(length) {
    const at = Math.ceil(this.#end / ALIGN_BYTES) * ALIGN_BYTES;
    const missing = at + length - this.#memory.buffer.byteLength;
    if (missing > 0) {
      this.#memory.grow(Math.ceil(missing / PAGE_BYTES));
      this.#renewViews();
    }
    this.#end = at + length;
    return at;
  }

  /** Creates the views of the buffer, which growing replaces. The module itself never grows its memory. */
  #renewViews() {
    this.#bytes = new Uint8Array(this.#memory.buffer);
    this.#view = new DataView(this.#memory.buffer);
  }

  /** Copies the bytes of a file and calls `use` with their address. If `use` throws an error, frees the bytes again. */
  store(bytes, use) {
    const end = this.#end;
    try {
      const at = this.allocate(bytes.byteLength);
      this.#bytes.set(bytes, at);
      return use(at);
    } catch (error) {
      this.#end = end;
      throw error;
    }
  }

  /** The byte at an address. */
  byte(at) {
    return this.#bytes[at];
  }

  /** The signed number of 32 bits at an address. */
  int(at) {
    return this.#view.getInt32(at, true);
  }

  /** The bytes at an address, until the memory grows. */
  bytes(at, length) {
    return this.#bytes.subarray(at, at + length);
  }

  /** The address of a slot. */
  slot(number) {
    return this.#slots + number * Memory.SLOT_BYTES;
  }

  /** Writes a struct into a slot and returns its address. Do not change the struct after that; create a new one. */
  put(number, type, value) {
    const at = this.slot(number);
    if (this.#held[number] !== value) {
      type.write(this.#view, at, value);
      this.#held[number] = value;
    }
    return at;
  }

  /** Writes the bytes of a struct into a slot and returns its address. */
  putBytes(number, bytes) {
    const at = this.slot(number);
    this.#held[number] = undefined;
    this.#bytes.set(bytes, at);
    return at;
  }

  /** A copy of the bytes of the struct in a slot. */
  copy(number, length) {
    const at = this.slot(number);
    return this.#bytes.slice(at, at + length);
  }

  /** A copy of the bytes of the last result. */
  answer(length) {
    return this.copy(ANSWER, length);
  }

  /** Reads a struct at an address. */
  read(at, type) {
    return type.read(this.#view, at);
  }

  /** Writes a struct to an address. */
  write(at, type, value) {
    type.write(this.#view, at, value);
  }

  /** Writes a string, and returns its address and length in bytes. They are valid until the next string is written. */
  text(string) {
    const bytes = ENCODER.encode(string);
    if (bytes.length > this.#text.capacity) {
      const capacity = Math.max(bytes.length, 2 * this.#text.capacity);
      this.#text = { at: this.allocate(capacity), capacity };
    }
    this.#bytes.set(bytes, this.#text.at);
    return [this.#text.at, bytes.length];
  }

  /** Writes a time and returns its address. */
  time(time) {
    const at = this.slot(TIME);
    const view = this.#view;
    if (typeof time === "number" && this.#isInSeconds) {
      view.setFloat64(at + lipz_time.places.count, time, true);
      return at;
    }
    this.#isInSeconds = typeof time === "number";
    const { count, rate_hz } = lipz_time.places;
    if (this.#isInSeconds) {
      view.setFloat64(at + count, time, true);
      view.setUint32(at + rate_hz, SECONDS, true);
      return at;
    }
    const [units, rate] = timeOf(time);
    view.setBigInt64(at + count, units, true);
    view.setUint32(at + rate_hz, rate, true);
    return at;
  }

  /** Reads a string. */
  string({ data, length_bytes }) {
    return DECODER.decode(this.bytes(data, length_bytes));
  }

  /** Queries the dialogue with a function whose last argument receives the result; undefined if there is none. */
  ask(type, name, ...args) {
    const status = this.#functions[name](this.dialogue, ...args, this.slot(ANSWER));
    if (status === NONE) return undefined;
    this.must(status);
    return type.read(this.#view, this.slot(ANSWER));
  }

  /** All results of a query that takes an index. */
  askAll(type, name, ...args) {
    const answers = [];
    for (;;) {
      const answer = this.ask(type, name, ...args, answers.length);
      if (answer === undefined) return answers;
      answers.push(answer);
    }
  }

  /** Queries the dialogue, and keeps the result in a slot. Returns its address; undefined if there is none. */
  keep(number, name, ...args) {
    const at = this.slot(number);
    const status = this.#functions[name](this.dialogue, ...args, at);
    if (status === NONE) return undefined;
    this.must(status);
    return at;
  }

  /** Calls a function with the dialogue, and returns its status. */
  status(name, ...args) {
    return this.#functions[name](this.dialogue, ...args);
  }

  /** Calls a function without the dialogue, and returns its status and its result. */
  call(type, name, ...args) {
    const status = this.#functions[name](...args, this.slot(ANSWER));
    return { status, answer: type.read(this.#view, this.slot(ANSWER)) };
  }

  /** The address to which a function writes the number of an unusable file. */
  get problem() {
    return this.slot(PROBLEM);
  }

  /** Throws an error unless a status is that of success. `nameOf` returns the name of a file by its number. */
  must(status, nameOf) {
    if (status === OK) return;
    this.#functions.lipz_status_message(status, this.slot(ANSWER));
    const message = this.string(this.read(this.slot(ANSWER), lipz_string));
    if (nameOf === undefined) {
      throw new LipzError(`${message} (status ${status})`, { status, remedy: remedyFor(status) });
    }
    const { file, offset_bytes: offsetBytes } = this.read(this.problem, lipz_problem);
    const about = { file: nameOf(file), status, offsetBytes, remedy: remedyFor(status) };
    throw new LipzError(`${message} (status ${status}, at byte ${offsetBytes})`, about);
  }
}

/** A time in whole units, as in `lipz_time`: their count and the rate, which is 0 for microseconds. */
function timeOf(time) {
  if ("us" in time) return [BigInt(time.us), 0];
  const { position, rateHz } = time;
  // Without a rate, the time counts as before the start.
  return isSampleRate(rateHz) ? [BigInt(position), rateHz] : [-1n, 0];
}
