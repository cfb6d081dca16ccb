// Dialogues of several files in node: patches, text banks, and sets whose banks are loaded on demand.

import assert from "node:assert/strict";
import { createServer } from "node:http";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { LipzError, openDialogue } from "../node.js";

const golden = (name) => new URL(`banks/${name}`, import.meta.url);
const inSet = (name) => new URL(`sets/${name}`, import.meta.url);
const named = async (name) => ({ name, bytes: await readFile(golden(name)) });
const INDEX = "dubbed.lipzset";
const SHARDS = ["dubbed.0-of-2.51e62ffc7e3d30e7.lipzbank", "dubbed.1-of-2.2372b0174a3e0e74.lipzbank"];
/** The bank of `aye`, which is not the first. */
const [FIRST, OTHER] = SHARDS;

/** The offsets of the checksum and the format version in headers (docs/reference/bank-format.md). */
const CHECKSUM_OFFSET = 8;
const FORMAT_MAJOR_OFFSET = 20;

const tags = (handles) => handles.map(({ tag }) => tag).sort();
const keys = (dialogue) => dialogue.clips().map(({ key }) => key);
const kinds = (dialogue) => dialogue.files.map(({ kind }) => kind);
const textOf = (dialogue, key, tag) => dialogue.clip(key).segment(0).text(dialogue.locale(tag));

test("a dialogue answers from its topmost file", async () => {
  const below = await openDialogue([golden("small.lipzbank")]);
  const stack = await openDialogue([golden("small.lipzbank"), golden("patch.lipzbank")]);
  assert.deepEqual(kinds(stack), ["bank", "patch"]);
  assert.equal(stack.defaultLocale.tag, "en-us");
  assert.deepEqual(tags(stack.locales), ["de-de", "en-us", "fr-fr"]);
  assert.deepEqual(keys(stack).filter((key) => below.clip(key) === undefined), ["patch/new"]);
  assert.equal(stack.clipCount, keys(stack).length);
  assert.ok(below.clip("act2/bare") && stack.clip("act2/bare") === undefined, "removed");
  // A text of the patch, visemes of the base.
  const clip = stack.clip("act1/blair");
  assert.equal(clip.frames, below.clip("act1/blair").frames);
  assert.deepEqual(textOf(stack, "act1/blair", "en-us"), { text: "Patched.", isFallback: false });
  assert.equal(stack.clip(clip.id).key, "act1/blair");
  // The patch has French. For other clips, French falls back to the default locale.
  const { text } = textOf(below, "act2/far", "en-us");
  assert.deepEqual(textOf(stack, "act2/far", "fr-fr"), { text, isFallback: true });
  assert.deepEqual(textOf(stack, "patch/new", "fr-fr"), { text: "Neuf.", isFallback: false });
  assert.equal(stack.clip("patch/new").cursor().advanceTo(0).events.length, 1);
  assert.equal(stack.babble("nobody"), undefined);
  assert.equal(stack.defaultBabble.name, "default");
});

test("a clip of a stack is played in the voice that is asked for", async () => {
  const below = await openDialogue([golden("dubbed.lipzbank")]);
  const stack = await openDialogue([golden("dubbed.lipzbank"), golden("redub.lipzbank")]);
  const played = (key, tag, from = stack) => from.clip(key).inVoice(from.voice(tag));
  assert.deepEqual(stack.voices.map(({ tag }) => tag), ["en-us", "de-at", "de-de"]);
  assert.equal(played("no", "de-de", below).spoken, "original");
  const { clip, spoken } = played("no", "de-de");
  assert.deepEqual([clip.key, clip.frames, spoken], ["de/no", "LAAAAAAAE-", "dub"]);
  assert.deepEqual(clip.segment(0).text(stack.locale("de-de")), { text: "Nein.", isFallback: false });
  assert.equal(played("no", "de-at").spoken, "other-dub");
  assert.equal(clip.inVoice(stack.voice("en-us")).clip.key, "no");
  assert.deepEqual([clip.voice.tag, stack.clip("aye").voice.tag], ["de-de", "en-us"]);
  assert.equal(played("aye", "de-de").clip.key, "de/aye", "a dub of the base");
  assert.equal(stack.voice("it-it"), undefined);
});

test("faces of a stack have the profiles of the topmost bank with some", async () => {
  const below = await openDialogue([golden("dubbed.lipzbank")]);
  const stack = await openDialogue([golden("dubbed.lipzbank"), golden("redub.lipzbank")]);
  // The base has the clip, and the patch has the profile: a blink every second instead of every four seconds.
  const blinks = (clip, profile) => {
    const lids = Array.from({ length: 2000 }, (_, step) => clip.faceAt(step / 50, undefined, profile).blink);
    return lids.filter((closed, at) => closed === 1 && lids[at - 1] !== 1).length;
  };
  const count = blinks(stack.clip("aye"));
  assert.ok(count > 30 && blinks(below.clip("aye")) < 20, count);
  assert.equal(blinks(stack.clip("aye").orFps(12)), count);
  assert.equal(blinks(stack.clip("aye"), stack.defaultFaceProfile), count);
  assert.equal(stack.faceProfile("nobody"), undefined);
  assert.deepEqual(stack.clip("aye").faceAt({ us: 500000 }), stack.clip("aye").faceAt(0.5));
});

test("text banks have the texts of their bank, next to each other", async () => {
  const [german, english] = ["split.de-de.lipztexts", "split.en-us.lipztexts"].map(golden);
  const without = await openDialogue([golden("split.lipzbank")]);
  const one = await openDialogue([golden("split.lipzbank"), german]);
  const both = await openDialogue([golden("split.lipzbank"), german, english]);
  assert.deepEqual([without, one, both].map((dialogue) => tags(dialogue.locales)), [[], ["de-de"], ["de-de", "en-us"]]);
  assert.deepEqual(kinds(both), ["bank", "texts", "texts"]);
  const whole = await openDialogue([golden("small.lipzbank")]);
  for (const tag of ["de-de", "en-us"]) {
    const texts = (dialogue) => dialogue.clips().map((clip) => clip.segment(0)?.text(dialogue.locale(tag))?.text);
    assert.deepEqual(texts(both), texts(whole));
  }
  assert.equal(textOf(one, "act1/toonboom", "de-de").text, "Nur");
});

/** A patch for a different base. Open it unverified, because its own checksum is then wrong. */
async function moved(patch, from, to) {
  const [bytes, before, after] = await Promise.all([patch, from, to].map((url) => readFile(url)));
  const place = bytes.indexOf(before.subarray(CHECKSUM_OFFSET, CHECKSUM_OFFSET + 8));
  after.copy(bytes, place, CHECKSUM_OFFSET, CHECKSUM_OFFSET + 8);
  return { name: "moved.lipzbank", bytes };
}

/** All results of the clips with these keys. */
function told(dialogue, keys) {
  const locales = dialogue.locales.sort((a, b) => (a.tag < b.tag ? -1 : 1));
  const textsOf = ({ segments }) => segments.map((segment) => locales.map((locale) => [locale.tag, segment.text(locale)]));
  const playedIn = (clip, voice) => [voice.tag, clip.inVoice(voice).clip.key, clip.inVoice(voice).spoken];
  const voicesOf = (clip) => dialogue.voices.map((voice) => playedIn(clip, voice));
  const eventsOf = ({ segments }) => segments.map(({ event, events }) => [event, events]);
  const clips = keys.map((key) => dialogue.clip(key));
  return clips.map((clip) => [clip.key, clip.frames, textsOf(clip), voicesOf(clip), eventsOf(clip), clip.faceAt(1)]);
}

test("a bank, a patch and text banks answer together", async () => {
  const stack = await openDialogue(["small.lipzbank", "patch.lipzbank"].map(golden));
  const patch = await moved(golden("patch.lipzbank"), golden("small.lipzbank"), golden("split.lipzbank"));
  const texts = await Promise.all(["split.de-de.lipztexts", "split.en-us.lipztexts"].map(named));
  const files = [golden("split.lipzbank"), patch, ...texts];
  for (const order of [files, [files[0], ...texts, patch]]) {
    const dialogue = await openDialogue(order, { verify: false });
    assert.deepEqual(keys(dialogue).sort(), keys(stack).sort());
    assert.deepEqual(told(dialogue, keys(stack)), told(stack, keys(stack)));
  }
  const without = await openDialogue([golden("split.lipzbank"), patch, texts[0]], { verify: false });
  assert.equal(textOf(without, "act1/toonboom", "de-de").text, "Nur");
  await refused([...files.slice(0, 1), await named("patch.lipzbank"), ...texts], "patch.lipzbank", 37);
});

test("a patch over a set answers before the bank below it is loaded", async () => {
  const stack = await openDialogue(["dubbed.lipzbank", "redub.lipzbank"].map(golden));
  const patch = await moved(golden("redub.lipzbank"), golden("dubbed.lipzbank"), inSet(INDEX));
  const set = await openDialogue([inSet(INDEX), patch], { verify: false });
  assert.deepEqual(kinds(set), ["set", "bank", "absent", "patch"]);
  assert.deepEqual(tags(set.voices), tags(stack.voices));
  assert.equal(set.clip("de/no").frames, stack.clip("de/no").frames, "only the patch has it");
  assert.throws(() => set.clip("aye"), (error) => error.status === 261 && error.file.endsWith(OTHER));
  const voice = set.voice("de-de");
  assert.equal(set.clip("no").inVoice(voice).clip.key, "de/no");
  assert.equal((await set.loadClip("aye")).inVoice(voice).clip.key, "de/aye");
  assert.deepEqual(keys(set).sort(), keys(stack).sort());
  assert.deepEqual(told(set, keys(stack)), told(stack, keys(stack)));
});

/** Asserts that opening files fails with an error that names one of them. */
async function refused(files, file, status, options) {
  await assert.rejects(openDialogue(files, options), (error) => {
    assert.ok(error instanceof LipzError, String(error.stack));
    assert.deepEqual([error.file, error.status], [file, status], error.message);
    assert.ok(error.message.startsWith(`${file}: `) && error.message.endsWith(`; ${error.remedy}`), error.message);
    return true;
  });
}

test("the error names the file that does not fit, and says what to do", async () => {
  const small = await named("small.lipzbank");
  const patch = await named("patch.lipzbank");
  const german = await named("split.de-de.lipztexts");
  const drama = await named("drama.lipzbank");
  const index = { name: INDEX, bytes: await readFile(inSet(INDEX)) };
  const cut = { name: "cut", bytes: patch.bytes.subarray(0, 100) };
  const empty = { name: "empty", bytes: new ArrayBuffer(0) };
  await refused([drama, patch], "patch.lipzbank", 37);
  await refused([small, drama], "drama.lipzbank", 38);
  await refused([small, small], "small.lipzbank", 38);
  await refused([small, cut], "cut", 5);
  await refused([empty], "empty", 1);
  await refused([small, empty], "empty", 1);
  await refused([drama, german], "split.de-de.lipztexts", 28);
  await refused([german], "split.de-de.lipztexts", 29);
  await refused([patch], "patch.lipzbank", 37);
  await refused([small, index], INDEX, 38);
  await refused([{ name: "notes.txt", bytes: Buffer.from("some words ".repeat(10)) }], "notes.txt", 2);
  // Bytes without a name are numbered.
  await refused([small.bytes, cut.bytes], "files[1]", 5);
  await assert.rejects(openDialogue([]), (error) => error instanceof LipzError && error.status === 39);
  const notFiles = [[undefined], [{ name: "x" }], [{ bytes: small.bytes }], [7]];
  for (const files of [undefined, golden("small.lipzbank"), small.bytes, ...notFiles]) {
    await assert.rejects(openDialogue(files), TypeError);
  }
});

test("damage is an error with a status and a place; an unverified file is opened all the same", async () => {
  const { bytes } = await named("small.lipzbank");
  const damaged = Uint8Array.from(bytes);
  damaged[damaged.length - 1] ^= 1;
  const isDamage = (error) => error instanceof LipzError && error.status === 12 && error.offsetBytes === 8;
  await assert.rejects(openDialogue([damaged]), isDamage);
  const dialogue = await openDialogue([damaged], { verify: false });
  assert.equal(dialogue.clip("act1/blair").key, "act1/blair");
});

test("a bank of another format is refused", async () => {
  const { bytes } = await named("small.lipzbank");
  for (const major of [0, 2]) {
    const old = Buffer.from(bytes);
    old.writeUInt16LE(major, FORMAT_MAJOR_OFFSET);
    const files = [{ name: "old.lipzbank", bytes: old }];
    for (const verify of [true, false]) await refused(files, "old.lipzbank", 4, { verify });
  }
});

test("files are paths, URLs, bytes of any kind, or bytes with a name", async () => {
  const url = golden("small.lipzbank");
  const { bytes } = await named("small.lipzbank");
  const server = createServer(async (request, response) => {
    if (request.url !== "/small.lipzbank?v=1") return response.writeHead(404).end();
    response.end(bytes);
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  const http = `http://127.0.0.1:${server.address().port}/`;
  const buffer = Uint8Array.from(bytes).buffer;
  const kinds = [url, String(url), fileURLToPath(url), `${http}small.lipzbank?v=1`, bytes, buffer, new DataView(buffer)];
  for (const file of [...kinds, { name: "any", bytes: buffer }]) {
    const { files, clipCount } = await openDialogue([file]);
    assert.equal(clipCount, 12, String(file));
    assert.equal(files[0].name, file.name ?? (ArrayBuffer.isView(file) || file === buffer ? "files[0]" : String(file)));
  }
  await refused([`${http}missing`], `${http}missing`, undefined);
  await refused(["missing.lipzbank"], "missing.lipzbank", undefined);
  server.close();
  server.closeAllConnections();
});

test("the module can be given: as bytes, compiled, or as a path", async () => {
  const url = new URL("../lipz.wasm", import.meta.url);
  const bytes = await readFile(url);
  for (const wasm of [bytes, await WebAssembly.compile(bytes), url, fileURLToPath(url)]) {
    assert.equal((await openDialogue([golden("small.lipzbank")], { wasm })).clipCount, 12);
  }
  await refused([golden("small.lipzbank")], "missing.wasm", undefined, { wasm: "missing.wasm" });
});

test("a set answers as the one bank, and loads what is asked for", async () => {
  const whole = await openDialogue([golden("dubbed.lipzbank")]);
  const loaded = [];
  const load = (fileName) => (loaded.push(fileName), readFile(inSet(fileName)));
  const set = await openDialogue([await readFile(inSet(INDEX))], { load });
  assert.deepEqual(kinds(set), ["set", "bank", "absent"]);
  assert.deepEqual(loaded, [FIRST], "the first bank has locales and profiles");
  assert.equal(set.clipCount, whole.clipCount);
  assert.deepEqual(tags(set.locales), tags(whole.locales));
  const locale = set.locale("en-us");
  assert.throws(() => set.clip("aye"), (error) => {
    assert.deepEqual([error.name, error.file, error.status], ["LipzError", OTHER, 261]);
    return /loadClip/.test(error.remedy);
  });
  const [aye, again] = await Promise.all([set.loadClip("aye"), set.loadClip("aye")]);
  assert.deepEqual([aye.key, again.key], ["aye", "aye"]);
  assert.deepEqual(loaded, SHARDS, "each bank is loaded once");
  assert.deepEqual(keys(set).sort(), keys(whole).sort());
  for (const clip of whole.clips()) {
    for (const asked of [clip.key, clip.id]) {
      const found = set.clip(asked);
      assert.deepEqual([found.key, found.frames], [clip.key, clip.frames]);
      assert.deepEqual(found.segment(0).text(locale), clip.segment(0).text(whole.locale("en-us")), "a handle from before");
      const played = [[set, found], [whole, clip]].map(([from, clip]) => clip.inVoice(from.voice("de-de")));
      assert.deepEqual([played[0].clip.key, played[0].spoken], [played[1].clip.key, played[1].spoken]);
    }
  }
  assert.equal(await set.loadClip("nobody"), undefined);
  assert.equal(set.clip("nobody"), undefined);
  assert.deepEqual(set.voices.map(({ tag }) => tag), whole.voices.map(({ tag }) => tag));
});

test("the banks of a set are next to its index, or in the list", async () => {
  for (const index of [inSet(INDEX), fileURLToPath(inSet(INDEX))]) {
    const set = await openDialogue([index]);
    assert.equal((await set.loadClip("aye")).key, "aye");
    assert.ok(set.files[2].name.endsWith(OTHER) && set.files[2].kind === "bank", set.files[2].name);
  }
  const bytes = await Promise.all([INDEX, ...SHARDS].map((name) => readFile(inSet(name))));
  const [index, first, other] = [INDEX, ...SHARDS].map((name, at) => ({ name: `banks/${name}`, bytes: bytes[at] }));
  const listed = await openDialogue([index, other, first]);
  assert.deepEqual(kinds(listed), ["set", "bank", "bank"]);
  assert.equal(listed.clip("aye").key, "aye");
  await refused([index], FIRST, undefined);
  const partly = await openDialogue([index, first]);
  await assert.rejects(partly.loadClip("aye"), (error) => error.file === OTHER && /load/.test(error.remedy));
  await partly.loadAll().then(assert.fail, (error) => assert.equal(error.file, OTHER));
  const all = await openDialogue([inSet(INDEX)]);
  await all.loadAll();
  assert.deepEqual([all.clips().length, kinds(all)], [all.clipCount, ["set", "bank", "bank"]]);
  await all.loadAll();
});

test("a dialogue without a set has all its clips at once", async () => {
  const dialogue = await openDialogue([golden("small.lipzbank")]);
  assert.equal((await dialogue.loadClip("act1/blair")).key, "act1/blair");
  assert.equal(await dialogue.loadClip("nobody"), undefined);
  await dialogue.loadAll();
});

test("banks that are not those of the index are refused, and loaded again", async () => {
  const index = await readFile(inSet(INDEX));
  const damaged = Uint8Array.from(index);
  damaged[100] ^= 1;
  const load = (name) => readFile(inSet(name));
  for (const verify of [true, false]) {
    const isDamage = (error) => error instanceof LipzError && error.offsetBytes === 8;
    await assert.rejects(openDialogue([damaged], { load, verify }), isDamage);
  }
  let answer = () => load(FIRST);
  const set = await openDialogue([index], { load: (name) => (name === OTHER ? answer() : load(name)) });
  const isRefused = (status) =>
    assert.rejects(set.loadClip("aye"), (error) => error.file === OTHER && error.status === status);
  await isRefused(44);
  answer = async () => {
    const [own, forged] = await Promise.all([load(OTHER), load(FIRST)]);
    own.copy(forged, 8, 8, 16);
    return forged;
  };
  await isRefused(12);
  answer = () => Promise.reject(new Error("no network"));
  await isRefused(undefined);
  answer = () => new ArrayBuffer(0);
  await isRefused(1);
  answer = () => load(OTHER);
  assert.equal((await set.loadClip("aye")).key, "aye");
  await refused([{ name: INDEX, bytes: index }], FIRST, 44, { load: () => load(OTHER) });
  const unverified = await openDialogue([index], { verify: false, load: () => load(FIRST) });
  await assert.rejects(unverified.loadClip("aye"), (error) => error.file === OTHER && error.status === 44);
  // The URLs of banks in a list may have a query, and may encode any character.
  const urls = [inSet(INDEX), ...SHARDS.map((name) => new URL(`${String(inSet(name)).replace(/k$/, "%6B")}?v=2`))];
  assert.equal((await openDialogue(urls)).clip("aye").key, "aye");
});
