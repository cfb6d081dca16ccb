// The demo in Chromium: the page test/page.js looks at it from inside, and reports.

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

test("the demo plays a clip in Chromium", { timeout: TIMEOUT_MS }, async (t) => {
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
  const page = `http://127.0.0.1:${server.address().port}/test/page.html`;
  const browser = spawn(CHROMIUM, [...FLAGS, `--user-data-dir=${folder}`, page], { stdio: "ignore" });
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
  assert.ok(checks > 120);
});
