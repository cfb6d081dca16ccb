// A dialogue: files that act as one bank.

import { Babble } from "./babble.js";
import { Clip } from "./clip.js";
import { ABSENT, LipzError, NONE, OK, remedyFor } from "./error.js";
import { ArticulationProfile, Rig } from "./articulation.js";
import { FaceProfile } from "./face-profile.js";
import { Locale, Voice, handleOf } from "./handle.js";
import { FIRST, SECOND } from "./memory.js";
import * as c from "./structs.js";

const NULL = [0, 0];
/** The kinds of files, in the order of lipz.h. */
const KINDS = ["absent", "bank", "patch", "texts", "set"];

export class Dialogue {
  #memory;
  /** The name of each file, with a function to load it if it is absent. */
  #files;
  /** The address of the files in memory. */
  #places;
  #flags;
  /** Promises for the banks that are being loaded. */
  #loading = new Map();

  /**
   * @param files the `name` of each file, and `load` if it is a bank of a set
   * @param contents the address of the contents of all files
   */
  constructor(memory, files, contents, flags) {
    this.#memory = memory;
    this.#files = files;
    this.#flags = flags;
    this.#places = memory.allocate(files.length * c.lipz_file.size);
    memory.dialogue = memory.allocate(c.lipz_dialogue.size);
    this.#mustFit(memory.status("lipz_dialogue_open", this.#places, contents, files.length, flags, memory.problem));
  }

  #mustFit(status) {
    this.#memory.must(status, (number) => this.#files[number]?.name ?? this.#files.at(-1)?.name);
  }

  #info() {
    return this.#memory.ask(c.lipz_dialogue_info_t, "lipz_dialogue_info");
  }

  /** The names and kinds of the files, from the bottom to the top. */
  get files() {
    const found = this.#memory.askAll(c.lipz_file_info, "lipz_dialogue_file_by_index");
    return this.#files.map(({ name }, number) => {
      const { kind, checksum } = found[number];
      return { name, kind: KINDS[kind], checksum };
    });
  }

  get clipCount() {
    return Number(this.#info().clip_count);
  }

  /** The clip with this key, or with this id if it is a bigint. */
  clip(keyOrId) {
    const { status, fields } = this.#find(keyOrId);
    if (status === ABSENT) {
      const about = { file: this.#files[fields.file].name, status, remedy: remedyFor(status) };
      throw new LipzError("the bank of this clip is not loaded yet", about);
    }
    return status === OK ? new Clip(this.#memory, fields) : undefined;
  }

  /** The same, after the bank of the set for the clip is loaded. */
  async loadClip(keyOrId) {
    for (;;) {
      const { status, fields } = this.#find(keyOrId);
      if (status !== ABSENT) return this.clip(keyOrId);
      await this.#load(fields.file);
    }
  }

  /** Loads all banks of a set. */
  async loadAll() {
    await Promise.all(this.files.map(({ kind }, number) => kind === "absent" && this.#load(number)));
  }

  /** All clips of the loaded files. */
  clips() {
    return this.clipsUnder("");
  }

  /** The clips whose keys start with a prefix. */
  clipsUnder(prefix) {
    const memory = this.#memory;
    const clips = [];
    const position = memory.putBytes(FIRST, new Uint8Array(c.u64.size));
    const text = memory.text(prefix);
    for (;;) {
      const fields = memory.ask(c.lipz_clip, "lipz_dialogue_next_clip", ...text, position);
      if (fields === undefined) return clips;
      clips.push(new Clip(memory, fields));
    }
  }

  locale(tag) {
    const found = this.#memory.ask(c.lipz_locale, "lipz_dialogue_locale", ...this.#memory.text(tag));
    return found && new Locale(this.#memory, found);
  }

  get locales() {
    const found = this.#memory.askAll(c.lipz_locale, "lipz_dialogue_locale_by_index");
    return found.map((fields) => new Locale(this.#memory, fields));
  }

  get defaultLocale() {
    const found = this.#memory.ask(c.lipz_locale, "lipz_dialogue_locale", ...NULL);
    return found && new Locale(this.#memory, found);
  }

  variant(locale, key) {
    const memory = this.#memory;
    const asked = handleOf(Locale, locale).put(memory, FIRST);
    const found = new Locale(memory, memory.ask(c.lipz_locale, "lipz_dialogue_variant", asked, ...memory.text(key)));
    return found.tag === locale.tag ? locale : found;
  }

  voice(tag) {
    const found = this.#memory.ask(c.lipz_voice, "lipz_dialogue_voice", ...this.#memory.text(tag));
    return found && new Voice(this.#memory, found);
  }

  get voices() {
    const found = this.#memory.askAll(c.lipz_voice, "lipz_dialogue_voice_by_index");
    return found.map((fields) => new Voice(this.#memory, fields));
  }

  /** The babble profile with this name. */
  babble(name) {
    const found = this.#memory.ask(c.lipz_babble, "lipz_dialogue_babble", ...this.#memory.text(name));
    return found && new Babble(this.#memory, found);
  }

  /** The profile of the project, by default that of the Second Life viewer. */
  get defaultBabble() {
    return new Babble(this.#memory, this.#memory.ask(c.lipz_babble, "lipz_dialogue_babble", ...NULL));
  }

  /** The face profile with this name. */
  faceProfile(name) {
    const found = this.#memory.ask(c.lipz_face_profile, "lipz_dialogue_face_profile", ...this.#memory.text(name));
    return found && new FaceProfile(this.#memory, found);
  }

  /** The profile of the project, or the built-in profile. */
  get defaultFaceProfile() {
    const found = this.#memory.ask(c.lipz_face_profile, "lipz_dialogue_face_profile", ...NULL);
    return new FaceProfile(this.#memory, found);
  }

  /** The articulation profile with this name. */
  articulationProfile(name) {
    const words = this.#memory.text(name);
    const found = this.#memory.ask(c.lipz_articulation_profile, "lipz_dialogue_articulation_profile", ...words);
    return found && new ArticulationProfile(this.#memory, found);
  }

  /** The rig with this name. */
  rig(name) {
    const found = this.#memory.ask(c.lipz_rig, "lipz_dialogue_rig", ...this.#memory.text(name));
    return found && new Rig(this.#memory, found);
  }

  /** The status of a query for a clip, and the fields of its result. */
  #find(keyOrId) {
    const memory = this.#memory;
    const [name, ...args] =
      typeof keyOrId === "bigint"
        ? ["lipz_dialogue_clip", keyOrId]
        : ["lipz_dialogue_clip_by_key", ...memory.text(keyOrId)];
    const { status, answer } = memory.call(c.lipz_clip, name, memory.dialogue, ...args);
    if (![ABSENT, NONE, OK].includes(status)) memory.must(status);
    return { status, fields: answer };
  }

  /** Loads a bank of a set once, and again only after a failure. */
  #load(number) {
    if (!this.#loading.has(number)) {
      const loaded = this.#files[number].load().then((bytes) => this.#supply(number, bytes));
      this.#loading.set(number, loaded.finally(() => this.#loading.delete(number)));
    }
    return this.#loading.get(number);
  }

  #supply(number, bytes) {
    const memory = this.#memory;
    memory.store(bytes, (data) => {
      const contents = memory.put(SECOND, c.lipz_bytes, { data, length_bytes: bytes.byteLength });
      const args = [this.#places, number, contents, this.#flags, memory.problem];
      this.#mustFit(memory.status("lipz_dialogue_supply", ...args));
    });
  }
}
