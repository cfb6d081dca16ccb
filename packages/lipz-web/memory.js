// The memory of one instance of the module: files, strings and structs go in, answers come out.

import { lipz_string } from "./structs.js";

const PAGE_BYTES = 65536;
/** Room for one struct, longer than any. */
const SLOT_BYTES = 256;

/** Slots of the structs that are passed to functions, and of what they answer. */
export const BANK = 0;
export const FIRST = 1;
export const SECOND = 2;
export const THIRD = 3;
export const FOURTH = 4;
const ANSWER = 5;

const LIPZ_OK = 0;
const LIPZ_NONE = 256;

const DECODER = new TextDecoder("utf-8", { ignoreBOM: true });
const ENCODER = new TextEncoder();

/** A file that is refused, or a call that makes no sense. */
export class LipzError extends Error {
  constructor(message, status, offsetBytes) {
    super(message);
    this.name = "LipzError";
    this.status = status;
    this.offsetBytes = offsetBytes;
  }
}

export class Memory {
  #functions;
  #memory;
  #slots;
  #text;

  constructor({ exports: { memory, ...functions } }) {
    this.#memory = memory;
    this.#functions = functions;
    this.#slots = this.#grow(PAGE_BYTES);
    this.#text = { at: this.#grow(PAGE_BYTES), capacity: PAGE_BYTES };
  }

  /** The address of a slot. */
  slot(number) {
    return this.#slots + number * SLOT_BYTES;
  }

  /** Copies the bytes of a file into new pages, where they stay, and gives their address. */
  add(bytes) {
    const at = this.#grow(bytes.byteLength);
    new Uint8Array(this.#memory.buffer).set(bytes, at);
    return at;
  }

  /** Writes a struct into a slot and gives its address. */
  put(number, type, value) {
    type.write(this.#view(), this.slot(number), value);
    return this.slot(number);
  }

  /** Writes the bytes of a struct into a slot and gives its address. */
  putBytes(number, bytes) {
    new Uint8Array(this.#memory.buffer).set(bytes, this.slot(number));
    return this.slot(number);
  }

  /** Copies the bytes of the struct that was answered last. */
  answer(length) {
    return this.bytes(ANSWER, length);
  }

  /** Copies the bytes of a struct out of a slot. */
  bytes(number, length) {
    return new Uint8Array(this.#memory.buffer, this.slot(number), length).slice();
  }

  /** Writes a string: address and length in bytes, until the next one is written. */
  text(string) {
    const bytes = ENCODER.encode(string);
    if (bytes.length > this.#text.capacity) {
      this.#text = { at: this.#grow(bytes.length), capacity: bytes.length };
    }
    new Uint8Array(this.#memory.buffer).set(bytes, this.#text.at);
    return [this.#text.at, bytes.length];
  }

  /** What stands in a slot. */
  read(number, type) {
    return type.read(this.#view(), this.slot(number));
  }

  /** The string that `data` and `length_bytes` of a struct are about. */
  string({ data, length_bytes }) {
    return DECODER.decode(new Uint8Array(this.#memory.buffer, data, length_bytes));
  }

  /** Calls a function that opens or checks a file, and whose last argument tells where damage is. */
  check(name, ...args) {
    const status = this.#functions[name](...args, this.slot(ANSWER));
    this.#must(status, this.#view().getUint32(this.slot(ANSWER), true));
  }

  /** Calls a function that answers nothing. */
  call(name, ...args) {
    this.#must(this.#functions[name](...args));
  }

  /** Calls a function whose last argument gets its answer; undefined if there is none. */
  ask(type, name, ...args) {
    const status = this.#functions[name](...args, this.slot(ANSWER));
    if (status === LIPZ_NONE) return undefined;
    this.#must(status);
    return this.read(ANSWER, type);
  }

  /** Throws what a status other than that of success says. */
  refuse(status) {
    this.#must(status);
  }

  #must(status, offsetBytes) {
    if (status === LIPZ_OK) return;
    this.#functions.lipz_status_message(status, this.slot(ANSWER));
    const message = this.string(this.read(ANSWER, lipz_string));
    throw new LipzError(`${message} (lipz status ${status})`, status, offsetBytes);
  }

  #view() {
    return new DataView(this.#memory.buffer);
  }

  #grow(lengthBytes) {
    return this.#memory.grow(Math.ceil(lengthBytes / PAGE_BYTES)) * PAGE_BYTES;
  }
}
