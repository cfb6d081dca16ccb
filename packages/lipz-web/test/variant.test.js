// The order in which the key of a variant finds a text.

import assert from "node:assert/strict";
import { test } from "node:test";
import { foundKeys } from "../variant.js";

test("a number comes first, and a gender is found without it", () => {
  assert.deepEqual(foundKeys("few-fem"), ["few-fem", "few", "fem"]);
  const formal = ["many-fem-formal", "many-fem", "many", "fem-formal", "fem"];
  assert.deepEqual(foundKeys("many-fem-formal"), formal);
  assert.deepEqual(foundKeys("fem-few"), ["fem-few", "fem"]);
  assert.deepEqual(foundKeys("few"), ["few"]);
  assert.deepEqual(foundKeys(""), [""]);
});
