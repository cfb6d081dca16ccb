// What both browsers evaluate in the page.

/** The middle of an element, in the window, once it is in view. */
export const middleOf = (selector) => `(() => {
  const element = document.querySelector(${JSON.stringify(selector)});
  element.scrollIntoView({ block: "nearest" });
  const { left, top, width, height } = element.getBoundingClientRect();
  return { x: left + width / 2, y: top + height / 2 };
})()`;
