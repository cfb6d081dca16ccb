// The keyboard shortcuts of the page, as in video editors.

/** Elements that handle keys themselves. */
const OWN = "input, select, textarea";
/** Elements that Space activates. */
const PRESSED = "button, label, a, summary";

/** Calls a function of `does` for each shortcut. */
export function onKeys(does) {
  const plain = {
    " ": ({ target }) => (target.closest(PRESSED) ? undefined : does.toggle),
    k: () => does.stop,
    l: () => does.forward,
    j: () => does.back,
    o: () => does.loop,
    h: () => does.half,
    "/": () => does.search,
    ArrowLeft: ({ shiftKey }) => () => (shiftKey ? does.seconds(-1) : does.frames(-1)),
    ArrowRight: ({ shiftKey }) => () => (shiftKey ? does.seconds(1) : does.frames(1)),
    Home: () => does.start,
    End: () => does.end,
    "+": () => () => does.zoom(true),
    "-": () => () => does.zoom(false),
  };
  const withControl = { s: () => does.save, z: ({ shiftKey }) => (shiftKey ? does.redo : does.undo), y: () => does.redo };
  addEventListener("keydown", (event) => {
    if (event.altKey) return;
    const isCommand = event.ctrlKey || event.metaKey;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const isText = Boolean(event.target.closest?.(OWN));
    // In a field, the browser undoes typing.
    if (isText && !(isCommand && key === "s")) return;
    const keys = isCommand ? withControl : plain;
    const action = Object.hasOwn(keys, key) ? keys[key](event) : undefined;
    if (action === undefined) return;
    event.preventDefault();
    action();
  });
}
