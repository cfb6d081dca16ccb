// Chromium without a window, for tests that examine pages from inside.

import { spawn } from "node:child_process";
import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";

const CHROMIUM = process.env.CHROMIUM ?? "chromium";
const FLAGS = [
  "--headless",
  "--no-sandbox",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
  "--autoplay-policy=no-user-gesture-required",
];

/** Flags for pages without WebGL, and for those that draw with WebGL on the processor. */
export const WITHOUT_GPU = ["--disable-gpu"];
export const SWIFTSHADER = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"];

/**
 * Opens a page until the end of a test. `listen` starts a server that passes the JSON of `POST /report` to a function,
 * and returns the server. Returns the first report.
 */
export async function reported(t, listen, path, flags) {
  const folder = await mkdtemp(join(tmpdir(), "lipz-"));
  let tell;
  const report = new Promise((resolve) => (tell = resolve));
  const server = await listen(async (path, request) => {
    if (path !== "/report") return false;
    let text = "";
    for await (const part of request) text += part;
    tell(JSON.parse(text));
    return true;
  });
  const page = `http://127.0.0.1:${server.address().port}/${path}`;
  const browser = spawn(CHROMIUM, [...FLAGS, ...flags, `--user-data-dir=${folder}`, page], { stdio: "ignore" });
  browser.on("error", (error) => tell({ failures: [`${CHROMIUM} cannot be run: ${error.message}`] }));
  t.after(async () => {
    browser.kill("SIGKILL");
    server.close();
    server.closeAllConnections();
    await rm(folder, { recursive: true, force: true, maxRetries: 5 });
  });
  return report;
}
