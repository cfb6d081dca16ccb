// A clip: one spoken line of a dialogue.

import { Cursor } from "./cursor.js";
import { Curve, emotionsOf } from "./curve.js";
import { LipzError, throwForeign } from "./error.js";
import { articulationOf, rigOf } from "./articulation.js";
import { faceOf, lookAtOf, profileOf, whoOf } from "./face-profile.js";
import { estimatedFrame, rateOf } from "./frame-time.js";
import { Voice, handleOf } from "./handle.js";
import { FIRST, KEPT_EMOTIONS, KEPT_FACE, KEPT_MOUTH, SECOND } from "./memory.js";
import { segmentOf } from "./segment.js";
import * as c from "./structs.js";
import { MICROS_PER_SECOND, VISEME_TYPES } from "./words.js";

/** The source of the visemes of a clip in a voice, in the order of lipz.h. */
const SPOKEN = ["original", "dub", "other-dub"];

export class Clip {
  #memory;
  #fields;
  #key;
  /** Frames per second; NaN without a valid rate. */
  #rate;
  /** The address of the frame codes, which stay in their place; NaN if a damaged bank lacks some. */
  #frames;

  constructor(memory, fields) {
    this.#memory = memory;
    this.#fields = fields;
    this.#rate = rateOf(fields.fps_numerator, fields.fps_denominator);
  }

  get #address() {
    return this.#memory.put(FIRST, c.lipz_clip, this.#fields);
  }

  /** Calls a function whose first arguments are the dialogue and this clip. */
  #ask(type, name, ...args) {
    return this.#memory.ask(type, name, this.#address, ...args);
  }

  /** Returns the same clip with different fields. */
  #with(fields) {
    return new Clip(this.#memory, { ...this.#fields, ...fields });
  }

  get id() {
    return this.#fields.id;
  }

  /** Read only once, because sorting and searching clips use the key many times. */
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

  /** The clip with this frame rate, if its file does not specify one. */
  orFps(numerator, denominator = 1) {
    return this.#with(this.fps ? {} : { fps_numerator: numerator, fps_denominator: denominator });
  }

  /** The clip with this viseme type, if its file does not specify one. */
  orVisemeType(name) {
    return this.#with({ viseme_type: this.#fields.viseme_type || VISEME_TYPES.indexOf(name) });
  }

  /** The length in seconds; undefined without a frame rate. */
  get duration() {
    return this.startOfFrame(this.frameCount);
  }

  /** The start time of a frame, in seconds; undefined without a frame rate. */
  startOfFrame(frame) {
    const us = this.#ask(c.u64, "lipz_clip_start_of_frame_us", frame);
    return us === undefined ? undefined : Number(us) / MICROS_PER_SECOND;
  }

  /**
   * The number of frames to hold a consonant so that viewers can read it or, if you pass the microseconds of a rendered
   * frame, so that one rendered frame shows it.
   */
  holdFrames(renderedFrameUs = 0) {
    return this.#ask(c.u32, "lipz_clip_hold_frames", renderedFrameUs);
  }

  /** The recording that the clip was made for; undefined if the bank does not record it. */
  get recording() {
    const found = this.#ask(c.lipz_recording, "lipz_clip_recording");
    return found && { duration: Number(found.length_us) / MICROS_PER_SECOND, contentHash: found.content_hash };
  }

  /** The voice in which the clip is spoken; undefined without dubs. */
  get voice() {
    const found = this.#ask(c.lipz_voice, "lipz_clip_voice");
    return found && new Voice(this.#memory, found);
  }

  /** The clip to play in a voice, and the source of its visemes. */
  inVoice(voice) {
    const found = this.#ask(c.lipz_voiced_clip, "lipz_clip_in_voice", handleOf(Voice, voice).put(this.#memory, SECOND));
    return { clip: new Clip(this.#memory, found.clip), spoken: SPOKEN[found.spoken] };
  }

  frameAt(time) {
    // A call of the module takes ten times as long, and only times at the start of a frame need it.
    const frame = estimatedFrame(time, this.#rate);
    if (frame === undefined) return this.#ask(c.u32, "lipz_clip_frame_at", this.#memory.time(time));
    return frame < this.#fields.frame_count ? frame : undefined;
  }

  viseme(frame) {
    if (!(frame >= 0 && frame < this.#fields.frame_count)) return "-";
    const code = this.#memory.byte(this.#framesAt + frame);
    // Without such a byte, the module decides.
    return code === undefined ? this.#ask(c.lipz_viseme, "lipz_clip_viseme", frame) : String.fromCharCode(code);
  }

  visemeAt(time) {
    return this.viseme(this.frameAt(time));
  }

  get #framesAt() {
    return (this.#frames ??= this.#findFrames());
  }

  #findFrames() {
    const { data, length_bytes: length } = this.#ask(c.lipz_string, "lipz_clip_frames") ?? {};
    return length === this.#fields.frame_count ? data : NaN;
  }

  /** The openness of the mouth at a time; undefined without visemes or a frame rate. */
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

  /** A cursor before the start of the audio. */
  cursor(settings = {}) {
    const size = c.lipz_cursor.size;
    if (this.#ask(c.lipz_cursor, "lipz_cursor_new", size) === undefined) {
      throw new LipzError("the clip has no frame rate", { remedy: "set one with clip.orFps" });
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

  /** The emotions of a character of the clip at a time. */
  emotionsAt(time, who) {
    const memory = this.#memory;
    return emotionsOf(this.#ask(c.lipz_emotions, "lipz_clip_emotions_at", memory.time(time), whoOf(memory, who)));
  }

  /** The face of a character of the clip at a time. */
  faceAt(time, who, profile, lookAt) {
    const address = this.#faceAt(this.#memory.time(time), who, profile, lookAt);
    return faceOf(this.#memory.read(address, c.lipz_face));
  }

  /** The articulation at a time. */
  articulationAt(time, profile) {
    const address = this.#articulationAt(this.#memory.time(time), profile);
    return articulationOf(this.#memory.read(address, c.lipz_articulation));
  }

  /** The weights of a rig at a time, with articulation, emotions and face of a character of the clip. */
  weightsAt(time, rig, { who, profile, faceProfile, lookAt, out } = {}) {
    const memory = this.#memory;
    const at = memory.time(time);
    const structs = [
      this.#articulationAt(at, profile),
      memory.keep(KEPT_EMOTIONS, "lipz_clip_emotions_at", this.#address, at, whoOf(memory, who)),
      this.#faceAt(at, who, faceProfile, lookAt),
    ];
    return rigOf(rig).weightsFrom(memory, structs, out);
  }

  /** The address of the articulation at the time with this address. */
  #articulationAt(time, profile) {
    const memory = this.#memory;
    const kept = memory.keep(KEPT_MOUTH, "lipz_clip_articulation_at", this.#address, time, profileOf(memory, profile));
    return kept ?? throwForeign("articulation profile");
  }

  /** The address of the face at the time with this address. */
  #faceAt(time, who, profile, lookAt) {
    const memory = this.#memory;
    const settings = [whoOf(memory, who), profileOf(memory, profile), lookAtOf(memory, lookAt)];
    const kept = memory.keep(KEPT_FACE, "lipz_clip_face_at", this.#address, time, ...settings);
    return kept ?? throwForeign("face profile");
  }
}
