// Curves in node: the answers in the dump next to their bank.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { EMOTIONS, openDialogue } from "../node.js";

const banks = new URL("./banks/", import.meta.url);
const dialogue = await openDialogue([new URL("curves.lipzbank", banks)]);
const dump = await readFile(new URL("curves.dump", banks), "utf8");

test("curves have the keys and values of the reader", () => {
  let seen = 0;
  for (const part of dump.split("\nclip ").slice(1)) {
    const clip = dialogue.clip(part.slice(0, part.lastIndexOf(" ", part.indexOf("\n"))));
    const lines = Array.from(part.matchAll(/^ {2}curve "(.*?)" (.*), each 50 ms: (.*)$/gm));
    assert.deepEqual(clip.curves.map((curve) => curve.name), lines.map(([, name]) => name));
    for (const [, name, keys, values] of lines) {
      const curve = clip.orFps(24).curve(name);
      assert.equal(curve.keys.map(({ frame, value }) => `${frame}:${value}`).join(" "), keys);
      assert.equal(curve.keyCount, curve.keys.length);
      values.split(" ").forEach((value, step) => {
        assert.equal(curve.valueAt({ us: step * 50_000 }), Number(value), `${name} at ${step * 50} ms`);
      });
      for (const { frame, value } of curve.keys) assert.equal(curve.value(frame), value);
      seen += 1;
    }
  }
  assert.equal(seen, 7);
});

test("emotions are the curves of their names", () => {
  const clip = dialogue.clip("act1/rig");
  const { values, strongest, sum } = clip.emotionsAt(0.5);
  assert.deepEqual([values.anger, values.joy, strongest, sum], [2.2, 0, "anger", 2.2]);
  assert.deepEqual(Object.keys(values), EMOTIONS);
  assert.equal(clip.emotionsAt({ us: -1 }).strongest, undefined);
  assert.equal(dialogue.clip("act1/plain").emotionsAt(1).sum, 0);
});

test("what is not there is undefined", () => {
  const clip = dialogue.clip("nothing");
  assert.equal(clip.curve("anger"), undefined);
  assert.equal(clip.curve("joy").valueAt(0), undefined, "without a frame rate");
  assert.equal(clip.orFps(10).curve("joy").valueAt(NaN), 1.5);
  assert.deepEqual(dialogue.clip("act1/plain").curves, []);
});
