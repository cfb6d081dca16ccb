// Tests the built package as its users install it, with bundlers, and with engines in Chromium:
// node test/engines/run.js FOLDER
//
// FOLDER keeps the bundlers and engines, which npm installs there if package.json has changed. Run it in a package that
// `cargo xtask web` has built.

import { spawnSync } from "node:child_process";
import { cp, mkdir, readFile, readdir, rename, rm, writeFile } from "node:fs/promises";
import { join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const PACKAGE = fileURLToPath(new URL("../../", import.meta.url));
const TEST = ".test.js";
const INSTALL = ["install", "--no-package-lock", "--ignore-scripts", "--no-audit", "--no-fund", "--silent"];

function run(folder, program, ...args) {
  const { status, error, stdout } = spawnSync(program, args, { cwd: folder, stdio: ["ignore", "pipe", "inherit"] });
  if (error) throw error;
  if (status !== 0) throw new Error(`${program} ${args[0]} failed with ${status}\n${stdout}`);
  return String(stdout);
}

/** Installs the bundlers and engines, unless these versions are installed. */
async function installTools(folder) {
  const wanted = await readFile(join(PACKAGE, "test/engines/package.json"), "utf8");
  const installed = await readFile(join(folder, "installed.json"), "utf8").catch(() => undefined);
  if (installed === wanted) return;
  await rm(join(folder, "installed.json"), { force: true });
  await writeFile(join(folder, "package.json"), wanted);
  run(folder, "npm", ...INSTALL);
  await writeFile(join(folder, "installed.json"), wanted);
}

/** Installs the package from the archive that npm would publish. */
async function installPackage(folder) {
  const archive = run(folder, "npm", "pack", "--silent", PACKAGE).trim();
  await rename(join(folder, archive), join(folder, "reader.tgz"));
  run(folder, "npm", ...INSTALL, "--no-save", "./reader.tgz");
}

/** Copies the tests, the examples and a bank, which find the installed package from there. */
async function copyTests(folder) {
  await rm(join(folder, "bundles"), { recursive: true, force: true });
  for (const [from, to] of [["test/engines", "test"], ["examples", "examples"], ["test/banks", "banks"]]) {
    await rm(join(folder, to), { recursive: true, force: true });
    await cp(join(PACKAGE, from), join(folder, to), { recursive: true });
  }
}

async function main(argument) {
  if (argument === undefined) throw new Error("usage: node test/engines/run.js FOLDER");
  const folder = resolve(argument);
  await mkdir(folder, { recursive: true });
  await installTools(folder);
  await installPackage(folder);
  await copyTests(folder);
  const tests = (await readdir(join(folder, "test"))).filter((name) => name.endsWith(TEST));
  const files = tests.sort().map((name) => join("test", name));
  // One at a time: each starts browsers.
  const args = ["--test", "--test-concurrency=1", "--test-reporter=spec", ...files];
  process.exitCode = spawnSync("node", args, { cwd: folder, stdio: "inherit" }).status ?? 1;
}

await main(process.argv[2]);
