// The demo for a user who does not want motion: it shows the content of the line, and nothing sways.

export async function motion(demo, same) {
  const { page, window, player } = await demo({ bank: "faces", clip: "rig" });
  same(window.matchMedia("(prefers-reduced-motion: reduce)").matches, true, "the browser says so");
  const seen = (name, attribute) => page.querySelector(`#face [data-part=${name}]`).getAttribute(attribute);
  const isMoved = (from, to, name, attribute) => {
    player.seek(from);
    const before = seen(name, attribute);
    player.seek(to);
    return seen(name, attribute) !== before;
  };
  same(isMoved(0, 0.8, "features", "transform"), false, "the head");
  same(isMoved(1.7, 2.2, "body", "d"), false, "breath");
  same(isMoved(0.5, 1, "leftIris", "cx"), false, "glances");
  same(isMoved(0, 0.5, "leftUpper", "d"), true, "a blink");
  same(isMoved(0, 0.2, "inside", "d"), true, "the mouth");
  same(isMoved(0, 0.66, "browLeft", "d"), true, "brows");
}
