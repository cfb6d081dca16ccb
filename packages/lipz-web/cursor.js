// The cursor: the position in a clip while it plays. Its bytes are the struct of lipz.h.

import { FIRST, SECOND } from "./memory.js";
import { segmentOf } from "./segment.js";
import * as c from "./structs.js";
import { eventOf, MICROS_PER_SECOND, nameOf, TEN_THOUSAND } from "./words.js";

const OVER = 0xffffffff;
const WAITING = 0xfffffffe;
const NO_NAME = { bank: 0, id: 0 };
const MOST_MICROS = 0xffffffff;
/** The permitted leads in frames. With more, visemes would no longer match the audio. */
const LEAD_FRAMES = [1, 2];

/** A time in whole microseconds. */
function micros(time) {
  const us = typeof time === "number" ? Math.round(time * MICROS_PER_SECOND) : Number(time.us);
  return Math.max(0, Math.min(us, MOST_MICROS));
}

export class Cursor {
  #clip;
  #memory;
  #bytes;
  #speaker;

  constructor(clip, memory, bytes) {
    this.#clip = clip;
    this.#memory = memory;
    this.#bytes = bytes;
  }

  /** The same cursor in a clip of a different dialogue. */
  in(clip, memory) {
    const cursor = new Cursor(clip, memory, this.#bytes.slice());
    cursor.#set("clip_id", clip.id);
    return cursor;
  }

  #view() {
    return new DataView(this.#bytes.buffer);
  }

  #get(field) {
    return c.lipz_cursor.fields[field].read(this.#view(), c.lipz_cursor.places[field]);
  }

  #set(field, value) {
    c.lipz_cursor.fields[field].write(this.#view(), c.lipz_cursor.places[field], value);
  }

  /** The address of the cursor, for a function of lipz.h. */
  get #address() {
    // A bank of the set that was loaded since may have the only event that mentions the speaker.
    if (this.#speaker !== undefined && this.#get("speaker_bank") === NO_NAME.bank) this.speaker = this.#speaker;
    return this.#memory.putBytes(FIRST, this.#bytes);
  }

  /** Calls a function whose first arguments are the dialogue and this cursor. */
  #ask(type, name, ...args) {
    return this.#memory.ask(type, name, this.#address, ...args);
  }

  /** Calls a function that changes the cursor. */
  #move(name, ...args) {
    const memory = this.#memory;
    memory.must(memory.status(name, this.#address, ...args));
    this.#bytes = memory.copy(FIRST, c.lipz_cursor.size);
    return new Due(memory, this.#bytes);
  }

  get clip() {
    return this.#clip;
  }

  /** The lead of visemes before the audio, in seconds. Also accepts `{ us }` and `{ frames }`. */
  get lead() {
    return this.#get("lead_us") / MICROS_PER_SECOND;
  }

  set lead(lead) {
    const frames = typeof lead === "object" ? lead.frames : undefined;
    this.#set("lead_us", micros(frames === undefined ? lead : this.#secondsOf(frames)));
  }

  #secondsOf(frames) {
    if (LEAD_FRAMES.includes(frames)) return this.#clip.startOfFrame(frames);
    throw new RangeError(`a lead must be 1 or 2 frames, or a time, but not ${frames} frames`);
  }

  /** The minimum number of frames for a consonant. Also accepts `"readable"` and `{ renderedFrame }`. */
  get hold() {
    return this.#get("hold_frames");
  }

  set hold(hold) {
    const isCount = typeof hold === "number";
    const frames = isCount ? hold : this.#clip.holdFrames(hold === "readable" ? undefined : micros(hold.renderedFrame));
    this.#set("hold_frames", frames);
  }

  /** The speaker, to whom events without a character belong. */
  get speaker() {
    return this.#speaker;
  }

  set speaker(name) {
    const { bank, id } = (name && this.#nameOf(name)) ?? NO_NAME;
    this.#speaker = name;
    this.#set("speaker_id", id);
    this.#set("speaker_bank", bank);
  }

  /** The name in events, as a struct of lipz.h; undefined if no event mentions it. */
  #nameOf(name) {
    return this.#memory.ask(c.lipz_name, "lipz_dialogue_event_name", ...this.#memory.text(name));
  }

  advanceTo(time) {
    return this.#move("lipz_cursor_advance", this.#memory.time(time));
  }

  loopTo(time) {
    return this.#move("lipz_cursor_loop", this.#memory.time(time));
  }

  seek(time) {
    this.#move("lipz_cursor_seek", this.#memory.time(time));
  }

  finish() {
    return this.#move("lipz_cursor_finish");
  }

  get frame() {
    const frame = this.#get("frame");
    return frame === OVER || frame === WAITING ? undefined : frame;
  }

  get isOver() {
    return this.#get("frame") === OVER;
  }

  get viseme() {
    return this.#ask(c.lipz_viseme, "lipz_cursor_viseme") ?? "-";
  }

  get openness() {
    const tenThousandths = this.#ask(c.u32, "lipz_cursor_openness");
    return tenThousandths === undefined ? undefined : tenThousandths / TEN_THOUSAND;
  }

  get segment() {
    return segmentOf(this.#memory, this.#ask(c.lipz_segment, "lipz_cursor_segment"));
  }

  /** The emotion, stare and pointing of a character, by default of the speaker. */
  state(name) {
    let address = 0;
    if (name !== undefined) {
      const found = this.#nameOf(name);
      // No event mentions the name, so the state is empty.
      if (found === undefined) return { name, feels: undefined, staresAt: undefined, pointsAt: undefined };
      address = this.#memory.put(SECOND, c.lipz_name, found);
    }
    return this.#character(this.#ask(c.lipz_character, "lipz_cursor_character", address));
  }

  /** All characters that events of the clip mention, with their states. */
  characters() {
    const found = this.#memory.askAll(c.lipz_character, "lipz_cursor_character_by_index", this.#address);
    return found.map((character) => this.#character(character));
  }

  #character({ name, feels, stares_at, points_at }) {
    const word = (of) => nameOf(this.#memory, of);
    return { name: word(name), feels: word(feels), staresAt: word(stares_at), pointsAt: word(points_at) };
  }
}

/** The events and segments that a move has made due. */
export class Due {
  #memory;
  #bytes;

  constructor(memory, bytes) {
    this.#memory = memory;
    this.#bytes = bytes;
  }

  /** Takes everything of one kind from a copy of the cursor, so that repeated calls return the same. */
  #taken(type, name, read) {
    const memory = this.#memory;
    const taken = [];
    const cursor = memory.putBytes(FIRST, this.#bytes);
    for (;;) {
      const found = memory.ask(type, name, cursor);
      if (found === undefined) return taken;
      taken.push(read(memory, found));
    }
  }

  /** The events, in order. Events without a character belong to the speaker. */
  get events() {
    return this.#taken(c.lipz_event, "lipz_cursor_take_event", eventOf);
  }

  /** The segments, in order, for event strings in a different syntax. */
  get segments() {
    return this.#taken(c.lipz_segment, "lipz_cursor_take_segment", segmentOf);
  }
}
