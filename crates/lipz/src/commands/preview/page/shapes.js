// The row of mouth shapes in the file, for dragging and typing.

import { VISEMES } from "../web/face.js";
import { made } from "./list.js";

/** What is dragged by itself. A press anywhere else moves the playhead. */
export const GRIP = "[data-grip]";

const $ = (id) => document.getElementById(id);

export class Shapes {
  #tracks;
  #change;
  #mouth;
  #isEditable = false;
  #type = "blair";
  #frame = () => 0;

  /**
   * `change` receives the new visemes, and whether the change is complete or still in progress; `step` advances by a
   * frame, as after typing a code; `frame` returns the frame at the playhead.
   */
  constructor(tracks, { change, step, frame }) {
    [this.#tracks, this.#change, this.#frame] = [tracks, change, frame];
    const row = $("shapes");
    row.addEventListener("pointerdown", (event) => this.#grab(event));
    row.addEventListener("keydown", (event) => this.#key(event, step));
  }

  /** Shows visemes of a viseme type. */
  show(mouth, type, isEditable) {
    [this.#mouth, this.#type, this.#isEditable] = [mouth, type, isEditable];
    $("shapes").ariaLabel = isEditable ? "Mouth shapes: type a code to replace the frame at the playhead" : "Mouth shapes";
    this.draw();
  }

  /** Draws the visible shapes. */
  draw() {
    if (this.#mouth === undefined) return;
    const parts = [];
    const put = (element, start, end) => this.#tracks.place(element, start, end) && parts.push(element);
    for (const { code, start, end } of this.#mouth.runs) {
      // Only visible ones are made, because a long clip has thousands.
      if (!this.#tracks.sees(start, end)) continue;
      const shape = made("span", code === "-" ? "shape rest" : "shape", code);
      shape.title = `${VISEMES[this.#type]?.[code] ?? code}, ${end - start} frame${end - start === 1 ? "" : "s"}`;
      put(shape, start, end);
      if (start > 0 && this.#isEditable) put(handle("edge", start), start, start);
    }
    this.#mouth.starts.forEach((start, index) => this.#tracks.sees(start, start) && put(handle("bar", index + 1), start, start));
    $("shapes").replaceChildren(...parts);
  }

  #grab(event) {
    const grip = event.target.closest(GRIP);
    if (!grip || !this.#isEditable || event.button !== 0) return;
    event.preventDefault();
    $("shapes").focus();
    const before = this.#mouth;
    const [what, at] = [grip.dataset.grip, Number(grip.dataset.at)];
    const moved = ({ clientX }) => {
      const frame = Math.round(this.#tracks.frameAt(clientX));
      return what === "edge" ? before.edge(at, frame) : before.start(at, frame);
    };
    const move = (event) => this.#show(moved(event), false);
    const drop = (event) => {
      removeEventListener("pointermove", move);
      removeEventListener("pointerup", drop);
      removeEventListener("pointercancel", drop);
      this.#show(event.type === "pointerup" ? moved(event) : before, true);
    };
    addEventListener("pointermove", move);
    addEventListener("pointerup", drop);
    addEventListener("pointercancel", drop);
  }

  #key(event, step) {
    if (!this.#isEditable || event.ctrlKey || event.altKey || event.metaKey) return;
    const frame = this.#frame();
    // Codes are capital letters, so that the letters of playback work here, too.
    const code = Object.hasOwn(VISEMES[this.#type] ?? {}, event.key) ? event.key : undefined;
    const runs = this.#mouth.runs;
    const run = runs.find(({ start, end }) => start <= frame && frame < end);
    const isAtEnd = frame >= this.#mouth.codes.length;
    const segment = this.#mouth.starts.findLastIndex((start) => start <= frame) + 1;
    const to = {
      "[": () => this.#mouth.edge(run.start, run.start - 1),
      "]": () => this.#mouth.edge(run.start, run.start + 1),
      "<": () => this.#mouth.start(segment, this.#mouth.starts[segment - 1] - 1),
      ">": () => this.#mouth.start(segment, this.#mouth.starts[segment - 1] + 1),
      "|": () => this.#mouth.divided(frame),
      Backspace: isAtEnd && this.#mouth.codes.length > 0 && (() => this.#mouth.shorter()),
    }[event.key];
    const needsRun = event.key === "[" || event.key === "]";
    if ((needsRun && !run) || (!to && code === undefined)) return;
    event.preventDefault();
    event.stopPropagation();
    this.#show(to ? to() : this.#mouth.typed(frame, code), true);
    if (!to) step();
  }

  #show(mouth, isDone) {
    this.#mouth = mouth;
    this.draw();
    this.#change(mouth, isDone);
  }
}

function handle(grip, at) {
  const element = made("span", `grip ${grip}`);
  Object.assign(element.dataset, { grip, at });
  element.title = grip === "edge" ? "Drag the edge of the shape" : "Drag the start of the segment";
  return element;
}
