// The changes of a clip: undo, redo, and unsaved changes.

/** The prefix of the names of text elements. */
const TEXT = "text_";

export class Edits {
  #page;
  #inFile;
  /** The texts of all elements: now, before each change, and after each undone change. */
  #now;
  #done = [];
  #undone = [];

  /** Starts with a clip as stored in its file. */
  constructor(page) {
    this.#take(page);
    this.#now = this.#inFile;
  }

  get page() {
    return this.#page;
  }

  /** Whether the clip has an editable file. */
  get isEditable() {
    return this.#page.source !== null;
  }

  get canUndo() {
    return this.#done.length > 0;
  }

  get canRedo() {
    return this.#undone.length > 0;
  }

  /** Whether anything differs from the file. */
  get isChanged() {
    return Object.keys(this.#changed).length > 0;
  }

  /** The change in the form that the server expects. */
  get change() {
    return { key: this.#page.key, source: this.#page.source, elements: this.#changed };
  }

  get #changed() {
    const names = Object.keys({ ...this.#inFile, ...this.#now });
    const others = names.filter((name) => (this.#now[name] ?? "") !== (this.#inFile[name] ?? ""));
    return Object.fromEntries(others.map((name) => [name, this.#now[name] ?? ""]));
  }

  /** Returns the text of an element, or undefined if the clip lacks it. */
  get(name) {
    return this.#now[name];
  }

  /** The locales of its texts. */
  get locales() {
    const names = Object.keys(this.#now).filter((name) => name.startsWith(TEXT));
    return names.map((name) => name.slice(TEXT.length));
  }

  /** Sets the text of an element. Returns whether it has changed. */
  set(name, text) {
    if (text === this.get(name)) return false;
    this.#done.push(this.#now);
    this.#undone = [];
    this.#now = { ...this.#now, [name]: text };
    return true;
  }

  undo() {
    if (!this.canUndo) return;
    this.#undone.push(this.#now);
    this.#now = this.#done.pop();
  }

  redo() {
    if (!this.canRedo) return;
    this.#done.push(this.#now);
    this.#now = this.#undone.pop();
  }

  /** Whether the file matches the page. */
  isAs(page) {
    const there = Object.entries(Object.fromEntries(page.elements));
    return there.length === Object.keys(this.#now).length && there.every(([name, text]) => this.#now[name] === text);
  }

  /** Takes over the current file. Changes made here are kept and can be undone; everything else is as in the file. */
  rebase(page) {
    const states = [...this.#done, this.#now, ...this.#undone];
    const names = Object.keys(Object.assign({}, ...states));
    const touched = names.filter((name) => states.some((state) => state[name] !== states[0][name]));
    this.#take(page);
    const keep = (state) => ({ ...this.#inFile, ...Object.fromEntries(touched.map((name) => [name, state[name]])) });
    this.#now = keep(this.#now);
    [this.#done, this.#undone] = [this.#done.map(keep), this.#undone.map(keep)];
  }

  #take(page) {
    this.#page = page;
    this.#inFile = Object.fromEntries(page.elements);
  }
}
