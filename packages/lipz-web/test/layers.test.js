// Layers over banks, in node: fixtures/banks/v1/patch.lipzbank over small.lipzbank, redub.lipzbank over dubbed.lipzbank.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { LipzError, open, openLayers } from "../lipz.js";

const read = (name) => readFile(new URL(`banks/${name}.lipzbank`, import.meta.url));
const [base, patch, other, dubbed, redub] = await Promise.all(["small", "patch", "drama", "dubbed", "redub"].map(read));

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

test("a clip of a stack is played in the voice that is asked for", async () => {
  const below = (await open(dubbed)).verify();
  const layers = await openLayers([dubbed, redub]);
  assert.deepEqual(layers.voices, ["en-us", "de-at", "de-de"]);
  assert.deepEqual(below.clip("no").inVoice("de-de").spoken, "original");
  const { clip, spoken } = layers.clip("no").inVoice("de-de");
  assert.deepEqual([clip.key, clip.frames, spoken], ["de/no", "LAAAAAAAE-", "dub"]);
  assert.deepEqual(clip.segment(0).text("de-de"), { text: "Nein.", isFallback: false });
  assert.equal(layers.clip("no").inVoice("de-at").spoken, "other-dub");
  assert.equal(clip.inVoice("en-us").clip.key, "no");
  assert.deepEqual([clip.voice, layers.clip("aye").voice], ["de-de", "en-us"]);
  assert.equal(layers.clip("aye").inVoice("de-de").clip.key, "de/aye", "a dub of the base");
  assert.equal(layers.clip("no").inVoice("it-it"), undefined);
  assert.deepEqual((await openLayers([base, patch])).voices, []);
});

test("faces of a stack have the profiles of the topmost bank with some", async () => {
  const below = (await open(dubbed)).verify();
  const layers = await openLayers([dubbed, redub]);
  // The base has the clip, the layer the profile: a blink in each second, not in each fourth.
  const blinks = (clip, settings) => {
    const lids = Array.from({ length: 2000 }, (_, step) => clip.faceAt(step / 50, settings).blink);
    return lids.filter((closed, at) => closed === 1 && lids[at - 1] !== 1).length;
  };
  const count = blinks(layers.clip("aye"));
  assert.ok(count > 30 && blinks(below.clip("aye")) < 20, count);
  assert.equal(blinks(layers.clip("aye").orFps(12)), count);
  const profile = layers.defaultFaceProfile;
  assert.equal(blinks(layers.clip("aye"), { profile }), count);
  assert.equal(layers.faceProfile("nobody"), undefined);
  assert.deepEqual(layers.clip("aye").faceAt({ us: 500000 }), layers.clip("aye").faceAt(0.5));
});

test("a layer uses the locales of a text bank", async () => {
  const [bank, texts] = await Promise.all(["split.lipzbank", "split.de-de.lipztexts"].map((name) => readFile(new URL(`banks/${name}`, import.meta.url))));
  const without = await openLayers([bank]);
  const layers = await openLayers([{ bank, texts }]);
  assert.deepEqual([without.locales, layers.locales], [[], ["de-de"]]);
  const expected = (await open(base)).clips().map((clip) => clip.segment(0)?.text("de-de")?.text);
  assert.deepEqual(layers.clips().map((clip) => clip.segment(0)?.text("de-de")?.text), expected);
  await assert.rejects(openLayers([{ bank: base, texts: texts.subarray(0, 80) }]), LipzError);
});

test("layers that do not fit are refused", async () => {
  for (const files of [[patch], [other, patch], [base, other], [base, patch.subarray(0, 100)], []]) {
    await assert.rejects(openLayers(files), LipzError);
  }
});
