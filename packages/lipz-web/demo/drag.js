// Dragging the playhead: with a pointer on anything that shows time from left to right.

/**
 * Calls `scrub` with the time under the pointer, and whether the pointer is still down. `timeAt` is the time at an x of the
 * window; `isTaken` says that a press is for something else, such as a scrollbar.
 */
export function onDrag(element, timeAt, scrub, isTaken = () => false) {
  let held;
  element.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || isTaken(event)) return;
    held = event.pointerId;
    element.setPointerCapture(held);
    scrub(timeAt(event.clientX), true);
  });
  element.addEventListener("pointermove", (event) => {
    if (event.pointerId === held) scrub(timeAt(event.clientX), true);
  });
  for (const end of ["pointerup", "pointercancel"]) {
    element.addEventListener(end, (event) => {
      if (event.pointerId !== held) return;
      held = undefined;
      scrub(timeAt(event.clientX), false);
    });
  }
}
