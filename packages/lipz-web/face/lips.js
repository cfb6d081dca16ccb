// The mouth: lips around an opening that contains teeth and tongue. The upper teeth stay with the skull, and the lower
// teeth move down with the jaw.

import { path, px } from "./path.js";

const MOUTH = { x: 0, y: 58 };
/** The heights of the teeth beyond the lips, from the edges that meet in a closed jaw. */
const TEETH = { upper: 18, lower: 15 };
/** Lips at a smaller distance than this are drawn closed, with a seam. */
const CLOSED = 1.2;
/** The distance at which lips form an oval. */
const TALL = 36;
/** The top of a cubic curve is at three quarters of the way to its handles. */
const HANDLE = 4 / 3;

export function mouthParts(given, id) {
  const { left, right, jaw, bottom, shift, round, tip, isBitten, tongueOut } = given;
  const top = -(left.up + right.up) / 2;
  const floor = bottom - given.shrug;
  // A wide-open mouth is also an oval.
  const lips = { ...given, oval: Math.max(round, 0.75 * Math.min(1, (floor - top) / TALL)) };
  const opening = openingOf(lips, floor);
  const outline = `${opening.upper}${opening.lower}Z`;
  const teeth = round > 0.5 ? 0 : 1;
  return {
    mouth: { transform: `translate(${px(MOUTH.x + shift)} ${MOUTH.y})` },
    inside: { d: outline },
    insideOutline: { d: outline },
    insideClip: { id: `${id}inside` },
    insideMouth: { "clip-path": `url(#${id}inside)` },
    upperLip: { d: upperLip(lips, top, opening) },
    lowerLip: { d: lowerLip(lips, floor, opening) },
    seam: { d: opening.upper, opacity: floor - top < CLOSED ? 1 : 0 },
    upperTeeth: { d: path`M-30 ${-TEETH.upper}H30V1.5Q0 3.5 -30 1.5Z`, opacity: teeth },
    lowerTeeth: { d: path`M-26 ${jaw + 3}Q0 ${jaw + 1} 26 ${jaw + 3}V${jaw + TEETH.lower}H-26Z`, opacity: teeth },
    tongue: tongueOf(lips),
    tip: { cx: 0, cy: px(jaw * 0.62 + 2), rx: 8.5, ry: px(jaw * 0.62 + 1.5), opacity: tip },
    bite: { d: isBitten ? path`M-16 ${top + 2}Q0 ${top} 16 ${top + 2}L15 2.4Q0 4.6 -15 2.4Z` : "" },
    tongueOut: { d: tongueOut > 0.15 ? outOf(floor, 20 * tongueOut) : "" },
  };
}

/** The edges of the opening, from the right corner over the top to the left corner, and back. */
function openingOf({ left, right, oval }, floor) {
  // Round lips form an ellipse, and spread lips are flatter.
  const near = 0.62 + 0.36 * oval;
  const handle = (side, edge) => side.corner + (edge - side.corner) * HANDLE;
  return {
    upper: path`M${-right.width} ${right.corner}C${-right.width * near} ${handle(right, -right.up)} ${left.width * near} ${handle(left, -left.up)} ${left.width} ${left.corner}`,
    lower: path`C${left.width * near} ${handle(left, floor)} ${-right.width * near} ${handle(right, floor)} ${-right.width} ${right.corner}`,
    upperBack: path`C${left.width * near} ${handle(left, -left.up)} ${-right.width * near} ${handle(right, -right.up)} ${-right.width} ${right.corner}`,
  };
}

/** The distance by which the lips extend beyond the corners. */
const beyond = ({ round, lip }) => 2.2 + 2.6 * round * lip;

/** The upper lip has a bow in the middle, unless it is rounded. */
function upperLip(lips, top, opening) {
  const { left, right, oval, lip } = lips;
  const out = beyond(lips);
  const edge = top - 5.6 * lip;
  const bow = 1.7 * lip * (1 - oval);
  const half = ({ width, corner, up }) => {
    const w = width + out;
    const flat = { x: w * 0.6, y: corner + (-up - corner) * HANDLE - 5 * lip, x2: 6, y2: edge - bow };
    const round = { x: w, y: corner + (edge - corner) * 0.55, x2: w * 0.55, y2: edge };
    const mix = (key) => flat[key] + (round[key] - flat[key]) * oval;
    return { w, x: mix("x"), y: mix("y"), x2: mix("x2"), y2: mix("y2") };
  };
  const [r, l] = [half(right), half(left)];
  return (
    path`M${-r.w} ${right.corner}C${-r.x} ${r.y} ${-r.x2} ${r.y2} 0 ${edge + bow}C${l.x2} ${l.y2} ${l.x} ${l.y} ${l.w} ${left.corner}L${left.width} ${left.corner}` +
    `${opening.upperBack}Z`
  );
}

function lowerLip(lips, floor, opening) {
  const { left, right, oval, lip, isBitten } = lips;
  const out = beyond(lips);
  const edge = floor + 6.4 * lip * (isBitten ? 0.6 : 1);
  const near = 0.68 + 0.32 * oval;
  const handle = (side) => side.corner + (edge - side.corner) * HANDLE;
  return (
    path`M${right.width * -1} ${right.corner}L${-right.width - out} ${right.corner}C${(-right.width - out) * near} ${handle(right)} ${(left.width + out) * near} ${handle(left)} ${left.width + out} ${left.corner}L${left.width} ${left.corner}` +
    `${opening.lower}Z`
  );
}

/** The tongue, on the floor of the mouth, and higher for vowels with a raised tongue. */
function tongueOf({ jaw, bottom, left, tongue }) {
  return { cx: 0, cy: px(bottom + 4 - 4 * tongue), rx: px(left.width * 0.66), ry: px(3 + jaw * 0.24 + 6 * tongue) };
}

function outOf(floor, length) {
  return path`M-9 ${floor - 3}C-11 ${floor + length * 0.8} -6 ${floor + length} 0 ${floor + length}C6 ${floor + length} 11 ${floor + length * 0.8} 9 ${floor - 3}Z`;
}
