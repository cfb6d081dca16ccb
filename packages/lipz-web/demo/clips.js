// The choice of a clip: a search field, and a list of results (the combobox of ARIA's authoring practices).

/** The maximum number of clips in the list. More would be slow and hard to read. */
const MOST = 60;

export class Clips {
  #input;
  #list;
  #keys = [];
  #chosen = "";
  #choose;
  #active = -1;

  /** `choose` receives the key of the chosen clip. */
  constructor(input, list, choose) {
    this.#input = input;
    this.#list = list;
    this.#choose = choose;
    input.addEventListener("focus", () => {
      input.select();
      this.#open("");
    });
    input.addEventListener("click", () => this.#list.hidden && this.#open(""));
    input.addEventListener("input", () => this.#open(input.value));
    input.addEventListener("blur", () => this.#close());
    input.addEventListener("keydown", (event) => this.#key(event));
    // This event comes before the field loses the focus and the list closes.
    list.addEventListener("pointerdown", (event) => {
      event.preventDefault();
      const option = event.target.closest("[data-key]");
      if (option) this.#take(option.dataset.key);
    });
  }

  /** All clips. */
  set keys(keys) {
    this.#keys = keys;
  }

  /** The current clip. */
  set chosen(key) {
    this.#chosen = key;
    this.#close();
  }

  /** The keys that contain all words of a query. Keys that start with the query come first. */
  find(query) {
    const words = query.toLowerCase().split(/\s+/).filter(Boolean);
    const found = this.#keys.filter((key) => words.every((word) => key.toLowerCase().includes(word)));
    const starts = (key) => words.length > 0 && key.toLowerCase().startsWith(words[0]);
    return [...found.filter(starts), ...found.filter((key) => !starts(key))];
  }

  #open(query) {
    const found = this.find(query);
    // Without a query, the list starts a little before the current clip.
    const from = query === "" ? Math.max(0, Math.min(found.indexOf(this.#chosen) - 5, found.length - MOST)) : 0;
    const options = found.slice(from, from + MOST).map((key, index) => {
      const option = document.createElement("li");
      Object.assign(option, { id: `clip-${index}`, textContent: key, role: "option" });
      option.dataset.key = key;
      option.ariaSelected = String(key === this.#chosen);
      return option;
    });
    const left = found.length - options.length;
    if (left > 0 || found.length === 0) {
      const rest = document.createElement("li");
      rest.className = "rest";
      rest.textContent = found.length === 0 ? "No matching clips" : `${left} more; type to filter`;
      options.push(rest);
    }
    this.#list.replaceChildren(...options);
    this.#list.hidden = false;
    this.#input.ariaExpanded = "true";
    this.#activate(query === "" ? found.indexOf(this.#chosen) - from : 0);
  }

  #close() {
    this.#list.hidden = true;
    this.#input.ariaExpanded = "false";
    this.#input.removeAttribute("aria-activedescendant");
    this.#input.value = this.#chosen;
    this.#input.title = this.#chosen;
  }

  #activate(index) {
    const options = Array.from(this.#list.querySelectorAll("[data-key]"));
    this.#active = Math.max(0, Math.min(index, options.length - 1));
    options.forEach((option, at) => option.classList.toggle("active", at === this.#active));
    const active = options[this.#active];
    if (active) this.#input.setAttribute("aria-activedescendant", active.id);
    else this.#input.removeAttribute("aria-activedescendant");
    active?.scrollIntoView({ block: "nearest" });
  }

  #key(event) {
    const steps = { ArrowDown: 1, ArrowUp: -1, PageDown: 10, PageUp: -10 };
    if (event.key in steps) {
      event.preventDefault();
      if (this.#list.hidden) this.#open("");
      else this.#activate(this.#active + steps[event.key]);
    } else if (event.key === "Enter" && !this.#list.hidden) {
      const option = this.#list.querySelector(".active");
      if (option) this.#take(option.dataset.key);
    } else if (event.key === "Escape") {
      this.#close();
    }
  }

  #take(key) {
    this.chosen = key;
    this.#choose(key);
  }
}
