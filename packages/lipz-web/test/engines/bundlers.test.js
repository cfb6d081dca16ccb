// Bundlers: programs that import the installed package are bundled without settings, and then find its module.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { cp, mkdir, readdir, rm, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import * as esbuild from "esbuild";
import * as vite from "vite";
import webpack from "webpack";
import { WITHOUT_GPU, reported } from "./chromium.js";
import { serveFolder } from "./server.js";

const TIMEOUT_MS = 120_000;
const ROOT = fileURLToPath(new URL("../", import.meta.url));
const PACKAGE = join(ROOT, "node_modules/@lipz/reader");
const BANK = join(ROOT, "banks/rigs.lipzbank");
/** What the program reports. */
const ANSWERS = { clip: "english", viseme: "-", shape: "jawOpen" };

/** A program that uses the package, and then calls `report`. */
const program = (options = "{}", imports = "") => `
  import { openDialogue, rig } from "@lipz/reader";
  ${imports}
  async function answers() {
    const dialogue = await openDialogue([BANK], ${options});
    const [clip] = dialogue.clips();
    return { clip: clip.key, viseme: clip.visemeAt(0.5), shape: Object.keys(rig(["jawOpen"]).map)[0] };
  }
  answers().catch(({ message }) => ({ message })).then(report);
`;
const IN_BROWSER = `const BANK = "/rigs.lipzbank";
  const report = (found) => fetch("/report", { method: "POST", body: JSON.stringify(found) });`;
const IN_NODE = `const BANK = ${JSON.stringify(BANK)}; const report = (found) => console.log(JSON.stringify(found));`;
const PAGE = `<!doctype html><title>Bundle</title><script type="module" src="./out.js"></script>`;

/** A new folder with a program, a page and a bank. */
async function project(name, source = IN_BROWSER + program()) {
  const folder = join(ROOT, "bundles", name);
  await rm(folder, { recursive: true, force: true });
  await mkdir(join(folder, "dist"), { recursive: true });
  await writeFile(join(folder, "entry.js"), source);
  await writeFile(join(folder, "dist/index.html"), PAGE);
  await cp(BANK, join(folder, "dist/rigs.lipzbank"));
  return folder;
}

const inChromium = (t, folder) => reported(t, (post) => serveFolder(folder, post), "index.html", WITHOUT_GPU);

const copyModule = (folder) => cp(join(PACKAGE, "lipz.wasm"), join(folder, "dist/lipz.wasm"));

async function bundleWithEsbuild(folder, settings = {}) {
  const { errors, warnings } = await esbuild.build({
    entryPoints: [join(folder, "entry.js")],
    outfile: join(folder, "dist/out.js"),
    bundle: true,
    format: "esm",
    logLevel: "silent",
    ...settings,
  });
  assert.deepEqual([errors, warnings], [[], []]);
}

test("esbuild: the module is copied next to the bundle", { timeout: TIMEOUT_MS }, async (t) => {
  const folder = await project("esbuild");
  await bundleWithEsbuild(folder, { minify: true });
  await copyModule(folder);
  assert.deepEqual(await inChromium(t, join(folder, "dist")), ANSWERS);
});

test("esbuild: the module is an option, as for a classic script", { timeout: TIMEOUT_MS }, async (t) => {
  const folder = await project("esbuild-option", IN_BROWSER + program('{ wasm: "/lipz.wasm" }'));
  await bundleWithEsbuild(folder, { format: "iife" });
  await copyModule(folder);
  assert.deepEqual(await inChromium(t, join(folder, "dist")), ANSWERS);
});

test("esbuild: the module is inside the bundle", { timeout: TIMEOUT_MS }, async (t) => {
  const source = IN_BROWSER + program("{ wasm }", 'import wasm from "@lipz/reader/lipz.wasm";');
  const folder = await project("esbuild-binary", source);
  await bundleWithEsbuild(folder, { loader: { ".wasm": "binary" } });
  assert.deepEqual(await inChromium(t, join(folder, "dist")), ANSWERS);
});

test("esbuild: a missing module is an error with its remedy", { timeout: TIMEOUT_MS }, async (t) => {
  for (const format of ["esm", "iife"]) {
    const folder = await project(`esbuild-missing-${format}`);
    await bundleWithEsbuild(folder, { format });
    const { message } = await inChromium(t, join(folder, "dist"));
    assert.match(message, /^lipz\.wasm: .*; copy lipz\.wasm from the package next to the bundle, or pass/);
  }
});

test("webpack finds the module", { timeout: TIMEOUT_MS }, async (t) => {
  for (const mode of ["production", "development"]) {
    const folder = await project(`webpack-${mode}`);
    const output = { path: join(folder, "dist"), filename: "out.js" };
    const stats = await new Promise((resolve, reject) => {
      const settings = { mode, context: folder, entry: "./entry.js", output };
      webpack(settings, (error, found) => (error ? reject(error) : resolve(found)));
    });
    const { errors, warnings } = stats.toJson();
    assert.deepEqual([errors, warnings], [[], []]);
    assert.ok((await readdir(output.path)).some((name) => name.endsWith(".wasm")));
    assert.deepEqual(await inChromium(t, output.path), ANSWERS);
  }
});

/** A project in the layout of Vite. */
async function viteProject(name) {
  const folder = await project(name);
  await writeFile(join(folder, "index.html"), PAGE.replace("out.js", "entry.js"));
  await mkdir(join(folder, "public"));
  await cp(BANK, join(folder, "public/rigs.lipzbank"));
  return folder;
}

test("Vite finds the module", { timeout: TIMEOUT_MS }, async (t) => {
  const folder = await viteProject("vite");
  await vite.build({ root: folder, logLevel: "silent", configFile: false });
  assert.ok((await readdir(join(folder, "dist/assets"))).some((name) => name.endsWith(".wasm")));
  assert.deepEqual(await inChromium(t, join(folder, "dist")), ANSWERS);
});

test("Vite finds the module while you develop", { timeout: TIMEOUT_MS }, async (t) => {
  const folder = await viteProject("vite-server");
  const listen = async (post) => {
    const report = (request, response, next) => {
      if (request.method !== "POST") return next();
      return post(request.url, request).then(() => response.end());
    };
    const plugins = [{ name: "report", configureServer: ({ middlewares }) => void middlewares.use(report) }];
    const started = { root: folder, configFile: false, logLevel: "silent", cacheDir: join(folder, "cache"), plugins };
    const server = await vite.createServer({ ...started, server: { host: "127.0.0.1", port: 0 } });
    t.after(() => server.close());
    await server.listen();
    return server.httpServer;
  };
  assert.deepEqual(await reported(t, listen, "index.html", WITHOUT_GPU), ANSWERS);
});

test("browsers need no bundler", { timeout: TIMEOUT_MS }, async (t) => {
  const folder = await project("none");
  await cp(PACKAGE, join(folder, "dist/lipz"), { recursive: true });
  const source = IN_BROWSER + program();
  await writeFile(join(folder, "dist/out.js"), source.replace('"@lipz/reader"', '"./lipz/lipz.js"'));
  assert.deepEqual(await inChromium(t, join(folder, "dist")), ANSWERS);
});

test("node needs no bundler, and runs bundles", async () => {
  const folder = await project("node", IN_NODE + program());
  const run = (file) => JSON.parse(execFileSync("node", [file], { encoding: "utf8" }));
  assert.deepEqual(run(join(folder, "entry.js")), ANSWERS);
  await bundleWithEsbuild(folder, { platform: "node", outfile: join(folder, "dist/out.mjs") });
  await copyModule(folder);
  assert.deepEqual(run(join(folder, "dist/out.mjs")), ANSWERS);
});
