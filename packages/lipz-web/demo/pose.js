// The pose of the speaker's face at a time, as face.js draws it.

import { emotionsOf, VISEMES } from "../face.js";
import { EMOTIONS } from "../lipz.js";

/** What moves a face besides its mouth and its emotions. */
const MOTIONS = ["blink", "headPitch", "headYaw", "headRoll", "eyePitch", "eyeYaw", "brows", "shrug", "breath"];
/** What stands still for those who do not want motion: what is left is what the line says. */
const RESTLESS = ["headPitch", "headYaw", "headRoll", "breath"];

const still = matchMedia("(prefers-reduced-motion: reduce)");

/** Gives the function that tells the pose at a time, of a cursor there: the curves of a clip are looked up once. */
export function posesOf(clip) {
  const { curves } = clip;
  const others = curves.filter(({ name }) => !EMOTIONS.includes(name));
  // Without curves of emotion, the face is that of the word: `feels sad`.
  const isFelt = others.length < curves.length;
  return (cursor, time) => {
    const emotions = isFelt ? clip.emotionsAt(time).values : emotionsOf(cursor.state().feels);
    const shapes = Object.fromEntries(others.map((curve) => [curve.name, curve.valueAt(time)]));
    const motions = Object.fromEntries(MOTIONS.map((name) => [name, shapes[name] ?? 0]));
    if (still.matches) RESTLESS.forEach((name) => (motions[name] = 0));
    return { viseme: cursor.viseme, visemeType: clip.visemeType, emotions, shapes, ...motions };
  };
}

/** The clip with the viseme type that its codes fit, if its file leaves it unspecified. */
export function withType(clip) {
  const codes = Array.from(new Set(clip.frames));
  const fits = (type) => codes.every((code) => Object.hasOwn(VISEMES[type], code));
  return clip.orVisemeType(Object.keys(VISEMES).find(fits) ?? "blair");
}
