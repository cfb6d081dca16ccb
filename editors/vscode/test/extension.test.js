// What is packed: whatever its manifest names is there, and the extension, in a stand-in for the editor, starts the program that
// its settings name and speaks with it. LIPZ names the program.

const assert = require("node:assert");
const { existsSync, readFileSync } = require("node:fs");
const { Module } = require("node:module");
const { join } = require("node:path");
const test = require("node:test");
const { CancellationTokenSource, Editor, Position } = require("./vscode.js");

const FOLDER = join(__dirname, "..");
const manifest = JSON.parse(readFileSync(join(FOLDER, "package.json"), "utf8"));

test("what the manifest names is there", () => {
  const { languages, grammars } = manifest.contributes;
  const paths = [manifest.main, ...languages.map(({ configuration }) => configuration), ...grammars.map(({ path }) => path)];
  for (const path of paths) assert.ok(existsSync(join(FOLDER, path)), path);
  for (const { path } of grammars) assert.equal(JSON.parse(readFileSync(join(FOLDER, path))).scopeName, grammars[0].scopeName);
  assert.deepEqual(languages[0].extensions, [".lipz"]);
});

/** The extension, activated in an editor with these settings. */
async function activated(settings) {
  const editor = new Editor(settings);
  const load = Module._load;
  Module._load = (name, ...rest) => (name === "vscode" ? editor.vscode : load(name, ...rest));
  const file = require.resolve(join(FOLDER, manifest.main));
  delete require.cache[file];
  const extension = require(file);
  const context = { subscriptions: [] };
  await extension.activate(context);
  Module._load = load;
  return { editor, extension, context };
}

test("the extension is activated, and says when the program is missing", async () => {
  const { editor, extension, context } = await activated({ command: "no-such-program-lipz" });
  assert.deepEqual(editor.registered, manifest.contributes.commands.map(({ command }) => command));
  assert.equal(context.subscriptions.length, 2);
  assert.match(editor.shown.join(), /cannot be run: .*no-such-program-lipz/);
  await extension.deactivate();
});

// The client that is packed speaks with the program that is built, as it does in the editor.
test("the program answers the extension", { skip: !process.env.LIPZ && "LIPZ names no program", timeout: 60_000 }, async () => {
  const { editor, extension } = await activated({ command: process.env.LIPZ });
  assert.deepEqual(editor.shown, []);
  const text = '{\n"visemes": "MA EO", "viseme_type": "blair",\n"fps": 10, "text_en-us": "𝄞 Ma", "events": "feels "\n}\n';
  const document = await editor.open("/project/a.lipz", text);
  const codes = (found) => found.map(({ code }) => code.value ?? code);
  const [blank] = await editor.diagnosed(document, (found) => codes(found).includes("LZ0402"));
  assert.equal(blank.source, "lipz");
  const ask = (kind, method, ...args) => editor.providers.get(kind)[method](document, ...args, new CancellationTokenSource().token, {});
  const hover = await ask("Hover", "provideHover", new Position(1, 16));
  assert.match(hover.contents.value, /!\[the mouth\]\(data:image.*frame 3, 0.300 s/s);
  const offers = await ask("CompletionItem", "provideCompletionItems", new Position(2, 51));
  const labels = (offers.items ?? offers).map(({ label }) => label);
  assert.ok(labels.includes("happy") && labels.includes("anger"), String(labels));
  const symbols = await ask("DocumentSymbol", "provideDocumentSymbols");
  assert.deepEqual(symbols.map(({ name }) => name), ["visemes", "viseme_type", "fps", "text_en-us", "events"]);
  await editor.type(document, 1, 14, 15, "A");
  await editor.diagnosed(document, (found) => !codes(found).includes("LZ0402"));
  const [edit] = await ask("DocumentFormattingEdit", "provideDocumentFormattingEdits", { tabSize: 2, insertSpaces: true });
  assert.match(edit.newText, /^ {2}"visemes" : +"MAAEO"/);
  await extension.deactivate();
});
