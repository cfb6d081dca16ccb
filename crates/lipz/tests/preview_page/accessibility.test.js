// axe looks at the page of `lipz preview`: what it says of contrast, names and roles. LIPZ names the command.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { Browser } from "./browser.js";
import { MAYOR, Project } from "./project.js";

const TIMEOUT_MS = 180_000;
const READY = "globalThis.preview?.then(({ player }) => player.key !== undefined)";
const AXE = new URL("node_modules/axe-core/axe.min.js", import.meta.url);
/** What keeps people out; axe also knows what only bothers them. */
const SERIOUS = ["serious", "critical"];

/** All that breaks a rule. */
async function violations(page) {
  await page.value(await readFile(AXE, "utf8"));
  return page.value("axe.run({ resultTypes: ['violations'] }).then(({ violations }) => violations)");
}

/** The serious findings: the rule, and the elements. */
async function findings(page) {
  const serious = (await violations(page)).filter(({ impact }) => SERIOUS.includes(impact));
  return serious.flatMap(({ id, nodes }) => nodes.map(({ target, any }) => `${id}: ${target} ${any[0]?.message ?? ""}`));
}

test("axe sees the page", { timeout: TIMEOUT_MS }, async (t) => {
  const browser = await Browser.start();
  t.after(() => browser.end());
  const page = await browser.open("data:text/html,<html lang=en><title>A</title><img src=a.png>");
  await page.until("document.images.length === 1");
  assert.equal((await findings(page)).filter((finding) => finding.startsWith("image-alt: img")).length, 1);
});

test("nothing keeps anybody out", { timeout: TIMEOUT_MS }, async (t) => {
  const project = await Project.small();
  t.after(() => project.end());
  const address = await project.preview();
  const browser = await Browser.start();
  t.after(() => browser.end());
  for (const [width, height] of [[375, 800], [1280, 900]]) {
    const page = await browser.open(address, width, height);
    await page.until(READY);
    for (const scheme of ["light", "dark"]) {
      await page.scheme(scheme);
      assert.deepEqual(await findings(page), [], `${width} px, ${scheme}`);
    }
  }
  const phone = await browser.open(address, 375, 800);
  await phone.until(READY);
  await phone.click("#clips-button");
  await phone.until('document.body.classList.contains("choosing")');
  assert.deepEqual((await violations(phone)).map(({ id }) => id), [], "the list is open");
  const page = await browser.open(`${address}#clip=act2/wrong`);
  await page.until(READY);
  assert.deepEqual(await findings(page), [], "with diagnostics");
});

test("a long clip keeps nobody out, and a conflict does not widen the page", { timeout: TIMEOUT_MS }, async (t) => {
  const project = await Project.long();
  t.after(() => project.end());
  const address = await project.preview();
  const browser = await Browser.start();
  t.after(() => browser.end());
  const file = await project.read("voices/long.lipz");
  for (const [width, height] of [[375, 800], [3840, 2160]]) {
    const page = await browser.open(address, width, height);
    await page.until(READY);
    for (let zoom = 0; zoom < 5; zoom++) await page.key("+");
    const scrolls = '(({ scrollWidth, clientWidth }) => scrollWidth > clientWidth)(document.getElementById("timeline"))';
    assert.equal(await page.value(scrolls), true, "the timeline is wider than the window");
    assert.deepEqual(await findings(page), [], `${width} px, zoomed`);
    await page.value('document.getElementById("shapes").focus()');
    await page.key("E");
    await page.until('!document.getElementById("save").disabled');
    await project.write("voices/long.lipz", file.replace("Otto 5.", "Otto five."));
    await page.key("s", "control");
    await page.until('!document.getElementById("conflict").hidden');
    assert.equal(await page.value('document.querySelector("#theirs mark").textContent'), "5");
    assert.deepEqual(await findings(page), [], `${width} px, a conflict`);
    const main = await page.value('(({ scrollWidth, clientWidth }) => scrollWidth - clientWidth)(document.getElementById("clip"))');
    assert.equal(main, 0, "nothing is out of the window");
    await project.write("voices/long.lipz", file);
    await page.click("#drop");
    await page.until('document.getElementById("save").disabled');
  }
});

test("a conflict keeps nobody out", { timeout: TIMEOUT_MS }, async (t) => {
  const project = await Project.small();
  t.after(() => project.end());
  const address = await project.preview();
  const browser = await Browser.start();
  t.after(() => browser.end());
  const page = await browser.open(address);
  await page.until(READY);
  await page.value('document.getElementById("shapes").focus()');
  await page.key("E");
  await page.until('!document.getElementById("save").disabled');
  await project.write("voices/act1/mayor.lipz", MAYOR.replace("points door", "points window"));
  await page.key("s", "control");
  await page.until('!document.getElementById("conflict").hidden');
  assert.deepEqual(await findings(page), []);
});
