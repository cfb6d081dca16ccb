// The mouth shape of each code of the three viseme types: the positions of lips, jaw and tongue that phonetics
// describes for the phones in the Lipz specification.

/**
 * Half the width between the corners; the heights by which the upper lip is raised, the jaw is lowered, and the lower
 * lip is below the lower teeth; and the thickness of the lips. Rounded lips hide the teeth. `free` limits the effect of
 * emotions on the mouth, so that a phone with closed lips stays readable in any mood.
 */
const shape = (width, up, jaw, low, more = {}) => {
  const usual = { round: 0, lip: 1, tongue: 0, tip: 0, bite: 0, free: 0.5 };
  return { width, up, jaw, low, ...usual, ...more };
};

/** Silence: lips together, relaxed. */
const REST = shape(24, 0.2, 0, 0.4, { free: 1 });
/** M, B, P: lips pressed together. */
const CLOSED = shape(25.5, 0, 0, 0, { lip: 0.6, free: 0 });
/** Most consonants, as in "see": teeth together, lips apart and a little spread. */
const TEETH = shape(25, 5, 2.5, 5, { free: 0.25 });
/** E, as in "bet": lips spread, tongue in the middle. */
const SPREAD = shape(30, 6, 12, 4.5, { tongue: 0.55 });
/** A and I, as in "father" and "fly": jaw down, tongue low. */
const OPEN = shape(23, 6, 28, 4, { tongue: 0.3 });
/** O, as in "go": lips rounded. */
const ROUND = shape(14, 8, 17, 5, { round: 1, lip: 1.1, tongue: 0.2, free: 0.3 });
/** U, as in "blue": lips rounded and pushed forward. */
const PUSHED = shape(9.5, 7, 5, 5, { round: 1, lip: 1.35, free: 0.15 });
/** W and Q, as in "we" and "queen": lips drawn together to a small hole. */
const HOLE = shape(5, 3, 1, 3, { round: 1, lip: 1.6, free: 0.1 });
/** F and V: the lower lip touches the upper teeth. */
const BITE = shape(24, 6, 0, 1.2, { bite: 1, free: 0.1 });
/** L: the tip of the tongue behind the upper teeth. */
const TIP = shape(22, 6, 9, 3.5, { tip: 1, free: 0.3 });

const SHAPES = {
  blair: { A: OPEN, M: CLOSED, O: ROUND, S: TEETH, W: HOLE, E: SPREAD, F: BITE, L: TIP, U: PUSHED },
  toonboom: { A: CLOSED, B: TEETH, C: SPREAD, D: OPEN, E: ROUND, F: HOLE, G: BITE },
  rms: Object.fromEntries(Array.from({ length: 10 }, (_, digit) => [digit, loud(digit)])),
};

/** Loudness from 0, closed, to 9, fully open. The jaw is lowered step by step. */
function loud(digit) {
  if (digit === 0) return shape(22, 0, 0, 0, { free: 0.2 });
  return shape(22, 0.8 * digit, 3.2 * digit - 1.5, 0.5 * digit + 1, { tongue: 0.4 });
}

/** The meaning of each code in the words of the Lipz specification, with example words. */
export const VISEMES = {
  blair: {
    "-": "rest",
    A: "A, I: “father”, “fly”",
    M: "M, B, P: “map”",
    O: "O: “go”",
    S: "most consonants: “see”",
    W: "W, Q: “we”, “queen”",
    E: "E: “bet”",
    F: "F, V: “five”",
    L: "L: “light”",
    U: "U: “blue”",
  },
  toonboom: {
    "-": "rest",
    A: "M, B, P: “map”",
    B: "most consonants: “see”",
    C: "E: “bet”",
    D: "A, I: “father”, “fly”",
    E: "O: “go”",
    F: "W, Q: “we”, “queen”",
    G: "F, V: “five”",
  },
  rms: {
    "-": "rest",
    0: "closed",
    1: "minimally open",
    2: "louder",
    3: "louder",
    4: "louder",
    5: "louder",
    6: "louder",
    7: "“yell” open",
    8: "louder",
    9: "fully open",
  },
};

/** The shape of a viseme; rest without a type, or for a code that the type does not have. */
export function shapeOf(viseme = "-", type = undefined) {
  const shapes = Object.hasOwn(SHAPES, type ?? "") ? SHAPES[type] : {};
  return Object.hasOwn(shapes, viseme) ? shapes[viseme] : REST;
}

/** The values of an articulation at rest. */
const AT_REST = { jaw: 0.05, opening: 0.12, rounding: 0.1 };
/** The drop of the jaw and the distance of the lips in "father", and the greatest height of the upper lip. */
const FATHER = { jaw: 28, gap: 38, up: 6 };
/** The part of the tongue that is out of the mouth in "thin". */
const BETWEEN_TEETH = 0.3;
/** How far the corners move inwards for round lips, and outwards for spread and for pressed lips. */
const CORNERS = { usual: 24, round: 16, spread: 6, pressed: 1.5 };

/** The shape of a mouth that moves freely: `clip.articulationAt(time)`. */
export function shapeOfArticulation(articulation) {
  const value = (name) => {
    const rest = AT_REST[name] ?? 0;
    return Math.max(0, Math.min(1, (Number(articulation[name] ?? 0) - rest) / (1 - rest)));
  };
  const [round, teeth, closed, spread] = ["rounding", "teeth", "closure", "spreading"].map(value);
  const jaw = FATHER.jaw * value("jaw");
  const gap = REST.up + REST.low + FATHER.gap * value("opening");
  const mixed = (from, to, part) => from + (to - from) * part;
  // The upper lip takes part of a small opening, and the lower lip the rest.
  const up = mixed(Math.min(FATHER.up, gap * 0.4), BITE.up, teeth);
  const bottom = mixed(gap - Math.min(FATHER.up, gap * 0.4), BITE.low, teeth);
  const busy = Math.max(0.85 * Math.max(round, teeth), 0.6 * Math.max(spread, value("tongueTip")), 0.5 * value("jaw"));
  return {
    width: CORNERS.usual - CORNERS.round * round + CORNERS.spread * spread + CORNERS.pressed * closed,
    up: up * (1 - closed),
    jaw,
    low: bottom * (1 - closed) - jaw,
    round,
    lip: mixed(1 + 0.4 * round, CLOSED.lip, closed),
    tongue: 0.25 + 0.4 * value("tongueBack"),
    tip: value("tongueTip") * Math.min(1, gap / 12),
    out: BETWEEN_TEETH * value("tongueOut"),
    bite: teeth > 0.5 ? 1 : 0,
    free: (1 - closed) * (1 - busy),
  };
}

/** The corners and lips of a shape, combined with the weights of the face: `weight(name)` is from 0 to 1. */
export function lipsOf(shape, weight) {
  const { free } = shape;
  const both = (name) => (weight(`${name}Left`) + weight(`${name}Right`)) / 2;
  const bent = 0.35 + 0.65 * free;
  const pucker = weight("mouthPucker");
  const funnel = weight("mouthFunnel") * free;
  const lowered = free * (30 * weight("jawOpen") * (1 - shape.jaw / 45));
  const jaw = shape.jaw + lowered;
  // Behind closed lips, the jaw stays open.
  const closed = Math.min(lowered, free * 30 * weight("mouthClose"));
  const hanging = Math.max(0, Math.min(jaw, jaw + shape.low) - closed);
  const side = (name) => {
    const smile = weight(`mouthSmile${name}`);
    const frown = weight(`mouthFrown${name}`);
    const stretch = weight(`mouthStretch${name}`);
    return {
      width: (shape.width + bent * (5 * smile + 6 * stretch - frown)) * (1 - 0.55 * pucker) * (1 - 0.3 * funnel),
      corner: bent * (8 * frown + 3 * stretch - 11 * smile) + hanging * 0.3 * (1 - smile),
      up: shape.up + free * (7 * weight(`mouthUpperUp${name}`) + 3 * weight(`noseSneer${name}`)) + 5 * funnel,
    };
  };
  return {
    left: side("Left"),
    right: side("Right"),
    jaw,
    bottom: jaw - closed + shape.low + free * (7 * both("mouthLowerDown") + 4 * funnel),
    shift: 7 * (weight("mouthLeft") - weight("mouthRight")) * (0.4 + 0.6 * free),
    round: Math.max(shape.round, funnel),
    lip: shape.lip * (1 - 0.35 * both("mouthPress")) * (1 + 0.4 * pucker),
    shrug: 3 * weight("mouthShrugLower") * free,
    isBitten: shape.bite > 0,
    tongue: shape.tongue,
    tip: shape.tip,
    tongueOut: Math.max(shape.out ?? 0, weight("tongueOut") * free),
  };
}
