// Texts of two locales and events in columns, with a row for each segment.

import { made } from "./list.js";

const DELIMITER = "|";

export class Texts {
  #element;
  #does;
  /** The contents of the table: its columns, the parts of their texts, and the number of segments of the visemes. */
  #columns = [];
  #parts = [];
  #count = 0;
  /** The structure of the table, which decides whether the existing one can be kept. */
  #outline;

  /**
   * `does` has the callbacks: `change` receives the name of an element and its new text, `seek` the target segment, and
   * `look` the name of an element and the segment whose text the user looks at. `type` is called while the user types.
   */
  constructor(element, does) {
    [this.#element, this.#does] = [element, does];
  }

  /** Whether a field has typed text that is not part of the clip yet. */
  get isTyping() {
    const field = this.#active;
    return field !== undefined && !field.readOnly && plain(field.value) !== this.#part(field.dataset.place, field.dataset.at);
  }

  /** Takes over the text in the field that is typed into, which keeps the focus. */
  commit() {
    const { value, dataset } = this.#active ?? {};
    if (this.isTyping) this.#typed(value, dataset.place, Number(dataset.at));
  }

  get #active() {
    const field = document.activeElement;
    return field?.matches("textarea") && this.#element.contains(field) ? field : undefined;
  }

  /**
   * Shows elements of a file with a row per segment of its visemes. `columns` are `{ name, label, lang, text, review }`,
   * where `review` has the segments to be reviewed.
   */
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
      const isDivided = columns[place].review?.includes(Number(at)) ?? false;
      field.classList.toggle("review", isDivided);
      field.title = isDivided ? "Divided in proportion: check this text" : "";
      // Do not change a field while the user types in it.
      if (field !== document.activeElement || field.readOnly) field.value = this.#part(place, at);
    }
  }

  /** Marks the current segment. */
  mark(segment) {
    this.#element.querySelectorAll("tbody tr").forEach((row, at) => row.classList.toggle("now", at === segment?.index));
  }

  /** Builds the table again. A field in use keeps its state. */
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
      button.onclick = () => this.#does.seek(at);
      row.insertCell().append(button);
      this.#columns.forEach((column, place) => row.insertCell().append(this.#field(column, place, at, isEditable)));
    }
    const { name, at } = typed?.dataset ?? {};
    const next = name && table.querySelector(`[data-name="${name}"][data-at="${at}"]`);
    const [start, end] = [typed?.selectionStart, typed?.selectionEnd];
    if (next) next.value = typed.value;
    // Removing the field does not end typing.
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
    field.addEventListener("input", () => this.#does.type());
    field.addEventListener("focus", () => this.#does.look(name, at));
    field.addEventListener("keydown", (event) => {
      if (event.key === "Escape") field.value = this.#part(place, at);
      else if (event.key !== "Enter") return;
      event.preventDefault();
      field.blur();
    });
    field.addEventListener("blur", () => {
      if ("gone" in field.dataset) return;
      this.#typed(field.value, place, at);
      // Also if the text is as it was.
      this.#does.type();
    });
    return field;
  }

  #part(place, at) {
    return (this.#parts[place]?.[at] ?? "").trim();
  }

  #typed(text, place, at) {
    const value = plain(text);
    if (value === this.#part(place, at)) return;
    const parts = this.#parts[place];
    const whole = Array.from({ length: Math.max(this.#count, parts.length) }, (_, index) => parts[index] ?? "");
    whole[at] = value;
    // Emptied parts without a segment are removed.
    while (at >= this.#count && whole.length > this.#count && whole.at(-1).trim() === "") whole.pop();
    this.#does.change(this.#columns[place].name, whole.join(DELIMITER));
  }
}

/** Returns typed text as a part of an element. A `|` would start a new segment. */
const plain = (text) => text.replaceAll(DELIMITER, "").replace(/\s*\n\s*/g, " ").trim();
