// The parts of the drawn face, from back to front: an element, its name, its fixed attributes, and its content.
//
// geometry.js returns the attributes of named parts that depend on the pose.

const HAIR = "#4a3a3a";
const LINE = "#a5694f";
const line = (width, colour = LINE) => ({
  fill: "none",
  stroke: colour,
  "stroke-width": width,
  "stroke-linecap": "round",
  "stroke-linejoin": "round",
});

function eye(side) {
  return [
    ["path", `${side}White`, { fill: "#fffdf8" }],
    [
      "g",
      `${side}Inside`,
      {},
      [
        ["circle", `${side}Iris`, { r: 7, fill: "#5a7d8c" }],
        ["circle", `${side}Pupil`, { fill: "#20242e" }],
        ["circle", `${side}Light`, { r: 1.7, fill: "#fff" }],
        ["path", `${side}Shade`, { fill: "#20242e", opacity: 0.13 }],
      ],
    ],
    ["path", `${side}Lower`, line(1.4, "#b57b60")],
    ["path", `${side}Upper`, line(3, "#3a2c2c")],
  ];
}

const MOUTH = [
  ["path", "inside", { fill: "#4d1a24" }],
  [
    "g",
    "insideMouth",
    {},
    [
      ["ellipse", "tongue", { fill: "#d9747a" }],
      ["path", "lowerTeeth", { fill: "#f3ece0" }],
      ["path", "upperTeeth", { fill: "#fffaf0" }],
      ["ellipse", "tip", { fill: "#e0838a" }],
    ],
  ],
  ["path", "lowerLip", { fill: "#cf6a63" }],
  ["path", "upperLip", { fill: "#bd5852" }],
  ["path", "bite", { fill: "#fffaf0" }],
  ["path", "seam", line(1.6, "#6e2b2e")],
  ["path", "tongueOut", { fill: "#e0838a" }],
];

/** An outline that clips a group. */
const clip = (name) => ["clipPath", `${name}Clip`, {}, [["path", `${name}Outline`, {}]]];

const LIGHT = [
  ["stop", "moodNear", { offset: 0.5 }],
  ["stop", "moodFar", { offset: 1, "stop-opacity": 0 }],
];

export const PARTS = [
  ["defs", undefined, {}, [clip("right"), clip("left"), clip("inside"), ["radialGradient", "moodLight", {}, LIGHT]]],
  ["circle", "mood", { r: 112, cy: -6 }],
  ["path", "body", { fill: "#55678f" }],
  ["path", "neck", {}],
  [
    "g",
    "head",
    {},
    [
      ["g", "back", {}, [["path", undefined, { fill: HAIR, d: "M-72 6C-86 -60 -62 -104 0 -105C62 -104 86 -60 72 6C70 26 -70 26 -72 6Z" }]]],
      [
        "g",
        "ears",
        {},
        [
          ["ellipse", "earRight", { cx: -68, cy: 6, rx: 10, ry: 15 }],
          ["ellipse", "earLeft", { cx: 68, cy: 6, rx: 10, ry: 15 }],
        ],
      ],
      ["path", "skull", {}],
      ["path", "fringe", { fill: HAIR }],
      [
        "g",
        "features",
        {},
        [
          ["ellipse", "cheekRight", { rx: 14, ry: 9 }],
          ["ellipse", "cheekLeft", { rx: 14, ry: 9 }],
          ["path", "crease", line(1.6)],
          ...eye("right"),
          ...eye("left"),
          ["path", "browRight", line(5, HAIR)],
          ["path", "browLeft", line(5, HAIR)],
          ["path", "furrow", line(1.6)],
          ["path", "forehead", line(1.6)],
          ["path", "tears", { fill: "#6bb5f0" }],
          ["path", "nose", line(2.6)],
          ["path", "wrinkles", line(1.5)],
          ["g", "mouth", {}, MOUTH],
        ],
      ],
      ["path", "sweat", { fill: "#7fc4f5" }],
    ],
  ],
];

const escaped = (text) => String(text).replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll('"', "&quot;");

/** Elements as text, with the `attributes` of named parts. Unless `isNamed`, invisible parts are omitted. */
export function markup(parts, attributes, isNamed) {
  return parts.map(([tag, name, fixed, inside = []]) => {
    const all = { ...(isNamed && name && { "data-part": name }), ...fixed, ...attributes[name] };
    if (!isNamed && (all.opacity === 0 || all.d === "")) return "";
    const told = Object.entries(all).map(([key, value]) => ` ${key}="${escaped(value)}"`).join("");
    const within = markup(inside, attributes, isNamed);
    return within ? `<${tag}${told}>${within}</${tag}>` : `<${tag}${told}/>`;
  }).join("");
}
