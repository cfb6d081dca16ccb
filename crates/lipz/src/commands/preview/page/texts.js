// Texts of two locales and events, side by side, a row for each segment.

import { made } from "./list.js";

const DELIMITER = "|";

export class Texts {
  #element;
  #change;
  #seek;

  /** `change` gets the name of an element and its new text, `seek` a segment to go to. */
  constructor(element, { change, seek }) {
    [this.#element, this.#change, this.#seek] = [element, change, seek];
  }

  /** Shows elements of a file, as many rows as its mouth has segments: `columns` are `{ name, label, lang, text }`. */
  show(columns, count, isEditable) {
    const focused = document.activeElement?.closest?.("textarea")?.dataset;
    const [name, at] = [focused?.name, focused?.at];
    const table = made("table", "texts");
    const head = table.createTHead().insertRow();
    head.append(made("th", "", "#"), ...columns.map(({ label }) => Object.assign(made("th", "", label), { scope: "col" })));
    const body = table.createTBody();
    const parts = columns.map(({ text }) => (text ?? "").split(DELIMITER));
    for (let index = 0; index < Math.max(count, ...parts.map((part) => part.length)); index++) {
      const row = body.insertRow();
      const button = made("button", "go", String(index + 1));
      Object.assign(button, { type: "button", ariaLabel: `Go to segment ${index + 1}` });
      button.onclick = () => this.#seek(index);
      row.insertCell().append(button);
      columns.forEach((column, place) => row.insertCell().append(this.#field(column, parts[place], index, count, isEditable)));
    }
    this.#element.replaceChildren(table);
    if (name) this.#element.querySelector(`[data-name="${name}"][data-at="${at}"]`)?.focus();
  }

  /** Marks the segment that is said. */
  mark(segment) {
    this.#element.querySelectorAll("tbody tr").forEach((row, at) => row.classList.toggle("now", at === segment?.index));
  }

  #field({ name, label, lang, text }, parts, index, count, isEditable) {
    const field = document.createElement("textarea");
    Object.assign(field, { rows: 1, value: (parts[index] ?? "").trim(), dir: "auto", lang, readOnly: !isEditable });
    field.ariaLabel = `${label}, segment ${index + 1}`;
    Object.assign(field.dataset, { name, at: index });
    field.placeholder = text === undefined ? "—" : "";
    field.addEventListener("keydown", (event) => {
      if (event.key === "Enter") {
        event.preventDefault();
        field.blur();
      } else if (event.key === "Escape") {
        field.value = (parts[index] ?? "").trim();
        field.blur();
      }
    });
    field.addEventListener("change", () => {
      // A `|` would make another segment.
      const value = field.value.replaceAll(DELIMITER, "").replace(/\s*\n\s*/g, " ").trim();
      if (value === (parts[index] ?? "").trim()) return;
      const whole = Array.from({ length: Math.max(count, parts.length) }, (_, at) => parts[at] ?? "");
      this.#change(name, whole.with(index, value).join(DELIMITER));
    });
    return field;
  }
}
