// The pictures in the documentation, drawn with the face of the package: `node pictures.js FOLDER` writes them.

import { writeFile } from "node:fs/promises";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { areasOf, lineOf } from "../demo/plots.js";
import { levelsOf } from "../demo/levels.js";
import { geometry } from "../face/geometry.js";
import { markup, PARTS } from "../face/parts.js";
import { EMOTION_COLOURS, faceMarkup, VIEW_BOX, VISEMES } from "../face.js";
import { ARTICULATORS, EMOTIONS, openDialogue } from "../node.js";

const [LEFT, TOP, WIDTH, HEIGHT] = VIEW_BOX;
const INK = "#20242e";
const FAINT = "#5b6474";
const EDGE = "#d9d3c4";
const PANEL = "#f7f4ec";
const FONT = 'font-family="system-ui, \'DejaVu Sans\', sans-serif"';

const escaped = (text) => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;");
const text = (x, y, size, words, more = "") => `<text x="${x}" y="${y}" font-size="${size}" ${more}>${escaped(words)}</text>`;

/** A picture of this size with a title. Repeated elements are written once. */
function picture(width, height, title, contents) {
  const count = new Map();
  const each = /<(?:path|ellipse|circle)[^>]{40,}\/>/g;
  for (const [found] of contents.matchAll(each)) count.set(found, (count.get(found) ?? 0) + 1);
  const shared = Array.from(count.keys()).filter((found) => count.get(found) > 1);
  const ids = new Map(shared.map((found, index) => [found, `s${index}`]));
  const defined = shared.map((found) => found.replace(" ", ` id="${ids.get(found)}" `)).join("");
  const used = contents.replace(each, (found) => (ids.has(found) ? `<use href="#${ids.get(found)}"/>` : found));
  return (
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" width="${width}" height="${height}" role="img" ${FONT}>` +
    `<title>${escaped(title)}</title><defs>${defined}</defs><rect width="${width}" height="${height}" rx="14" fill="${PANEL}"/>${used}</svg>\n`
  ).replaceAll(/<(g|path|use|text|rect|defs)/g, "\n<$1");
}

/** Faces in rows, each with a heading and a line below it. */
function sheet(title, columns, faces) {
  const [wide, high] = [WIDTH * 0.68, HEIGHT * 0.68 + 58];
  const cells = faces.map(([heading, line, pose], index) => {
    const [x, y] = [16 + (index % columns) * wide, 14 + Math.floor(index / columns) * high];
    const face = `<g transform="translate(${x} ${y}) scale(.68) translate(${-LEFT} ${-TOP})">${faceMarkup(pose, `f${index}`)}</g>`;
    const below = y + HEIGHT * 0.68;
    return (
      face +
      text(x + wide / 2, below + 20, heading.length > 12 ? 13 : 17, heading, `text-anchor="middle" font-weight="700" fill="${INK}"`) +
      text(x + wide / 2, below + 38, 11.5, line, `text-anchor="middle" fill="${FAINT}"`)
    );
  });
  return picture(Math.round(columns * wide + 32), Math.round(Math.ceil(faces.length / columns) * high + 14), title, cells.join(""));
}

function visemes(type, title, columns) {
  const faces = Object.entries(VISEMES[type]).sort(([a], [b]) => (a < b ? -1 : 1));
  return sheet(title, columns, faces.map(([viseme, sounds]) => [viseme, sounds, { viseme, visemeType: type }]));
}

function emotions() {
  const faces = EMOTIONS.flatMap((emotion) => [5, 10].map((value) => [emotion, String(value), { emotions: { [emotion]: value } }]));
  return sheet("The twelve attributes of emotion, at 5 and at 10", 6, faces);
}

const MIXES = [
  ["anger 2.2", "a slight sneer", { anger: 2.2 }],
  ["joy 5 + sadness 5", "a sad smile", { joy: 5, sadness: 5 }],
  ["anger 5 + joy 5", "a wicked grin", { anger: 5, joy: 5 }],
  ["fear 3", "worry", { fear: 3 }],
  ["disgust 3", "disdain", { disgust: 3 }],
  ["anger 3", "sternness", { anger: 3 }],
];

function mixes() {
  return sheet("Emotions that are mixed, or mild", 6, MIXES.map(([heading, line, emotions]) => [heading, line, { emotions }]));
}

/** A clip while it plays: the face, and rows of texts, visemes, emotions and curves. */
async function playing(time) {
  const dialogue = await openDialogue([new URL("../demo/faces.lipzbank", import.meta.url)]);
  const english = dialogue.locale("en-us");
  const clip = dialogue.clip("leave");
  const [x, width, frames] = [250, 610, clip.frameCount];
  const px = (frame) => Number((x + (frame * width) / frames).toFixed(1));
  const now = clip.segmentAt(time).index;
  const pose = { viseme: clip.visemeAt(time), visemeType: clip.visemeType, emotions: clip.emotionsAt(time).values };
  const plot = (y, height, inside) => `<g transform="translate(${x} ${y}) scale(${(width / frames).toFixed(4)} ${height})">${inside}</g>`;
  const parts = clip.segments.flatMap((segment) => {
    const fill = segment.index === now ? "#dbe5fb" : "#fffdf8";
    const [from, to] = [px(segment.startFrame), px(segment.endFrame)];
    return [
      `<rect x="${from}" y="18" width="${(to - from).toFixed(1)}" height="48" fill="${fill}" stroke="${EDGE}"/>`,
      text(from + 8, 39, 13, segment.text(english).text, `fill="${INK}"`),
      text(from + 8, 57, 10.5, segment.event, `fill="${FAINT}"`),
    ];
  });
  const bars = levelsOf(clip).map((level, frame) => `M${frame} ${(1 - level).toFixed(2)}h.85V1h-.85Z`).join("");
  const codes = Array.from(clip.frames, (code, frame) => text(px(frame + 0.5), 122, 6.5, code, `text-anchor="middle" fill="${FAINT}"`));
  const felt = EMOTIONS.map((name) => clip.curve(name)).filter(Boolean);
  const areas = areasOf(felt, frames).map(({ name, d }) => `<path d="${d}" fill="${EMOTION_COLOURS[name]}"/>`);
  const lines = felt.flatMap((curve, row) => {
    const y = 172 + row * 30;
    const line = `<path d="${lineOf(curve, frames).d}" fill="none" stroke="${EMOTION_COLOURS[curve.name]}" stroke-width="2" vector-effect="non-scaling-stroke"/>`;
    const value = `${curve.name} ${Number(curve.valueAt(time).toFixed(1))}`;
    return [plot(y, 26, line), text(x - 8, y + 22, 11, value, `text-anchor="end" fill="${FAINT}"`)];
  });
  const head = px((time / clip.duration) * frames);
  const playhead = `<rect x="${head - 1}" y="12" width="2" height="284" fill="#a65e00"/>`;
  return picture(
    880,
    308,
    "A clip while it plays: the face, its texts, mouth shapes, emotions and curves",
    `<g transform="translate(8 14) scale(.82) translate(${-LEFT} ${-TOP})">${faceMarkup(pose, "f")}</g>` +
      parts.join("") + plot(76, 38, `<path d="${bars}" fill="#7488bd"/>`) + codes.join("") + plot(130, 34, areas.join("")) + lines.join("") + playhead +
      text(102, 256, 16, clip.segment(now).text(english).text, `text-anchor="middle" fill="${INK}"`),
  );
}

/** The parts of a face that are visible from nose to chin, and the clip paths of the mouth. */
const AROUND_MOUTH = new Set([undefined, "head", "skull", "features", "nose", "mouth", "insideClip"]);

/** The parts of a face from nose to chin, with all parts of the mouth. */
function aroundMouth(parts) {
  return parts
    .filter(([, name]) => AROUND_MOUTH.has(name))
    .map(([tag, name, fixed, inside = []]) => [tag, name, fixed, name === "mouth" || name === "insideClip" ? inside : aroundMouth(inside)]);
}

/** A picture of the mouth for each code of each viseme type, for editors. */
function shapes() {
  const parts = aroundMouth(PARTS);
  const mouth = (viseme, visemeType) => {
    const drawn = markup(parts, geometry({ viseme, visemeType }, "m"), false);
    return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="-66 -6 132 108" width="132" height="108">${drawn}</svg>`;
  };
  const drawn = ([type, codes]) => [type, Object.fromEntries(Object.keys(codes).map((code) => [code, mouth(code, type)]))];
  return JSON.stringify(Object.fromEntries(Object.entries(VISEMES).map(drawn)), null, 1) + "\n";
}

/** Groups of mouths in rows. A group has a title, and each mouth a heading and a line below it. */
function mouths(title, columns, groups) {
  const parts = aroundMouth(PARTS);
  const [wide, high, gap, titled] = [118, 124, 12, 26];
  let [top, count] = [12, 0];
  const drawn = groups.map(([name, cells]) => {
    const start = top + (name === "" ? 0 : titled);
    top = start + Math.ceil(cells.length / columns) * high + 4;
    const all = cells.map(([heading, line, articulation], index) => {
      const [x, y] = [12 + (index % columns) * wide, start + Math.floor(index / columns) * high];
      const mouth = markup(parts, geometry({ articulation }, `m${count++}`), false);
      const inner = wide - gap;
      return (
        `<svg x="${x + gap / 2}" y="${y}" viewBox="-66 -6 132 108" width="${inner}" height="${Math.round((inner * 108) / 132)}">${mouth}</svg>` +
        text(x + wide / 2, y + 100, heading.length > 12 ? 10 : 13, heading, `text-anchor="middle" font-weight="700" fill="${INK}"`) +
        text(x + wide / 2, y + 114, 10.5, line, `text-anchor="middle" fill="${FAINT}"`)
      );
    });
    return (name === "" ? "" : text(18, start - 8, 14, name, `font-weight="700" fill="${FAINT}"`)) + all.join("");
  });
  return picture(columns * wide + 24, top + 6, title, drawn.join(""));
}

/** Each articulator at its largest value. The tongue is only visible in an open mouth. */
function articulators() {
  const open = { jaw: 0.55, opening: 0.5 };
  const around = { jaw: { opening: 0.3 }, tongueTip: open, tongueOut: open, tongueBack: open, spreading: { opening: 0.3 } };
  const spelled = (name) => name.replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`);
  const cells = ARTICULATORS.map((name) => [spelled(name), name === "jaw" ? "lips together below" : "", { ...around[name], [name]: 1 }]);
  cells[0][1] = "with slightly open lips";
  cells.filter(([name]) => name.startsWith("tongue")).forEach((cell) => (cell[1] = "in an open mouth"));
  return mouths("The nine articulators, each at 1000", 5, [["", cells]]);
}

/** The mouth of each weight of a rig that speech moves: that of the English phone with the largest weight. */
async function rigs(names, title, columns) {
  const dialogue = await openDialogue([new URL("./banks/rigs.lipzbank", import.meta.url)]);
  const clip = dialogue.clip("english");
  const phones = Array.from({ length: 39 }, (_, index) => 0.3 + index * 0.4);
  const groups = names.map((name) => {
    const rig = dialogue.rig(name);
    const rows = phones.map((time) => Array.from(rig.weights(clip.articulationAt(time))));
    const rest = Array.from(rig.weights(clip.articulationAt(0)));
    const most = rig.weightNames.map((_, weight) => Math.max(...rows.map((row) => row[weight])));
    const cells = rig.weightNames.flatMap((weight, index) => {
      if (weight.endsWith("Right") || most[index] < rest[index] + 0.1) return [];
      const best = rows.findIndex((row) => row[index] === most[index]);
      return [[weight.replace(/Left$/, ""), `${ENGLISH[best]} ${most[index].toFixed(2)}`, clip.articulationAt(phones[best])]];
    });
    return [name, cells];
  });
  return mouths(title, columns, groups);
}

/** The phones of the clip in the bank, in the order of their times. */
const ENGLISH =
  "AA AE AH AO AW AY B CH D DH EH ER EY F G HH IH IY JH K L M N NG OW OY P R S SH T TH UH UW V W Y Z ZH".split(" ");

/** All pictures, by file name. */
export async function pictures() {
  return {
    "blair.svg": visemes("blair", "The mouth shapes of the viseme type blair", 5),
    "toonboom.svg": visemes("toonboom", "The mouth shapes of the viseme type toonboom", 4),
    "rms.svg": visemes("rms", "The mouth shapes of the viseme type rms", 6),
    "emotions.svg": emotions(),
    "mixes.svg": mixes(),
    "articulators.svg": articulators(),
    "rigs-heads.svg": await rigs(["arkit", "facefx", "vrm", "second-life"], "Shapes of heads, at the English phone that moves each most", 9),
    "rigs-visemes.svg": await rigs(["ovr", "talking-heads"], "Visemes as weights, at the English phone that moves each most", 8),
    "shapes.json": shapes(),
    "playing.svg": await playing(1.1),
  };
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  for (const [name, contents] of Object.entries(await pictures())) await writeFile(join(process.argv[2], name), contents);
}
