// A bank and the layers over it: the topmost of them answers.

import { BANK, FIRST, LipzError, SECOND } from "./memory.js";
import { byCodePoints } from "./order.js";
import { settingsOf } from "./specials.js";
import * as c from "./structs.js";

const NO_LAYER = 0xffffffff;

export class Layers {
  #opened;
  #memory;
  #banks;
  #info;
  #clipOf;
  /** For each tag the locale in each layer, or undefined. */
  #locales = new Map();

  constructor(opened, memory, clipOf) {
    this.#opened = opened;
    this.#memory = memory;
    this.#clipOf = clipOf;
    // The structs of the banks, in the array that the functions take.
    const structs = opened.map(({ memory }) => memory.bytes(BANK, c.lipz_bank.size));
    const array = new Uint8Array(structs.length * c.lipz_bank.size);
    structs.forEach((bytes, index) => array.set(bytes, index * c.lipz_bank.size));
    this.#banks = [memory.add(array), structs.length];
    try {
      memory.check("lipz_layers_check", ...this.#banks);
    } catch (error) {
      throw new LipzError(`layer ${error.offsetBytes}: ${error.message}`, error.status);
    }
    this.#info = memory.ask(c.lipz_layers_info_t, "lipz_layers_info", ...this.#banks);
  }

  get layerCount() {
    return this.#opened.length;
  }

  /** The tags of the locales, in their order. */
  get locales() {
    const tags = new Set(this.#opened.flatMap(({ bank }) => bank.locales));
    return [...tags].filter((tag) => this.#locale(tag).some((locale) => locale !== undefined)).sort(byCodePoints);
  }

  get defaultLocale() {
    return this.#opened[this.#info.default_locale_layer].bank.defaultLocale;
  }

  /** The clip with this key, or with this id if it is a bigint, of the topmost layer that has it. */
  clip(keyOrId) {
    const memory = this.#memory;
    return this.#clip(
      typeof keyOrId === "bigint"
        ? memory.ask(c.lipz_layered_clip, "lipz_layers_clip_by_id", ...this.#banks, keyOrId)
        : memory.ask(c.lipz_layered_clip, "lipz_layers_clip_by_key", ...this.#banks, ...memory.text(keyOrId)),
    );
  }

  /** All clips, in the order of their keys by code points. */
  clips() {
    const ids = new Set(this.#opened.flatMap(({ bank }) => bank.clips().map((clip) => clip.id)));
    const clips = [...ids].map((id) => this.clip(id)).filter((clip) => clip !== undefined);
    return clips.sort((a, b) => byCodePoints(a.key, b.key));
  }

  /** The locales of the voices: that of the originals first. None in a stack without dubs. */
  get voices() {
    const tags = [];
    for (;;) {
      const tag = this.#memory.ask(c.lipz_string, "lipz_layers_voice_at", ...this.#banks, tags.length);
      if (tag === undefined) return tags;
      tags.push(this.#memory.string(tag));
    }
  }

  /** The babble profile with this name. */
  babble(name) {
    return this.#opened[this.#info.babble_layer].bank.babble(name);
  }

  get defaultBabble() {
    return this.#opened[this.#info.babble_layer].bank.defaultBabble;
  }

  /** The face profile with this name. */
  faceProfile(name) {
    return this.#opened[this.#info.faces_layer].bank.faceProfile(name);
  }

  get defaultFaceProfile() {
    return this.#opened[this.#info.faces_layer].bank.defaultFaceProfile;
  }

  #clip(fields) {
    if (fields === undefined) return undefined;
    const text = (segment, tag) => this.#text(fields, segment.index, tag);
    const stack = {
      voiceOf: (id) => this.#voiceOf(id),
      clipIn: (id, tag) => this.#clipIn(id, tag),
      face: (clip, ...args) => this.#face({ ...fields, clip }, ...args),
    };
    return this.#clipOf(this.#opened[fields.layer].memory, fields.clip, text, stack);
  }

  /** The locale of the voice that a clip is spoken in. */
  #voiceOf(id) {
    const tag = this.#memory.ask(c.lipz_string, "lipz_layers_clip_voice", ...this.#banks, id);
    return tag && this.#memory.string(tag);
  }

  /** The clip as it is played in a voice, and whose it is, as a number. */
  #clipIn(id, tag) {
    const memory = this.#memory;
    const name = "lipz_layers_clip_in_voice";
    const voiced = memory.ask(c.lipz_layered_voiced_clip, name, ...this.#banks, id, ...memory.text(tag));
    return voiced && { clip: this.#clip(voiced.clip), spoken: voiced.spoken };
  }

  /** The fields of the face of a clip, or of somebody in it, with the profiles of the whole stack. */
  #face(clip, what, who, settings, ...time) {
    const memory = this.#memory;
    const asked = memory.put(FIRST, c.lipz_layered_clip, clip);
    const pointers = [...who(memory), ...settingsOf(memory, settings)];
    return memory.ask(c.lipz_face, `lipz_layers_face_${what}`, ...this.#banks, asked, ...pointers, ...time);
  }

  #text(clip, segment, tag) {
    if (clip.texts_layer === NO_LAYER) return undefined;
    const locale = this.#locale(tag)[clip.texts_layer];
    if (locale === undefined) return undefined;
    const memory = this.#memory;
    const asked = memory.put(FIRST, c.lipz_layered_clip, clip);
    const shown = memory.put(SECOND, c.lipz_layered_locale, locale);
    return memory.ask(c.lipz_text, "lipz_layers_text", ...this.#banks, asked, segment, shown);
  }

  /** The locale in each layer. */
  #locale(tag) {
    if (!this.#locales.has(tag)) {
      const memory = this.#memory;
      const inLayer = (_, layer) =>
        memory.ask(c.lipz_layered_locale, "lipz_layers_locale", ...this.#banks, layer, ...memory.text(tag));
      this.#locales.set(tag, this.#opened.map(inLayer));
    }
    return this.#locales.get(tag);
  }
}
