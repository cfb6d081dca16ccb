// Measures the built package in node: node --expose-gc --min-semi-space-size=128 target/web/test/bench.js
//
// The questions are those of docs/inside/ports.md. Times are the least of several rounds, because other programs disturb
// the rest. Bytes are the most of them, because node may collect garbage during a round, unless the options give it
// enough memory.

import { readFile } from "node:fs/promises";
import { openDialogue, rig } from "../node.js";

const ROUNDS = 20;
const QUERIES = 200_000;
const TICKS = 20_000;
const OPENINGS = 20;
const FRAME_SECONDS = 1 / 60;
const CLIP_SECONDS = 4;
const SPOKEN_SECONDS = 1.4;

/** Prints nanoseconds and bytes for each call of a function, which gets the number of the call. */
function measure(name, count, call) {
  const rounds = Array.from({ length: ROUNDS }, () => {
    globalThis.gc?.();
    const { heapUsed } = process.memoryUsage();
    const start = process.hrtime.bigint();
    for (let index = 0; index < count; index++) call(index);
    const ns = Number(process.hrtime.bigint() - start) / count;
    return { ns, bytes: (process.memoryUsage().heapUsed - heapUsed) / count };
  });
  const all = (of) => rounds.map((round) => round[of]);
  console.log(`bench ${name}_ns ${Math.min(...all("ns")).toFixed(1)} JavaScript`);
  console.log(`bench ${name}_bytes ${Math.round(Math.max(...all("bytes")))} JavaScript`);
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

const bank = (name) => readFile(new URL(`banks/${name}.lipzbank`, import.meta.url));
const bytes = await bank("drama");
const drama = await openDialogue([bytes]);
const german = drama.locale("de-de");
const clip = drama.clip("act1/mara-good-evening");
measure("viseme", QUERIES, (index) => clip.visemeAt((index * FRAME_SECONDS) % CLIP_SECONDS));

const cursor = clip.cursor({ speaker: "mara" });
measure("tick", TICKS, (index) => {
  const seconds = (index * FRAME_SECONDS) % CLIP_SECONDS;
  if (seconds < FRAME_SECONDS) cursor.seek(seconds);
  const { events } = cursor.advanceTo(seconds);
  return [events, cursor.viseme, cursor.segment?.text(german)?.text];
});

const phones = await openDialogue([await bank("phones")]);
const spoken = phones.clip("spoken");
const weights = phones.rig("arkit");
const shapes = rig(weights.weightNames, weights);
const settings = { out: new Float32Array(weights.weightNames.length) };
const influences = new Float32Array(weights.weightNames.length);
measure("weights", TICKS, (index) => {
  const seconds = (index * FRAME_SECONDS) % SPOKEN_SECONDS;
  shapes.apply(spoken.weightsAt(seconds, weights, settings), influences);
});
console.log(`open: ${await opening(bytes)} us`);
