// Converts a pose to the attributes of the parts, which state the position of each part.
//
// Proportions are from "Talking Heads": the eyes are halfway down the head; brow, base of the nose and chin are a third
// apart; the mouth is as wide as the distance of the pupils. Left is the left of the character, which is right in the
// drawing.

import { weightsOf } from "./emotion.js";
import { browParts, eyeParts } from "./eyes.js";
import { headParts, turnOf } from "./head.js";
import { mouthParts } from "./lips.js";
import { lipsOf, shapeOf, shapeOfArticulation } from "./mouth.js";
import { moodParts, skinOf, skinParts } from "./skin.js";

/** The limits of each number in a pose. A flat face can turn only by a limited angle. */
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

/** The pose with each number within its limits, including the angles that emotions add. */
function limited(pose, felt) {
  const limits = Object.entries(LIMITS);
  const numbers = limits.map(([name, limit]) => [name, within(Number(pose[name] ?? 0) + (felt.get(name) ?? 0), limit)]);
  return { ...pose, ...Object.fromEntries(numbers) };
}

/** The weight of each blend shape, from -1 to 1, from emotions and from the curves of a rig. */
function weights(felt, { shapes = {}, brows, shrug }) {
  const all = new Map(felt);
  const add = (name, weight) => all.set(name, (all.get(name) ?? 0) + weight);
  // Only pupils can both grow and shrink.
  const limit = (name) => [name === "pupils" ? -1 : 0, 1];
  for (const [name, weight] of Object.entries(shapes)) add(name, within(Number(weight ?? 0), limit(name)));
  for (const name of ["browInnerUp", "browOuterUpLeft", "browOuterUpRight"]) add(name, 0.8 * brows + 0.4 * shrug);
  // A shrug of the face: brows and lower lip up, corners down.
  for (const name of ["mouthShrugLower", "mouthFrownLeft", "mouthFrownRight"]) add(name, 0.6 * shrug);
  return (name) => within(all.get(name) ?? 0, [-1, 1]);
}

/** The attributes of all named parts. `id` is unique among the faces in a document. */
export function geometry(given, id) {
  const felt = new Map(Object.entries(weightsOf(given.emotions)));
  const pose = limited(given, felt);
  const weight = weights(felt, pose);
  const shape = pose.articulation ? shapeOfArticulation(pose.articulation) : shapeOf(pose.viseme, pose.visemeType);
  const lips = lipsOf(shape, weight);
  const turn = turnOf(pose);
  return {
    ...headParts(pose, turn, lips.jaw, skinOf(weight), weight),
    ...browParts(weight),
    ...eyeParts(pose, weight, id),
    ...mouthParts(lips, id),
    ...skinParts(weight, turn.x),
    ...moodParts(pose.emotions, id),
  };
}
