// The examples in Chromium: each engine shows different mouths for different phones. And TalkingHead's arrays.

import assert from "node:assert/strict";
import { cp, mkdir, rm, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { openDialogue } from "@lipz/reader";
import * as esbuild from "esbuild";
import { visemesOf } from "../examples/talkinghead/visemes.js";
import { SWIFTSHADER, reported } from "./chromium.js";
import { faceGlb, faceVrm } from "./model.js";
import { serveFolder } from "./server.js";

const TIMEOUT_MS = 240_000;
const ROOT = fileURLToPath(new URL("../", import.meta.url));
const BANK = join(ROOT, "banks/rigs.lipzbank");

const ENGINES = {
  three: ["main.js", "face.glb"],
  "react-three-fiber": ["main.jsx", "face.glb"],
  "three-vrm": ["main.js", "face.vrm"],
  babylon: ["main.js", "face.glb"],
  playcanvas: ["main.js", "face.glb"],
};
const CANVAS = '<canvas width="320" height="240"></canvas>';
const DIV = '<div style="width: 320px; height: 240px"></div>';

/** A program that passes an example to test/engines/page.js. That of React follows a clock instead of a call. */
const program = (name, file, model) => `
  import { speaker } from "../../examples/${name}/${file}";
  import { examine } from "../../test/page.js";
  ${
    name === "react-three-fiber"
      ? `examine("${model}", (element, files) => {
           let now = 0;
           speaker(element, files, () => now);
           return (seconds) => (now = seconds);
         });`
      : `examine("${model}", speaker);`
  }
`;

/** A folder with the bundled example, its page and its files. */
async function bundled(name, [file, model]) {
  const folder = join(ROOT, "bundles", `engine-${name}`);
  await rm(folder, { recursive: true, force: true });
  await mkdir(folder, { recursive: true });
  await writeFile(join(folder, "entry.js"), program(name, file, model));
  const element = file.endsWith("x") ? DIV : CANVAS;
  await writeFile(join(folder, "index.html"), `<!doctype html>${element}<script type="module" src="out.js"></script>`);
  await writeFile(join(folder, model), model.endsWith("vrm") ? faceVrm() : faceGlb());
  await cp(BANK, join(folder, "rigs.lipzbank"));
  await cp(join(ROOT, "node_modules/@lipz/reader/lipz.wasm"), join(folder, "lipz.wasm"));
  const { errors } = await esbuild.build({
    entryPoints: [join(folder, "entry.js")],
    outfile: join(folder, "out.js"),
    bundle: true,
    format: "esm",
    jsx: "automatic",
    define: { "process.env.NODE_ENV": '"production"' },
    logLevel: "silent",
  });
  assert.deepEqual(errors, []);
  return folder;
}

for (const [name, files] of Object.entries(ENGINES)) {
  test(`${name} shows the mouths of a line`, { timeout: TIMEOUT_MS }, async (t) => {
    const folder = await bundled(name, files);
    const listen = (post) => serveFolder(folder, post);
    const { error, mouths, open } = await reported(t, listen, "index.html", SWIFTSHADER);
    assert.equal(error, undefined);
    t.diagnostic(`${mouths} different mouths, ${JSON.stringify(open)}`);
    assert.ok(mouths >= 7, `${mouths} different mouths`);
    const { AA, B, IY, UW } = open;
    assert.ok(AA.high > 2 * B.high, "open for a vowel, closed for a plosive");
    assert.ok(UW.wide < 0.8 * IY.wide, "round and spread");
  });
}

test("TalkingHead gets the visemes of a line", async () => {
  const dialogue = await openDialogue([BANK]);
  const { visemes, vtimes, vdurations } = visemesOf(dialogue.clip("english"), dialogue.rig("ovr"));
  assert.deepEqual([vtimes.length, vdurations.length], [visemes.length, visemes.length]);
  assert.equal(new Set(visemes).size, 15, "each viseme has a phone that shows it");
  let end = 0;
  vtimes.forEach((start, index) => {
    assert.equal(start, end, "without gaps");
    end += vdurations[index];
  });
  assert.equal(end, Math.round(dialogue.clip("english").duration * 1000));
  const at = (ms) => visemes[vtimes.findLastIndex((start) => start <= ms)];
  // The start, and the middles of AA, B, F, IY, AO and TH.
  assert.deepEqual([0, 300, 2700, 5500, 7100, 1500, 12_700].map(at), ["sil", "aa", "PP", "FF", "I", "O", "TH"]);
});
