// The programs of the readme: the first one runs, and those for engines are parts of the examples.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { fileURLToPath } from "node:url";

const readme = await readFile(new URL("../README.md", import.meta.url), "utf8");

/** The blocks of code in this language. */
function blocks(text, language) {
  const found = Array.from(text.matchAll(/^```(\w+)\n(.*?)^```$/gms));
  return found.filter(([, name]) => name === language).map(([, , code]) => code);
}

test("the readme starts with the installation, and ten lines that run", () => {
  const [[installation], [program], [output]] = ["sh", "js", "text"].map((language) => blocks(readme, language));
  assert.equal(installation, "npm install @lipz/reader\n");
  assert.ok(readme.indexOf(installation) < readme.indexOf(program));
  assert.ok(program.trim().split("\n").length <= 11, "ten lines, and an empty one");
  const cwd = fileURLToPath(new URL("../demo", import.meta.url));
  const printed = execFileSync("node", ["--input-type=module", "--eval", program], { cwd, encoding: "utf8" });
  assert.equal(printed.replace(/ +$/gm, ""), output);
});

test("the programs for engines are parts of the examples", async () => {
  const engines = {
    "three.js": "three/main.js",
    "React Three Fiber": "react-three-fiber/main.jsx",
    "VRM avatars": "three-vrm/main.js",
    "Babylon.js": "babylon/main.js",
    PlayCanvas: "playcanvas/main.js",
    TalkingHead: "talkinghead/visemes.js",
  };
  let compared = 0;
  for (const [heading, path] of Object.entries(engines)) {
    const section = readme.split(`\n### ${heading}\n`)[1].split("\n### ")[0];
    const example = await readFile(new URL(`../examples/${path}`, import.meta.url), "utf8");
    const lines = new Set(example.split("\n").map((line) => line.replace(/^ \*/, "").trim()));
    for (const program of blocks(section, "js")) {
      for (const line of program.split("\n").filter(Boolean)) {
        assert.ok(lines.has(line.trim()), `${path} lacks: ${line}`);
        compared += 1;
      }
    }
  }
  assert.ok(compared > 20, compared);
});
