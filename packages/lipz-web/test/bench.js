// Measures the built package in node: node --expose-gc --min-semi-space-size=128 target/web/test/bench.js
//
// A query is the viseme at a time. A tick is a rendered frame: the cursor advances, and the weights of a rig move the
// shapes of a model. Times are the least of several rounds, because other programs disturb the rest. Bytes are the most
// of them, because node may collect garbage during a round, unless the options give it enough memory.

import { readFile } from "node:fs/promises";
import { openDialogue, rig } from "../node.js";

const ROUNDS = 7;
const QUERIES = 200_000;
const TICKS = 20_000;
const OPENINGS = 20;
const FRAME_SECONDS = 1 / 60;

/** Nanoseconds and bytes for each call of a function, which gets the number of the call. */
function measured(count, call) {
  const rounds = Array.from({ length: ROUNDS }, () => {
    globalThis.gc?.();
    const { heapUsed } = process.memoryUsage();
    const start = process.hrtime.bigint();
    for (let index = 0; index < count; index++) call(index);
    const ns = Number(process.hrtime.bigint() - start) / count;
    return { ns, bytes: (process.memoryUsage().heapUsed - heapUsed) / count };
  });
  const all = (of) => rounds.map((round) => round[of]);
  return { ns: Math.round(Math.min(...all("ns"))), bytes: Math.round(Math.max(...all("bytes"))) };
}

/** Microseconds to open a bank whose module is compiled. */
async function opening(bytes) {
  let least = Infinity;
  for (let index = 0; index < OPENINGS; index++) {
    const start = performance.now();
    await openDialogue([bytes]);
    least = Math.min(least, performance.now() - start);
  }
  return Math.round(least * 1000);
}

const bytes = await readFile(new URL("banks/drama.lipzbank", import.meta.url));
const drama = (await openDialogue([bytes])).clip("act1/mara-good-evening");
const rigs = await openDialogue([new URL("banks/rigs.lipzbank", import.meta.url)]);
const line = rigs.clip("english");
const weights = rigs.rig("arkit");
const shapes = rig(weights.weightNames, weights);
const settings = { out: new Float32Array(weights.weightNames.length) };
const influences = new Float32Array(weights.weightNames.length);
const cursor = line.cursor();

const length = drama.duration;
const query = measured(QUERIES, (index) => drama.visemeAt((index * FRAME_SECONDS) % length));
const duration = line.duration;
const tick = measured(TICKS, (index) => {
  const seconds = (index * FRAME_SECONDS) % duration;
  if (seconds < FRAME_SECONDS) cursor.seek(seconds);
  cursor.advanceTo(seconds);
  shapes.apply(line.weightsAt(seconds, weights, settings), influences);
});
const openUs = await opening(bytes);
console.log(`web: query ${query.ns} ns, tick ${tick.ns} ns, open ${openUs} us, bytes per tick ${tick.bytes}`);
