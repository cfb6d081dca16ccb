// The effects of the twelve attributes of emotion on a face: weights of blend shapes with ARKit's names, and changes of
// skin and eyes.
//
// As on the rig of "Talking Heads", each attribute has a pose at 5 and a pose at 10, and is neutral at 0. Poses are
// added. The muscles of each emotion are from Ekman and Friesen's Facial Action Coding System (EMFACS); for pain, from
// Prkachin and Solomon. docs/guides/faces.md has the table with its sources.

import { mixed } from "./colour.js";

/** Weights at 5 and at 10, from 0 to 1. Names without a side apply to both sides. Angles of `head` are in degrees. */
const POSES = {
  sadness: {
    browInnerUp: [0.7, 1],
    eyeBlink: [0.12, 0.25],
    eyeLookDown: [0.2, 0.3],
    mouthFrown: [0.75, 1],
    mouthShrugLower: [0.3, 0.5],
    jawOpen: [0, 0.28],
    mouthLowerDown: [0, 0.35],
    tears: [0, 1],
    headPitch: [-4, -8],
  },
  anger: {
    browDown: [0.7, 1],
    eyeWide: [0.3, 0.5],
    eyeSquint: [0.15, 0.3],
    noseSneerLeft: [0.7, 0.9],
    noseSneerRight: [0.2, 0.6],
    mouthUpperUpLeft: [0.5, 0.7],
    mouthUpperUpRight: [0, 0.45],
    mouthLowerDown: [0, 0.5],
    mouthPress: [0.4, 0.2],
    mouthFrown: [0.25, 0.5],
    flush: [0.3, 0.8],
    headPitch: [-3, -6],
  },
  joy: {
    mouthSmile: [0.75, 1],
    cheekSquint: [0.5, 1],
    eyeSquint: [0.2, 0.45],
    mouthUpperUp: [0.2, 0.45],
    jawOpen: [0.04, 0.3],
    browOuterUp: [0.15, 0.3],
    flush: [0.1, 0.2],
  },
  fear: {
    browInnerUp: [0.65, 1],
    browOuterUp: [0.2, 0.3],
    browDown: [0.1, 0.15],
    eyeWide: [0.6, 1],
    mouthStretch: [0.6, 1],
    mouthLowerDown: [0.2, 0.5],
    mouthFrown: [0.25, 0.35],
    jawOpen: [0.04, 0.2],
    pale: [0.3, 0.8],
    sweat: [0, 0.7],
    pupils: [-0.15, -0.35],
  },
  disgust: {
    noseSneer: [0.7, 1],
    mouthUpperUp: [0.45, 0.7],
    browDown: [0.4, 0.6],
    eyeSquint: [0.45, 0.75],
    cheekSquint: [0.3, 0.5],
    mouthFrown: [0.5, 0.75],
    mouthShrugLower: [0.3, 0.3],
    jawOpen: [0, 0.25],
    tongueOut: [0, 0.7],
    sick: [0.35, 0.9],
    headPitch: [2, 3],
  },
  surprise: {
    browInnerUp: [0.6, 1],
    browOuterUp: [0.7, 1],
    eyeWide: [0.5, 0.8],
    jawOpen: [0.3, 0.5],
    mouthFunnel: [0.35, 0.5],
    headPitch: [1, 2],
  },
  shock: {
    browInnerUp: [0.8, 1],
    browOuterUp: [0.45, 0.7],
    eyeWide: [0.8, 1],
    jawOpen: [0.45, 0.85],
    mouthStretch: [0.15, 0.25],
    pale: [0.5, 1],
    pupils: [-0.4, -0.7],
    headPitch: [2, 4],
  },
  perplexed: {
    browOuterUpLeft: [0.8, 1],
    browInnerUp: [0.1, 0.2],
    browDownRight: [0.55, 0.8],
    eyeSquintRight: [0.35, 0.55],
    mouthLeft: [0.5, 0.8],
    mouthPress: [0.25, 0.4],
    mouthFrownRight: [0.3, 0.5],
    eyeLookUp: [0.15, 0.3],
    headRoll: [5, 9],
  },
  asleep: {
    eyeBlink: [0.6, 1],
    browInnerUp: [0.1, 0.2],
    jawOpen: [0.03, 0.16],
    headPitch: [-5, -11],
    headRoll: [4, 9],
  },
  pain: {
    browDown: [0.6, 0.9],
    browInnerUp: [0.3, 0.4],
    eyeSquint: [0.6, 0.9],
    eyeBlink: [0.2, 0.7],
    noseSneer: [0.4, 0.6],
    cheekSquint: [0.5, 0.8],
    mouthStretch: [0.5, 0.9],
    mouthUpperUp: [0.35, 0.6],
    mouthLowerDown: [0.35, 0.7],
    sweat: [0.2, 0.6],
    pale: [0.1, 0.3],
    headRoll: [-3, -6],
  },
  exertion: {
    browDown: [0.5, 0.8],
    eyeSquint: [0.5, 0.8],
    cheekPuff: [0.6, 1],
    mouthPress: [0.6, 1],
    noseSneer: [0.2, 0.4],
    flush: [0.5, 1],
    sweat: [0.4, 1],
    headPitch: [-2, -4],
  },
  shout: {
    jawOpen: [0.6, 1],
    mouthUpperUp: [0.35, 0.6],
    mouthLowerDown: [0.35, 0.6],
    mouthStretch: [0.15, 0.3],
    browDown: [0.45, 0.75],
    eyeSquint: [0.3, 0.45],
    noseSneer: [0.2, 0.4],
    flush: [0.3, 0.6],
    headPitch: [2, 4],
  },
};

/** Shapes without sides, and entries that are not blend shapes. All other shapes have a left and a right side. */
const WHOLE = ["browInnerUp", "jawOpen", "mouthFunnel", "mouthPucker", "mouthShrugLower", "cheekPuff", "tongueOut", "mouthLeft"];
const NO_SHAPE = ["tears", "sweat", "flush", "pale", "sick", "pupils", "headPitch", "headRoll"];

/** The colour of each attribute. */
export const EMOTION_COLOURS = {
  sadness: "#4f86e8",
  anger: "#e0483c",
  joy: "#f0b41c",
  fear: "#8f63d4",
  disgust: "#6b9f3b",
  surprise: "#f0872c",
  shock: "#8fa6bf",
  perplexed: "#2aa79f",
  asleep: "#6a70a8",
  pain: "#c2427f",
  exertion: "#a8702c",
  shout: "#ff6b5e",
};

const MOST = 10;
const MIDDLE = 5;

/** The weight of a pair at a value from 0 to 10. */
function weightAt([half, full], value) {
  return value <= MIDDLE ? (half * value) / MIDDLE : half + ((full - half) * (value - MIDDLE)) / (MOST - MIDDLE);
}

/** Both sides of a shape, or the name itself. */
function sides(name) {
  const isOne = WHOLE.includes(name) || NO_SHAPE.includes(name) || /(Left|Right)$/.test(name);
  return isOne ? [name] : [`${name}Left`, `${name}Right`];
}

/** The added weights of the effects of emotions, whose values are from 0 to 10. */
export function weightsOf(emotions = {}) {
  const weights = {};
  for (const [emotion, value] of Object.entries(emotions)) {
    if (!(value > 0) || !Object.hasOwn(POSES, emotion)) continue;
    for (const [name, pair] of Object.entries(POSES[emotion])) {
      for (const side of sides(name)) weights[side] = (weights[side] ?? 0) + weightAt(pair, Math.min(value, MOST));
    }
  }
  return weights;
}

/** The mixed colour of emotions, and their total strength from 0 to 1. */
export function moodOf(emotions = {}) {
  const value = (emotion) => Math.min(emotions[emotion], MOST);
  const felt = Object.entries(EMOTION_COLOURS).filter(([emotion]) => emotions[emotion] > 0);
  const sum = felt.reduce((sum, [emotion]) => sum + value(emotion), 0);
  const colour = mixed(felt.map(([emotion, colour]) => [colour, value(emotion) / sum]));
  return { colour, strength: Math.min(1, sum / MOST) };
}
