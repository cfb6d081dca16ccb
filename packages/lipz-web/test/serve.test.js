// The server of the demo, in the package and in the repository, where some files are in other folders.

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { cp, mkdir, mkdtemp, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";

const DEMO = fileURLToPath(new URL("../demo", import.meta.url));

/** A repository with only the sources of the demo. */
async function repository(t) {
  const root = await mkdtemp(join(tmpdir(), "lipz serve "));
  t.after(() => rm(root, { recursive: true, force: true }));
  const at = join(root, "packages/lipz-web");
  await cp(DEMO, join(at, "demo"), { recursive: true, filter: (path) => !path.endsWith(".lipzbank") });
  await writeFile(join(at, "package.json"), '{"type":"module"}');
  return { root, at };
}

/** Starts the server as in the README. Returns its address, or its output if it ends. */
function start(t, folder, ...args) {
  const server = spawn(process.execPath, ["demo/serve.js", ...args], { cwd: folder });
  t.after(() => server.kill());
  return new Promise((resolve) => {
    let errors = "";
    server.stderr.on("data", (text) => (errors += text));
    server.stdout.once("data", (text) => resolve({ url: String(text).trim() }));
    server.once("close", (code) => resolve({ code, errors }));
  });
}

test("in the repository, files that are elsewhere are served", async (t) => {
  const { root, at } = await repository(t);
  await mkdir(join(root, "target/web"), { recursive: true });
  await mkdir(join(root, "fixtures/banks/v1"), { recursive: true });
  await writeFile(join(root, "target/web/lipz.wasm"), "module");
  await writeFile(join(root, "fixtures/banks/v1/drama.lipzbank"), "bank");
  await writeFile(join(root, "fixtures/banks/v1/faces.lipzbank"), "faces");
  const { url } = await start(t, at, "0");
  const get = async (path) => {
    const response = await fetch(new URL(path, url));
    return [response.status, response.headers.get("content-type"), (await response.text()).slice(0, 15)];
  };
  assert.deepEqual(await get("/"), [200, "text/html", "<!doctype html>"], "the address that is printed is the page");
  const { url: shown } = await fetch(new URL("/?clip=act1/none", url));
  assert.match(shown, /\/demo\/index\.html\?clip=act1\/none$/, "with what it asks for");
  assert.deepEqual(await get("/demo/dialogue.lipzbank"), [200, "application/octet-stream", "bank"]);
  assert.deepEqual(await get("/demo/faces.lipzbank"), [200, "application/octet-stream", "faces"]);
  assert.deepEqual(await get("/lipz.wasm"), [200, "application/wasm", "module"]);
  for (const path of ["/nothing", "/..%2f..%2ftarget/web/lipz.wasm", "/%2e%2e/%2e%2e/target/web/lipz.wasm", "/%"]) {
    assert.equal((await get(path))[0], 404, path);
  }
});

test("missing files are reported, with the command that makes them", async (t) => {
  const { at } = await repository(t);
  const { code, errors } = await start(t, at, "0");
  assert.equal(code, 1);
  assert.match(errors, /^lipz\.wasm is missing: .*cargo xtask web/);
  const wrong = await start(t, at, "eighty");
  assert.deepEqual([wrong.code, wrong.errors.includes("eighty is not a port")], [1, true]);
});
