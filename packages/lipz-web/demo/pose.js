// The pose of the speaker's face at a time, as face.js draws it.

import { emotionsOf, VISEMES } from "../face.js";
import { EMOTIONS } from "../lipz.js";

/** Members that stay still for users who do not want motion. All other members show the content of the line. */
const RESTLESS = { headPitch: 0, headYaw: 0, headRoll: 0, eyePitch: 0, eyeYaw: 0, breath: 0 };

/** The minimum and maximum angle of a target to the side, in degrees, and the maximum angle up or down. */
const ASIDE = { least: 12, most: 40 };
const UP = 8;

/** The seconds for which eyes stay on a target of `sees`: one, as in the built-in profile for any target. */
const SEEN = 1;

/** Curves of ARKit that every recorded face has. */
const RECORDED = ["jawOpen", "mouthClose", "mouthFunnel"];

const still = matchMedia("(prefers-reduced-motion: reduce)");

/** Returns a function from a time and a cursor to the pose. The curves of the clip are looked up only once. */
export function posesOf(clip) {
  const { curves } = clip;
  const others = curves.filter(({ name }) => !EMOTIONS.includes(name));
  // Without curves of emotion, the word in an event sets the face: `feels sad`.
  const isFelt = others.length < curves.length;
  const sights = sightsOf(clip);
  const names = new Set(others.map(({ name }) => name));
  // Curves of a recorded face move the whole mouth. Without them, it moves as in a game.
  const isRecorded = RECORDED.every((name) => names.has(name));
  return (cursor, time) => {
    const { feels, staresAt } = cursor.state();
    const last = sights.filter(({ since }) => since <= time).at(-1);
    const lookedAt = last?.verb === "sees" && time < last.since + SEEN ? last.object : staresAt;
    const emotions = isFelt ? clip.emotionsAt(time).values : emotionsOf(feels);
    const shapes = Object.fromEntries(others.map((curve) => [curve.name, curve.valueAt(time)]));
    const face = clip.faceAt(time, undefined, undefined, lookedAt && placeOf(lookedAt));
    const articulation = isRecorded ? {} : clip.articulationAt(time);
    return { articulation, emotions, shapes, ...face, ...(still.matches && RESTLESS) };
  };
}

/** The target of the gaze with its start. `stares` lasts, and is in the state of the cursor; `sees` is momentary. */
function sightsOf(clip) {
  const isSight = ({ character, verb }) => character === undefined && (verb === "sees" || verb === "stares");
  return clip.segments.flatMap(({ startFrame, events }) =>
    events.filter(isSight).map(({ verb, object }) => ({ verb, object, since: clip.startOfFrame(startFrame) })),
  );
}

/** The direction of a target. A bank has no positions, so each name gets a direction to the side of the face. */
function placeOf(name) {
  let number = 0;
  for (const character of name) number = (number * 31 + character.codePointAt(0)) % 997;
  const aside = ASIDE.least + (number % (ASIDE.most - ASIDE.least));
  return { yaw: number % 2 === 0 ? aside : -aside, pitch: (number % (2 * UP)) - UP, isPerson: false };
}

/** The clip with the viseme type that fits its codes, if its file does not specify one. */
export function withType(clip) {
  const codes = Array.from(new Set(clip.frames));
  const fits = (type) => codes.every((code) => Object.hasOwn(VISEMES[type], code));
  return clip.orVisemeType(Object.keys(VISEMES).find(fits) ?? "blair");
}
