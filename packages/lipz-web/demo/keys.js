// The keys of the player: on the page as a whole, and on its timeline, which is a slider.

/** Elements that use keys themselves. */
const OWN = "input:not([type=checkbox]):not([type=file]), select, textarea, [contenteditable]";
/** Elements that Space already presses. */
const PRESSED = "button, input, label, a, summary";

/** Calls a function of `does` for each key of the player. */
export function onKeys(does) {
  const keys = {
    " ": ({ target }) => target.closest(PRESSED) || does.toggle,
    ArrowLeft: ({ shiftKey }) => () => (shiftKey ? does.seconds(-1) : does.frames(-1)),
    ArrowRight: ({ shiftKey }) => () => (shiftKey ? does.seconds(1) : does.frames(1)),
    ArrowDown: (event) => event.target.role === "slider" && keys.ArrowLeft(event),
    ArrowUp: (event) => event.target.role === "slider" && keys.ArrowRight(event),
    PageDown: ({ target }) => target.role === "slider" && (() => does.seconds(-1)),
    PageUp: ({ target }) => target.role === "slider" && (() => does.seconds(1)),
    Home: () => does.start,
    End: () => does.end,
    "+": () => () => does.zoom(true),
    "-": () => () => does.zoom(false),
  };
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || event.target.closest(OWN)) return;
    const action = Object.hasOwn(keys, event.key) && keys[event.key](event);
    if (typeof action !== "function") return;
    event.preventDefault();
    action();
  });
}
