// The package in node, on the drama of the fixtures; and its structs against the header of C.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { LipzError, open } from "../lipz.js";
import { byCodePoints } from "../order.js";
import * as structs from "../structs.js";

const bytes = await readFile(new URL("../demo/dialogue.lipzbank", import.meta.url));
const KEY = "act1/mara-good-evening";

test("a bank tells its clips and locales", async () => {
  const bank = (await open(bytes)).verify();
  assert.equal(bank.clipCount, 48);
  assert.equal(bank.locales.length, 12);
  assert.equal(bank.defaultLocale, "en-us");
  const keys = bank.clips().map((clip) => clip.key);
  assert.equal(keys.length, 48);
  assert.ok(keys.includes(KEY));
});

test("clips are in the order of their keys by code points", async () => {
  const keys = (await open(bytes)).clips().map((clip) => clip.key);
  const inUtf8 = (key) => Buffer.from(key, "utf8");
  const byBytes = (a, b) => Buffer.compare(inUtf8(a), inUtf8(b));
  assert.deepEqual(keys, [...keys].sort(byBytes));
  const characters = ["", "a", "z", "é", "灯", "\ud7ff", "\ue000", "\uff01", "\u{10000}", "\u{1f600}", "\u{1f601}", "\u{10ffff}"];
  for (const a of characters) {
    for (const b of characters) {
      for (const [left, right] of [[a, b], [`a${a}`, `a${b}`], [`${a}x`, `${b}x`], [`\u{1f600}${a}`, `\u{1f600}${b}`]]) {
        assert.equal(Math.sign(byCodePoints(left, right)), byBytes(left, right), `${left} and ${right}`);
      }
    }
  }
});

test("a clip has the frames of its Lipz file", async () => {
  const clip = (await open(bytes)).clip(KEY);
  assert.equal(clip.id, 0x6ce303e9277896dbn);
  assert.equal(clip.frames.slice(0, 8), "SOOOOSEE");
  assert.deepEqual(clip.fps, { numerator: 24, denominator: 1 });
  assert.equal(clip.visemeType, "blair");
  assert.equal(clip.duration, Math.ceil((clip.frameCount * 1e6) / 24) / 1e6);
  assert.equal(clip.segments.length, 3);
  assert.equal(clip.segment(3), undefined);
});

test("all units of time lead to the same frame", async () => {
  const clip = (await open(bytes)).clip(KEY);
  for (let frame = 0; frame < clip.frameCount; frame++) {
    const times = [frame / 24, { us: Math.ceil((frame * 1e6) / 24) }, { position: frame * 2000, rateHz: 48000 }];
    for (const time of times) {
      assert.equal(clip.frameAt(time), frame);
      assert.equal(clip.visemeAt(time), clip.frames[frame]);
      assert.equal(clip.viseme(frame), clip.frames[frame]);
    }
  }
  for (const time of [-1, 1e9, NaN, Infinity, { us: -1n }, { position: 5, rateHz: 0 }]) {
    assert.equal(clip.frameAt(time), undefined);
    assert.equal(clip.visemeAt(time), "-");
    assert.equal(clip.segmentAt(time), undefined);
  }
});

test("a clip knows the recording that it was made for", async () => {
  const bank = (await open(await readFile(new URL("banks/recorded.lipzbank", import.meta.url)))).verify();
  assert.deepEqual(bank.clip("aye").recording, { duration: 0.083375, contentHash: 0x77581a3b3eea67ddn });
  assert.deepEqual(bank.clip("empty").recording, { duration: 0, contentHash: 0x9336724e82b4b8d6n });
  assert.equal(bank.clip("silent").recording, undefined);
  assert.equal((await open(bytes)).clip(KEY).recording, undefined);
});

test("a clip is played in the voice that is asked for", async () => {
  const bank = (await open(await readFile(new URL("banks/dubbed.lipzbank", import.meta.url)))).verify();
  assert.deepEqual(bank.voices, ["en-us", "de-at", "de-de"]);
  const played = (key, tag) => {
    const voiced = bank.clip(key).inVoice(tag);
    return voiced && [voiced.clip.key, voiced.clip.voice, voiced.spoken, voiced.clip.segmentAt(0).text("en-us").text];
  };
  for (const asked of ["aye", "de/aye"]) {
    assert.deepEqual(played(asked, "en-us"), ["aye", "en-us", "original", "Aye!"]);
    assert.deepEqual(played(asked, "de-de"), ["de/aye", "de-de", "dub", "Aye!"]);
    assert.deepEqual(played(asked, "de-at"), ["de/aye", "de-de", "other-dub", "Aye!"]);
  }
  assert.deepEqual(played("no", "de-de"), ["no", "en-us", "original", "No."]);
  assert.equal(played("no", "fr-fr"), undefined);
  const without = await open(bytes);
  assert.deepEqual([without.voices, without.clip(KEY).voice, without.clip(KEY).inVoice("de-de")], [[], undefined, undefined]);
});

test("a segment has its text in every locale, and its events", async () => {
  const segment = (await open(bytes)).clip(KEY).segmentAt(1.6);
  assert.equal(segment.index, 1);
  assert.deepEqual(segment.text("de-de"), { text: "Du bist spät dran,", isFallback: false });
  assert.deepEqual(segment.text("ja-jp"), { text: "あんたは遅刻、", isFallback: false });
  assert.equal(segment.text("tlh"), undefined);
  assert.equal(segment.event, "sees otto");
  assert.deepEqual(segment.events, [{ character: undefined, verb: "sees", object: "otto" }]);
});

test("a text of another locale is marked", async () => {
  const segment = (await open(bytes)).clip("act2/otto-eyes").segment(0);
  assert.equal(segment.text("en-us").isFallback, false);
  assert.deepEqual(segment.text("de-de"), { ...segment.text("en-us"), isFallback: true });
});

test("a frame rate is supplied where there is none", async () => {
  const clip = (await open(bytes)).clip("act1/admiral-tick");
  assert.equal(clip.fps, undefined);
  assert.equal(clip.duration, undefined);
  assert.equal(clip.orFps(12).frameAt(0.25), 3);
});

test("damage is an error with a status and a place", async () => {
  const damaged = Uint8Array.from(bytes);
  damaged[damaged.length - 1] ^= 1;
  const bank = await open(damaged);
  assert.throws(() => bank.verify(), (error) => error instanceof LipzError && error.status === 12 && error.offsetBytes === 8);
  await assert.rejects(open(bytes.subarray(0, 100)), LipzError);
  await assert.rejects(open(new ArrayBuffer(0)), LipzError);
});

test("a text bank has the texts of its bank, and of no other", async () => {
  const golden = (name) => readFile(new URL(`banks/${name}`, import.meta.url));
  const bank = (await open(await golden("split.lipzbank"))).verify();
  assert.deepEqual(bank.locales, []);
  bank.useTexts(await golden("split.de-de.lipztexts")).verify();
  assert.deepEqual(bank.locales, ["de-de"]);
  const segment = bank.clip("act1/toonboom").segment(0);
  assert.equal(segment.text("de-de").text, "Nur");
  bank.useTexts(await golden("split.en-us.lipztexts"));
  assert.deepEqual([bank.locales, segment.text("de-de")], [["en-us"], undefined]);
  const other = await open(bytes);
  assert.throws(() => other.useTexts(new Uint8Array(10)), LipzError);
  const texts = await golden("split.de-de.lipztexts");
  assert.throws(() => other.useTexts(texts), (error) => error instanceof LipzError && error.status === 28);
  assert.equal(other.locales.length, 12, "the bank is as it was");
});

test("a cursor gives events once, and shows mouth and segment", async () => {
  const bank = await open(bytes);
  const cursor = bank.clip("act1/otto-ticking").cursor({ speaker: "otto", lead: { frames: 1 }, hold: "readable" });
  assert.deepEqual([cursor.frame, cursor.isOver, cursor.lead, cursor.hold], [undefined, false, 0.041667, 2]);
  const due = cursor.advanceTo(0);
  assert.deepEqual(due.events[0], { character: "otto", verb: "does", object: "jump" });
  assert.deepEqual(due.events, due.events, "asked again");
  assert.deepEqual(due.segments.map((segment) => segment.index), [0, 1]);
  assert.deepEqual(cursor.advanceTo(0.1).events, []);
  assert.deepEqual([cursor.frame, cursor.viseme, cursor.segment.text("de-de").text], [2, "S", "Es tickt nicht."]);
  assert.equal(cursor.state().feels, "afraid");
  assert.deepEqual(cursor.state("nell"), { name: "nell", feels: undefined, staresAt: "otto", pointsAt: undefined });
  assert.deepEqual(cursor.state("nobody"), { name: "nobody", feels: undefined, staresAt: undefined, pointsAt: undefined });
  assert.deepEqual(due.events.length, 3, "what was due then");
  cursor.seek(1000);
  assert.deepEqual([cursor.isOver, cursor.viseme, cursor.segment], [true, "-", undefined]);
});

test("a cursor needs a frame rate, and says so", async () => {
  const clip = (await open(bytes)).clip("act1/admiral-tick");
  assert.throws(() => clip.cursor(), /frame rate/);
  assert.equal(clip.orFps(12).cursor({ hold: { picture: 0.25 } }).hold, 3);
  assert.throws(() => clip.orFps(12).cursor({ lead: { frames: 3 } }), RangeError);
});

test("a mouth is open as far as its shape, and babbles without one", async () => {
  const bank = await open(bytes);
  const clip = bank.clip(KEY);
  assert.deepEqual([clip.opennessAt(0), clip.opennessAt(0.05), clip.opennessAt(1000)], [0.33, 0.66, 0]);
  assert.deepEqual(bank.defaultBabble.at(0.25, 0.8), { ooh: 0.7744, aah: 0.5929 });
  assert.deepEqual(bank.defaultBabble.at({ us: 250_000n }), { ooh: 0.7744, aah: 0.5082 });
  assert.equal(bank.babble("robot"), undefined);
  assert.equal(bank.defaultBabble.name, "default");
});

test("views into larger buffers are opened as what they show", async () => {
  const larger = new Uint8Array(bytes.length + 10);
  larger.set(bytes, 5);
  const bank = await open(larger.subarray(5, 5 + bytes.length));
  assert.equal(bank.verify().clipCount, 48);
});

test("keys of any length and alphabet can be asked for", async () => {
  const bank = await open(bytes);
  assert.equal(bank.clip("灯台".repeat(50_000)), undefined);
  assert.equal(bank.clip(""), undefined);
  assert.equal(bank.clip(KEY).key, KEY);
});

test("the package has the version of the library", async () => {
  const header = await readFile(new URL("lipz.h", import.meta.url), "utf8");
  const { version } = JSON.parse(await readFile(new URL("../package.json", import.meta.url), "utf8"));
  const numbers = ["MAJOR", "MINOR", "PATCH"].map((part) => header.match(`LIPZ_VERSION_${part} (\\d+)`)[1]);
  assert.equal(version, numbers.join("."));
});

test("structs.js has the structs of lipz.h, field by field", async () => {
  const header = await readFile(new URL("lipz.h", import.meta.url), "utf8");
  const names = { size_t: "u32", int32_t: "i32", uint32_t: "u32", uint64_t: "u64", "const char *": "pointer", "const uint8_t *": "pointer" };
  const declared = Array.from(header.matchAll(/^typedef struct (\w+) \{\n([^}]*)\}/gm));
  assert.equal(declared.length, Object.values(structs).filter((type) => type.fields).length);
  for (const [, name, body] of declared) {
    const fields = Array.from(body.matchAll(/^ {2}(?:struct )?(\w[\w ]*?\*|\w+) ?(\w+)(?:\[(\w+)\])?;$/gm));
    assert.deepEqual(Object.keys(structs[name].fields), fields.map(([, , field]) => field), name);
    for (const [, type, field, count] of fields) {
      const found = structs[name].fields[field];
      const length = count && Number(header.match(new RegExp(`#define ${count} (\\d+)`))[1]);
      assert.equal(found.length, length, `${name}.${field}[${count}]`);
      assert.equal(count ? found.of : found, structs[names[type] ?? type], `${name}.${field}: ${type}`);
    }
  }
});
