// The head, which turns, nods and tilts with hair, ears and nose; and neck and shoulders, which show breath.

import { mixed } from "./colour.js";
import { path, px } from "./path.js";

const RADIANS = Math.PI / 180;
/** The movement of features on a turning head, in the units of the drawing. */
const DEPTH = 46;

/** The offset of the features on a head that turns and nods. Parts further back move less, or backwards. */
export function turnOf({ headYaw, headPitch }) {
  return { x: Math.sin(headYaw * RADIANS) * DEPTH, y: -Math.sin(headPitch * RADIANS) * DEPTH };
}

export function headParts(pose, { x, y }, jawOpen, skin, weight) {
  const move = (part) => `translate(${px(x * part)} ${px(y * part)})`;
  const breath = pose.breath * 0.9;
  const jaw = Math.min(14, jawOpen * 0.32);
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

/** The nose leads a turning head, and its wings rise with a sneer. */
function noseOf(x, weight) {
  const lead = x * 0.25;
  const wing = (side) => -3.5 * weight(`noseSneer${side}`);
  const [right, left] = [wing("Right"), wing("Left")];
  return path`M${lead - 10} ${29 + right}C${lead - 13} ${34 + right} ${lead - 8} ${36 + right / 2} ${lead - 4} 35C${lead - 2} 37 ${lead + 2} 37 ${lead + 4} 35C${lead + 8} ${36 + left / 2} ${lead + 13} ${34 + left} ${lead + 10} ${29 + left}`;
}
