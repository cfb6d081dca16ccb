// The page of `lipz preview` in a browser, used as people do: LIPZ names the command, BROWSER the browser.

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { Browser } from "./browser.js";
import { MAYOR, Project, SETTINGS } from "./project.js";

const TIMEOUT_MS = 180_000;
const READY = "globalThis.preview?.then(({ player }) => player.key !== undefined)";
const FILE = "voices/act1/mayor.lipz";
const BOBBY = new URL("../../../../fixtures/speech/bobby.wav", import.meta.url);
/** What a page that plays does: where there is no device for sound, silently. */
const SOUNDS = Browser.hasSound ? "player.clock.isAudio" : "player.clock.playing";
const time = "preview.then(({ player }) => player.clock.time)";
const text = (id) => `document.getElementById("${id}").textContent`;

/** A page of a project in a browser, until the test ends. */
async function opened(t, project, options = [], hash = "") {
  t.after(() => project.end());
  const address = await project.preview(...options);
  const browser = await Browser.start();
  t.after(() => browser.end());
  const page = await browser.open(address + hash);
  await page.until(READY);
  return page;
}

const close = (actual, expected, what) => assert.ok(Math.abs(actual - expected) < 0.02, `${what}: ${actual}, not ${expected}`);

test("a clip is seen, heard and moved in with keys alone", { timeout: TIMEOUT_MS }, async (t) => {
  const page = await opened(t, await Project.small());
  assert.equal(await page.value(text("key")), "act1/mayor");
  assert.equal(await page.value(text("subtitle")), "Mayor?");
  assert.equal(await page.value(text("other")), "Meister?");
  await page.key("ArrowRight");
  close(await page.value(time), 1 / 24, "a frame on");
  await page.key("End");
  close(await page.value(time), 20 / 24, "the end");
  await page.key("Home");
  await page.key(" ");
  await page.until(`preview.then(({ player }) => ${SOUNDS} && player.clock.time > 0.2)`);
  await page.key("k");
  const stopped = await page.value(time);
  await page.key("j");
  await page.until(`preview.then(({ player }) => player.clock.rate === -1 && player.clock.time < ${stopped})`);
  await page.until("preview.then(({ player }) => !player.clock.playing)");
  close(await page.value(time), 0, "back at the start");
  await page.key("h");
  await page.key("o");
  await page.key("l");
  await page.until(`preview.then(({ player }) => player.clock.rate === 0.5 && ${SOUNDS})`);
  await new Promise((resolve) => setTimeout(resolve, 900));
  assert.ok((await page.value(time)) < 8 / 24, "the first segment is repeated");
  await page.key("k");
  await page.key("/");
  await page.type("otto");
  await page.key("ArrowDown");
  await page.until(`${text("key")} === "act1/otto"`);
  assert.equal(await page.value(text("count")), "1 of 3 clips");
  assert.deepEqual(page.complaints, []);
});

test("what is edited is drawn, undone, and saved as the file is laid out", { timeout: TIMEOUT_MS }, async (t) => {
  const project = await Project.small();
  const page = await opened(t, project);
  const drawn = "preview.then(async ({ player }) => (await player.settled, player.clip.frames))";
  await page.click("#timeline");
  await page.key("Home");
  await page.value('document.getElementById("shapes").focus()');
  await page.key("E");
  await page.until(`${drawn}.then((frames) => frames === "EAAAEO--MAAEEO------")`);
  close(await page.value(time), 1 / 24, "typing goes on by a frame");
  const framePx = await page.value('document.querySelector("#timeline .track").offsetWidth / 20');
  await page.drag('[data-grip="edge"][data-at="4"]', -framePx);
  await page.until(`${drawn}.then((frames) => frames === "EAAEEO--MAAEEO------")`);
  await page.drag('[data-grip="bar"]', -framePx);
  await page.until('preview.then(async ({ player }) => (await player.settled, player.clip.segment(1).startFrame === 7))');
  await page.key("z", "control");
  await page.until('preview.then(async ({ player }) => (await player.settled, player.clip.segment(1).startFrame === 8))');
  await page.key("z", "control", "shift");
  await page.until('preview.then(async ({ player }) => (await player.settled, player.clip.segment(1).startFrame === 7))');
  await page.click('[data-name="text_de-de"][data-at="1"]');
  await page.key("End");
  await page.type("!");
  await page.key("Enter");
  assert.equal(await project.read(FILE), MAYOR, "nothing is written before it is saved");
  await page.key("s", "control");
  await page.until('document.getElementById("save").disabled');
  const file = await project.read(FILE);
  assert.match(file, /"visemes" : {4}"EAAEEO-\|-MAAEEO------"/, file);
  assert.ok(file.includes("{louder} Meister!!"), file);
  assert.ok(file.includes('  "note" : "as recorded"\n'), "all else stays");
  assert.deepEqual(page.complaints, []);
});

test("a file that has changed on disk is not overwritten", { timeout: TIMEOUT_MS }, async (t) => {
  const project = await Project.small();
  const page = await opened(t, project);
  await page.value('document.getElementById("shapes").focus()');
  await page.key("E");
  await page.until('!document.getElementById("save").disabled');
  const theirs = MAYOR.replace("points door", "points window");
  await project.write(FILE, theirs);
  await page.key("s", "control");
  await page.until('!document.getElementById("conflict").hidden');
  assert.ok((await page.value(text("theirs"))).includes("points window"));
  assert.equal(await project.read(FILE), theirs);
  await page.click("#again");
  await page.until('document.getElementById("conflict").hidden && !document.getElementById("save").disabled');
  await page.key("s", "control");
  await page.until('document.getElementById("save").disabled');
  assert.equal(await project.read(FILE), theirs.replace("MAAAEO", "EAAAEO"), "both changes are there");
});

test("the page follows the files, and stays where it was", { timeout: TIMEOUT_MS }, async (t) => {
  const project = await Project.small();
  const page = await opened(t, project);
  await page.key("+");
  await page.key("+");
  for (let frame = 0; frame < 3; frame++) await page.key("ArrowRight");
  const [before, width] = [await page.value(time), await page.value('document.querySelector("#timeline .track").offsetWidth')];
  await project.write(FILE, MAYOR.replace("Mayor? ", "Mayors?"));
  await page.until(`${text("subtitle")} === "Mayors?"`);
  assert.equal(await page.value(time), before);
  assert.equal(await page.value('document.querySelector("#timeline .track").offsetWidth'), width);
  await project.write(FILE, MAYOR.replace("MAAAEO", "MAAAE?"));
  const isTold = `${text("problems")}.includes("\`?\`")`;
  await page.until(isTold);
  await project.write(FILE, MAYOR);
  await page.until(`!${isTold}`);
});

test("diagnostics are where they are", { timeout: TIMEOUT_MS }, async (t) => {
  const page = await opened(t, await Project.small(), [], "#clip=act2/wrong");
  assert.ok((await page.value(text("problems"))).includes("LZ0601"));
  await page.value('(document.getElementById("what").value = "With errors", document.getElementById("what").dispatchEvent(new Event("input")))');
  assert.equal(await page.value(text("count")), "1 of 3 clips");
});

test("a clip with errors is shown as far as it is right, and mended", { timeout: TIMEOUT_MS }, async (t) => {
  const project = await Project.small();
  const parts = '{ "visemes": "MAAO|MAAO", "text_en-us": "Only a text.", "text_de-de": "Nur | ein | Text.", "fps": 24, "viseme_type": "blair" }\n';
  await project.write("voices/act2/parts.lipz", parts);
  const page = await opened(t, project);
  await page.until(`${text("subtitle")} === "Mayor?"`);
  await page.click('[data-key="act2/parts"]');
  await page.until(`${text("key")} === "act2/parts" && !document.getElementById("tracks").hidden`);
  assert.equal(await page.value(text("subtitle")), "", "nothing of another clip stays");
  assert.equal(await page.value(text("viseme")), "M");
  assert.equal(await page.value('preview.then(({ player }) => player.clip.segments.length)'), 2);
  assert.equal(await page.value('[...document.querySelectorAll("#texts th")].map((cell) => cell.textContent).join()'), "#,en-us,de-de,Events");
  await page.click('[data-name="text_de-de"][data-at="2"]');
  await page.key("a", "control");
  await page.key("Backspace");
  await page.key("Enter");
  // The list of problems becomes shorter, and what is below it moves.
  await page.until("preview.then(async ({ player }) => (await player.settled, true))");
  await page.click('[data-name="text_en-us"][data-at="1"]');
  await page.type("Two.");
  await page.key("Enter");
  await page.until(`preview.then(async ({ player }) => (await player.settled, document.getElementById("problems").hidden))`);
  await page.key("s", "control");
  await page.until('document.getElementById("save").disabled');
  assert.equal(await project.read("voices/act2/parts.lipz"), parts.replace("| Text.", "").replace("a text.", "a text.|Two."));
  assert.deepEqual(page.complaints, []);
});

test("a project of one clip with errors has its texts", { timeout: TIMEOUT_MS }, async (t) => {
  const project = await Project.make({ "voices/a.lipz": '{ "visemes": "MA", "text_en-us": "A.", "text_de-de": "A.|B.", "fps": 24, "viseme_type": "blair" }' });
  const page = await opened(t, project, ["voices"]);
  assert.equal(await page.value(text("count")), "1 clip");
  assert.equal(await page.value(text("subtitle")), "A.");
  assert.equal(await page.value('document.querySelectorAll(\'[data-name="text_de-de"]\').length'), 2);
});

test("what is typed counts from its first key, and stays while files change", { timeout: TIMEOUT_MS }, async (t) => {
  const project = await Project.small();
  const page = await opened(t, project);
  const field = '[data-name="text_en-us"][data-at="0"]';
  const isChanged = "preview.then(({ player }) => player.isChanged)";
  await page.click(field);
  await page.key("Home");
  await page.type("Oh, ");
  assert.equal(await page.value(isChanged), true, "a reload asks");
  assert.equal(await page.value('document.getElementById("save").disabled'), false);
  await project.write("voices/act1/otto.lipz", '{ "visemes": "MAEO--", "text_en-us": "Good morning.", "fps": 24, "viseme_type": "blair" }\n');
  await page.until("preview.then(({ list }) => document.getElementById('list').textContent.includes('0.3 s'))");
  const listed = "preview.then(() => document.getElementById('list').textContent)";
  const before = await page.value(listed);
  const theirs = MAYOR.replace("MAAAEO", "MA|AAEOOO").replace("{louder} Mayor!", "{louder} Mayor!|Mayor.").replace("{louder} Meister!", "{louder} Meister!|Meister.").replace("points door", "points door|");
  await project.write(FILE, theirs);
  await page.until(`${listed}.then((list) => list !== ${JSON.stringify(before)})`);
  const state = `(({ value, selectionStart }) => [value, selectionStart, document.activeElement.matches(${JSON.stringify(field)})])(document.querySelector(${JSON.stringify(field)}))`;
  assert.deepEqual(await page.value(state), ["Oh, Mayor?", 4, true]);
  await page.key("s", "control");
  await page.until('!document.getElementById("conflict").hidden');
  assert.equal(await project.read(FILE), theirs, "nobody's text is lost");
  assert.ok((await page.value(text("yours"))).includes("Oh, Mayor?"));
  await page.click("#drop");
  await page.until('document.querySelectorAll("#texts tbody tr").length === 3');
  assert.equal(await page.value(isChanged), false);
  await page.click(field);
  await page.key("End");
  await page.type("?");
  await page.key("s", "control");
  await page.until('document.getElementById("save").disabled');
  assert.ok((await project.read(FILE)).includes('"Mayor??'), "Ctrl+S saves what is being typed");
  await page.type("x");
  await page.key("Escape");
  assert.equal(await page.value(isChanged), false, "Escape takes it back");
});

test("after saving, the page follows the file, and a conflict shows all that is overwritten", { timeout: TIMEOUT_MS }, async (t) => {
  const project = await Project.small();
  const page = await opened(t, project);
  const field = '[data-name="text_en-us"][data-at="0"]';
  await page.click(field);
  await page.key("a", "control");
  await page.type("Well, my mayor?");
  await page.key("Enter");
  await page.key("s", "control");
  await page.until('document.getElementById("save").disabled');
  const saved = await project.read(FILE);
  assert.ok(saved.includes('"Well, my mayor?|'), saved);
  assert.equal(await page.value("preview.then(({ player }) => player.isChanged)"), false, "aligned is not changed");
  const theirs = saved.replace("Well, my mayor?", "Good morning?");
  await project.write(FILE, theirs);
  await page.until(`${text("subtitle")} === "Good morning?"`);
  await page.value('document.getElementById("shapes").focus()');
  await page.key("E");
  await page.until('!document.getElementById("save").disabled');
  await project.write(FILE, theirs.replace("Good morning?", "Good evening?"));
  await page.key("s", "control");
  await page.until('!document.getElementById("conflict").hidden');
  assert.ok(!(await page.value(text("yours"))).includes("mayor?\""), "the text is saved, and no change of mine");
  await page.click("#again");
  await page.until('document.getElementById("conflict").hidden && !document.getElementById("save").disabled');
  await page.key("s", "control");
  await page.until('document.getElementById("save").disabled');
  const both = await project.read(FILE);
  assert.ok(both.includes("Good evening?") && both.includes('"EAAAEO'), both);
});

test("a click on a shape goes there, and the keys of playback play", { timeout: TIMEOUT_MS }, async (t) => {
  const project = await Project.small();
  const page = await opened(t, project);
  const frames = "preview.then(async ({ player }) => (await player.settled, player.clip.frames))";
  await page.click("#shapes .shape:nth-of-type(4)");
  await page.until(`${time}.then((time) => time > 0.1)`);
  assert.equal(await page.value('document.activeElement.id'), "shapes");
  await page.key("l");
  await page.until("preview.then(({ player }) => player.clock.playing)");
  await page.key("k");
  await page.key("o");
  assert.equal(await page.value('document.getElementById("loop").ariaPressed'), "true");
  assert.equal(await page.value(frames), "MAAAEO--MAAEEO------", "they type nothing");
  await page.key("Home");
  await page.key("L");
  await page.until(`${frames}.then((frames) => frames === "LAAAEO--MAAEEO------")`);
});

test("a new segment divides all texts, and a saved file is right", { timeout: TIMEOUT_MS }, async (t) => {
  const clip = '{ "visemes": "----MAEOMAEOMAEOMAEO----", "text_en-us": "Yes, I was {sad} there all along.", "text_de-de": "Ja, ich war die ganze Zeit da.", "text_fr-fr": "Oui, j\'étais là.", "events": "mara feels joy", "fps": 24, "viseme_type": "blair" }\n';
  const project = await Project.make({ "lipz.toml": 'sources = ["voices"]\ndefault-locale = "en-us"\n', "voices/a.lipz": clip });
  const page = await opened(t, project);
  for (let frame = 0; frame < 12; frame++) await page.key("ArrowRight");
  await page.value('document.getElementById("shapes").focus()');
  await page.key("|");
  await page.until("preview.then(async ({ player }) => (await player.settled, player.clip.segments.length === 2))");
  const reviewed = await page.value(text("divided"));
  assert.ok(reviewed.includes("text_fr-fr (segments 1, 2)"), `also of locales that are not shown: ${reviewed}`);
  await page.click("#undo");
  await page.until("preview.then(async ({ player }) => (await player.settled, player.clip.segments.length === 1))");
  assert.equal(await page.value(text("divided")), "", "nothing is divided");
  await page.click("#redo");
  await page.until("preview.then(async ({ player }) => (await player.settled, player.clip.segments.length === 2))");
  assert.equal(await page.value(text("divided")), reviewed);
  assert.equal(await page.value('document.querySelectorAll("#texts textarea.review").length'), 4);
  await page.click('[data-name="text_de-de"][data-at="1"]');
  assert.equal(await page.value('document.querySelectorAll("#texts textarea.review").length'), 3, "it was looked at");
  await page.key("s", "control");
  await page.until('document.getElementById("save").disabled');
  const file = JSON.parse(await project.read("voices/a.lipz"));
  assert.deepEqual(
    [file["text_en-us"], file["text_de-de"], file["text_fr-fr"], file.events].map((text) => text.split("|").map((part) => part.trim())),
    [["Yes, I was {sad} there", "all along."], ["Ja, ich war die", "ganze Zeit da."], ["Oui,", "j'étais là."], ["mara feels joy", ""]],
  );
  await page.value('document.getElementById("shapes").focus()');
  await page.key("|");
  await page.until("preview.then(async ({ player }) => (await player.settled, player.clip.segments.length === 1))");
  await page.key("s", "control");
  await page.until('document.getElementById("save").disabled');
  assert.equal(await page.value(text("divided")), "", "a single segment has the whole text");
  const again = JSON.parse(await project.read("voices/a.lipz"));
  assert.deepEqual([again["text_en-us"], again.events], ["Yes, I was {sad} there all along.", "mara feels joy"]);
  assert.deepEqual(page.complaints, []);
});

test("a new segment starts at a word of the recording", { timeout: TIMEOUT_MS }, async (t) => {
  const project = await Project.make({ "lipz.toml": SETTINGS, "voices/bobby.lipz": '{ "text_en-us": "Bobby ripped the ledger." }\n', "recordings/bobby.wav": await readFile(BOBBY) });
  assert.equal(spawnSync(process.env.LIPZ, ["sync"], { cwd: project.folder }).status, 0);
  // An emotion that was added after the lip sync goes with its word.
  const synced = await project.read("voices/bobby.lipz");
  await project.write("voices/bobby.lipz", synced.replace("ripped", "{anger 6} ripped"));
  const page = await opened(t, project);
  assert.equal(await page.value('[...document.querySelectorAll("#words .word")].map(({ textContent }) => textContent).join()'), "Bobby,ripped,the,ledger", "words keep their times");
  await page.value('preview.then(({ player }) => player.seek([...document.querySelectorAll("#words .word")][1].start + 0.02))');
  await page.value('document.getElementById("shapes").focus()');
  await page.key("|");
  await page.until("preview.then(async ({ player }) => (await player.settled, player.clip.segments.length === 2))");
  await page.value('preview.then(({ player }) => player.seek([...document.querySelectorAll("#words .word")][3].start + 0.02))');
  await page.value('document.getElementById("shapes").focus()');
  await page.key("|");
  await page.until("preview.then(async ({ player }) => (await player.settled, player.clip.segments.length === 3))");
  assert.equal(await page.value(text("divided")), "", "nothing to review");
  await page.key("s", "control");
  await page.until('document.getElementById("save").disabled');
  const file = JSON.parse(await project.read("voices/bobby.lipz"));
  assert.deepEqual(file["text_en-us"].split("|").map((part) => part.trim()), ["Bobby", "{anger 6} ripped the", "ledger."]);
});

test("a clip whose key has spaces is opened, played and saved", { timeout: TIMEOUT_MS }, async (t) => {
  const clip = (name) => `{ "visemes": "MAEO", "text_en-us": "${name}", "fps": 24, "viseme_type": "blair" }\n`;
  const project = await Project.make({ "lipz.toml": SETTINGS, "voices/a b.lipz": clip("with a space"), "voices/a+b.lipz": clip("with a sign") });
  const page = await opened(t, project);
  assert.equal(await page.value(text("subtitle")), "with a space");
  await page.value('document.getElementById("shapes").focus()');
  await page.key("E");
  await page.until('!document.getElementById("save").disabled');
  await page.key("s", "control");
  await page.until('document.getElementById("save").disabled');
  assert.ok((await project.read("voices/a b.lipz")).includes("EAEO"));
  assert.equal(await project.read("voices/a+b.lipz"), clip("with a sign"));
});

test("a clip of ten minutes has elements only for visible shapes", { timeout: TIMEOUT_MS }, async (t) => {
  const line = Array.from({ length: 300 }, (_, at) => `Good evening, Otto ${at + 1}, how are you today?`).join("|");
  const visemes = Array.from({ length: 300 }, () => "MAEO".repeat(12)).join("|");
  const file = JSON.stringify({ visemes, "text_en-us": line, "text_de-de": line, fps: 24, viseme_type: "blair" });
  const project = await Project.make({ "lipz.toml": SETTINGS, "voices/long.lipz": `${file}\n` });
  const page = await opened(t, project);
  await page.value('document.getElementById("shapes").focus()');
  await page.value("globalThis.passed = undefined");
  await page.value(`(document.getElementById("shapes").addEventListener("keydown", () => {
    globalThis.began = performance.now();
    preview.then(({ player }) => setTimeout(() => player.settled.then(() => (globalThis.passed = performance.now() - globalThis.began))));
  }, { capture: true, once: true }), true)`);
  await page.key("E");
  await page.until("globalThis.passed !== undefined");
  t.diagnostic(`a code was drawn ${Math.round(await page.value("globalThis.passed"))} ms after its key`);
  assert.ok((await page.value('document.querySelectorAll("#shapes > *").length')) < 2000, "shapes are made where they are seen");
});

test("codes are those of the file, whatever the bank has", { timeout: TIMEOUT_MS }, async (t) => {
  const page = await opened(t, await Project.small(), ["--config", "viseme-type=toonboom"]);
  await page.value('document.getElementById("shapes").focus()');
  await page.key("G");
  await page.key("O");
  await page.until(`preview.then(async ({ player }) => (await player.settled, player.isChanged))`);
  assert.equal(await page.value('document.querySelector("#shapes .shape").textContent'), "O", "`G` is no code of the file");
  assert.ok(!(await page.value(text("problems"))).includes("LZ0401"));
});

test("texts are searched, too, and settings with mistakes are told", { timeout: TIMEOUT_MS }, async (t) => {
  const project = await Project.small();
  const page = await opened(t, project);
  await page.key("/");
  await page.type("meister otto");
  await page.until(`${text("count")} === "0 of 3 clips"`);
  await page.value('document.getElementById("search").value = ""');
  await page.type("MEISTER");
  await page.until(`${text("count")} === "1 of 3 clips"`);
  await project.write("lipz.toml", 'sources = ["voices"]\nfancy = 1\n');
  await page.until(`${text("notice")}.includes("fancy")`);
  await project.write("lipz.toml", 'sources = ["voices"]\n');
  await page.until('document.getElementById("notice").hidden');
  await page.value('document.getElementById("search").value = ""');
  await project.remove(FILE);
  await page.until(`${text("notice")}.includes("act1/mayor no longer exists")`);
  await page.type("otto");
  await page.click('[data-key="act1/otto"]');
  await page.until(`${text("key")} === "act1/otto" && document.getElementById("notice").hidden`);
});

test("20,000 clips are listed and searched at once", { timeout: TIMEOUT_MS }, async (t) => {
  const page = await opened(t, await Project.large(20_000));
  assert.equal(await page.value(text("count")), "20,000 clips");
  const rows = 'document.querySelectorAll("#list .row").length';
  assert.ok((await page.value(rows)) < 100, "rows are made where they are seen");
  await page.value('document.getElementById("list").scrollTop = 1e9');
  await page.until('document.querySelector("#list .row:last-child").ariaPosInSet === "20000"');
  await page.key("/");
  await page.type("line-19999");
  await page.until(`${text("count")} === "1 of 20,000 clips"`);
  await page.value('document.getElementById("search").value = ""');
  await page.type("evening, Otto 1999");
  await page.until(`${text("count")} === "12 of 20,000 clips"`);
  const shown = await page.value("preview.then(({ shown }) => Math.round(shown))");
  t.diagnostic(`the first clip was shown ${shown} ms after the page was asked for`);
});

test("a clip of `lipz new` gets a mouth by typing", { timeout: TIMEOUT_MS }, async (t) => {
  const project = await Project.make({ "lipz.toml": 'sources = ["voices"]\ndefault-locale = "en-us"\n' });
  spawnSync(process.env.LIPZ, ["new", "aye", "Aye.|No."], { cwd: project.folder });
  const page = await opened(t, project);
  assert.equal(await page.value(text("subtitle")), "Aye.", "what is to be said is seen");
  await page.value('document.getElementById("shapes").focus()');
  const drawn = (frames) => page.until(`preview.then(async ({ player }) => (await player.settled, player.clip.frames === "${frames}"))`);
  for (const code of ["M", "A", "|", "E", "E", "O"]) await page.key(code);
  await drawn("MAEEO");
  await page.key("Backspace");
  await drawn("MAEE");
  assert.equal(await page.value("preview.then(({ player }) => player.clip.segment(1).startFrame)"), 2);
  await page.key("-");
  await drawn("MAEE-");
  await page.key("s", "control");
  await page.until('document.getElementById("save").disabled');
  const file = await project.read("voices/aye.lipz");
  assert.match(file, /^\{\n {2}"visemes" : +"MA *\|EE-",\n {2}"text_en-us" : "Aye\.\|No\."/, file);
  assert.deepEqual(page.complaints, []);
});

test("the phones of a clip that was synced come when it is looked at", { timeout: TIMEOUT_MS }, async (t) => {
  const project = await Project.make({ "lipz.toml": SETTINGS, "voices/bobby.lipz": '{ "text_en-us": "Bobby ripped the ledger." }\n', "recordings/bobby.wav": await readFile(BOBBY) });
  const { status, stderr } = spawnSync(process.env.LIPZ, ["sync"], { cwd: project.folder, encoding: "utf8" });
  assert.equal(status, 0, stderr);
  const page = await opened(t, project);
  const row = '[...document.querySelectorAll("#phones .phone")]';
  await page.until(`!document.getElementById("phones").hidden && ${row}.length > 10`);
  assert.deepEqual((await page.value(`${row}.map(({ textContent }) => textContent)`)).slice(0, 4), ["B", "AA", "B", "IY"]);
  const rights = '(id) => Math.max(...[...document.querySelectorAll(id)].map((part) => part.getBoundingClientRect().right))';
  assert.ok(Math.abs(await page.value(`(${rights})("#phones .phone") - (${rights})("#words .word")`)) < 3, "the last word ends with its last phone");
  assert.deepEqual(page.complaints, []);
});

test("an address leads to a clip and a moment", { timeout: TIMEOUT_MS }, async (t) => {
  const page = await opened(t, await Project.small(), [], "#clip=act1/mayor&at=0.25");
  assert.equal(await page.value(time), 0.25);
  await page.key("ArrowRight");
  await page.value('document.getElementById("link").click()');
  await page.until(`${text("linked")} !== ""`);
  assert.equal(await page.value("location.hash"), "#clip=act1/mayor&at=0.292", "the start of the frame, not before it");
  await page.value('location.hash = "#clip=act1/otto&at=0.1"');
  await page.until(`${text("key")} === "act1/otto"`);
  await page.until(`${time}.then((time) => time === 0.1)`);
});

test("what must not be written cannot be edited", { timeout: TIMEOUT_MS }, async (t) => {
  const page = await opened(t, await Project.small(), ["--read-only"]);
  assert.equal(await page.value('document.getElementById("edits").hidden'), true);
  await page.value('document.getElementById("shapes").focus()');
  await page.key("E");
  assert.ok((await page.value("preview.then(({ player }) => player.clip.frames)")).startsWith("M"));
  assert.equal(await page.value('document.querySelector("#texts textarea").readOnly'), true);
});

test("an exported page plays from a disk, without a server", { timeout: TIMEOUT_MS }, async (t) => {
  const project = await Project.small();
  t.after(() => project.end());
  const { status, stderr } = spawnSync(process.env.LIPZ, ["preview", "--output", "site"], { cwd: project.folder, encoding: "utf8" });
  assert.equal(status, 1, `one of the clips has an error, which is told: ${stderr}`);
  assert.ok(stderr.includes("LZ0601"), stderr);
  const browser = await Browser.start();
  t.after(() => browser.end());
  const page = await browser.open(`file://${project.folder}/site/index.html`);
  await page.until(READY);
  assert.equal(await page.value(text("count")), "3 clips");
  assert.equal(await page.value(text("subtitle")), "Mayor?");
  await page.key(" ");
  await page.until(`preview.then(({ player }) => ${SOUNDS} && player.clock.time > 0.1)`);
  assert.equal(await page.value('document.getElementById("edits").hidden'), true);
  assert.deepEqual(page.complaints, []);
});
