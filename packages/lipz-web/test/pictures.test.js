// The pictures in docs/pictures match the drawings of the face.

import assert from "node:assert/strict";
import { readdir, readFile } from "node:fs/promises";
import { test } from "node:test";
import { pictures } from "./pictures.js";

const folder = new URL("./pictures/", import.meta.url);

test("the pictures of the documentation are current", async () => {
  const drawn = await pictures();
  assert.deepEqual((await readdir(folder)).sort(), Object.keys(drawn).sort());
  for (const [name, contents] of Object.entries(drawn)) {
    assert.ok((await readFile(new URL(name, folder), "utf8")) === contents, `docs/pictures/${name}: run \`cargo xtask pictures\``);
    assert.ok(contents.length < 100_000, `${name} has ${contents.length} bytes`);
    assert.doesNotMatch(contents, /NaN|undefined/, name);
  }
});
