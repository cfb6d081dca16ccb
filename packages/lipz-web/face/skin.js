// The skin, with its colour, cheeks, wrinkles, tears and sweat; and the light of a mood behind the head.

import { mixed } from "./colour.js";
import { moodOf } from "./emotion.js";
import { path, px } from "./path.js";

const SKIN = "#f2c9a5";
const BLUSH = "#e9957a";
/** The colours into which skin can turn, each with its maximum share. */
const TURNS = { flush: ["#e2574c", 0.3], pale: ["#e9e6e4", 0.55], sick: ["#8fb05a", 0.35] };

/** The colour of the skin. */
export function skinOf(weight) {
  const turned = Object.entries(TURNS).map(([name, [colour, most]]) => [colour, most * Math.max(0, weight(name))]);
  const rest = Math.max(0, 1 - turned.reduce((sum, [, share]) => sum + share, 0));
  const sum = turned.reduce((sum, [, share]) => sum + share, rest);
  return mixed([[SKIN, rest], ...turned].map(([colour, share]) => [colour, share / sum]));
}

/** The light behind the head, in the colours of the emotions. */
export function moodParts(emotions, id) {
  const { colour, strength } = moodOf(emotions);
  return {
    mood: { fill: `url(#${id}mood)`, opacity: px(strength > 0 ? 0.2 + 0.8 * strength : 0) },
    moodLight: { id: `${id}mood` },
    moodNear: { "stop-color": colour },
    moodFar: { "stop-color": colour },
  };
}

/** `x` is the offset of the features, against which the cheeks stay on the head. */
export function skinParts(weight, x) {
  const cheek = (side) => Math.max(0, weight(`cheekSquint${side}`));
  const puff = weight("cheekPuff");
  const flush = 0.5 * Math.max(0, weight("flush"));
  const blush = mixed([[BLUSH, 1 - flush], ["#d8403a", flush]]);
  const shown = Math.max(0, 0.42 + 0.4 * weight("flush") - 0.42 * weight("pale") - 0.3 * weight("sick"));
  const cheekAt = (side, sign) => ({
    cx: px(sign * (46 + 3 * puff) - 0.35 * x),
    cy: px(28 - 4 * cheek(side) + 8 * puff),
    rx: px(14 + 5 * puff),
    ry: px(9 + 6 * puff),
    fill: blush,
    opacity: px(shown),
  });
  const wrinkle = Math.max(0, (weight("noseSneerLeft") + weight("noseSneerRight")) / 2);
  return {
    cheekLeft: cheekAt("Left", 1),
    cheekRight: cheekAt("Right", -1),
    // From the nose around the mouth.
    crease: {
      d: path`M-17 36Q-30 44 -33 ${56 - 4 * cheek("Right")}M17 36Q30 44 33 ${56 - 4 * cheek("Left")}`,
      opacity: px(Math.min(0.6, 0.7 * Math.max(cheek("Left"), cheek("Right"), wrinkle))),
    },
    wrinkles: { d: path`M-6 9L-2 12M6 9L2 12M-7 15L-3 17M7 15L3 17`, opacity: px(Math.min(0.7, 0.8 * wrinkle)) },
    tears: { d: drop(-33, 22, 5) + drop(33, 27, 5), opacity: px(weight("tears")) },
    sweat: { d: drop(59, -20, 6) + drop(-55, -34, 4.5), opacity: px(Math.min(1, weight("sweat"))) },
  };
}

/** A drop, as the text of a path. */
function drop(x, y, size) {
  const [low, floor] = [y + size * 0.4, y + size * 1.3];
  const near = size * 0.7;
  return path`M${x} ${y - size}C${x + size} ${low} ${x + near} ${floor} ${x} ${floor}C${x - near} ${floor} ${x - size} ${low} ${x} ${y - size}Z`;
}
