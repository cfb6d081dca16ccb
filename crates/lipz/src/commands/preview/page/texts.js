// Texts of two locales and events, side by side, a row for each segment.

import { made } from "./list.js";

const DELIMITER = "|";

export class Texts {
  #element;
  #change;
  #seek;
  /** What the table shows: its columns, the parts of their texts, how many segments the mouth has. */
  #columns = [];
  #parts = [];
  #count = 0;
  /** By what the table that is there can be kept. */
  #outline;

  /** `change` gets the name of an element and its new text, `seek` a segment to go to. */
  constructor(element, { change, seek }) {
    [this.#element, this.#change, this.#seek] = [element, change, seek];
  }

  /** Shows elements of a file, as many rows as its mouth has segments: `columns` are `{ name, label, lang, text }`. */
  show(columns, count, isEditable) {
    [this.#columns, this.#count] = [columns, count];
    this.#parts = columns.map(({ text }) => (text ?? "").split(DELIMITER));
    const rows = Math.max(count, ...this.#parts.map((part) => part.length));
    const outline = JSON.stringify([columns.map(({ name }) => name), rows, isEditable]);
    if (outline !== this.#outline) this.#build(rows, isEditable);
    this.#outline = outline;
    for (const field of this.#element.querySelectorAll("textarea")) {
      const { place, at } = field.dataset;
      field.placeholder = columns[place].text === undefined ? "—" : "";
      // What somebody is typing stays as it is.
      if (field !== document.activeElement || field.readOnly) field.value = this.#part(place, at);
    }
  }

  /** Marks the segment that is said. */
  mark(segment) {
    this.#element.querySelectorAll("tbody tr").forEach((row, at) => row.classList.toggle("now", at === segment?.index));
  }

  /** Makes the table anew; a field in which somebody types is taken over as it is. */
  #build(rows, isEditable) {
    const typed = this.#element.contains(document.activeElement) ? document.activeElement : undefined;
    const table = made("table", "texts");
    const head = table.createTHead().insertRow();
    head.append(made("th", "", "#"), ...this.#columns.map(({ label }) => Object.assign(made("th", "", label), { scope: "col" })));
    const body = table.createTBody();
    for (let at = 0; at < rows; at++) {
      const row = body.insertRow();
      const button = made("button", "go", String(at + 1));
      Object.assign(button, { type: "button", ariaLabel: `Go to segment ${at + 1}` });
      button.onclick = () => this.#seek(at);
      row.insertCell().append(button);
      this.#columns.forEach((column, place) => row.insertCell().append(this.#field(column, place, at, isEditable)));
    }
    const { name, at } = typed?.dataset ?? {};
    const next = name && table.querySelector(`[data-name="${name}"][data-at="${at}"]`);
    const [start, end] = [typed?.selectionStart, typed?.selectionEnd];
    if (next) next.value = typed.value;
    // Its removal is no end of typing.
    typed?.toggleAttribute("data-gone", true);
    this.#element.replaceChildren(table);
    next?.focus();
    next?.setSelectionRange(start, end);
  }

  #field({ name, label, lang }, place, at, isEditable) {
    const field = document.createElement("textarea");
    Object.assign(field, { rows: 1, dir: "auto", lang, readOnly: !isEditable });
    field.ariaLabel = `${label}, segment ${at + 1}`;
    Object.assign(field.dataset, { name, place, at });
    field.addEventListener("keydown", (event) => {
      if (event.key === "Escape") field.value = this.#part(place, at);
      else if (event.key !== "Enter") return;
      event.preventDefault();
      field.blur();
    });
    field.addEventListener("blur", () => "gone" in field.dataset || this.#typed(field.value, place, at));
    return field;
  }

  #part(place, at) {
    return (this.#parts[place][at] ?? "").trim();
  }

  #typed(text, place, at) {
    // A `|` would make another segment.
    const value = text.replaceAll(DELIMITER, "").replace(/\s*\n\s*/g, " ").trim();
    if (value === this.#part(place, at)) return;
    const parts = this.#parts[place];
    const whole = Array.from({ length: Math.max(this.#count, parts.length) }, (_, index) => parts[index] ?? "");
    whole[at] = value;
    // Parts that no segment has go when they are emptied.
    while (at >= this.#count && whole.length > this.#count && whole.at(-1).trim() === "") whole.pop();
    this.#change(this.#columns[place].name, whole.join(DELIMITER));
  }
}
