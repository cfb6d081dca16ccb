// A drawn face: a mouth for each viseme, the twelve attributes of emotion, eyes that blink and look, brows, head and
// breath. Types are in face.d.ts.

import { geometry } from "./face/geometry.js";
import { markup, PARTS } from "./face/parts.js";

export { EMOTION_COLOURS, weightsOf } from "./face/emotion.js";
export { VISEMES } from "./face/mouth.js";
export { emotionsOf } from "./face/presets.js";

/** The area of a face: x, y, width, height. */
export const VIEW_BOX = [-110, -120, 220, 260];

/** The number of faces that this program has drawn. Each has outlines with different names. */
let count = 0;

/** Returns the elements of a face as text, for an `<svg>` or a `<g>`. `id` is unique in the document. */
export function faceMarkup(pose = {}, id = `face${++count}-`) {
  return markup(PARTS, geometry(pose, id), false);
}

/** A face in an `<svg>` of the page. */
export class FaceDrawing {
  #id = `face${++count}-`;
  #parts;
  #shown = {};

  constructor(svg) {
    svg.setAttribute("viewBox", VIEW_BOX.join(" "));
    this.#shown = geometry({}, this.#id);
    svg.innerHTML = markup(PARTS, this.#shown, true);
    this.#parts = Array.from(svg.querySelectorAll("[data-part]"), (part) => [part.dataset.part, part]);
  }

  /** Draws a pose. Missing members are neutral, and unchanged elements are not touched. */
  show(pose) {
    const next = geometry(pose, this.#id);
    for (const [name, part] of this.#parts) {
      for (const [key, value] of Object.entries(next[name] ?? {})) {
        if (this.#shown[name][key] !== value) part.setAttribute(key, value);
      }
    }
    this.#shown = next;
  }
}
