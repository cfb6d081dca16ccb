// Drags the playhead with a pointer, on any element that shows time from left to right.

/**
 * Calls `scrub` with the time under the pointer, and whether the pointer is still down. `timeAt` returns the time at an
 * x of the window. `isTaken` returns whether a press has a different target, such as a scrollbar.
 */
export function onDrag(element, timeAt, scrub, isTaken = () => false) {
  let held;
  /** The last time shown, or undefined. */
  let last;
  const show = (event) => scrub((last = timeAt(event.clientX)), true);
  element.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || isTaken(event)) return;
    [held, last] = [event.pointerId, undefined];
    element.setPointerCapture(held);
    // A finger may be about to scroll the page.
    if (event.pointerType !== "touch") show(event);
  });
  element.addEventListener("pointermove", (event) => {
    if (event.pointerId === held) show(event);
  });
  element.addEventListener("pointerup", (event) => {
    if (event.pointerId !== held) return;
    held = undefined;
    scrub(timeAt(event.clientX), false);
  });
  // The browser scrolls, and its event has no position.
  element.addEventListener("pointercancel", (event) => {
    if (event.pointerId !== held) return;
    held = undefined;
    if (last !== undefined) scrub(last, false);
  });
}
