// The package in node, with the drama of the fixtures; and its structs compared with the C header.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { EMOTIONS, LipzError, openDialogue } from "../node.js";
import { REMEDIES } from "../error.js";
import { Memory } from "../memory.js";
import * as structs from "../structs.js";

const bytes = await readFile(new URL("../demo/dialogue.lipzbank", import.meta.url));
const golden = (name) => new URL(`banks/${name}`, import.meta.url);
const drama = await openDialogue([bytes]);
const KEY = "act1/mara-good-evening";

test("a dialogue has clips and locales", () => {
  assert.equal(drama.clipCount, 48);
  assert.equal(drama.locales.length, 12);
  assert.equal(drama.defaultLocale.tag, "en-us");
  assert.deepEqual([drama.locale("en-us").isDefault, drama.locale("de-de").isDefault], [true, false]);
  assert.equal(drama.locale("tlh"), undefined);
  const keys = drama.clips().map((clip) => clip.key);
  assert.equal(keys.length, 48);
  assert.ok(keys.includes(KEY));
  assert.equal(drama.clip(KEY).key, drama.clip(drama.clip(KEY).id).key);
  assert.equal(drama.clip(1n), undefined);
});

test("clips are in the order of their keys by code points", () => {
  const keys = drama.clips().map((clip) => clip.key);
  const byBytes = (a, b) => Buffer.compare(Buffer.from(a, "utf8"), Buffer.from(b, "utf8"));
  assert.deepEqual(keys, [...keys].sort(byBytes));
  const under = drama.clipsUnder("act2/").map((clip) => clip.key);
  assert.deepEqual(under, keys.filter((key) => key.startsWith("act2/")));
  assert.ok(under.length > 0);
  assert.deepEqual(drama.clipsUnder("act9/"), []);
  const counts = [drama.clips(), drama.clips()].map((clips) => clips.length);
  assert.deepEqual(counts, [48, 48], "also when they are asked for twice in a row");
});

test("a clip has the frames of its Lipz file", async () => {
  const clip = drama.clip(KEY);
  assert.equal(clip.id, 0x6ce303e9277896dbn);
  assert.equal(clip.frames.slice(0, 8), "SOOOOSEE");
  assert.deepEqual(clip.fps, { numerator: 24, denominator: 1 });
  assert.equal(clip.visemeType, "blair");
  assert.equal(clip.duration, Math.ceil((clip.frameCount * 1e6) / 24) / 1e6);
  assert.equal(clip.segments.length, 3);
  assert.equal(clip.segment(3), undefined);
});

test("all units of time lead to the same frame", async () => {
  const clip = drama.clip(KEY);
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
  const recorded = await openDialogue([golden("recorded.lipzbank")]);
  assert.deepEqual(recorded.clip("aye").recording, { duration: 0.083375, contentHash: 0x77581a3b3eea67ddn });
  assert.deepEqual(recorded.clip("empty").recording, { duration: 0, contentHash: 0x9336724e82b4b8d6n });
  assert.equal(recorded.clip("silent").recording, undefined);
  assert.equal(drama.clip(KEY).recording, undefined);
});

test("a clip is played in the voice that is asked for", async () => {
  const dubbed = await openDialogue([golden("dubbed.lipzbank")]);
  const english = dubbed.locale("en-us");
  assert.deepEqual(dubbed.voices.map(({ tag }) => tag), ["en-us", "de-at", "de-de"]);
  assert.deepEqual(dubbed.voices.map(({ isOriginal }) => isOriginal), [true, false, false]);
  const played = (key, tag) => {
    const { clip, spoken } = dubbed.clip(key).inVoice(dubbed.voice(tag));
    return [clip.key, clip.voice.tag, spoken, clip.segmentAt(0).text(english).text];
  };
  for (const asked of ["aye", "de/aye"]) {
    assert.deepEqual(played(asked, "en-us"), ["aye", "en-us", "original", "Aye!"]);
    assert.deepEqual(played(asked, "de-de"), ["de/aye", "de-de", "dub", "Aye!"]);
    assert.deepEqual(played(asked, "de-at"), ["de/aye", "de-de", "other-dub", "Aye!"]);
  }
  assert.deepEqual(played("no", "de-de"), ["no", "en-us", "original", "No."]);
  assert.equal(dubbed.voice("fr-fr"), undefined);
  assert.throws(() => dubbed.clip("aye").inVoice("de-de"), { name: "TypeError", message: /dialogue.voice\(tag\)/ });
  assert.deepEqual([drama.voices, drama.voice("de-de"), drama.clip(KEY).voice], [[], undefined, undefined]);
});

test("a segment has its text in every locale, and its events", async () => {
  const segment = drama.clip(KEY).segmentAt(1.6);
  assert.equal(segment.index, 1);
  assert.deepEqual(segment.text(drama.locale("de-de")), { text: "Du bist spät dran,", isFallback: false });
  assert.deepEqual(segment.text(drama.locale("ja-jp")), { text: "あんたは遅刻、", isFallback: false });
  assert.equal(segment.text(drama.locale("tlh")), undefined);
  assert.equal(segment.event, "sees otto");
  assert.deepEqual(segment.events, [{ character: undefined, verb: "sees", object: "otto", strength: undefined }]);
});

test("a text of another locale is marked", async () => {
  const segment = drama.clip("act2/otto-eyes").segment(0);
  assert.equal(segment.text(drama.locale("en-us")).isFallback, false);
  assert.deepEqual(segment.text(drama.locale("de-de")), { ...segment.text(drama.locale("en-us")), isFallback: true });
});

test("a frame rate is supplied where there is none", async () => {
  const clip = drama.clip("act1/admiral-tick");
  assert.equal(clip.fps, undefined);
  assert.equal(clip.duration, undefined);
  assert.equal(clip.orFps(12).frameAt(0.25), 3);
});

test("a locale is looked up, and is that of its dialogue", async () => {
  const segment = drama.clip(KEY).segmentAt(1.6);
  assert.equal(segment.text(undefined), undefined);
  assert.throws(() => segment.text("de-de"), { name: "TypeError", message: /de-de.*dialogue.locale\(tag\)/ });
  const other = await openDialogue([golden("small.lipzbank")]);
  assert.equal(segment.text(other.locale("de-de")), undefined);
});

test("gestures have a strength", async () => {
  const { segments } = (await openDialogue([golden("specials.lipzbank")])).clip("listens");
  const [first, second] = segments.map(({ events }) => events);
  assert.deepEqual(first[0], { character: "mara", verb: "nods", object: undefined, strength: 6 });
  assert.deepEqual(second[0], { character: "mara", verb: "looks away", object: undefined, strength: undefined });
});

test("a cursor gives events once, and shows mouth and segment", async () => {
  const cursor = drama.clip("act1/otto-ticking").cursor({ speaker: "otto", lead: { frames: 1 }, hold: "readable" });
  assert.deepEqual([cursor.frame, cursor.isOver, cursor.lead, cursor.hold], [undefined, false, 0.041667, 2]);
  const due = cursor.advanceTo(0);
  assert.deepEqual(due.events[0], { character: "otto", verb: "does", object: "jump", strength: undefined });
  assert.deepEqual(due.events, due.events, "asked again");
  assert.deepEqual(due.segments.map((segment) => segment.index), [0, 1]);
  assert.deepEqual(cursor.advanceTo(0.1).events, []);
  assert.deepEqual([cursor.frame, cursor.viseme, cursor.segment.text(drama.locale("de-de")).text], [2, "S", "Es tickt nicht."]);
  assert.equal(cursor.state().feels, "afraid");
  assert.deepEqual(cursor.state("nell"), { name: "nell", feels: undefined, staresAt: "otto", pointsAt: undefined });
  assert.deepEqual(cursor.state("nobody"), { name: "nobody", feels: undefined, staresAt: undefined, pointsAt: undefined });
  assert.deepEqual(due.events.length, 3, "what was due then");
  cursor.seek(1000);
  assert.deepEqual([cursor.isOver, cursor.viseme, cursor.segment], [true, "-", undefined]);
});

test("a cursor needs a frame rate, and says so", async () => {
  const clip = drama.clip("act1/admiral-tick");
  assert.throws(() => clip.cursor(), /frame rate/);
  assert.equal(clip.orFps(12).cursor({ hold: { renderedFrame: 0.25 } }).hold, 3);
  assert.throws(() => clip.orFps(12).cursor({ lead: { frames: 3 } }), RangeError);
});

test("a mouth is open as far as its shape, and babbles without one", async () => {
  const clip = drama.clip(KEY);
  assert.deepEqual([clip.opennessAt(0), clip.opennessAt(0.05), clip.opennessAt(1000)], [0.33, 0.66, 0]);
  assert.deepEqual(drama.defaultBabble.at(0.25, 0.8), { ooh: 0.7744, aah: 0.5929 });
  assert.deepEqual(drama.defaultBabble.at({ us: 250_000n }), { ooh: 0.7744, aah: 0.5082 });
  assert.equal(drama.babble("robot"), undefined);
  assert.equal(drama.defaultBabble.name, "default");
});

test("views into larger buffers are opened as what they show", async () => {
  const larger = new Uint8Array(bytes.length + 10);
  larger.set(bytes, 5);
  assert.equal((await openDialogue([larger.subarray(5, 5 + bytes.length)])).clipCount, 48);
});

test("keys of any length and alphabet can be asked for", () => {
  assert.equal(drama.clip("灯台".repeat(50_000)), undefined);
  assert.equal(drama.clip(""), undefined);
  assert.equal(drama.clip(KEY).key, KEY);
});

test("the package has the version of the library", async () => {
  const header = await readFile(new URL("lipz.h", import.meta.url), "utf8");
  const { version } = JSON.parse(await readFile(new URL("../package.json", import.meta.url), "utf8"));
  const numbers = ["MAJOR", "MINOR", "PATCH"].map((part) => header.match(`LIPZ_VERSION_${part} (\\d+)`)[1]);
  assert.equal(version, numbers.join("."));
});

test("structs.js has the structs of lipz.h, field by field", async () => {
  const header = await readFile(new URL("lipz.h", import.meta.url), "utf8");
  const numbers = { size_t: "u32", int32_t: "i32", int64_t: "i64", uint16_t: "u16", uint32_t: "u32", uint64_t: "u64", double: "f64" };
  const names = { ...numbers, "const char *": "pointer", "const uint8_t *": "pointer" };
  const declared = Array.from(header.matchAll(/^typedef struct \{\n([^}]*)\} (\w+);/gm));
  assert.equal(declared.length, Object.values(structs).filter((type) => type.fields).length);
  for (const [, body, name] of declared) {
    const fields = Array.from(body.matchAll(/^ {2}(\w[\w ]*?\*|\w+) ?(\w+)(?:\[(\w+)\])?;$/gm));
    assert.deepEqual(Object.keys(structs[name].fields), fields.map(([, , field]) => field), name);
    assert.equal(fields.length, Array.from(body.matchAll(/;$/gm)).length, name);
    for (const [, type, field, count] of fields) {
      const found = structs[name].fields[field];
      const length = count && Number(header.match(new RegExp(`#define ${count} (\\d+)`))[1]);
      assert.equal(found.length, length, `${name}.${field}[${count}]`);
      assert.equal(count ? found.of : found, structs[names[type] ?? type], `${name}.${field}: ${type}`);
    }
  }
});

test("queries of a damaged bank that was not verified throw nothing but LipzErrors", async () => {
  const bank = await readFile(golden("dubbed.lipzbank"));
  const ask = (dialogue) => {
    const handles = [...dialogue.locales, ...dialogue.voices].map(({ tag }) => tag);
    for (const clip of dialogue.clips()) {
      const { key, frames, fps, duration, visemeType } = clip;
      handles.push(key, frames, fps, duration, visemeType, clip.visemeAt(0.1), ...clip.segments.map(({ events }) => events));
    }
    return handles;
  };
  let opened = 0;
  for (let at = 64; at + 4 <= bank.length; at += 4) {
    for (const word of [0, 7, 0xffffffff]) {
      const damaged = Uint8Array.from(bank);
      new DataView(damaged.buffer).setUint32(at, word, true);
      try {
        const dialogue = await openDialogue([damaged], { verify: false });
        opened++;
        ask(dialogue);
      } catch (error) {
        assert.ok(error instanceof LipzError, `word ${at}: ${error.stack}`);
      }
    }
  }
  assert.ok(opened > 100, opened);
});

test("remedies are those for the statuses of lipz.h", async () => {
  const header = await readFile(new URL("lipz.h", import.meta.url), "utf8");
  for (const [name, [status]] of Object.entries(REMEDIES)) {
    assert.equal(status, Number(header.match(`#define ${name} (\\d+)`)[1]), name);
  }
  assert.match(header, new RegExp(`#define LIPZ_EMOTION_COUNT ${EMOTIONS.length}\\n`));
});

test("the module has each function of lipz.h, with its parameters", async () => {
  const header = await readFile(new URL("lipz.h", import.meta.url), "utf8");
  const module = await WebAssembly.compile(await readFile(new URL("../lipz.wasm", import.meta.url)));
  const { exports } = await WebAssembly.instantiate(module);
  const declared = Array.from(header.matchAll(/^\w+ (lipz_\w+)\(([^)]*)\);/gm));
  assert.ok(declared.length > 40, declared.length);
  for (const [, name, parameters] of declared) {
    const count = parameters === "void" ? 0 : parameters.split(",").length;
    // A struct that is passed by value becomes one address.
    assert.equal(exports[name].length, count, name);
  }
  const called = Object.keys(exports).filter((name) => name.startsWith("lipz_"));
  assert.deepEqual(called.sort(), declared.map(([, name]) => name).sort());
});

test("no struct is too long for its slot", () => {
  const kept = ["lipz_dialogue", "lipz_file"];
  const passed = Object.entries(structs).filter(([name, type]) => type.fields && !kept.includes(name));
  for (const [name, { size }] of passed) assert.ok(size <= Memory.SLOT_BYTES, `${name}: ${size}`);
});
