// One clip: its playback and its editing.

import { FaceDrawing, VISEMES } from "../web/face.js";
import { openDialogue } from "../web/lipz.js";
import { Articulators } from "../web/demo/articulators.js";
import { Curves } from "../web/demo/curves.js";
import { levelsOf } from "../web/demo/levels.js";
import { posesOf, withType } from "../web/demo/pose.js";
import { SpriteDrawing } from "../web/demo/sprites.js";
import { Timeline } from "../web/demo/timeline.js";
import { Editor } from "./editor.js";
import { Problems } from "./problems.js";
import { Clock } from "./sound.js";
import { source } from "./source.js";
import { Tracks } from "./tracks.js";

/** The rate for clips whose file does not state one. */
const FRAMES_PER_SECOND = 24;
const FASTEST = 4;
/** The time that a clip is shown before its phones are requested, so that browsing the list does not wait for them. */
const LINGER_MS = 200;

const $ = (id) => document.getElementById(id);

export class Player {
  clock = new Clock();
  #face = new FaceDrawing($("face"));
  #sprite = new SpriteDrawing($("sprite"));
  #scrub = (time, isDown) => this.scrub(time, isDown);
  #curves = new Curves($("curves"), this.#scrub);
  #articulators = new Articulators($("articulation"), this.#scrub);
  #tracks = new Tracks(this.#scrub);
  #timeline = new Timeline($("timeline"), this.#scrub, (view) => this.#look(view));
  #problems = new Problems($("problems"), (frame) => this.seek(this.#clip.startOfFrame(frame) ?? 0));
  #editor = new Editor(this.#tracks, {
    draw: (dialogue) => this.#draw(dialogue),
    diagnose: (diagnostics) => this.#diagnose(diagnostics),
    step: () => this.#frames(1),
    frame: () => this.#clip?.frameAt(this.clock.time) ?? Infinity,
    refresh: () => this.refresh(),
    seek: (segment) => this.seek(this.#clip?.startOfFrame(this.#clip.segment(segment)?.startFrame ?? 0) ?? 0),
  });
  /** The dialogue of the bank; undefined if nothing could be packed. */
  #dialogue;
  /** The texts of clips of the bank, by clip key, as far as they have been searched. */
  #said = new Map();
  #clip;
  /** The dialogue of that clip: that of the bank, or of a draft. */
  #home;
  /** The key of the drawn clip; undefined if there is none. */
  #drawn;
  #cursor;
  #poseAt;
  #soundOf;
  /** The number of requests for phones. Only the last answer is used. */
  #phonesAsked = 0;
  #wasRate;

  constructor() {
    const { actions } = this;
    const buttons = { play: "toggle", loop: "loop", half: "half", undo: "undo", redo: "redo", save: "save" };
    for (const [id, action] of Object.entries(buttons)) $(id).onclick = actions[action];
    $("in").onclick = () => actions.zoom(true);
    $("out").onclick = () => actions.zoom(false);
    $("fit").onclick = () => this.#clip && this.#timeline.fit();
    $("locale").onchange = $("beside").onchange = () => this.#languages();
  }

  /** The actions of keys and buttons. */
  actions = {
    toggle: () => (this.clock.playing ? this.#stop() : this.#play(this.#speed)),
    stop: () => this.#stop(),
    forward: () => this.#play(this.clock.rate > 0 ? Math.min(FASTEST, this.clock.rate * 2) : this.#speed),
    back: () => this.#play(this.clock.rate < 0 ? Math.max(-FASTEST, this.clock.rate * 2) : -this.#speed),
    loop: () => this.#loop(toggled($("loop"))),
    half: () => (toggled($("half")), this.clock.rate > 0 && this.#play(this.#speed)),
    frames: (count) => this.#frames(count),
    seconds: (count) => this.seek(this.clock.time + count),
    start: () => this.seek(0),
    end: () => this.seek(this.#clip?.duration),
    zoom: (isIn) => this.#clip && this.#timeline.zoom(isIn),
    undo: () => this.#editor.undo(),
    redo: () => this.#editor.redo(),
    save: () => this.#editor.save(),
  };

  /** The key of the current clip. */
  get key() {
    return this.#editor.key;
  }

  /** Whether there are unsaved changes. */
  get isChanged() {
    return this.#editor.isChanged;
  }

  get clip() {
    return this.#clip;
  }

  /** The dialogue of that clip. */
  get dialogue() {
    return this.#home;
  }

  /** Resolves when the last change is drawn. */
  get settled() {
    return this.#editor.settled;
  }

  get #speed() {
    return pressed($("half")) ? 0.5 : 1;
  }

  /** Replaces the bank. */
  async open(bytes, isReadOnly) {
    const wasm = await source.wasm?.();
    this.#dialogue = bytes.byteLength > 0 ? await openDialogue([bytes], { wasm }) : undefined;
    this.#said.clear();
    this.#editor.isReadOnly = isReadOnly;
    this.#offer();
  }

  /** Returns all texts of a clip for searching; nothing if the bank lacks the clip. */
  said(key) {
    if (!this.#said.has(key)) {
      const segments = this.#dialogue?.clip(key)?.segments ?? [];
      const textsIn = (locale) => segments.map((segment) => segment.text(locale)?.text ?? "").join(" ");
      const texts = this.#dialogue?.locales.map(textsIn);
      this.#said.set(key, texts?.join("\n").toLowerCase() ?? "");
    }
    return this.#said.get(key);
  }

  /** Shows a clip from its start, or from a time. */
  async choose(key, time = 0) {
    const page = await source.clip(key);
    this.clock.pause(0);
    this.#loop(press($("loop"), false));
    this.#editor.show(page);
    this.#soundOf = this.#drawn = undefined;
    this.#tracks.phones = [];
    $("key").textContent = key;
    await this.#take(page);
    this.seek(time);
  }

  /** Shows the current state of the clip after its file or the bank has changed. Time and zoom stay. */
  async refresh() {
    const page = await source.clip(this.key);
    if (!this.#editor.refresh(page)) await this.#take(page);
  }

  /** Shows a clip from the bank or, if it has errors, the correct parts of its file. */
  async #take(page) {
    const sets = page.sprites ? await source.sprites() : {};
    this.#sprite.sprites = sets[page.sprites];
    $("face").toggleAttribute("hidden", this.#sprite.isShown);
    this.#offer();
    this.#draw(this.#dialogue);
    this.#diagnose(page.diagnostics);
    if (this.#clip === undefined) await this.#editor.pack();
    this.#hear(page);
    await this.#listen(page);
  }

  /** Jumps to a time; continues playing. */
  seek(time) {
    if (!this.#clip) return;
    const at = Math.max(0, Math.min(Number.isFinite(time) ? time : 0, this.#clip.duration));
    this.#cursor.seek(at);
    this.clock.seek(at);
    if (pressed($("loop"))) this.#loop(true);
    this.show();
  }

  scrub(time, isDown) {
    this.#wasRate ??= this.clock.rate;
    if (this.clock.playing) this.clock.pause();
    this.seek(time);
    if (isDown) return;
    if (this.#wasRate !== 0 && this.clock.time < this.#clip.duration) this.#play(this.#wasRate);
    this.#wasRate = undefined;
  }

  /** Draws the clip of a dialogue, or that it is missing. The view stays if the same clip is already drawn. */
  #draw(dialogue) {
    const before = this.#clip;
    const clip = dialogue?.clip(this.key);
    this.#home = dialogue;
    $("tracks").hidden = clip === undefined;
    this.#clip = this.#editor.clip = clip && withType(clip.orFps(FRAMES_PER_SECOND));
    const isSame = this.#drawn === this.key;
    const wasAtEnd = isSame && this.clock.time >= before.duration;
    this.#drawn = this.#clip && this.key;
    if (this.#clip) {
      this.#cursor = this.#clip.cursor();
      this.#poseAt = posesOf(this.#clip);
      this.#tracks.clip = this.#clip;
      this.#curves.show(this.#clip);
      this.#articulators.show(this.#clip);
      this.#timeline[isSame ? "update" : "show"](this.#clip, levelsOf(this.#clip), this.#locale);
    } else this.#blank();
    this.#languages();
    // A frame typed after the last one comes after the playhead.
    if (this.#clip && wasAtEnd && !this.clock.playing) this.seek(this.#clip.duration);
  }

  /** Clears the view, so that nothing of a different clip remains. */
  #blank() {
    this.clock.pause(0);
    $("curves").hidden = $("articulation").hidden = true;
    this.#face.show({});
    for (const id of ["subtitle", "other", "feeling", "state", "viseme", "time"]) $(id).textContent = "";
    $("viseme").title = "";
    $("viseme").ariaLabel = "No mouth shape";
    this.#editor.mark(undefined);
    this.#button();
  }

  #diagnose(diagnostics) {
    this.#problems.show(diagnostics, this.#clip);
    if (this.#clip) this.#tracks.show(this.#editor.words, diagnostics, this.#beside);
  }

  /** Fetches the recording of a clip, which may have changed under the same name. */
  async #listen({ key, has_sound, path }) {
    if (!has_sound) {
      this.clock.load(undefined);
      this.#tracks.sound = undefined;
      return;
    }
    const isAnew = this.#soundOf !== path;
    this.#soundOf = path;
    const buffer = await this.clock.decode(await source.sound(key)).catch(() => undefined);
    if (this.key !== key || (!isAnew && this.clock.playing)) return;
    this.clock.load(buffer);
    this.#tracks.sound = buffer;
  }

  /** Fetches the phones of the recording, which the server may have to align first. */
  async #hear({ key, has_sound, path }) {
    const asked = ++this.#phonesAsked;
    if (has_sound && path !== null) await new Promise((resolve) => setTimeout(resolve, LINGER_MS));
    if (asked !== this.#phonesAsked) return;
    const phones = has_sound && path !== null ? await source.phones(key) : [];
    if (asked === this.#phonesAsked) this.#tracks.phones = phones;
  }

  #look(view) {
    this.#curves.look(view);
    this.#articulators.look(view);
    this.#tracks.look(view);
    this.#editor.look();
  }

  /** The selected locale of the clip; undefined if its dialogue lacks it. */
  get #locale() {
    return this.#home?.locale($("locale").value);
  }

  get #beside() {
    return this.#home?.locale($("beside").value);
  }

  /** Offers the locales of the bank, and those that only the clip's file has. */
  #offer() {
    const tags = (this.#dialogue?.locales ?? []).map(({ tag }) => tag).sort();
    const locales = Array.from(new Set([...tags, ...this.#editor.ownLocales]));
    const usual = this.#dialogue?.defaultLocale?.tag ?? locales[0];
    const main = locales.includes($("locale").value) ? $("locale").value : usual;
    const wasAsked = $("beside").options.length > 1;
    const beside = wasAsked ? $("beside").value : (locales.find((tag) => tag !== main) ?? "");
    choices($("locale"), locales, main);
    choices($("beside"), ["", ...locales], beside);
    $("beside").options[0].textContent = "none";
  }

  #languages() {
    this.#editor.languages($("locale").value, $("beside").value);
    if (!this.#clip) return;
    this.#timeline.texts(this.#locale);
    this.#tracks.texts(this.#beside);
    this.show();
  }

  #frames(count) {
    if (!this.#clip) return;
    const frame = this.#clip.frameAt(this.clock.time) ?? this.#clip.frameCount;
    this.seek(this.#clip.startOfFrame(Math.max(0, frame + count)) ?? this.#clip.duration);
  }

  #loop(isOn) {
    const at = this.clock.time;
    const segment = isOn && (this.#clip?.segmentAt(at) ?? this.#clip?.segments.at(-1));
    const seconds = (frame) => this.#clip.startOfFrame(frame) ?? this.#clip.duration;
    const isLong = segment && segment.startFrame < segment.endFrame;
    this.clock.loop = isLong ? { start: seconds(segment.startFrame), end: seconds(segment.endFrame) } : undefined;
  }

  async #play(rate) {
    if (!this.#clip) return;
    if (rate > 0 && this.clock.time >= this.#clip.duration) this.seek(0);
    await this.clock.play(rate);
    this.show();
    requestAnimationFrame(() => this.#tick());
  }

  #stop() {
    this.clock.pause();
    this.show();
  }

  #tick() {
    const { rate, time } = this.clock;
    if (rate === 0 || !this.#clip) return;
    if (rate > 0 ? time >= this.#clip.duration : time <= 0) this.clock.pause(rate > 0 ? this.#clip.duration : 0);
    else requestAnimationFrame(() => this.#tick());
    this.show();
  }

  /** Updates everything on the page to the time. */
  show() {
    if (!this.#clip) return;
    const { time, rate } = this.clock;
    // Backwards, no events are due; a loop starts again.
    if (rate < 0 || pressed($("loop"))) this.#cursor.seek(time);
    this.#cursor.advanceTo(time);
    const { viseme } = this.#cursor;
    // For a clip without visemes, show the first text.
    const segment = this.#clip.frameCount > 0 ? this.#cursor.segment : this.#clip.segments[0];
    const [main, beside] = [this.#locale, this.#beside].map((locale) => segment?.text(locale));
    const feeling = felt(this.#clip.emotionsAt(time));
    if (this.#sprite.isShown) this.#sprite.show(viseme);
    else this.#face.show(this.#poseAt(this.#cursor, time));
    this.#timeline.mark(time, segment, main?.text, feeling);
    this.#tracks.mark(time);
    this.#curves.mark(time);
    this.#articulators.mark(time);
    this.#editor.mark(segment);
    say($("subtitle"), main, $("locale").value);
    say($("other"), beside, $("beside").value);
    $("feeling").textContent = feeling;
    $("state").textContent = Array.from(new Set([segment?.event, ...states(this.#cursor)])).filter(Boolean).join(" · ");
    $("viseme").textContent = viseme;
    $("viseme").title = $("viseme").ariaLabel = `Mouth shape ${viseme}: ${VISEMES[this.#clip.visemeType][viseme] ?? "none"}`;
    $("time").textContent = `${time.toFixed(2)} / ${this.#clip.duration.toFixed(2)} s · frame ${this.#clip.frameAt(time) ?? this.#clip.frameCount}`;
    this.#button();
  }

  #button() {
    $("play").classList.toggle("playing", this.clock.playing);
    $("play").ariaLabel = this.clock.playing ? "Pause" : "Play";
  }
}

function say(element, text, tag) {
  element.textContent = text?.text ?? "";
  // The bank does not state the locale of a fallback text.
  element.lang = text?.isFallback ? "" : tag;
  element.dir = "auto";
  element.classList.toggle("fallback", text?.isFallback ?? false);
}

/** Returns the emotions of the speaker, the strongest first. */
function felt({ values }) {
  const strongest = Object.entries(values).filter(([, value]) => value > 0).sort(([, a], [, b]) => b - a);
  return strongest.map(([emotion, value]) => `${emotion} ${Number(value.toFixed(1))}`).join(", ");
}

/** Returns the lasting states of the events so far. */
function states(cursor) {
  return cursor.characters().map(({ name, feels, staresAt, pointsAt }) => {
    const lasts = [feels && `feels ${feels}`, staresAt && `stares at ${staresAt}`, pointsAt && `points at ${pointsAt}`];
    const all = lasts.filter(Boolean).join(", ");
    return all && `${name ?? "the speaker"} ${all}`;
  });
}

function choices(select, tags, chosen) {
  select.replaceChildren(...tags.map((tag) => new Option(tag, tag, false, tag === chosen)));
}

const pressed = (button) => button.ariaPressed === "true";

function press(button, isOn) {
  button.ariaPressed = String(isOn);
  return isOn;
}

const toggled = (button) => press(button, !pressed(button));
