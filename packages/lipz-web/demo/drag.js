// Dragging the playhead: with a pointer on anything that shows time from left to right.

/**
 * Calls `scrub` with the time under the pointer, and whether the pointer is still down. `timeAt` is the time at an x of the
 * window; `isTaken` says that a press is for something else, such as a scrollbar.
 */
export function onDrag(element, timeAt, scrub, isTaken = () => false) {
  let held;
  /** The last time that was shown; undefined if none was. */
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
  // The browser scrolls: its event has no place.
  element.addEventListener("pointercancel", (event) => {
    if (event.pointerId !== held) return;
    held = undefined;
    if (last !== undefined) scrub(last, false);
  });
}
