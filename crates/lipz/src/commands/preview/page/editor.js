// Editing a clip: shapes, segments, texts and events. The compiler packs each change before it is drawn.

import { VISEMES } from "../web/face.js";
import { openDialogue } from "../web/lipz.js";
import { showDifference } from "./difference.js";
import { Edits } from "./edits.js";
import { Mouth } from "./mouth.js";
import { Shapes } from "./shapes.js";
import { source } from "./source.js";
import { Texts } from "./texts.js";

const $ = (id) => document.getElementById(id);

export class Editor {
  isReadOnly = true;
  #clip;
  #does;
  #edits;
  #shapes;
  #texts;
  #locales = [];
  /** The number of requested drafts. Only the last is drawn. */
  #asked = 0;
  /** Resolves when the last draft is drawn. */
  settled = Promise.resolve();

  /** `does` has the callbacks for changes: `draw` the clip of a dialogue, `diagnose`, `step`, `frame` and `seek`. */
  constructor(tracks, does) {
    this.#does = does;
    const change = (mouth, isDone) => isDone && this.#set("visemes", mouth.toString());
    this.#shapes = new Shapes(tracks, { change, step: does.step, frame: does.frame });
    this.#texts = new Texts($("texts"), { change: (name, text) => this.#set(name, text), seek: does.seek });
    $("again").onclick = () => this.#solve(true);
    $("drop").onclick = () => this.#solve(false);
  }

  get key() {
    return this.#edits?.page.key;
  }

  get words() {
    return this.#edits.page.words;
  }

  /** The locales with texts in the file. */
  get ownLocales() {
    return this.#edits?.locales ?? [];
  }

  get isChanged() {
    return this.#edits?.isChanged ?? false;
  }

  get #isEditable() {
    return !this.isReadOnly && this.#edits.isEditable;
  }

  /** The clip on display. */
  set clip(clip) {
    this.#clip = clip;
  }

  /** Starts over with a clip. */
  show(page) {
    this.#edits = new Edits(page);
    $("conflict").hidden = true;
    this.#fill();
  }

  /** Takes over the current file, unless it has unsaved changes. Returns whether it did. */
  refresh(page) {
    if (this.isChanged) return true;
    if (this.#edits.isAs(page)) this.#edits.rebase(page);
    else this.#edits = new Edits(page);
    this.#fill();
    return false;
  }

  /** Shows texts in these locales. */
  languages(main, beside) {
    this.#locales = [main, beside].filter(Boolean);
    this.#fill();
  }

  /** Draws the visible frames. */
  look() {
    this.#shapes.draw();
  }

  mark(segment) {
    this.#texts.mark(segment);
  }

  undo() {
    this.#edits.undo();
    this.#drafted();
  }

  redo() {
    this.#edits.redo();
    this.#drafted();
  }

  /** Writes the changes into the file. */
  async save() {
    if (!this.isChanged || this.isReadOnly) return;
    await this.settled;
    const answer = await source.save(this.#edits.change);
    if (answer.result === "saved") {
      this.#edits.rebase(await source.clip(this.key));
      this.#fill();
      return;
    }
    if (answer.result === "conflict") {
      $("conflict").hidden = false;
      showDifference($("theirs"), answer.theirs);
      showDifference($("yours"), answer.yours);
      $("again").focus();
      return;
    }
    if (answer.result === "errors") this.#does.diagnose(answer.diagnostics);
    throw new Error(`Not saved: ${answer.message ?? "the clip has errors"}`);
  }

  /** Ends a conflict: the changes are applied to the new file, or dropped. */
  async #solve(isMine) {
    const page = await source.clip(this.key);
    if (isMine) this.#edits.rebase(page);
    else this.#edits = new Edits(page);
    $("conflict").hidden = true;
    this.#drafted();
  }

  #set(name, text) {
    if (this.#edits.set(name, text)) this.#drafted();
  }

  /** Draws the parts of the file that can be packed, if the bank does not have the clip. */
  async pack() {
    if (!this.#edits.isEditable) return;
    this.settled = this.#draft(++this.#asked);
    await this.settled;
  }

  /** Shows the changed file at once, and the clip after packing. */
  #drafted() {
    this.#fill();
    this.settled = this.#draft(++this.#asked);
    return this.settled;
  }

  async #draft(asked) {
    const { answer, bank } = await source.draft(this.#edits.change);
    if (asked !== this.#asked) return;
    if (answer.result !== "draft") throw new Error(answer.message);
    if (bank) this.#does.draw(await openDialogue([bank]));
    this.#does.diagnose(answer.diagnostics);
  }

  /** The viseme type of the file's codes. The project may convert them to a different type. */
  get #type() {
    const own = this.#edits.get("viseme_type");
    return Object.hasOwn(VISEMES, own ?? "") ? own : this.#clip?.visemeType;
  }

  #fill() {
    if (this.#edits === undefined) return;
    // For a clip without a file, take the shapes in the bank.
    const visemes = this.#edits.get("visemes") ?? (this.#edits.isEditable ? undefined : shapesOf(this.#clip));
    const mouth = Mouth.read(visemes ?? "");
    // In a file without visemes, type them here.
    $("shapes").hidden = visemes === undefined && !this.#isEditable;
    this.#shapes.show(mouth, this.#type, this.#isEditable);
    const column = (tag) => ({ name: `text_${tag}`, label: tag, lang: tag, text: this.#edits.get(`text_${tag}`) });
    const events = { name: "events", label: "Events", lang: "", text: this.#edits.get("events") };
    $("texts").hidden = this.#edits.page.path === null;
    this.#texts.show([...this.#locales.map(column), events], mouth.starts.length + 1, this.#isEditable);
    $("edits").hidden = !this.#isEditable;
    $("undo").disabled = !this.#edits.canUndo;
    $("redo").disabled = !this.#edits.canRedo;
    $("save").disabled = !this.isChanged;
    document.body.classList.toggle("changed", this.isChanged);
  }
}

/** Returns the shapes of a clip of a bank as a file would store them. */
function shapesOf(clip) {
  const parts = clip?.segments.map(({ startFrame, endFrame }) => clip.frames.slice(startFrame, endFrame));
  return parts?.join("|");
}
