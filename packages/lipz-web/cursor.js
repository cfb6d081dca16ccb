// The cursor: where a clip is while it is played. Its numbers are the struct of lipz.h, kept here as bytes.

import { BANK, FIRST, SECOND } from "./memory.js";
import * as c from "./structs.js";
import { at, eventOf, MICROS_PER_SECOND, nameOf, TEN_THOUSAND } from "./words.js";

const OVER = 0xffffffff;
const WAITING = 0xfffffffe;
const NO_NAME = 0xffffffff;
const MOST_MICROS = 0xffffffff;

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

  /** The same cursor in a clip of another bank. */
  in(clip, memory, clipId) {
    const cursor = new Cursor(clip, memory, this.#bytes.slice());
    cursor.#set("clip_id", clipId);
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

  /** Asks about the bank and this cursor. */
  #ask(type, name, ...args) {
    const memory = this.#memory;
    return memory.ask(type, name, memory.slot(BANK), memory.putBytes(FIRST, this.#bytes), ...args);
  }

  /** Calls a function that changes the cursor. */
  #move(name, ...args) {
    const memory = this.#memory;
    memory.call(name, memory.slot(BANK), memory.putBytes(FIRST, this.#bytes), ...args);
    this.#bytes = memory.bytes(FIRST, c.lipz_cursor.size);
    return new Due(this.#clip, memory, this.#bytes);
  }

  #moveTo(how, time) {
    const [unit, ...args] = at(time);
    return this.#move(`lipz_cursor_${how}_${unit}`, ...args);
  }

  get clip() {
    return this.#clip;
  }

  /** How far mouth shapes are ahead of the sound, in seconds. Takes `{ us }` and `{ frames }`, too. */
  get lead() {
    return this.#get("lead_us") / MICROS_PER_SECOND;
  }

  set lead(lead) {
    const frames = typeof lead === "object" ? lead.frames : undefined;
    this.#set("lead_us", frames === undefined ? micros(lead) : this.#clip.leadOfFrames(frames));
  }

  /** How many frames a consonant shows at least. Takes `"readable"` and `{ picture }`, too. */
  get hold() {
    return this.#get("hold_frames");
  }

  set hold(hold) {
    const frames =
      typeof hold === "number" ? hold : this.#clip.holdFrames(hold === "readable" ? undefined : micros(hold.picture));
    this.#set("hold_frames", frames);
  }

  /** Who speaks, so whose events name no character. */
  get speaker() {
    return this.#speaker;
  }

  set speaker(name) {
    const memory = this.#memory;
    const found = name && memory.ask(c.lipz_name, "lipz_event_name", memory.slot(BANK), ...memory.text(name));
    this.#speaker = name;
    this.#set("speaker_id", found?.id ?? NO_NAME);
    this.#set("speaker_bank", found?.bank ?? 0);
  }

  advanceTo(time) {
    return this.#moveTo("advance", time);
  }

  loopTo(time) {
    return this.#moveTo("loop", time);
  }

  seek(time) {
    this.#moveTo("seek", time);
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
    return this.#clip.segmentOf(this.#ask(c.lipz_segment, "lipz_cursor_segment"));
  }

  /** What a character, or without a name the speaker, feels, stares and points at. */
  state(name) {
    const memory = this.#memory;
    let address = 0;
    if (name !== undefined) {
      const found = memory.ask(c.lipz_name, "lipz_event_name", memory.slot(BANK), ...memory.text(name));
      // No event mentions the name, so nothing is known of it.
      if (found === undefined) return { name, feels: undefined, staresAt: undefined, pointsAt: undefined };
      address = memory.put(SECOND, c.lipz_name, found);
    }
    return this.#character(this.#ask(c.lipz_character, "lipz_cursor_character", address));
  }

  /** All characters that events of the clip are about, with their states. */
  characters() {
    const characters = [];
    for (;;) {
      const found = this.#ask(c.lipz_character, "lipz_cursor_character_at", characters.length);
      if (found === undefined) return characters;
      characters.push(this.#character(found));
    }
  }

  #character({ name, feels, stares_at, points_at }) {
    const word = (of) => nameOf(this.#memory, of);
    return { name: word(name), feels: word(feels), staresAt: word(stares_at), pointsAt: word(points_at) };
  }
}

/** What a move has made due. */
export class Due {
  #clip;
  #memory;
  #bytes;

  constructor(clip, memory, bytes) {
    this.#clip = clip;
    this.#memory = memory;
    this.#bytes = bytes;
  }

  /** Takes everything of one kind, of a copy of the cursor: asked again, it is the same. */
  #taken(type, name, read) {
    const memory = this.#memory;
    const taken = [];
    let bytes = this.#bytes;
    for (;;) {
      const found = memory.ask(type, name, memory.slot(BANK), memory.putBytes(FIRST, bytes));
      if (found === undefined) return taken;
      bytes = memory.bytes(FIRST, c.lipz_cursor.size);
      taken.push(read(found));
    }
  }

  /** The events, in order; those that name no character are the speaker's. */
  get events() {
    return this.#taken(c.lipz_event, "lipz_cursor_take_event", (event) => eventOf(this.#memory, event));
  }

  /** The segments, in order: for event strings in another syntax. */
  get segments() {
    return this.#taken(c.lipz_segment, "lipz_cursor_take_segment", (segment) => this.#clip.segmentOf(segment));
  }
}
