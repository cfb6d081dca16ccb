// Tracks next to the timeline of a clip, on the same frames: recording, words, texts of another locale, diagnostics.

import { onDrag } from "../web/demo/drag.js";
import { made } from "./list.js";
import { GRIP } from "./shapes.js";

/** The most samples per column for its loudness: enough to show a syllable, few enough to draw at once. */
const MOST_SAMPLES = 400;

const $ = (id) => document.getElementById(id);

export class Tracks {
  #clip;
  #buffer;
  #words = [];
  #phones = [];
  #marks = [];
  #locale;
  #view = { first: 0, count: 1, width: 1 };
  #time = 0;

  constructor(scrub) {
    for (const id of ["wave", "words", "phones", "shapes", "translation", "marks"]) {
      onDrag($(id), (x) => this.timeAt(x), scrub, ({ target }) => target.closest(GRIP) !== null);
    }
    matchMedia("(prefers-color-scheme: light)").addEventListener("change", () => this.#draw());
  }

  /** The drawn clip. */
  set clip(clip) {
    this.#clip = clip;
  }

  /** Shows the words and the diagnostics of the clip at their positions. */
  show(words, diagnostics, locale) {
    this.#words = words;
    const places = diagnostics.map((found) => ({ ...found, at: frameOf(this.#clip, found) }));
    this.#marks = places.filter(({ at }) => at !== undefined);
    $("words").hidden = words.length === 0;
    $("marks").hidden = this.#marks.length === 0;
    this.texts(locale);
  }

  /** Shows the phones of the recording, or none if they are not available. */
  set phones(phones) {
    this.#phones = phones;
    $("phones").hidden = phones.length === 0;
    this.#draw();
  }

  /** Shows a recording; undefined for none. */
  set sound(buffer) {
    this.#buffer = buffer;
    $("wave").hidden = buffer === undefined;
    if (buffer) $("wave").ariaLabel = `The recording, ${buffer.duration.toFixed(2)} seconds`;
    this.#draw();
  }

  /** Shows the texts of another locale; undefined for none. */
  texts(locale) {
    this.#locale = locale;
    $("translation").hidden = !locale;
    this.#draw();
  }

  /** Shows the frames in view of the timeline: the first frame, their number, and their width in pixels. */
  look(view) {
    this.#view = view;
    this.#draw();
  }

  /** Moves the playhead. */
  mark(time) {
    this.#time = time;
    const x = this.#x((time / this.#clip.duration) * this.#clip.frameCount);
    const playhead = $("tracks").querySelector(":scope > .playhead");
    playhead.style.transform = `translateX(${x}px)`;
    playhead.hidden = x < 0 || x > this.#view.width;
    for (const word of $("tracks").querySelectorAll(".words > *")) word.classList.toggle("now", word.start <= time && time < word.end);
  }

  /** Returns the frame at an x of the window, as a fraction. */
  frameAt(x) {
    return this.#view.first + ((x - $("tracks").getBoundingClientRect().left - 1) / this.#view.width) * this.#view.count;
  }

  /** Returns the time at an x of the window. */
  timeAt(x) {
    return (this.frameAt(x) / this.#clip.frameCount) * this.#clip.duration;
  }

  /** Puts an element over frames. Returns whether it is visible. */
  place(element, start, end) {
    const [left, right] = [this.#x(start), this.#x(end)];
    element.style.left = `${left}px`;
    element.style.width = `${Math.max(1, right - left)}px`;
    return right >= 0 && left <= this.#view.width;
  }

  /** Whether any part of these frames is visible. */
  sees(start, end) {
    return this.#x(end) >= 0 && this.#x(start) <= this.#view.width;
  }

  #x(frame) {
    return (frame - this.#view.first) * (this.#view.width / this.#view.count);
  }

  #draw() {
    if (this.#clip === undefined) return;
    this.#wave();
    const rate = this.#clip.frameCount / this.#clip.duration;
    const blocks = (parent, items, of) => parent.replaceChildren(...items.map(of).filter(Boolean));
    const said = (text, className, { start_ms, end_ms }) => {
      if (!this.sees((start_ms / 1000) * rate, (end_ms / 1000) * rate)) return undefined;
      const word = Object.assign(made("span", className, text), { start: start_ms / 1000, end: end_ms / 1000, dir: "auto" });
      word.title = text;
      return this.place(word, word.start * rate, word.end * rate) && word;
    };
    blocks($("words"), this.#words, (found) => {
      const word = said(found.text, found.is_doubtful ? "word doubtful" : "word", found);
      if (word && found.is_doubtful) word.title = `${found.text}: uncertain`;
      return word;
    });
    blocks($("phones"), this.#phones, (found) => {
      const phone = said(found.phone, "phone", found);
      if (phone) phone.title = `${found.phone}, ${found.end_ms - found.start_ms} ms`;
      return phone;
    });
    blocks($("translation"), this.#locale && this.#clip.frameCount > 0 ? this.#clip.segments : [], (segment) => {
      if (!this.sees(segment.startFrame, segment.endFrame)) return undefined;
      const text = segment.text(this.#locale);
      const part = made("span", text?.isFallback ? "part fallback" : "part", text?.text ?? "");
      [part.dir, part.lang, part.title] = ["auto", text?.isFallback ? "" : this.#locale.tag, text?.text ?? ""];
      return this.place(part, segment.startFrame, segment.endFrame) && part;
    });
    blocks($("marks"), this.#marks, ({ at, severity, message }) => {
      const mark = made("span", `mark ${severity}`);
      mark.title = message;
      if (!this.place(mark, at, at)) return undefined;
      // Keep it fully visible at the ends of the window.
      mark.style.left = `clamp(0.35rem, ${mark.style.left}, calc(100% - 0.35rem))`;
      return mark;
    });
    this.mark(this.#time);
  }

  /** Draws the loudness of the recording: the lowest and the highest sample of each column of pixels. */
  #wave() {
    const canvas = $("wave");
    const { clientWidth: width, clientHeight: height } = canvas;
    if (!this.#buffer || width === 0) return;
    const dense = devicePixelRatio;
    Object.assign(canvas, { width: Math.round(width * dense), height: Math.round(height * dense) });
    const context = canvas.getContext("2d");
    const samples = this.#buffer.getChannelData(0);
    const perFrame = (this.#clip.duration / this.#clip.frameCount) * this.#buffer.sampleRate;
    const perColumn = (this.#view.count / canvas.width) * perFrame;
    context.fillStyle = getComputedStyle(canvas).getPropertyValue("--bar");
    const step = Math.max(1, Math.floor(perColumn / MOST_SAMPLES));
    for (let x = 0; x < canvas.width; x++) {
      const from = Math.floor(this.#view.first * perFrame + x * perColumn);
      let [low, high] = [0, 0];
      for (let at = from; at < from + Math.max(1, perColumn); at += step) {
        const sample = samples[at] ?? 0;
        if (sample < low) low = sample;
        if (sample > high) high = sample;
      }
      const half = canvas.height / 2;
      context.fillRect(x, half - high * half, 1, Math.max(dense, (high - low) * half));
    }
  }
}

/** Returns the frame of a diagnostic; undefined if it concerns the file. */
export function frameOf(clip, { frame, segment }) {
  return frame ?? (segment === null ? undefined : clip.segment(segment)?.startFrame);
}
