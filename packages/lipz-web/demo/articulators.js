// The articulators of a clip as curves, with a key per frame, and the box that shows them when it is opened.

import { ARTICULATORS } from "../lipz.js";
import { Curves } from "./curves.js";

export class Articulators {
  #element;
  #curves;
  #clip;
  #time = 0;

  constructor(element, scrub) {
    this.#element = element;
    this.#curves = new Curves(element, scrub);
    element.querySelector("details").ontoggle = () => this.#draw();
  }

  /** Shows the movement of the mouth of a clip, if it has frames. */
  show(clip) {
    this.#clip = clip;
    this.#draw();
  }

  look(view) {
    this.#curves.look(view);
  }

  mark(time) {
    this.#time = time;
    this.#curves.mark(time);
  }

  /** A long clip has many keys, which take time. */
  #draw() {
    const isOpen = this.#element.querySelector("details").open;
    this.#curves.show(this.#clip, isOpen ? curvesOf(this.#clip) : [], `${ARTICULATORS.length} articulators`, isOpen);
    this.#element.hidden = this.#clip.frameCount === 0;
    this.#curves.mark(this.#time);
  }
}

/** The movement of each articulator, from 0 to 1. */
function curvesOf(clip) {
  const frames = Array.from({ length: clip.frameCount }, (_, frame) => frame);
  const poses = frames.map((frame) => clip.articulationAt(clip.startOfFrame(frame)));
  return ARTICULATORS.map((name) => ({
    name: name.replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`),
    keys: frames.map((frame) => ({ frame, value: poses[frame][name] })),
    valueAt: (time) => clip.articulationAt(time)[name],
  }));
}
