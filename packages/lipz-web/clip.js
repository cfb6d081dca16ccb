// A clip: one spoken line of a dialogue.

import { Cursor } from "./cursor.js";
import { Curve, emotionsOf } from "./curve.js";
import { LipzError } from "./error.js";
import { faceOf, lookAtOf, profileOf, whoOf } from "./face-profile.js";
import { Voice, handleOf } from "./handle.js";
import { FIRST, SECOND } from "./memory.js";
import { segmentOf } from "./segment.js";
import * as c from "./structs.js";
import { MICROS_PER_SECOND, VISEME_TYPES } from "./words.js";

/** Whose mouth a clip in a voice has, as lipz.h numbers it. */
const SPOKEN = ["original", "dub", "other-dub"];

export class Clip {
  #memory;
  #fields;
  #key;

  constructor(memory, fields) {
    this.#memory = memory;
    this.#fields = fields;
  }

  get #address() {
    return this.#memory.put(FIRST, c.lipz_clip, this.#fields);
  }

  /** Calls a function whose first arguments are the dialogue and this clip. */
  #ask(type, name, ...args) {
    return this.#memory.ask(type, name, this.#address, ...args);
  }

  /** The same clip, with other numbers where it has none. */
  #with(fields) {
    return new Clip(this.#memory, { ...this.#fields, ...fields });
  }

  get id() {
    return this.#fields.id;
  }

  /** Read once: sorting and searching clips asks for it many times. */
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

  /** The clip with this frame rate, where its file leaves it unspecified. */
  orFps(numerator, denominator = 1) {
    return this.#with(this.fps ? {} : { fps_numerator: numerator, fps_denominator: denominator });
  }

  /** The clip with this viseme type, where its file leaves it unspecified. */
  orVisemeType(name) {
    return this.#with({ viseme_type: this.#fields.viseme_type || VISEME_TYPES.indexOf(name) });
  }

  /** The length in seconds; undefined without a frame rate. */
  get duration() {
    return this.startOfFrame(this.frameCount);
  }

  /** The second at which a frame starts to show; undefined without a frame rate. */
  startOfFrame(frame) {
    const us = this.#ask(c.u64, "lipz_clip_start_of_frame_us", frame);
    return us === undefined ? undefined : Number(us) / MICROS_PER_SECOND;
  }

  /** How many frames a consonant is held to be read or, with the microseconds of a rendered frame, to be in one. */
  holdFrames(renderedFrameUs = 0) {
    return this.#ask(c.u32, "lipz_clip_hold_frames", renderedFrameUs);
  }

  /** The recording that the clip was made for; undefined if the bank does not say. */
  get recording() {
    const found = this.#ask(c.lipz_recording, "lipz_clip_recording");
    return found && { duration: Number(found.length_us) / MICROS_PER_SECOND, contentHash: found.content_hash };
  }

  /** The voice that the clip is spoken in; undefined without dubs. */
  get voice() {
    const found = this.#ask(c.lipz_voice, "lipz_clip_voice");
    return found && new Voice(this.#memory, found);
  }

  /** The clip as it is played in a voice, and whose mouth it has. */
  inVoice(voice) {
    const found = this.#ask(c.lipz_voiced_clip, "lipz_clip_in_voice", handleOf(Voice, voice).put(this.#memory, SECOND));
    return { clip: new Clip(this.#memory, found.clip), spoken: SPOKEN[found.spoken] };
  }

  frameAt(time) {
    return this.#ask(c.u32, "lipz_clip_frame_at", this.#memory.time(time));
  }

  viseme(frame) {
    return this.#ask(c.lipz_viseme, "lipz_clip_viseme", frame) ?? "-";
  }

  visemeAt(time) {
    return this.#ask(c.lipz_viseme, "lipz_clip_viseme_at", this.#memory.time(time)) ?? "-";
  }

  /** How far the mouth is open at a time; undefined if the clip has no mouth shapes, and without a frame rate. */
  opennessAt(time) {
    if (this.fps === undefined) return undefined;
    const cursor = this.cursor();
    cursor.seek(time);
    return cursor.openness;
  }

  segment(index) {
    return segmentOf(this.#memory, this.#ask(c.lipz_segment, "lipz_clip_segment", index));
  }

  segmentAt(time) {
    return segmentOf(this.#memory, this.#ask(c.lipz_segment, "lipz_clip_segment_at", this.#memory.time(time)));
  }

  get segments() {
    return Array.from({ length: this.#fields.segment_count }, (_, index) => this.segment(index));
  }

  /** A cursor that waits for the audio of the clip to begin. */
  cursor(settings = {}) {
    const size = c.lipz_cursor.size;
    if (this.#ask(c.lipz_cursor, "lipz_cursor_new", size) === undefined) {
      throw new LipzError("the clip has no frame rate", { remedy: "give it one, with clip.orFps" });
    }
    const cursor = new Cursor(this, this.#memory, this.#memory.answer(size));
    const isSet = ([, value]) => value !== undefined;
    return Object.assign(cursor, Object.fromEntries(Object.entries(settings).filter(isSet)));
  }

  /** The cursor at the same time in this clip, which may be from a newer dialogue. */
  resume(cursor) {
    return cursor.in(this, this.#memory);
  }

  /** The curve with this name; undefined if the clip has none. */
  curve(name) {
    const found = this.#ask(c.lipz_curve, "lipz_clip_curve", ...this.#memory.text(name));
    return found && new Curve(this.#memory, found);
  }

  /** All curves, in the order of their names. */
  get curves() {
    const found = this.#memory.askAll(c.lipz_curve, "lipz_clip_curve_by_index", this.#address);
    return found.map((fields) => new Curve(this.#memory, fields));
  }

  /** What a character of the clip feels at a time. */
  emotionsAt(time, who) {
    const memory = this.#memory;
    return emotionsOf(this.#ask(c.lipz_emotions, "lipz_clip_emotions_at", memory.time(time), whoOf(memory, who)));
  }

  /** The face of a character of the clip at a time. */
  faceAt(time, who, profile, lookAt) {
    const memory = this.#memory;
    const settings = [whoOf(memory, who), profileOf(memory, profile), lookAtOf(memory, lookAt)];
    const face = this.#ask(c.lipz_face, "lipz_clip_face_at", memory.time(time), ...settings);
    if (face === undefined) {
      const remedy = "look it up in the dialogue of the clip";
      throw new LipzError("the face profile is from a different dialogue", { remedy });
    }
    return faceOf(face);
  }
}
