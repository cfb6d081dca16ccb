// A face whose mouth takes the shape of a viseme.

/** Half width, rise of the upper lip, drop of the lower lip, how much shows of teeth and tongue. */
const shape = (width, rise, drop, teeth = 0, tongue = 0) => ({ width, rise, drop, teeth, tongue });

const REST = shape(24, 1, 5);
const CLOSED = shape(26, 1, 1);
const CONSONANT = shape(28, 9, 14, 0.85);
const WIDE = shape(34, 10, 18, 0.7, 0.3);
const OPEN = shape(30, 16, 40, 0.32, 0.6);
const ROUND = shape(19, 22, 36, 0.1, 0.4);
const PURSED = shape(11, 12, 16);
const BITE = shape(27, 9, 8, 1.2);
const TONGUE = shape(28, 13, 28, 0.3, 0.9);
const HALF_ROUND = shape(15, 16, 24, 0, 0.3);

const SHAPES = {
  blair: { A: OPEN, M: CLOSED, O: ROUND, S: CONSONANT, W: PURSED, E: WIDE, F: BITE, L: TONGUE, U: HALF_ROUND },
  toonboom: { A: CLOSED, B: CONSONANT, C: WIDE, D: OPEN, E: ROUND, F: PURSED, G: BITE },
};

/** The shape of a viseme; the digits of `rms` open the mouth step by step. */
function shapeOf(viseme, type) {
  if (viseme === "-") return REST;
  if (type === "rms") return shape(24 + Number(viseme) / 2, 2 + Number(viseme) * 1.6, 4 + Number(viseme) * 4, 0.25, 0.4);
  return SHAPES[type ?? "blair"][viseme] ?? REST;
}

/** How far the mouth is open, from 0 to 1. */
export function openness(viseme, type) {
  const { rise, drop } = shapeOf(viseme, type);
  return Math.min(1, (rise + drop) / 58);
}

const outline = ({ width, rise, drop }) =>
  `M${-width} 0C${-width * 0.7} ${-rise * 1.3} ${width * 0.7} ${-rise * 1.3} ${width} 0` +
  `C${width * 0.75} ${drop * 1.3} ${-width * 0.75} ${drop * 1.3} ${-width} 0Z`;

const FACE = `
  <clipPath id="opening"><path/></clipPath>
  <ellipse class="hair" cx="0" cy="-22" rx="88" ry="86"/>
  <ellipse class="head" cx="0" cy="6" rx="78" ry="92"/>
  <path class="hair" d="M-76 -24C-60 -84 -12 -66 30 -74C56 -78 70 -52 77 -22C74 -96 34 -108 0 -108C-40 -108 -78 -90 -76 -24Z"/>
  <ellipse class="cheek" cx="-46" cy="28" rx="15" ry="9"/><ellipse class="cheek" cx="46" cy="28" rx="15" ry="9"/>
  <ellipse class="eye" cx="-30" cy="-8" rx="7" ry="9"/><ellipse class="eye" cx="30" cy="-8" rx="7" ry="9"/>
  <circle cx="-28" cy="-11" r="2.5" fill="#fff"/><circle cx="32" cy="-11" r="2.5" fill="#fff"/>
  <path class="brow" d="M-42 -28Q-30 -35 -18 -29"/><path class="brow" d="M18 -29Q30 -35 42 -28"/>
  <path class="nose" d="M-2 4Q-7 18 3 19"/>
  <g transform="translate(0 45) scale(0.86)">
    <path class="inside"/>
    <g clip-path="url(#opening)"><ellipse class="tongue" cx="0"/><rect class="teeth" x="-40" width="80"/></g>
    <path class="lips"/>
  </g>`;

/** Draws the face into an SVG element, and gives the function that moves its mouth. */
export function face(svg) {
  svg.innerHTML = FACE;
  const paths = svg.querySelectorAll("#opening path, .inside, .lips");
  const teeth = svg.querySelector(".teeth");
  const tongue = svg.querySelector(".tongue");
  return (viseme, type) => {
    const shape = shapeOf(viseme, type);
    paths.forEach((path) => path.setAttribute("d", outline(shape)));
    const height = (shape.rise + shape.drop) * shape.teeth * 0.55;
    set(teeth, { y: -shape.rise, height });
    set(tongue, { cy: shape.drop * (1.35 - shape.tongue * 0.55), rx: shape.width * 0.7, ry: shape.drop * shape.tongue * 0.7 });
  };
}

function set(element, attributes) {
  Object.entries(attributes).forEach(([name, value]) => element.setAttribute(name, value));
}
