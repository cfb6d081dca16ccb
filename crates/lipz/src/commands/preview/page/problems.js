// The diagnostics of a clip, each with a link to its position.

import { made } from "./list.js";
import { frameOf } from "./tracks.js";

export class Problems {
  #element;
  #seek;

  /** `seek` receives the target frame. */
  constructor(element, seek) {
    [this.#element, this.#seek] = [element, seek];
  }

  /** Shows diagnostics, or nothing if the list is empty. */
  show(diagnostics, clip) {
    this.#element.hidden = diagnostics.length === 0;
    this.#element.replaceChildren(...diagnostics.map((found) => this.#item(found, clip)));
  }

  #item(found, clip) {
    const item = made("article", `problem ${found.severity}`);
    const title = made("p", "message-line");
    title.append(made("b", "code", found.code), ` ${found.message}`);
    item.append(title, ...found.notes.map((note) => made("p", "note", note)));
    if (found.help) item.append(made("p", "help", found.help));
    const frame = clip && frameOf(clip, found);
    const place = found.line === null ? "" : `line ${found.line}, column ${found.column}`;
    if (frame === undefined) item.append(made("small", "place", place));
    else {
      const button = made("button", "place", `${found.element ?? ""} ${place}`.trim());
      button.type = "button";
      button.onclick = () => this.#seek(frame);
      item.append(button);
    }
    return item;
  }
}
