// Editing a clip: shapes, segments, texts and events. The compiler packs each change before it is drawn.

import { VISEMES } from "../web/face.js";
import { openDialogue } from "../web/lipz.js";
import { showDifference } from "./difference.js";
import { followed, listReview } from "./division.js";
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
  /** Whether the file has changed without being shown here. */
  #isBehind = false;
  /** The number of requested drafts. Only the last is drawn. */
  #asked = 0;
  /** Resolves when the last draft is drawn. */
  settled = Promise.resolve();

  /**
   * `does` has the callbacks for changes: `draw` the clip of a dialogue, `diagnose`, `step`, `frame`, `seek`, and
   * `refresh`, to show the current file.
   */
  constructor(tracks, does) {
    this.#does = does;
    const change = (mouth, isDone) => isDone && this.#set(followed(this.#edits, mouth, this.#clip));
    this.#shapes = new Shapes(tracks, { change, step: does.step, frame: does.frame });
    this.#texts = new Texts($("texts"), {
      change: (name, text) => this.#set({ elements: { [name]: text } }),
      seek: does.seek,
      type: () => this.#typed(),
      look: (name, segment) => this.#edits.looked(name, segment) && this.#fill(),
    });
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
    return (this.#edits?.isChanged ?? false) || this.#texts.isTyping;
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
    this.#isBehind = false;
    $("conflict").hidden = true;
    this.#fill();
  }

  /** Takes over the current file, unless it has unsaved changes. Returns whether it has. */
  refresh(page) {
    // The server compares the file with the one that the changes are based on.
    this.#isBehind = this.isChanged;
    if (this.#isBehind) return true;
    this.#edits.rebase(page);
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
    this.#follow();
  }

  redo() {
    this.#edits.redo();
    this.#drafted();
    this.#follow();
  }

  /** Writes the changes into the file, including text that is being typed. */
  async save() {
    this.#texts.commit();
    if (!this.isChanged || this.isReadOnly) return;
    await this.settled;
    const answer = await source.save(this.#edits.change);
    if (answer.result === "saved") {
      this.#isBehind = false;
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
    this.#isBehind = false;
    $("conflict").hidden = true;
    this.#drafted();
  }

  #set({ elements, review }) {
    if (this.#edits.set(elements, review)) this.#drafted();
  }

  /** Shows whether there are changes, after a key in a field. */
  #typed() {
    $("save").disabled = !this.isChanged;
    document.body.classList.toggle("changed", this.isChanged);
    this.#follow();
  }

  /** Shows the current file, if changes that kept it from being shown are undone. */
  #follow() {
    if (!this.#isBehind || this.isChanged) return;
    this.#isBehind = false;
    this.#does.refresh();
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
    const column = (tag) => {
      const name = `text_${tag}`;
      return { name, label: tag, lang: tag, text: this.#edits.get(name), review: this.#edits.review[name] };
    };
    const events = { name: "events", label: "Events", lang: "", text: this.#edits.get("events") };
    $("texts").hidden = this.#edits.page.path === null;
    this.#texts.show([...this.#locales.map(column), events], mouth.starts.length + 1, this.#isEditable);
    listReview($("divided"), this.#edits.review);
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
