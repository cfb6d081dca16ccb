// The curves of a clip below its timeline: emotions as a stacked band of their colours, and each curve separately with
// its value at the playhead. They zoom and scroll with the timeline.

import { EMOTION_COLOURS } from "../face.js";
import { EMOTIONS } from "../lipz.js";
import { onDrag } from "./drag.js";
import { areasOf, lineOf, told } from "./plots.js";

const SVG = "http://www.w3.org/2000/svg";
/** If there are more curves than this, they are folded until you open them. */
const MOST_OPEN = 12;
/** Degrees between two colours: the golden angle, with which neighbours differ. */
const TURN = 137.5;

export class Curves {
  #element;
  #band;
  #list;
  #summary;
  #playhead;
  #clip;
  #rows = [];
  #view = { first: 0, count: 1, width: 1 };
  #time = 0;

  constructor(element, scrub) {
    this.#element = element;
    this.#band = element.querySelector(".band");
    this.#list = element.querySelector("ol");
    this.#summary = element.querySelector("summary");
    this.#playhead = element.querySelector(".playhead");
    onDrag(element, (x) => this.#timeAt(x), scrub, ({ target }) => Boolean(target.closest("summary")));
  }

  /** Shows the curves of a clip, if it has any, or other ones. */
  show(clip, curves = clip.curves, title = curves.length === 1 ? "1 curve" : `${curves.length} curves`, isOpen = curves.length <= MOST_OPEN) {
    this.#clip = clip;
    this.#element.hidden = curves.length === 0;
    const felt = EMOTIONS.map((name) => curves.find((curve) => curve.name === name)).filter(Boolean);
    this.#band.toggleAttribute("hidden", felt.length === 0);
    this.#band.replaceChildren(...areasOf(felt, clip.frameCount).map(area));
    this.#rows = curves.map((curve, index) => row(curve, index, clip.frameCount));
    this.#list.replaceChildren(...this.#rows.map(({ item }) => item));
    this.#summary.textContent = title;
    this.#element.querySelector("details").open = isOpen;
    this.look(this.#view);
  }

  /** Shows the visible frames of the timeline: the first frame, their number, and the width in pixels. */
  look(view) {
    this.#view = view;
    const box = (height) => `${view.first} 0 ${view.count} ${height}`;
    this.#band.setAttribute("viewBox", box(1));
    this.#rows.forEach(({ plot }) => plot.setAttribute("viewBox", box(1)));
    this.#mark();
  }

  /** Moves the playhead, and shows the values there. */
  mark(time) {
    this.#time = time;
    this.#rows.forEach(({ curve, value }) => (value.textContent = told(curve.valueAt(time) ?? 0)));
    this.#mark();
  }

  #mark() {
    if (this.#clip === undefined) return;
    const { first, count, width } = this.#view;
    const x = ((this.#time / this.#clip.duration) * this.#clip.frameCount - first) * (width / count);
    this.#playhead.style.transform = `translateX(${x}px)`;
    this.#playhead.hidden = x < 0 || x > width;
  }

  #timeAt(x) {
    const { first, count, width } = this.#view;
    const frame = first + ((x - this.#element.getBoundingClientRect().left - this.#element.clientLeft) / width) * count;
    return (frame / this.#clip.frameCount) * this.#clip.duration;
  }
}

/** The area of an emotion in the band. */
function area({ name, d }) {
  const element = drawn("path", { d, fill: EMOTION_COLOURS[name] });
  element.append(drawn("title", {}, name));
  return element;
}

/** One curve: its name, its value, and its plot. */
function row(curve, index, frames) {
  const { least, most, zero, d } = lineOf(curve, frames);
  const item = document.createElement("li");
  item.style.setProperty("--curve", EMOTION_COLOURS[curve.name] ?? `hsl(${Math.round(index * TURN) % 360} 60% 55%)`);
  const name = made("b", "name", curve.name);
  name.dir = "auto";
  const value = made("span", "value");
  const range = made("small", "range", `${told(least)} to ${told(most)}`);
  const plot = drawn("svg", { preserveAspectRatio: "none", "aria-hidden": "true" });
  plot.append(
    drawn("path", { class: "zero", d: `M0 ${zero}H${frames}` }),
    drawn("path", { class: "line", d }),
  );
  item.append(name, value, range, plot);
  return { curve, item, value, plot };
}

function made(tag, className, text = "") {
  return Object.assign(document.createElement(tag), { className, textContent: text });
}

function drawn(tag, attributes, text = "") {
  const element = document.createElementNS(SVG, tag);
  Object.entries(attributes).forEach(([name, value]) => element.setAttribute(name, value));
  element.textContent = text;
  return element;
}
