// The timeline of a clip: its segments, the openness of the mouth in each frame, and the playhead. It zooms and scrolls,
// so that frames are visible in clips of any length.

import { onDrag } from "./drag.js";

/** The minimum width of a frame in pixels when a clip is opened, and the maximum width. */
const READABLE_PX = 4;
const WIDEST_PX = 48;
/** The width of the line for a segment without frames. */
const POINT_PX = 3;
const ZOOM = 1.5;
/** The minimum distance between two labels of seconds. */
const LABEL_PX = 64;
/** The part of the view that stays between the playhead and the edges. */
const MARGIN = 0.08;

export class Timeline {
  /** The slider, which also scrolls, so that the keyboard reaches the whole clip. */
  #element;
  #track = made("track");
  #segments = made("segments");
  #canvas = document.createElement("canvas");
  #playhead = made("playhead");
  #clip;
  #levels = [];
  #framePx = READABLE_PX;
  /** Whether the whole clip is in view, and stays in view if the size changes. */
  #isWhole = false;
  #time = 0;

  #look;

  /**
   * `scrub` receives the time under the pointer, and whether the pointer is still down. `look` receives the visible
   * frames: the first frame, their number, and the width in pixels.
   */
  constructor(element, scrub, look) {
    this.#element = element;
    this.#look = look;
    this.#canvas.className = "frames";
    this.#track.append(this.#segments, this.#canvas, this.#playhead);
    element.replaceChildren(this.#track);
    element.addEventListener("scroll", () => this.#draw());
    new ResizeObserver(() => this.#layOut()).observe(element);
    matchMedia("(prefers-color-scheme: light)").addEventListener("change", () => this.#draw());
    this.#listen(scrub);
  }

  /** Shows a clip with the texts of a locale, with visible frames. `levels` has the openness of the mouth. */
  show(clip, levels, locale) {
    this.#clip = clip;
    this.#levels = levels;
    this.#framePx = Math.max(READABLE_PX, this.#fitPx);
    this.#isWhole = this.#framePx === this.#fitPx;
    this.#element.setAttribute("aria-valuemax", clip.duration.toFixed(3));
    this.#element.scrollLeft = 0;
    this.texts(locale);
    this.#layOut();
  }

  /** Shows a new version of the clip, without changing the zoom. */
  update(clip, levels, locale) {
    [this.#clip, this.#levels] = [clip, levels];
    this.#element.setAttribute("aria-valuemax", clip.duration.toFixed(3));
    this.texts(locale);
    this.#layOut();
  }

  /** Shows the texts of a locale, each in the direction of its script. */
  texts(locale) {
    this.#segments.replaceChildren(...this.#clip.segments.map((segment) => this.#part(segment, locale)));
    this.#place();
  }

  /** Moves the playhead, keeps it in view, and marks a segment. */
  mark(time, segment, spoken, feeling) {
    this.#time = time;
    this.#follow();
    Array.from(this.#segments.children).forEach((part, index) => part.classList.toggle("now", index === segment?.index));
    this.#element.setAttribute("aria-valuenow", time.toFixed(3));
    const words = [`${time.toFixed(2)} seconds`, spoken && `: ${spoken}`, feeling && ` (${feeling})`];
    this.#element.setAttribute("aria-valuetext", words.filter(Boolean).join(""));
  }

  /** Places the playhead, and keeps it in view. */
  #follow() {
    const x = this.#x;
    const { scrollLeft, clientWidth } = this.#element;
    const margin = clientWidth * MARGIN;
    if (x < scrollLeft + margin || x > scrollLeft + clientWidth - margin) {
      this.#element.scrollLeft = x < scrollLeft + margin ? x - clientWidth + 2 * margin : x - 2 * margin;
    }
    this.#playhead.style.transform = `translateX(${x}px)`;
  }

  /** Makes frames wider or narrower around the playhead. */
  zoom(isIn) {
    this.#widen(this.#framePx * (isIn ? ZOOM : 1 / ZOOM));
  }

  /** Shows the whole clip. */
  fit() {
    this.#widen(this.#fitPx);
  }

  /** The width of a frame, in pixels, at which the clip fits the view. */
  get #fitPx() {
    return this.#element.clientWidth / Math.max(1, this.#clip.frameCount);
  }

  /** The position of the playhead. */
  get #x() {
    return Math.min(1, this.#time / this.#clip.duration) * this.#clip.frameCount * this.#framePx;
  }

  #widen(framePx) {
    const before = this.#x - this.#element.scrollLeft;
    this.#framePx = Math.max(this.#fitPx, Math.min(framePx, Math.max(WIDEST_PX, this.#fitPx)));
    this.#isWhole = this.#framePx === this.#fitPx;
    this.#layOut();
    this.#element.scrollLeft = this.#x - before;
    this.#draw();
  }

  /** Fits everything to the size of the view and of a frame. */
  #layOut() {
    if (this.#clip === undefined || this.#element.clientWidth === 0) return;
    this.#framePx = this.#isWhole ? this.#fitPx : Math.max(this.#fitPx, this.#framePx);
    this.#track.style.width = `${this.#framePx * this.#clip.frameCount}px`;
    this.#place();
    this.#follow();
    this.#draw();
  }

  #part(segment, locale) {
    const part = made("segment");
    const text = segment.text(locale);
    const said = document.createElement("span");
    said.textContent = text?.text || "\u00A0";
    said.dir = "auto";
    // The bank does not record the locale of a fallback text.
    said.lang = text?.isFallback ? "" : (locale?.tag ?? "");
    const event = document.createElement("small");
    event.textContent = segment.event || "\u00A0";
    part.append(said, event);
    part.classList.toggle("point", segment.startFrame === segment.endFrame);
    part.title = [text?.text, segment.event].filter(Boolean).join("\n");
    return part;
  }

  /** Places segments at their frames. A segment without frames is a line. */
  #place() {
    this.#clip.segments.forEach(({ startFrame, endFrame }, index) => {
      const { style } = this.#segments.children[index];
      const isPoint = startFrame === endFrame;
      // A line at the end of the clip stays within it.
      const last = this.#framePx * this.#clip.frameCount - (isPoint ? POINT_PX : 0);
      style.left = `${Math.min(startFrame * this.#framePx, last)}px`;
      style.width = `${(endFrame - startFrame) * this.#framePx}px`;
    });
  }

  /** Draws only the visible frames, because a canvas cannot be as wide as a long clip. */
  #draw() {
    const { clientWidth: width, scrollLeft } = this.#element;
    const height = this.#canvas.clientHeight;
    if (this.#clip === undefined || width === 0) return;
    this.#look({ first: scrollLeft / this.#framePx, count: width / this.#framePx, width });
    const dense = devicePixelRatio;
    Object.assign(this.#canvas, { width: Math.round(width * dense), height: Math.round(height * dense) });
    this.#canvas.style.width = `${width}px`;
    const context = this.#canvas.getContext("2d");
    context.scale(dense, dense);
    const colour = (name) => getComputedStyle(this.#element).getPropertyValue(name);
    context.fillStyle = colour("--bar");
    // The size of the page's text.
    const rem = parseFloat(getComputedStyle(document.documentElement).fontSize) / 16;
    const bars = height - 14 * rem;
    const bar = (x, px, level) => context.fillRect(x, bars * (0.95 - 0.9 * level), px, bars * (0.05 + 0.9 * level));
    const step = Math.max(1, Math.floor(1 / this.#framePx));
    const first = Math.floor(scrollLeft / this.#framePx / step) * step;
    const last = Math.min(this.#levels.length, Math.ceil((scrollLeft + width) / this.#framePx));
    for (let frame = first; frame < last; frame += step) {
      const px = this.#framePx * step;
      // If several frames share a pixel, the most open one is drawn.
      bar(frame * this.#framePx - scrollLeft, px > 2 ? px - 1 : px, Math.max(...this.#levels.slice(frame, frame + step)));
    }
    context.fillStyle = colour("--faint");
    context.font = `${10 * rem}px system-ui, sans-serif`;
    const second = (this.#framePx * this.#clip.frameCount) / this.#clip.duration;
    const each = [0.1, 0.5, 1, 2, 5, 10, 30, 60, 300].find((seconds) => seconds * second >= LABEL_PX * rem) ?? 600;
    for (let at = Math.ceil(scrollLeft / second / each); at * each * second < scrollLeft + width; at++) {
      const x = at * each * second - scrollLeft;
      context.fillRect(x, height - 12 * rem, 1, 12 * rem);
      context.fillText(`${Number((at * each).toFixed(1))} s`, x + 4 * rem, height - 3 * rem);
    }
  }

  #listen(scrub) {
    const timeAt = (clientX) => {
      const x = clientX - this.#element.getBoundingClientRect().left - this.#element.clientLeft + this.#element.scrollLeft;
      return (x / (this.#framePx * this.#clip.frameCount)) * this.#clip.duration;
    };
    const isScrollbar = ({ clientY }) =>
      clientY > this.#element.getBoundingClientRect().bottom - (this.#element.offsetHeight - this.#element.clientHeight);
    onDrag(this.#element, timeAt, scrub, isScrollbar);
    this.#element.addEventListener(
      "wheel",
      (event) => {
        if (!event.ctrlKey) return;
        event.preventDefault();
        this.zoom(event.deltaY < 0);
      },
      { passive: false },
    );
  }
}

function made(name) {
  const element = document.createElement("div");
  element.className = name;
  return element;
}
