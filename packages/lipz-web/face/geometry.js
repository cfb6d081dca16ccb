// From a pose to the attributes of the parts: where everything is drawn.
//
// Proportions are those that "Talking Heads" names: the eyes halfway down the head, brow, base of the nose and chin a third
// apart, the mouth as wide as the pupils are apart. Left is the left of the character, so right in the picture.

import { mixed, moodOf, weightsOf } from "./emotion.js";
import { eyeParts } from "./eyes.js";
import { mouthParts } from "./lips.js";
import { lipsOf, shapeOf } from "./mouth.js";
import { path, px } from "./path.js";

const SKIN = "#f2c9a5";
const RADIANS = Math.PI / 180;
/** How far features move on a head that turns, in the units of the picture. */
const DEPTH = 46;

/** The least and the greatest value of each number of a pose; a flat face can turn only so far. */
const LIMITS = {
  blink: [0, 1],
  headPitch: [-25, 25],
  headYaw: [-35, 35],
  headRoll: [-30, 30],
  eyePitch: [-45, 45],
  eyeYaw: [-45, 45],
  brows: [0, 1],
  shrug: [0, 1],
  breath: [0, 10],
};

const within = (value, [least, most]) => Math.max(least, Math.min(most, Number.isNaN(value) ? 0 : value));

/** The pose with a number within its limits for each that there is, and with the angles that emotions add. */
function limited(pose, felt) {
  const limits = Object.entries(LIMITS);
  const numbers = limits.map(([name, limit]) => [name, within(Number(pose[name] ?? 0) + (felt.get(name) ?? 0), limit)]);
  return { ...pose, ...Object.fromEntries(numbers) };
}

/** The weight of each blend shape, from -1 to 1: what emotions do, and the curves of a rig. */
function weights(felt, { shapes = {}, brows, shrug }) {
  const all = new Map(felt);
  const add = (name, weight) => all.set(name, (all.get(name) ?? 0) + weight);
  for (const [name, weight] of Object.entries(shapes)) add(name, within(Number(weight ?? 0), [-1, 1]));
  for (const name of ["browInnerUp", "browOuterUpLeft", "browOuterUpRight"]) add(name, 0.8 * brows + 0.4 * shrug);
  // A shrug of the face: brows and lower lip up, corners down.
  for (const name of ["mouthShrugLower", "mouthFrownLeft", "mouthFrownRight"]) add(name, 0.6 * shrug);
  return (name) => within(all.get(name) ?? 0, [-1, 1]);
}

/** The attributes of all parts that have a name. `id` tells this face from others in the same document. */
export function geometry(given, id) {
  const felt = new Map(Object.entries(weightsOf(given.emotions)));
  const pose = limited(given, felt);
  const weight = weights(felt, pose);
  const lips = lipsOf(shapeOf(pose.viseme, pose.visemeType), weight);
  const skin = skinOf(weight);
  return {
    ...headParts(pose, lips, skin, weight),
    ...browParts(weight),
    ...eyeParts(pose, weight, id),
    ...mouthParts(lips, id),
    ...skinParts(weight, Math.sin(pose.headYaw * RADIANS) * DEPTH),
    ...moodParts(pose, id),
  };
}

/** The light behind the head, in the colours of what is felt. */
function moodParts(pose, id) {
  const { colour, strength } = moodOf(pose.emotions);
  return {
    mood: { fill: `url(#${id}mood)`, opacity: px(strength > 0 ? 0.2 + 0.8 * strength : 0) },
    moodLight: { id: `${id}mood` },
    moodNear: { "stop-color": colour },
    moodFar: { "stop-color": colour },
  };
}

function skinOf(weight) {
  const part = (name, most) => most * Math.max(0, weight(name));
  const [flush, pale, sick] = [part("flush", 0.3), part("pale", 0.55), part("sick", 0.35)];
  const rest = Math.max(0, 1 - flush - pale - sick);
  const sum = rest + flush + pale + sick;
  return mixed([[SKIN, rest / sum], ["#e2574c", flush / sum], ["#e9e6e4", pale / sum], ["#8fb05a", sick / sum]]);
}

function headParts(pose, lips, skin, weight) {
  const x = Math.sin(pose.headYaw * RADIANS) * DEPTH;
  const y = -Math.sin(pose.headPitch * RADIANS) * DEPTH;
  const move = (part) => `translate(${px(x * part)} ${px(y * part)})`;
  const breath = pose.breath * 0.9;
  const jaw = Math.min(14, lips.jaw * 0.32);
  const puff = 7 * weight("cheekPuff");
  const chin = 97 + jaw;
  const dark = mixed([[skin, 0.86], ["#8a4a30", 0.14]]);
  return {
    head: { transform: `rotate(${px(pose.headRoll)} 0 84)` },
    back: { transform: move(-0.15) },
    ears: { transform: move(-0.3) },
    skull: {
      transform: move(0.35),
      fill: skin,
      d: path`M-68 -8C-70 -62 -44 -96 0 -96C44 -96 70 -62 68 -8C${67 + puff} 40 ${60 + puff} ${62 + jaw / 2} 42 ${chin - 17}C29 ${chin - 4} 14 ${chin} 0 ${chin}C-14 ${chin} -29 ${chin - 4} -42 ${chin - 17}C${-60 - puff} ${62 + jaw / 2} ${-67 - puff} 40 -68 -8Z`,
    },
    fringe: {
      transform: move(0.45),
      d: path`M-70 -14C-74 -66 -46 -101 0 -101C46 -101 74 -66 70 -14C66 -38 58 -54 46 -63C34 -52 8 -50 -14 -62C-34 -58 -60 -46 -70 -14Z`,
    },
    features: { transform: move(1) },
    earLeft: { fill: dark },
    earRight: { fill: dark },
    neck: { fill: dark, d: path`M-24 70L-26 ${116 - breath}C-12 ${126 - breath} 12 ${126 - breath} 26 ${116 - breath}L24 70Z` },
    body: {
      d: path`M-104 140C-100 ${118 - breath} -62 ${112 - breath} -34 ${108 - breath}C-14 ${121 - breath} 14 ${121 - breath} 34 ${108 - breath}C62 ${112 - breath} 100 ${118 - breath} 104 140Z`,
    },
    nose: { d: noseOf(x, weight) },
  };
}

/** The nose leads a head that turns; its wings rise with a sneer. */
function noseOf(x, weight) {
  const lead = x * 0.25;
  const wing = (side) => -3.5 * weight(`noseSneer${side}`);
  const [right, left] = [wing("Right"), wing("Left")];
  return path`M${lead - 10} ${29 + right}C${lead - 13} ${34 + right} ${lead - 8} ${36 + right / 2} ${lead - 4} 35C${lead - 2} 37 ${lead + 2} 37 ${lead + 4} 35C${lead + 8} ${36 + left / 2} ${lead + 13} ${34 + left} ${lead + 10} ${29 + left}`;
}

function browParts(weight) {
  const inner = weight("browInnerUp");
  const brow = (side, sign) => {
    const down = weight(`browDown${side}`);
    const outer = weight(`browOuterUp${side}`);
    const near = { x: sign * (15.5 - 3.5 * down - 1.5 * inner), y: -25.5 + 10 * down - 10 * inner - 2 * outer };
    const middle = { x: sign * 30, y: -33.5 + 6 * down - 5.5 * inner - 11 * outer };
    const far = { x: sign * 45, y: -23.5 + 2.5 * down + 1.5 * inner - 7 * outer };
    return { d: path`M${near.x} ${near.y}Q${middle.x} ${middle.y} ${far.x} ${far.y}` };
  };
  const down = Math.max(0, (weight("browDownLeft") + weight("browDownRight")) / 2);
  const top = -27 + 5 * down;
  return {
    browLeft: brow("Left", 1),
    browRight: brow("Right", -1),
    // Between lowered brows stand two lines, above raised ones lie others.
    furrow: { d: path`M-4 ${top}L-3 ${top + 9}M4 ${top}L3 ${top + 9}`, opacity: px(0.8 * down) },
    forehead: { d: path`M-26 -50Q0 -55 26 -50M-20 -57Q0 -61 20 -57`, opacity: px(Math.max(0, 1.2 * inner - 0.6)) },
  };
}

/** `x` is how far the features are moved: cheeks stay on the head. */
function skinParts(weight, x) {
  const cheek = (side) => Math.max(0, weight(`cheekSquint${side}`));
  const puff = weight("cheekPuff");
  const blush = mixed([["#e9957a", 1 - 0.5 * Math.max(0, weight("flush"))], ["#d8403a", 0.5 * Math.max(0, weight("flush"))]]);
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
  const drop = (x, y, size) =>
    path`M${x} ${y - size}C${x + size} ${y + size * 0.4} ${x + size * 0.7} ${y + size * 1.3} ${x} ${y + size * 1.3}C${x - size * 0.7} ${y + size * 1.3} ${x - size} ${y + size * 0.4} ${x} ${y - size}Z`;
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
