// Measures how soon `lipz preview` shows the first of 20,000 clips, with a cache from before, in Chromium: LIPZ names the
// command. `cargo xtask first-picture` runs it.

import { spawnSync } from "node:child_process";
import { performance } from "node:perf_hooks";
import { Browser } from "./browser.js";
import { Project } from "./project.js";

const CLIPS = 20_000;
const ROUNDS = 9;

const project = await Project.large(CLIPS);
await project.write("lipz.toml", 'sources = ["voices"]\noutput = "a.lipzbank"\ncache = "a.cache"\n');
const { status, stderr } = spawnSync(process.env.LIPZ, ["pack"], { cwd: project.folder, encoding: "utf8" });
if (status !== 0) throw new Error(stderr);
const browser = await Browser.start();
const rounds = [];
for (let round = 0; round < ROUNDS; round++) {
  const start = performance.now();
  const address = await project.preview();
  const served = performance.now();
  const page = await browser.open(address);
  await page.until("globalThis.preview");
  // Of the page's own clock: when its first clip was drawn, and when what it fetched had come.
  const own = await page.value(`preview.then(({ shown }) => {
    const parts = performance.getEntriesByType("resource").map(({ name, responseEnd }) => [name.split("/").at(-1), responseEnd]);
    return { shown, ...Object.fromEntries(parts) };
  })`);
  rounds.push({ "command to page": served - start, "list has come": own.clips, "bank has come": own.bank, "page asked to first picture": own.shown });
  await page.send("Page.close");
  project.process.removeAllListeners("exit").kill();
}
await browser.end();
await project.end();
const median = (values) => values.sort((a, b) => a - b)[Math.floor(values.length / 2)];
console.log(`${CLIPS.toLocaleString("en")} clips, median of ${ROUNDS} rounds (least, most), ms:`);
for (const name of Object.keys(rounds[0])) {
  const values = rounds.map((round) => round[name]);
  console.log(`  ${name}: ${median(values).toFixed(0)} (${Math.min(...values).toFixed(0)}, ${Math.max(...values).toFixed(0)})`);
}
