// A patch over a bank, in node: fixtures/banks/v1/patch.lipzbank over small.lipzbank.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { LipzError, open, openLayers } from "../lipz.js";

const read = (name) => readFile(new URL(`banks/${name}.lipzbank`, import.meta.url));
const [base, patch, other] = await Promise.all(["small", "patch", "drama"].map(read));

test("a stack answers from its topmost layer", async () => {
  const below = (await open(base)).verify();
  const layers = await openLayers([base, patch]);
  assert.equal(layers.layerCount, 2);
  assert.equal(layers.defaultLocale, "en-us");
  assert.deepEqual(layers.locales, ["de-de", "en-us", "fr-fr"]);
  const keys = layers.clips().map((clip) => clip.key);
  assert.deepEqual(keys.filter((key) => below.clip(key) === undefined), ["patch/new"]);
  assert.ok(below.clip("act2/bare") && layers.clip("act2/bare") === undefined, "removed");
  // A text of the patch, mouth shapes of the base.
  const clip = layers.clip("act1/blair");
  assert.equal(clip.frames, below.clip("act1/blair").frames);
  assert.deepEqual(clip.segment(0).text("en-us"), { text: "Patched.", isFallback: false });
  assert.equal(layers.clip(clip.id).key, "act1/blair");
  // The patch has French, for which the default locale stands in elsewhere.
  const far = below.clip("act2/far").segment(0).text("en-us");
  assert.deepEqual(layers.clip("act2/far").segment(0).text("fr-fr"), { text: far.text, isFallback: true });
  assert.deepEqual(layers.clip("patch/new").segment(0).text("fr-fr"), { text: "Neuf.", isFallback: false });
  assert.equal(layers.clip("patch/new").segment(0).text("nowhere"), undefined);
  assert.equal(layers.clip("patch/new").cursor().advanceTo(0).events.length, 1);
  assert.equal(layers.babble("nobody"), undefined);
  assert.equal(layers.defaultBabble.name, "default");
});

test("layers that do not fit are refused", async () => {
  for (const files of [[patch], [other, patch], [base, other], [base, patch.subarray(0, 100)], []]) {
    await assert.rejects(openLayers(files), LipzError);
  }
});
