// The demo in Chromium: test/page.js examines it from inside the page, and reports.

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { serve } from "../demo/serve.js";

const CHROMIUM = process.env.CHROMIUM ?? "chromium";
const TIMEOUT_MS = 120_000;
const FLAGS = [
  "--headless",
  "--no-sandbox",
  "--disable-gpu",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
  "--autoplay-policy=no-user-gesture-required",
];

/** The report of test/page.js about its checks, which depend on the query. */
async function reported(t, query, flags = []) {
  const folder = await mkdtemp(join(tmpdir(), "lipz-"));
  let tell;
  const report = new Promise((resolve) => (tell = resolve));
  const server = await serve(0, async (path, request) => {
    if (path !== "/report") return false;
    let text = "";
    for await (const part of request) text += part;
    tell(JSON.parse(text));
    return true;
  });
  const page = `http://127.0.0.1:${server.address().port}/test/page.html${query}`;
  const browser = spawn(CHROMIUM, [...FLAGS, ...flags, `--user-data-dir=${folder}`, page], { stdio: "ignore" });
  browser.on("error", (error) => tell({ failures: [`${CHROMIUM} cannot be run: ${error.message}`] }));
  t.after(async () => {
    browser.kill("SIGKILL");
    server.close();
    server.closeAllConnections();
    await rm(folder, { recursive: true, force: true, maxRetries: 5 });
  });
  const { failures, checks, clock } = await report;
  t.diagnostic(`${checks} checks, ${clock}`);
  assert.deepEqual(failures, []);
  return checks;
}

test("the demo plays a clip in Chromium", { timeout: TIMEOUT_MS }, async (t) => {
  assert.ok((await reported(t, "")) > 300);
});

test("nothing sways for those who do not want motion", { timeout: TIMEOUT_MS }, async (t) => {
  assert.ok((await reported(t, "?still", ["--force-prefers-reduced-motion"])) > 5);
});
