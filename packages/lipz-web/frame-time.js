// The frame at a time, by arithmetic with doubles, for the times at which their rounding cannot matter.
//
// The module computes the frame at any time exactly, but a call of it takes longer than all of this.

import { MICROS_PER_SECOND } from "./words.js";

/** The permitted rates in frames per second. */
const RATES = { least: 1, most: 1000 };
/**
 * More than the relative error of an estimate: four roundings of 2⁻⁵³, and the two units in the last place by which a
 * time in seconds may be too early.
 */
const TOLERANCE = 1e-14;
/** The lowest `rate_hz` of lipz.h that is not a sample rate. */
const FIRST_UNIT = 0xfffffffe;

/** The frames per second of a rate; NaN if it is missing or invalid. */
export function rateOf(numerator, denominator) {
  const rate = numerator / denominator;
  return rate >= RATES.least && rate <= RATES.most ? rate : NaN;
}

/** The frame at a time in a clip without end. Undefined before the start, or if only exact arithmetic can decide. */
export function estimatedFrame(time, framesPerSecond) {
  const frames = secondsOf(time) * framesPerSecond;
  const frame = Math.floor(frames * (1 - TOLERANCE));
  return frame >= 0 && frame === Math.floor(frames * (1 + TOLERANCE)) ? frame : undefined;
}

/** Whether a number is a rate of samples per second. */
export function isSampleRate(rateHz) {
  return rateHz > 0 && rateHz < FIRST_UNIT;
}

/** A time in seconds; NaN for a time in units that doubles may not represent. */
function secondsOf(time) {
  if (typeof time === "number") return time;
  const { us, position, rateHz } = time;
  if (Number.isSafeInteger(us)) return us / MICROS_PER_SECOND;
  const areWhole = us === undefined && Number.isSafeInteger(position) && Number.isInteger(rateHz);
  return areWhole && isSampleRate(rateHz) ? position / rateHz : NaN;
}
