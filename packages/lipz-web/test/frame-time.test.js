// Frames at times: the estimate with doubles, and the module where it cannot decide, against integers of any length.

import assert from "node:assert/strict";
import { test } from "node:test";
import { estimatedFrame, rateOf } from "../frame-time.js";
import { openDialogue } from "../node.js";

const RATES = [[24, 1], [60, 1], [30000, 1001], [24000, 1001], [25, 2], [1, 1], [1000, 1], [999_999_937, 1_000_003]];
const dialogue = await openDialogue([new URL("banks/small.lipzbank", import.meta.url)]);
/** A clip without a frame rate, so that it takes any. */
const unspecified = dialogue.clip("act2/unspecified");

/** A double as a fraction, in the way of the module: two units in the last place later. */
function fractionOf(seconds) {
  const view = new DataView(new ArrayBuffer(8));
  view.setFloat64(0, seconds);
  const bits = view.getBigUint64(0);
  const [exponent, digits] = [Number(bits >> 52n), bits & ((1n << 52n) - 1n)];
  const mantissa = (exponent > 0 ? digits | (1n << 52n) : digits) + 2n;
  const shift = 1075 - Math.max(exponent, 1);
  return shift > 0 ? [mantissa, 1n << BigInt(shift)] : [mantissa << BigInt(-shift), 1n];
}

/** The frame at a time in exact arithmetic, in a clip without end. */
function exactFrame(time, [numerator, denominator]) {
  let [count, perSecond] = [time.us ?? time.position, time.rateHz ?? 1e6];
  if (typeof time === "number") [count, perSecond] = fractionOf(time);
  return Number((BigInt(count) * BigInt(numerator)) / (BigInt(perSecond) * BigInt(denominator)));
}

/** The next doubles above and below a time, and the time itself. */
function* around(seconds) {
  yield seconds;
  const view = new DataView(new ArrayBuffer(8));
  for (const step of [-3n, -2n, -1n, 1n, 2n, 3n]) {
    view.setFloat64(0, seconds);
    view.setBigInt64(0, view.getBigInt64(0) + step);
    yield view.getFloat64(0);
  }
}

/** Times at and between the starts of frames. */
function* times([numerator, denominator]) {
  const frames = [0, 1, 2, 3, 7, 10, 59, 60, 1000, 123_457, 0.5, 1.25, 98.999];
  for (const frame of frames) {
    const start = (frame * denominator) / numerator;
    yield* start > 0 ? around(start) : [start];
    for (const step of [-1, 0, 1]) {
      yield { us: Math.max(0, Math.ceil(start * 1e6) + step) };
      for (const rateHz of [44_100, 48_000, 7]) yield { position: Math.max(0, Math.ceil(start * rateHz) + step), rateHz };
    }
  }
  yield* [5e-324, 1e-9, 1e9, { us: 2 ** 53 - 1 }, { position: 2 ** 53 - 1, rateHz: 48_000 }];
}

test("an estimate is the exact frame, or is left to the module", () => {
  let [decided, undecided] = [0, 0];
  for (const rate of RATES) {
    for (const time of times(rate)) {
      const frame = estimatedFrame(time, rateOf(...rate));
      if (frame === undefined) {
        undecided += 1;
        continue;
      }
      decided += 1;
      assert.equal(frame, exactFrame(time, rate), `${JSON.stringify(time)} at ${rate}`);
    }
  }
  assert.ok(decided > 500 && undecided > 100, `${decided} and ${undecided}`);
});

test("a clip returns the exact frame for any time", () => {
  let inside = 0;
  for (const rate of RATES) {
    const clip = unspecified.orFps(...rate);
    for (const time of times(rate)) {
      const exact = exactFrame(time, rate);
      const frame = exact < clip.frameCount ? exact : undefined;
      inside += frame === undefined ? 0 : 1;
      assert.equal(clip.frameAt(time), frame, `${JSON.stringify(time)} at ${rate}`);
      assert.equal(clip.visemeAt(time), clip.frames[frame] ?? "-");
    }
  }
  assert.ok(inside > 300, inside);
});

test("times outside a clip, and invalid rates", () => {
  const clip = unspecified.orFps(24);
  for (const time of [-1, -1e-9, NaN, Infinity, -Infinity, { us: -1 }, { position: 5, rateHz: 0 }]) {
    assert.equal(clip.frameAt(time), undefined, JSON.stringify(time));
    assert.equal(clip.visemeAt(time), "-");
  }
  assert.ok(Object.is(clip.frameAt({ us: 0 }), 0));
  assert.equal(clip.frameAt({ us: 50_000n }), 1);
  assert.equal(clip.frameAt({ position: 4800, rateHz: 48_000.5 }), 2, "the module rounds rates down");
  assert.throws(() => clip.frameAt({ us: 0.5 }), RangeError);
  for (const rate of [[0, 1], [24, 0], [1, 2], [2000, 1]]) {
    assert.equal(unspecified.orFps(...rate).frameAt(0.1), undefined);
  }
  for (const frame of [-1, clip.frameCount, 2 ** 32, NaN, undefined]) assert.equal(clip.viseme(frame), "-");
});

test("files that are loaded later do not move the frames", async () => {
  const set = await openDialogue([new URL("sets/dubbed.lipzset", import.meta.url)]);
  const [clip] = set.clips();
  const before = Array.from(clip.frames, (_, frame) => clip.viseme(frame)).join("");
  await set.loadAll();
  assert.equal(Array.from(before, (_, frame) => clip.viseme(frame)).join(""), clip.frames);
  assert.ok(before.length > 0);
});
