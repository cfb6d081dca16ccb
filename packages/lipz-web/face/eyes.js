// The eyes, with lids that close, widen and squint, and pupils that look; and the brows above them.

import { path, px } from "./path.js";

/** The centre, half the width, and the distances of the lids of an open eye from the centre. */
const EYE = { x: 28, y: -4, width: 14, upper: 10, lower: 7.5 };
/** The movement of a pupil per degree, and its maximum. */
const PER_DEGREE = 0.27;
const MOST = { x: 7, y: 4.5 };

const clamp = (value, least, most) => Math.max(least, Math.min(most, value));

export function eyeParts(pose, weight, id) {
  return { ...eye("left", "Left", 1, pose, weight, id), ...eye("right", "Right", -1, pose, weight, id) };
}

function eye(name, side, sign, pose, weight, id) {
  const { x, y, width, upper, lower } = EYE;
  // A blink closes the part of the eye that an emotion leaves open.
  const closed = clamp(1 - (1 - pose.blink) * (1 - clamp(weight(`eyeBlink${side}`), 0, 1)), 0, 1);
  const squint = clamp(weight(`eyeSquint${side}`), 0, 1);
  const wide = clamp(weight(`eyeWide${side}`), 0, 1);
  const down = lower * (1 - 0.55 * squint + 0.1 * wide);
  // In a blink, the upper lid moves most of the way.
  const meet = y + down * 0.65;
  const top = y - upper * (1 + 0.32 * wide) * (1 - 0.22 * squint);
  const lid = top + (meet - top) * closed;
  const floor = y + down + (meet - (y + down)) * closed;
  // Lowered brows press the inner end of the lid down, and raised brows pull it up.
  const tilt = (3.5 * weight(`browDown${side}`) - 2.5 * weight("browInnerUp")) * (1 - closed);
  const [near, far] = [x - width, x + width];
  const at = (value) => sign * value;
  const corner = y + 1 + (meet - y - 1) * closed * 0.5;
  // The top of a cubic curve is at three quarters of the way to its handles.
  const high = (edge) => corner + (edge - corner) / 0.75;
  const upperLid = path`M${at(near)} ${corner + 1}C${at(near + 4)} ${high(lid) + tilt} ${at(far - 6)} ${high(lid) - tilt * 0.3} ${at(far)} ${corner}`;
  const lowerLid = path`C${at(far - 5)} ${high(floor)} ${at(near + 5)} ${high(floor)} ${at(near)} ${corner + 1}`;
  const look = (direction) => 25 * PER_DEGREE * weight(`eyeLook${direction}${side}`);
  const dx = clamp(pose.eyeYaw * PER_DEGREE + sign * (look("Out") - look("In")), -MOST.x, MOST.x);
  const dy = clamp(-pose.eyePitch * PER_DEGREE + look("Down") - look("Up"), -MOST.y, MOST.y);
  const [cx, cy] = [px(at(x) + dx), px(y + dy)];
  const outline = `${upperLid}${lowerLid}Z`;
  return {
    [`${name}White`]: { d: outline },
    [`${name}Outline`]: { d: outline },
    [`${name}Clip`]: { id: `${id}${name}` },
    [`${name}Inside`]: { "clip-path": `url(#${id}${name})` },
    [`${name}Iris`]: { cx, cy },
    [`${name}Pupil`]: { cx, cy, r: px(3.5 * (1 + 0.6 * weight("pupils"))) },
    [`${name}Light`]: { cx: px(cx + 2), cy: px(cy - 2.4) },
    // The lid casts a shadow.
    [`${name}Shade`]: { d: path`M${at(near)} ${lid - 4}L${at(far)} ${lid - 4}L${at(far)} ${lid + 3}Q${at(x)} ${lid + 1} ${at(near)} ${lid + 3}Z` },
    [`${name}Upper`]: { d: upperLid },
    [`${name}Lower`]: { d: path`M${at(far)} ${corner}` + lowerLid },
  };
}

export function browParts(weight) {
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
    // Lowered brows have two vertical lines between them, and raised brows have horizontal lines above them.
    furrow: { d: path`M-4 ${top}L-3 ${top + 9}M4 ${top}L3 ${top + 9}`, opacity: px(0.8 * down) },
    forehead: { d: path`M-26 -50Q0 -55 26 -50M-20 -57Q0 -61 20 -57`, opacity: px(Math.max(0, 1.2 * inner - 0.6)) },
  };
}
