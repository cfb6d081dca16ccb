// The list of clips: search, filters, and rendering of visible rows only, so that 100,000 clips are as fast as ten.

/** The number of extra rows above and below those in view. */
const SPARE = 6;
/** The time for reading texts before the page does other work. */
const SLICE_MS = 8;
/** Codes of outdated content: stale-mouth, stale-translation, outdated-recording. */
const STALE = ["LZ1705", "LZ1911", "LZ1915"];

const WHAT = {
  "All clips": () => true,
  "With diagnostics": (clip) => clip.errors || clip.warnings,
  "With errors": (clip) => clip.errors,
  "Stale": (clip) => clip.codes?.some((code) => STALE.includes(code)),
  "With uncertain words": (clip) => clip.doubtful_words,
  "Without a recording": (clip) => !clip.has_sound,
};
const LENGTH = {
  "Any length": () => true,
  "Below 2 s": (clip) => clip.seconds < 2,
  "2 to 5 s": (clip) => clip.seconds >= 2 && clip.seconds < 5,
  "5 to 10 s": (clip) => clip.seconds >= 5 && clip.seconds < 10,
  "10 s or more": (clip) => clip.seconds >= 10,
};

const $ = (id) => document.getElementById(id);

export class List {
  #clips = [];
  #found = [];
  #locales = [];
  #chosen;
  #choose;
  #said;
  #track = document.createElement("div");

  /** `choose` receives the key of the chosen clip; `said` returns all texts of a clip in lower case. */
  constructor(choose, said) {
    [this.#choose, this.#said] = [choose, said];
    this.#track.role = "presentation";
    $("list").append(this.#track);
    $("list").addEventListener("scroll", () => this.#draw());
    $("list").addEventListener("keydown", (event) => this.#key(event));
    $("list").addEventListener("click", ({ target }) => this.#take(target.closest("[data-key]")?.dataset.key));
    $("search").addEventListener("keydown", (event) => event.key !== "Home" && event.key !== "End" && this.#key(event));
    $("search").addEventListener("focus", () => this.#read());
    new ResizeObserver(() => this.#draw()).observe($("list"));
    options($("what"), Object.keys(WHAT));
    options($("length"), Object.keys(LENGTH));
    for (const id of ["search", "what", "missing", "who", "length"]) $(id).addEventListener("input", () => this.#filter(true));
  }

  /** The number of clips that match the filters. */
  get count() {
    return this.#found.length;
  }

  /** Shows the clips of a project. Filters stay unchanged. */
  show({ clips, locales }) {
    this.#clips = clips.map((clip) => ({ ...clip, name: clip.key.toLowerCase() }));
    this.#locales = locales;
    options($("missing"), ["Any translation", ...locales.map((tag) => `Not in ${tag}`)]);
    const characters = new Set(clips.flatMap(({ characters = [] }) => characters));
    options($("who"), ["Any character", ...Array.from(characters).sort()]);
    $("who").hidden = characters.size === 0;
    $("missing").hidden = locales.length < 2;
    this.#filter(false);
  }

  /** Marks the current clip, and scrolls it into view. */
  set chosen(key) {
    this.#chosen = key;
    this.#draw();
    const index = this.#found.findIndex((clip) => clip.key === key);
    if (index < 0) return;
    const [top, bottom] = [index * this.#rowPx, (index + 1) * this.#rowPx];
    const { scrollTop, clientHeight } = $("list");
    if (top < scrollTop) $("list").scrollTop = top;
    else if (bottom > scrollTop + clientHeight) $("list").scrollTop = bottom - clientHeight;
  }

  get #rowPx() {
    return 3.25 * parseFloat(getComputedStyle(document.documentElement).fontSize);
  }

  /** Reads the texts of all clips in small steps, so that the first search does not wait for them. */
  async #read() {
    let end = performance.now() + SLICE_MS;
    for (const { key } of this.#clips) {
      this.#said(key);
      if (performance.now() < end) continue;
      await new Promise((resolve) => setTimeout(resolve));
      end = performance.now() + SLICE_MS;
    }
  }

  #filter(isAnew) {
    const words = $("search").value.toLowerCase().split(/\s+/).filter(Boolean);
    const missing = $("missing").selectedIndex - 1;
    const who = $("who").selectedIndex > 0 && $("who").value;
    const tests = [
      words.length > 0 && ((clip) => words.every((word) => clip.name.includes(word) || this.#said(clip.key).includes(word))),
      WHAT[$("what").value],
      LENGTH[$("length").value],
      missing >= 0 && ((clip) => !clip.locales?.includes(missing)),
      who && ((clip) => clip.characters?.includes(who)),
    ].filter(Boolean);
    this.#found = this.#clips.filter((clip) => tests.every((test) => test(clip)));
    const [all, left] = [this.#clips.length, this.#found.length];
    const shown = counted(all, "clip");
    $("count").textContent = left === all ? shown : `${left.toLocaleString("en")} of ${shown}`;
    this.#track.style.height = `${this.#found.length * this.#rowPx}px`;
    if (isAnew) $("list").scrollTop = 0;
    this.#draw();
  }

  #draw() {
    const row = this.#rowPx;
    const { scrollTop, clientHeight } = $("list");
    const first = Math.max(0, Math.floor(scrollTop / row) - SPARE);
    const shown = this.#found.slice(first, Math.ceil((scrollTop + clientHeight) / row) + SPARE);
    this.#track.replaceChildren(...shown.map((clip, at) => this.#row(clip, first + at, row)));
    const chosen = this.#track.querySelector("[aria-selected=true]");
    if (chosen) $("list").setAttribute("aria-activedescendant", chosen.id);
    else $("list").removeAttribute("aria-activedescendant");
  }

  #row(clip, index, row) {
    const item = document.createElement("div");
    Object.assign(item, { id: `row-${index}`, role: "option", className: "row", title: clip.key });
    item.dataset.key = clip.key;
    item.ariaSelected = String(clip.key === this.#chosen);
    item.ariaSetSize = String(this.#found.length);
    item.ariaPosInSet = String(index + 1);
    item.style.transform = `translateY(${index * row}px)`;
    const folder = clip.key.slice(0, clip.key.lastIndexOf("/") + 1);
    item.append(made("span", "name", clip.key.slice(folder.length)), made("small", "about", this.#about(clip, folder)));
    if (clip.errors) item.append(made("span", "badge error", counted(clip.errors, "error")));
    else if (clip.warnings) item.append(made("span", "badge warning", counted(clip.warnings, "warning")));
    return item;
  }

  #about({ seconds, locales, doubtful_words, is_left_out }, folder) {
    const about = [folder.slice(0, -1), seconds !== undefined && `${seconds.toFixed(1)} s`];
    if (this.#locales.length > 1 && !is_left_out) about.push(`${locales?.length ?? 0}/${this.#locales.length} locales`);
    if (doubtful_words) about.push(counted(doubtful_words, "uncertain word"));
    if (is_left_out) about.push("not in the bank");
    return about.filter(Boolean).join(" · ");
  }

  #key(event) {
    const page = Math.max(1, Math.floor($("list").clientHeight / this.#rowPx) - 1);
    const at = this.#found.findIndex((clip) => clip.key === this.#chosen);
    const last = this.#found.length - 1;
    const to = { ArrowDown: at + 1, ArrowUp: at - 1, PageDown: at + page, PageUp: at - page, Home: 0, End: last }[event.key];
    if (to === undefined || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    event.stopPropagation();
    this.#take(this.#found[Math.max(0, Math.min(to, last))]?.key);
  }

  #take(key) {
    if (key !== undefined && key !== this.#chosen) this.#choose(key);
  }
}

const counted = (count, what) => `${count.toLocaleString("en")} ${what}${count === 1 ? "" : "s"}`;

/** Replaces the options of a choice. The selected one stays if it is among them. */
function options(select, names) {
  const { value } = select;
  select.replaceChildren(...names.map((name) => new Option(name, name, false, name === value)));
}

export function made(tag, className, textContent = "") {
  return Object.assign(document.createElement(tag), { className, textContent });
}
