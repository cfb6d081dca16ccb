// The pose of the speaker's face at a time, as face.js draws it.

import { emotionsOf, VISEMES } from "../face.js";
import { EMOTIONS } from "../lipz.js";

/** What stands still for those who do not want motion: what is left is what the line says. */
const RESTLESS = { headPitch: 0, headYaw: 0, headRoll: 0, eyePitch: 0, eyeYaw: 0, breath: 0 };

/** How far to a side something is that somebody stares at, in degrees, at least and at most; and how far up or down. */
const ASIDE = { least: 12, most: 40 };
const UP = 8;

/** Seconds that eyes stay on what somebody sees: as long as on any place, of which the usual profile says a second. */
const SEEN = 1;

const still = matchMedia("(prefers-reduced-motion: reduce)");

/** Gives the function that tells the pose at a time, of a cursor there: the curves of a clip are looked up once. */
export function posesOf(clip) {
  const { curves } = clip;
  const others = curves.filter(({ name }) => !EMOTIONS.includes(name));
  // Without curves of emotion, the face is that of the word: `feels sad`.
  const isFelt = others.length < curves.length;
  const sights = sightsOf(clip);
  return (cursor, time) => {
    const { feels, staresAt } = cursor.state();
    const last = sights.filter(({ since }) => since <= time).at(-1);
    const lookedAt = last?.verb === "sees" && time < last.since + SEEN ? last.object : staresAt;
    const emotions = isFelt ? clip.emotionsAt(time).values : emotionsOf(feels);
    const shapes = Object.fromEntries(others.map((curve) => [curve.name, curve.valueAt(time)]));
    const face = clip.faceAt(time, undefined, undefined, lookedAt && placeOf(lookedAt));
    return { viseme: cursor.viseme, visemeType: clip.visemeType, emotions, shapes, ...face, ...(still.matches && RESTLESS) };
  };
}

/** What the speaker looks at, and since when: `stares` lasts, and is in the state of the cursor; `sees` is for a moment. */
function sightsOf(clip) {
  const isSight = ({ character, verb }) => character === undefined && (verb === "sees" || verb === "stares");
  return clip.segments.flatMap(({ startFrame, events }) =>
    events.filter(isSight).map(({ verb, object }) => ({ verb, object, since: clip.startOfFrame(startFrame) })),
  );
}

/** Where something is that a line names: a bank does not know, so each name has a place of its own beside the face. */
function placeOf(name) {
  let number = 0;
  for (const character of name) number = (number * 31 + character.codePointAt(0)) % 997;
  const aside = ASIDE.least + (number % (ASIDE.most - ASIDE.least));
  return { yaw: number % 2 === 0 ? aside : -aside, pitch: (number % (2 * UP)) - UP, isPerson: false };
}

/** The clip with the viseme type that its codes fit, if its file leaves it unspecified. */
export function withType(clip) {
  const codes = Array.from(new Set(clip.frames));
  const fits = (type) => codes.every((code) => Object.hasOwn(VISEMES[type], code));
  return clip.orVisemeType(Object.keys(VISEMES).find(fits) ?? "blair");
}
