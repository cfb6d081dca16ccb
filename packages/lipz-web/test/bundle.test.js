// Bundlers: in browsers, the package does not need node, and refers to its module so that bundlers find it.
// test/engines/bundlers.test.js bundles it.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";

const PACKAGE = new URL("../", import.meta.url);

/** A module and all modules that it imports, with their texts. */
async function modulesFrom(url, found = new Map()) {
  if (found.has(url.href)) return found;
  const text = await readFile(url, "utf8");
  found.set(url.href, text);
  for (const [, path] of text.matchAll(/(?:^|\s)(?:from|import) ?\(?"([^"]+)"/g)) {
    assert.match(path, /^\.\.?\//, `${url.pathname} imports ${path}`);
    await modulesFrom(new URL(path, url), found);
  }
  return found;
}

test("in browsers, the package imports modules of its own alone", async () => {
  const modules = await modulesFrom(new URL("lipz.js", PACKAGE));
  assert.ok(modules.size > 10, modules.size);
  const names = Array.from(modules.values()).filter((text) => text.includes('new URL("./lipz.wasm", import.meta.url)'));
  assert.equal(names.length, 1, "webpack and Vite look for these words");
  const { exports, files } = JSON.parse(await readFile(new URL("package.json", PACKAGE), "utf8"));
  assert.deepEqual(exports["."], { types: "./lipz.d.ts", node: "./node.js", default: "./lipz.js" });
  assert.ok(files.includes("*.js") && files.includes("lipz.wasm"));
  assert.equal(exports["./lipz.wasm"], "./lipz.wasm", "esbuild puts it into a bundle by this name");
});

test("both entries have the same exports, and those of lipz.d.ts", async () => {
  const [web, node] = await Promise.all([import("../lipz.js"), import("../node.js")]);
  assert.deepEqual(Object.keys(web).sort(), Object.keys(node).sort());
  const types = await readFile(new URL("lipz.d.ts", PACKAGE), "utf8");
  const declared = Array.from(types.matchAll(/^export (?:class|const|function) (\w+)/gm), ([, name]) => name);
  assert.deepEqual(Object.keys(web).sort(), declared.sort());
});
