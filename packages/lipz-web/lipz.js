// Reader of lipz dialogue banks: bytes → Bank → Clip → Segment. Types are in lipz.d.ts.

import { Babble } from "./babble.js";
import { Cursor } from "./cursor.js";
import { Curve, EMOTIONS, emotionsOf } from "./curve.js";
import { FaceProfile, faceOf, settingsOf, whoOf } from "./specials.js";
import { Layers } from "./layers.js";
import { BANK, FIRST, LipzError, Memory, SECOND } from "./memory.js";
import { byCodePoints } from "./order.js";
import { BankSet } from "./set.js";
import * as c from "./structs.js";
import { at, eventOf, TEN_THOUSAND, VISEME_TYPES } from "./words.js";

export { Babble, UNMEASURED } from "./babble.js";
export { BankSet, Cursor, Curve, EMOTIONS, FaceProfile, Layers, LipzError };

/** What the header of a bank takes, and where its checksum is in it. */
const HEADER_BYTES = 64;
const CHECKSUM_OFFSET = 8;

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

/** An instance of the reader. */
async function instance(wasm) {
  const reader = wasm ? module(wasm) : (compiled ??= module());
  return WebAssembly.instantiate(await reader);
}

/** Opens a bank: checks header and directory. Throws a LipzError if the bytes are not a bank. */
export async function open(bytes, { wasm } = {}) {
  return new Bank(new Memory(await instance(wasm)), bytesOf(bytes));
}

/**
 * Opens and verifies a bank and the layers over it, the base first; each its bytes, or `{ bank, texts }` with those of a text
 * bank. Throws a LipzError if they do not fit.
 */
export async function openLayers(files, { wasm } = {}) {
  // One instance for all: functions about a stack look at all of its banks.
  const shared = await instance(wasm);
  const opened = files.map((file) => {
    const memory = new Memory(shared);
    const bank = new Bank(memory, bytesOf(file.bank ?? file));
    return { memory, bank: (file.texts ? bank.useTexts(file.texts) : bank).verify() };
  });
  return new Layers(opened, new Memory(shared), (...args) => new Clip(...args));
}

/**
 * Opens a set of banks by its index. `load` gives the bytes of a bank by the name of its file, which is beside the index; it is
 * called when a clip of that bank is asked for. Throws a LipzError if the bytes are not an index.
 */
export async function openSet(index, load, { wasm } = {}) {
  return new BankSet(new Memory(await instance(wasm)), bytesOf(index), async (fileName) => {
    const bytes = bytesOf(await load(fileName));
    const bank = new Bank(new Memory(await instance(wasm)), bytes);
    const header = new DataView(bytes.buffer, bytes.byteOffset, HEADER_BYTES);
    return { bank, lengthBytes: bytes.byteLength, checksum: header.getBigUint64(CHECKSUM_OFFSET, true) };
  });
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

  /** The locales of the voices: that of the originals first. None in a bank without dubs. */
  get voices() {
    const tags = [];
    for (;;) {
      const tag = this.#memory.ask(c.lipz_string, "lipz_voice_at", this.#bank, tags.length);
      if (tag === undefined) return tags;
      tags.push(this.#memory.string(tag));
    }
  }

  /** The babble profile with this name. */
  babble(name) {
    const memory = this.#memory;
    const found = memory.ask(c.lipz_babble, "lipz_babble_by_name", this.#bank, ...memory.text(name));
    return found && new Babble(memory, found);
  }

  /** The profile of the project; that of the Second Life viewer if it has none. */
  get defaultBabble() {
    return new Babble(this.#memory, this.#memory.ask(c.lipz_babble, "lipz_babble_default", this.#bank));
  }

  /** The face profile with this name. */
  faceProfile(name) {
    const memory = this.#memory;
    const found = memory.ask(c.lipz_face_profile, "lipz_face_profile_by_name", this.#bank, ...memory.text(name));
    return found && new FaceProfile(memory, found);
  }

  /** The profile of the project; the usual one if it has none. */
  get defaultFaceProfile() {
    return new FaceProfile(this.#memory, this.#memory.ask(c.lipz_face_profile, "lipz_face_profile_default", this.#bank));
  }

  #clip(fields) {
    return fields && new Clip(this.#memory, fields, (segment, tag) => this.#text(segment, tag));
  }

  /** The text of a segment, given by its fields, in a locale of the bank. */
  #text(fields, tag) {
    const locale = this.#locales.find((locale) => locale.name === tag);
    if (locale === undefined) return undefined;
    const memory = this.#memory;
    const segment = memory.put(FIRST, c.lipz_segment, fields);
    return memory.ask(c.lipz_text, "lipz_segment_text", memory.slot(BANK), segment, memory.put(SECOND, c.lipz_locale, locale));
  }
}

/** Whose mouth a clip in a voice has, as the functions number it. */
const SPOKEN = ["original", "dub", "other-dub"];

export class Clip {
  #memory;
  #fields;
  #textOf;
  /** What a stack says, of all of its banks; undefined in a bank, which knows its dubs and profiles. */
  #stack;
  #key;

  constructor(memory, fields, textOf, stack) {
    this.#memory = memory;
    this.#fields = fields;
    this.#textOf = textOf;
    this.#stack = stack;
  }

  /** Calls a function whose first arguments are the bank and this clip. */
  #ask(type, name, ...args) {
    const clip = this.#memory.put(FIRST, c.lipz_clip, this.#fields);
    return this.#memory.ask(type, name, this.#memory.slot(BANK), clip, ...args);
  }

  /** Calls the function for the unit that a time is given in. */
  #askAt(type, what, time) {
    const [unit, ...args] = at(time);
    return this.#ask(type, `${what}_at_${unit}`, ...args);
  }

  get id() {
    return this.#fields.id;
  }

  /** Read once: sorting all clips of a bank asks for it many times. */
  get key() {
    return (this.#key ??= this.#memory.string(this.#ask(c.lipz_string, "lipz_clip_key")));
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

  /** The locale of the voice that the clip is spoken in; undefined in a bank without dubs. */
  get voice() {
    if (this.#stack) return this.#stack.voiceOf(this.id);
    const tag = this.#ask(c.lipz_string, "lipz_clip_voice");
    return tag && this.#memory.string(tag);
  }

  /**
   * The clip as it is played in a voice, and whose it is: "dub", "other-dub" or "original"; undefined if the bank has no
   * such voice.
   */
  inVoice(tag) {
    if (this.#stack) {
      const voiced = this.#stack.clipIn(this.id, tag);
      return voiced && { clip: voiced.clip, spoken: SPOKEN[voiced.spoken] };
    }
    const voiced = this.#ask(c.lipz_voiced_clip, "lipz_clip_in_voice", ...this.#memory.text(tag));
    return voiced && { clip: new Clip(this.#memory, voiced.clip, this.#textOf), spoken: SPOKEN[voiced.spoken] };
  }

  /** A cursor that waits for the sound of the clip to begin. */
  cursor(settings = {}) {
    const clip = this.#memory.put(FIRST, c.lipz_clip, this.#fields);
    const size = c.lipz_cursor.size;
    const started = this.#memory.ask(c.lipz_cursor, "lipz_cursor_new", this.#memory.slot(BANK), clip, size);
    if (started === undefined) throw new LipzError("the clip has no frame rate: give it one with orFps");
    return Object.assign(new Cursor(this, this.#memory, this.#memory.answer(size)), settings);
  }

  /** The cursor where it is, in this clip: the same one in a newer version of the bank. */
  resume(cursor) {
    return cursor.in(this, this.#memory, this.#fields.id);
  }

  /** One or two frames as a lead, in microseconds. */
  leadOfFrames(frames) {
    const name = { 1: "lipz_lead_one_frame", 2: "lipz_lead_two_frames" }[frames];
    if (name === undefined) throw new RangeError(`a lead has one or two frames, or any time, but not ${frames} frames`);
    return this.#memory.ask(c.u32, name, this.#memory.put(FIRST, c.lipz_clip, this.#fields));
  }

  /** How many frames a consonant is held to be read; or, with the microseconds of a picture, to be on one. */
  holdFrames(pictureUs) {
    const clip = this.#memory.put(FIRST, c.lipz_clip, this.#fields);
    return pictureUs === undefined
      ? this.#memory.ask(c.u32, "lipz_hold_readable", clip)
      : this.#memory.ask(c.u32, "lipz_hold_for_display", clip, pictureUs);
  }

  /** How far the mouth is open at a time, 0 to 0.99; undefined if the clip has no mouth shapes: let it babble. */
  opennessAt(time) {
    return this.frameCount > 0 ? opennessOf(this.#memory, this.visemeAt(time), this.#fields.viseme_type) : undefined;
  }

  /** The clip with this viseme type, where its file leaves it unspecified. */
  orVisemeType(name) {
    const viseme_type = this.#fields.viseme_type || VISEME_TYPES.indexOf(name);
    return new Clip(this.#memory, { ...this.#fields, viseme_type }, this.#textOf, this.#stack);
  }

  /** The curve with this name; undefined if the clip has none. */
  curve(name) {
    return this.#curve(this.#ask(c.lipz_curve, "lipz_clip_curve", ...this.#memory.text(name)));
  }

  /** All curves, in the order of their names. */
  get curves() {
    const curves = [];
    for (;;) {
      const curve = this.#curve(this.#ask(c.lipz_curve, "lipz_clip_curve_at", curves.length));
      if (curve === undefined) return curves;
      curves.push(curve);
    }
  }

  /** What the speaker feels at a time. */
  emotionsAt(time) {
    return emotionsOf(this.#askAt(c.lipz_emotions, "lipz_clip_emotions", time));
  }

  /** What a character of the clip feels at a time. */
  emotionsOf(character, time, { isSpeaker } = {}) {
    const [unit, ...args] = at(time);
    const who = whoOf(this.#memory, character, isSpeaker);
    return emotionsOf(this.#ask(c.lipz_emotions, `lipz_clip_emotions_of_${unit}`, who, ...args));
  }

  /** The speaker's face at a time. */
  faceAt(time, settings) {
    return this.#face(`at_${at(time)[0]}`, time, settings);
  }

  /** The face of a character of the clip at a time. */
  faceOf(character, time, { isSpeaker, ...settings } = {}) {
    return this.#face(`of_${at(time)[0]}`, time, settings, (memory) => [whoOf(memory, character, isSpeaker)]);
  }

  #face(what, time, settings, who = () => []) {
    const [, ...args] = at(time);
    const face = this.#stack
      ? this.#stack.face(this.#fields, what, who, settings, ...args)
      : this.#ask(c.lipz_face, `lipz_clip_face_${what}`, ...who(this.#memory), ...settingsOf(this.#memory, settings), ...args);
    if (face === undefined) throw new LipzError("the face profile is that of another bank");
    return faceOf(face);
  }

  #curve(fields) {
    return fields && new Curve((...args) => this.#ask(...args), this.#memory, fields);
  }

  /** The clip with this frame rate, where its file leaves it unspecified. */
  orFps(numerator, denominator = 1) {
    const fps = this.fps ? {} : { fps_numerator: numerator, fps_denominator: denominator };
    return new Clip(this.#memory, { ...this.#fields, ...fps }, this.#textOf, this.#stack);
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
    return fields && new Segment(this.#memory, fields, this.#textOf);
  }

  /** The segment of these fields, for the cursor. */
  segmentOf(fields) {
    return this.#segment(fields);
  }
}

/** How far a shape is open; undefined if its type is unspecified. */
function opennessOf(memory, viseme, type) {
  const tenThousandths = memory.ask(c.u32, "lipz_viseme_openness", viseme.charCodeAt(0), type);
  return tenThousandths === undefined ? undefined : tenThousandths / TEN_THOUSAND;
}

export class Segment {
  #memory;
  #fields;
  #textOf;

  constructor(memory, fields, textOf) {
    this.#memory = memory;
    this.#fields = fields;
    this.#textOf = textOf;
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

  /** The text in a locale; undefined if the clip has none, also by fallback. */
  text(tag) {
    const text = this.#textOf(this.#fields, tag);
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
      events.push(eventOf(this.#memory, event));
    }
  }
}
