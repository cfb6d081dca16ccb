// The changes of a clip: undo, redo, and unsaved changes.

/** The prefix of the names of text elements. */
const TEXT = "text_";
const DELIMITER = "|";

export class Edits {
  #page;
  #inFile;
  /** The texts of all elements. */
  #now;
  /** The segments whose texts a person should review, by the name of their element. */
  #review = {};
  /**
   * The changes before and after the current state, each as `{ before, after, reviews }` with the texts of its elements,
   * and the segments to review before and after it.
   */
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
    const others = names.filter((name) => !isSame(this.#now[name], this.#inFile[name]));
    return Object.fromEntries(others.map((name) => [name, this.#now[name] ?? ""]));
  }

  /** Returns the text of an element, or undefined if the clip lacks it. */
  get(name) {
    return this.#now[name];
  }

  /** The locales of its texts. */
  get locales() {
    return this.#texts.map((name) => name.slice(TEXT.length));
  }

  /** The names of the elements with texts and events. */
  get segmented() {
    return [...this.#texts, "events"].filter((name) => this.#now[name] !== undefined);
  }

  get #texts() {
    return Object.keys(this.#now).filter((name) => name.startsWith(TEXT));
  }

  get review() {
    return this.#review;
  }

  /** Takes note that a person looks at a text. Returns whether it was to be reviewed. */
  looked(name, segment) {
    if (!this.#review[name]?.includes(segment)) return false;
    this.#review = { ...this.#review, [name]: this.#review[name].filter((other) => other !== segment) };
    return true;
  }

  /** Sets the texts of elements and the segments to review in one step. Returns whether any text has changed. */
  set(elements, review = this.#review) {
    const after = Object.fromEntries(Object.entries(elements).filter(([name, text]) => text !== this.get(name)));
    const names = Object.keys(after);
    if (names.length === 0) return false;
    const before = Object.fromEntries(names.map((name) => [name, this.#now[name]]));
    this.#done.push({ before, after, reviews: { before: this.#review, after: review } });
    this.#undone = [];
    this.#review = review;
    this.#now = { ...this.#now, ...after };
    return true;
  }

  undo() {
    if (!this.canUndo) return;
    const change = this.#done.pop();
    this.#undone.push(change);
    this.#now = { ...this.#now, ...change.before };
    this.#review = change.reviews.before;
  }

  redo() {
    if (!this.canRedo) return;
    const change = this.#undone.pop();
    this.#done.push(change);
    this.#now = { ...this.#now, ...change.after };
    this.#review = change.reviews.after;
  }

  /**
   * Takes over the current file. Elements with unsaved changes stay as they are here, and all others become as they are
   * there. Changes of an element can be undone unless it was changed in the file as well.
   */
  rebase(page) {
    const [now, base, unsaved] = [this.#now, this.#inFile, this.#changed];
    this.#take(page);
    // An own change that is in the file by now, possibly aligned, is saved.
    const kept = Object.entries(unsaved).filter(([name, text]) => !isSame(text, this.#inFile[name]));
    this.#now = { ...this.#inFile, ...Object.fromEntries(kept) };
    const names = Object.keys({ ...base, ...this.#inFile });
    const foreign = names.filter((name) => !isSame(now[name], this.#inFile[name]) && !isSame(base[name], this.#inFile[name]));
    const rest = (texts) => Object.fromEntries(Object.entries(texts).filter(([name]) => !foreign.includes(name)));
    const without = (changes) =>
      changes.map((change) => ({ ...change, before: rest(change.before), after: rest(change.after) })).filter(({ after }) => Object.keys(after).length > 0);
    [this.#done, this.#undone] = [without(this.#done), without(this.#undone)];
  }

  #take(page) {
    this.#page = page;
    this.#inFile = Object.fromEntries(page.elements);
  }
}

/** Whether two texts of an element are the same. Spaces around segments only align them. */
function isSame(one = "", other = "") {
  const parts = (text) => text.split(DELIMITER).map((part) => part.trim()).join(DELIMITER);
  return one === other || parts(one) === parts(other);
}
