// Reader of lipz dialogue banks: bytes → Bank → Clip → Segment. Types are in lipz.d.ts.

import { BANK, FIRST, LipzError, Memory, SECOND } from "./memory.js";
import { byCodePoints } from "./order.js";
import * as c from "./structs.js";

export { LipzError };

const VISEME_TYPES = [undefined, "blair", "toonboom", "rms"];
const VERBS = [undefined, "feels", "sees", "stares", "stops staring", "points", "stops pointing", "does"];
const NO_NAME = 0xffffffff;

let compiled;

/** Compiles the reader; without a source, the file beside this one, once. */
async function module(source) {
  if (source instanceof WebAssembly.Module) return source;
  if (source) return WebAssembly.compile(source);
  const url = new URL("./lipz.wasm", import.meta.url);
  if (url.protocol === "file:") {
    const { readFile } = await import("node:fs/promises");
    return WebAssembly.compile(await readFile(url));
  }
  const response = await fetch(url);
  if (!response.ok) throw new LipzError(`${url} cannot be loaded (HTTP ${response.status})`);
  return WebAssembly.compile(await response.arrayBuffer());
}

/** Opens a bank: checks header and directory. Throws a LipzError if the bytes are not a bank. */
export async function open(bytes, { wasm } = {}) {
  const reader = wasm ? module(wasm) : (compiled ??= module());
  return new Bank(new Memory(await WebAssembly.instantiate(await reader)), bytesOf(bytes));
}

function bytesOf(bytes) {
  return ArrayBuffer.isView(bytes)
    ? new Uint8Array(bytes.buffer, bytes.byteOffset, bytes.byteLength)
    : new Uint8Array(bytes);
}

export class Bank {
  #memory;
  #bank;
  #locales;

  constructor(memory, bytes) {
    this.#memory = memory;
    this.#bank = memory.slot(BANK);
    memory.check("lipz_bank_open", memory.add(bytes), bytes.byteLength, this.#bank);
    this.#readLocales();
  }

  /** Checks every byte and reference, of the text bank too; throws a LipzError. Gives the bank. */
  verify() {
    this.#memory.check("lipz_bank_verify", this.#bank);
    return this;
  }

  /** Uses the locales of a text bank from now on. */
  useTexts(bytes) {
    const texts = bytesOf(bytes);
    this.#memory.check("lipz_bank_use_texts", this.#bank, this.#memory.add(texts), texts.byteLength);
    this.#readLocales();
    return this;
  }

  #readLocales() {
    const memory = this.#memory;
    const indices = Array.from({ length: this.#info().locale_count }, (_, index) => index);
    this.#locales = indices
      .map((index) => memory.ask(c.lipz_locale, "lipz_locale_at", this.#bank, index))
      .filter((locale) => locale !== undefined)
      .map((locale) => ({ ...locale, name: memory.string(locale.tag) }));
  }

  #info() {
    return this.#memory.ask(c.lipz_bank_info_t, "lipz_bank_info", this.#bank);
  }

  get clipCount() {
    return this.#info().clip_count;
  }

  get fingerprint() {
    return this.#info().fingerprint;
  }

  get locales() {
    return this.#locales.map((locale) => locale.name);
  }

  get defaultLocale() {
    return this.#locales.find((locale) => locale.is_default)?.name;
  }

  /** The clip with this key, or with this id if it is a bigint. */
  clip(keyOrId) {
    const memory = this.#memory;
    return this.#clip(
      typeof keyOrId === "bigint"
        ? memory.ask(c.lipz_clip, "lipz_clip_by_id", this.#bank, keyOrId)
        : memory.ask(c.lipz_clip, "lipz_clip_by_key", this.#bank, ...memory.text(keyOrId)),
    );
  }

  /** The clip in a slot, a number below `clipCount`. */
  clipAt(slot) {
    return this.#clip(this.#memory.ask(c.lipz_clip, "lipz_clip_at", this.#bank, slot));
  }

  /** All clips, in the order of their keys, which is that of `lipz inspect --list`: by code points. */
  clips() {
    const clips = Array.from({ length: this.clipCount }, (_, slot) => this.clipAt(slot));
    return clips.sort((a, b) => byCodePoints(a.key, b.key));
  }

  #clip(fields) {
    return fields && new Clip(this.#memory, fields, (tag) => this.#locales.find((locale) => locale.name === tag));
  }
}

export class Clip {
  #memory;
  #fields;
  #locale;

  constructor(memory, fields, locale) {
    this.#memory = memory;
    this.#fields = fields;
    this.#locale = locale;
  }

  /** Calls a function whose first arguments are the bank and this clip. */
  #ask(type, name, ...args) {
    const clip = this.#memory.put(FIRST, c.lipz_clip, this.#fields);
    return this.#memory.ask(type, name, this.#memory.slot(BANK), clip, ...args);
  }

  /** Calls the function for the unit that a time is given in. */
  #askAt(type, what, time) {
    if (typeof time === "number") return this.#ask(type, `${what}_at_seconds`, time);
    if ("us" in time) return this.#ask(type, `${what}_at_us`, BigInt(time.us));
    return this.#ask(type, `${what}_at_samples`, BigInt(time.position), time.rateHz);
  }

  get id() {
    return this.#fields.id;
  }

  get key() {
    return this.#memory.string(this.#ask(c.lipz_string, "lipz_clip_key"));
  }

  get frames() {
    return this.#memory.string(this.#ask(c.lipz_string, "lipz_clip_frames"));
  }

  get frameCount() {
    return this.#fields.frame_count;
  }

  get fps() {
    const { fps_numerator: numerator, fps_denominator: denominator } = this.#fields;
    return denominator === 0 ? undefined : { numerator, denominator };
  }

  get visemeType() {
    return VISEME_TYPES[this.#fields.viseme_type];
  }

  get hasVisemes() {
    return this.#fields.has_visemes !== 0;
  }

  get hasEvents() {
    return this.#fields.has_events !== 0;
  }

  /** The length in seconds; undefined without a frame rate. */
  get duration() {
    return this.startOfFrame(this.frameCount);
  }

  /** What the bank says about the recording; undefined if nothing. */
  get recording() {
    const found = this.#ask(c.lipz_recording, "lipz_clip_recording");
    return found && { duration: Number(found.length_us) / 1e6, contentHash: found.content_hash };
  }

  /** The clip with this frame rate, where its file leaves it unspecified. */
  orFps(numerator, denominator = 1) {
    const fps = this.fps ? {} : { fps_numerator: numerator, fps_denominator: denominator };
    return new Clip(this.#memory, { ...this.#fields, ...fps }, this.#locale);
  }

  /** The second at which a frame starts to show; undefined without a frame rate. */
  startOfFrame(frame) {
    const us = this.#ask(c.u64, "lipz_clip_start_of_frame_us", frame);
    return us === undefined ? undefined : Number(us) / 1e6;
  }

  viseme(frame) {
    return this.#ask(c.lipz_viseme, "lipz_clip_viseme", frame) ?? "-";
  }

  frameAt(time) {
    return this.#askAt(c.u32, "lipz_frame", time);
  }

  visemeAt(time) {
    return this.#askAt(c.lipz_viseme, "lipz_viseme", time) ?? "-";
  }

  segmentAt(time) {
    return this.#segment(this.#askAt(c.lipz_segment, "lipz_segment", time));
  }

  segment(index) {
    return this.#segment(this.#ask(c.lipz_segment, "lipz_segment_at", index));
  }

  get segments() {
    return Array.from({ length: this.#fields.segment_count }, (_, index) => this.segment(index));
  }

  #segment(fields) {
    return fields && new Segment(this.#memory, fields, this.#locale);
  }
}

export class Segment {
  #memory;
  #fields;
  #locale;

  constructor(memory, fields, locale) {
    this.#memory = memory;
    this.#fields = fields;
    this.#locale = locale;
  }

  #ask(type, name, ...args) {
    const segment = this.#memory.put(FIRST, c.lipz_segment, this.#fields);
    return this.#memory.ask(type, name, this.#memory.slot(BANK), segment, ...args);
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

  /** The text in a locale of the bank; undefined if the clip has none, also by fallback. */
  text(tag) {
    const locale = this.#locale(tag);
    if (locale === undefined) return undefined;
    const text = this.#ask(c.lipz_text, "lipz_segment_text", this.#memory.put(SECOND, c.lipz_locale, locale));
    return text && { text: this.#memory.string(text), isFallback: text.is_fallback !== 0 };
  }

  /** The event string; undefined if the file has no events. */
  get event() {
    const string = this.#ask(c.lipz_string, "lipz_segment_event_string");
    return string && this.#memory.string(string);
  }

  /** The events, if they are Character Event Syntax. */
  get events() {
    const events = [];
    for (;;) {
      const event = this.#ask(c.lipz_event, "lipz_segment_event", events.length);
      if (event === undefined) return events;
      const name = ({ name, id }) => (id === NO_NAME ? undefined : this.#memory.string(name));
      events.push({ character: name(event.character), verb: VERBS[event.verb], object: name(event.object) });
    }
  }
}
