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
  const names = { size_t: "u32", uint32_t: "u32", uint64_t: "u64", "const char *": "pointer", "const uint8_t *": "pointer" };
  const declared = Array.from(header.matchAll(/^typedef struct (\w+) \{\n([^}]*)\}/gm));
  assert.equal(declared.length, Object.values(structs).filter((type) => type.fields).length);
  for (const [, name, body] of declared) {
    const fields = Array.from(body.matchAll(/^ {2}(?:struct )?(\w[\w ]*?\*|\w+) ?(\w+);$/gm));
    assert.deepEqual(Object.keys(structs[name].fields), fields.map(([, , field]) => field), name);
    for (const [, type, field] of fields) {
      assert.equal(structs[name].fields[field], structs[names[type] ?? type], `${name}.${field}: ${type}`);
    }
  }
});
