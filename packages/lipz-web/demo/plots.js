// Plots of curves as paths: x is the frame, y goes from 0 at the top to 1.

import { EMOTIONS } from "../lipz.js";

/** The maximum of an emotion, which is also the intended maximum of their sum. */
const FULL = 10;
/** The part of the height that stays empty above and below a curve. */
const MARGIN = 0.08;

/** A value with at most three decimals. */
export const told = (value) => String(Number(value.toFixed(3)));

const y = (part) => Number(part.toFixed(4));

/** The line of a curve, the values at its edges, and the position of 0. */
export function lineOf({ name, keys }, frames) {
  let [least, most] = [0, EMOTIONS.includes(name) ? FULL : 0];
  for (const { value } of keys) [least, most] = [Math.min(least, value), Math.max(most, value)];
  if (least === 0) most = Math.max(most, 1);
  const at = (value) => y(1 - MARGIN - ((value - least) / (most - least)) * (1 - 2 * MARGIN));
  const points = keys.map(({ frame, value }) => `${frame} ${at(value)}`);
  const [first, last] = [keys[0], keys.at(-1)].map(({ value }) => at(value));
  return { least, most, zero: at(0), d: `M0 ${first}L${points.join("L")}L${Math.max(frames, keys.at(-1).frame)} ${last}` };
}

/** Stacked areas of emotions, which can bend at the keys of any of them. */
export function areasOf(curves, frames) {
  const places = new Set([0, frames]);
  for (const { keys } of curves) for (const { frame } of keys) places.add(frame);
  const bends = Array.from(places).sort((a, b) => a - b);
  const heights = curves.map((curve) => bends.map((frame) => Math.max(0, curve.value(frame))));
  const sums = bends.map((_, place) => heights.reduce((sum, height) => sum + height[place], 0));
  const full = sums.reduce((most, sum) => Math.max(most, sum), FULL);
  const floor = bends.map(() => 0);
  const edge = () => bends.map((frame, place) => `${frame} ${y(1 - floor[place] / full)}`);
  return curves.map(({ name }, index) => {
    const below = edge().reverse();
    heights[index].forEach((height, place) => (floor[place] += height));
    return { name, d: `M${edge().join("L")}L${below.join("L")}Z` };
  });
}
