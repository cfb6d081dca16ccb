// The drawn face in node: its mouths match the reader, its moods differ, and invalid numbers do not break it.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { lipsOf, shapeOf } from "../face/mouth.js";
import { PRESETS } from "../face/presets.js";
import { EMOTION_COLOURS, emotionsOf, faceMarkup, VISEMES, weightsOf } from "../face.js";
import { EMOTIONS, openDialogue } from "../node.js";

const dialogue = await openDialogue([new URL("banks/small.lipzbank", import.meta.url)]);
const drawn = (pose) => faceMarkup(pose, "");

/** The size of the opening of a shape: 0 for closed lips, and a minimal 1 for teeth on a lip. */
function opening({ width, up, jaw, low, bite }) {
  const height = up + jaw + low;
  return height < 1 ? 0 : bite ? 1 : width * height;
}

test("mouths are open in the order of the reader's openness", () => {
  for (const type of Object.keys(VISEMES)) {
    const clip = dialogue.clip(`act1/${type}`).orFps(24);
    const opennessOf = (code) => {
      const frame = clip.frames.indexOf(code);
      assert.ok(frame >= 0, `${type} ${code} is in the bank`);
      return clip.opennessAt(clip.startOfFrame(frame));
    };
    const codes = Object.keys(VISEMES[type]).filter((code) => clip.frames.includes(code));
    assert.ok(codes.length >= 8, type);
    for (const a of codes) {
      for (const b of codes.filter((b) => opennessOf(a) < opennessOf(b))) {
        assert.ok(opening(shapeOf(a, type)) < opening(shapeOf(b, type)), `${type}: ${a} is less open than ${b}`);
      }
    }
  }
});

test("weights below 0 are as 0", () => {
  for (const name of ["jawOpen", "mouthSmileLeft", "cheekPuff", "browDownLeft", "tears"]) {
    assert.equal(drawn({ shapes: { [name]: -0.5 } }), drawn({}), name);
    assert.notEqual(drawn({ shapes: { [name]: 0.5 } }), drawn({}), name);
  }
});

test("each code has a mouth of its own, and the same sounds have the same in both charts", () => {
  for (const type of Object.keys(VISEMES)) {
    const mouths = Object.keys(VISEMES[type]).map((viseme) => drawn({ viseme, visemeType: type }));
    assert.equal(new Set(mouths).size, mouths.length, type);
  }
  const codes = { A: "M", B: "S", C: "E", D: "A", E: "O", F: "W", G: "F", "-": "-" };
  for (const [toonboom, blair] of Object.entries(codes)) {
    assert.equal(VISEMES.toonboom[toonboom], VISEMES.blair[blair]);
    assert.equal(shapeOf(toonboom, "toonboom"), shapeOf(blair, "blair"));
  }
});

test("each emotion has a face and a colour of its own, which grow", () => {
  assert.deepEqual(Object.keys(EMOTION_COLOURS), EMOTIONS);
  assert.equal(new Set(Object.values(EMOTION_COLOURS)).size, EMOTIONS.length);
  const faces = EMOTIONS.flatMap((emotion) => [1, 2.5, 5, 7.5, 10].map((value) => drawn({ emotions: { [emotion]: value } })));
  assert.equal(new Set([...faces, drawn({})]).size, faces.length + 1);
  for (const emotion of EMOTIONS) {
    const sum = (value) => Object.values(weightsOf({ [emotion]: value })).reduce((sum, weight) => sum + Math.abs(weight), 0);
    assert.ok(0 < sum(2.5) && sum(2.5) < sum(5) && sum(5) < sum(10), emotion);
    assert.deepEqual(weightsOf({ [emotion]: 99 }), weightsOf({ [emotion]: 10 }));
  }
  assert.deepEqual(weightsOf({ joy: 0, anger: -1, smug: 5 }), {});
  assert.ok(Math.abs(weightsOf({ anger: 5, joy: 5 }).flush - 0.4) < 1e-9, "they are added");
});

test("words are the emotions that faces.md says", async () => {
  const page = await readFile(new URL("faces.md", import.meta.url), "utf8");
  const rows = Array.from(page.matchAll(/^\| ((?:`\w+`(?:, )?)+) \| (none|(?:\w+(?: \d+|, usual value)(?:, )?)+) \|/gm));
  const told = rows.flatMap(([, words, attributes]) => {
    const pairs = Array.from(attributes.matchAll(/(\w+)(?: (\d+)|, usual value)/g), ([, name, value]) => [name, Number(value ?? 5)]);
    return Array.from(words.matchAll(/`(\w+)`/g), ([, word]) => [word, Object.fromEntries(pairs)]);
  });
  assert.deepEqual(Object.fromEntries(told), PRESETS);
  for (const [word, emotions] of told) assert.equal(emotionsOf(word), PRESETS[word] ?? emotions);
  assert.deepEqual([emotionsOf("anger"), emotionsOf("smug"), emotionsOf(undefined), emotionsOf("toString")], [{ anger: 5 }, {}, {}, {}]);
});

test("sounds of closed lips are closed in every mood", () => {
  for (const emotion of EMOTIONS) {
    const weights = weightsOf({ [emotion]: 10 });
    for (const [viseme, type] of [["M", "blair"], ["A", "toonboom"]]) {
      const { left, right, bottom } = lipsOf(shapeOf(viseme, type), (name) => weights[name] ?? 0);
      assert.equal(left.up + right.up + bottom, 0, `${viseme} with ${emotion}`);
    }
  }
});

test("no number, name or nothing breaks the drawing", () => {
  const numbers = [NaN, Infinity, -Infinity, 1e300, -1e300, -1, 0, 1, undefined];
  const names = ["blink", "headPitch", "headYaw", "headRoll", "eyePitch", "eyeYaw", "brows", "shrug", "breath"];
  const poses = numbers.flatMap((number) => [
    ...names.map((name) => ({ [name]: number })),
    ...["jawOpen", "mouthPucker", "eyeBlinkLeft", "tongueOut", "nosuch", "__proto__"].map((name) => ({ shapes: { [name]: number } })),
    ...EMOTIONS.map((emotion) => ({ emotions: { [emotion]: number } })),
  ]);
  poses.push({ viseme: "?" }, { viseme: "A" }, { viseme: "A", visemeType: "nosuch" }, { viseme: "constructor", visemeType: "blair" });
  for (const pose of poses) {
    const text = drawn(pose);
    assert.doesNotMatch(text, /NaN|undefined|Infinity|e\+|null/, JSON.stringify(pose));
    assert.ok(text.length < 9000, JSON.stringify(pose));
  }
});

test("faces in one document have outlines of their own", () => {
  const ids = (text) => Array.from(text.matchAll(/ id="(.*?)"/g), ([, id]) => id);
  const all = [...ids(faceMarkup({})), ...ids(faceMarkup({}))];
  assert.equal(new Set(all).size, 8);
  const text = faceMarkup({}, "mara-");
  for (const [, id] of text.matchAll(/url\(#(.*?)\)/g)) assert.ok(ids(text).includes(id), id);
});
