// The demo in Chromium: test/page.js examines it from inside the page, and reports.

import assert from "node:assert/strict";
import { test } from "node:test";
import { serve } from "../demo/serve.js";
import { WITHOUT_GPU, reported } from "./engines/chromium.js";

const TIMEOUT_MS = 120_000;

/** The number of checks of test/page.js, which depend on the query. All must pass. */
async function checked(t, query, flags = []) {
  const listen = (post) => serve(0, post);
  const { failures, checks, clock } = await reported(t, listen, `test/page.html${query}`, [...WITHOUT_GPU, ...flags]);
  t.diagnostic(`${checks} checks, ${clock}`);
  assert.deepEqual(failures, []);
  return checks;
}

test("the demo plays a clip in Chromium", { timeout: TIMEOUT_MS }, async (t) => {
  assert.ok((await checked(t, "")) > 300);
});

test("nothing sways for those who do not want motion", { timeout: TIMEOUT_MS }, async (t) => {
  assert.ok((await checked(t, "?still", ["--force-prefers-reduced-motion"])) > 5);
});
