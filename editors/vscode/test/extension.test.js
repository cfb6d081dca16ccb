// What is packed: the extension activates in a stand-in for the editor, starts the program that its settings name, and
// whatever its manifest names is there.

const assert = require("node:assert");
const { existsSync, readFileSync } = require("node:fs");
const { Module } = require("node:module");
const { join } = require("node:path");
const test = require("node:test");

const FOLDER = join(__dirname, "..");
const manifest = JSON.parse(readFileSync(join(FOLDER, "package.json"), "utf8"));

test("what the manifest names is there", () => {
  const { languages, grammars } = manifest.contributes;
  const paths = [manifest.main, ...languages.map(({ configuration }) => configuration), ...grammars.map(({ path }) => path)];
  for (const path of paths) assert.ok(existsSync(join(FOLDER, path)), path);
  for (const { path } of grammars) assert.equal(JSON.parse(readFileSync(join(FOLDER, path))).scopeName, grammars[0].scopeName);
  assert.deepEqual(languages[0].extensions, [".lipz"]);
});

/** A stand-in for a part of the module `vscode`, which only the editor has: what is not known here does nothing. */
function standIn(known = {}) {
  const nothing = () => ({ dispose() {} });
  // What is written large is a class or a namespace, of which only names are asked.
  const other = (name) => (/^[A-Z]/.test(name) ? standIn(class {}) : nothing);
  return new Proxy(known, { get: (target, name) => (name in target || typeof name === "symbol" ? target[name] : other(name)) });
}

test("the extension is activated, and says when the program is missing", async () => {
  const [registered, shown] = [[], []];
  const vscode = standIn({
    version: "1.91.0",
    commands: standIn({ registerCommand: (name) => registered.push(name) }),
    languages: standIn(),
    window: standIn({
      showErrorMessage: async (message) => void shown.push(message),
      createOutputChannel: () => standIn(),
    }),
    workspace: standIn({
      getConfiguration: () => ({ get: (name, other) => (name === "command" ? "no-such-program-lipz" : other) }),
      workspaceFolders: undefined,
      textDocuments: [],
    }),
    EventEmitter: class {
      event = () => ({ dispose() {} });
      fire() {}
      dispose() {}
    },
    env: { language: "en", appName: "stand-in" },
  });
  const load = Module._load;
  Module._load = (name, ...rest) => (name === "vscode" ? vscode : load(name, ...rest));
  try {
    const extension = require(join(FOLDER, manifest.main));
    const context = { subscriptions: [] };
    await extension.activate(context);
    assert.deepEqual(registered, manifest.contributes.commands.map(({ command }) => command));
    assert.equal(context.subscriptions.length, 2);
    assert.match(shown.join(), /cannot be run: .*no-such-program-lipz/);
    await extension.deactivate();
  } finally {
    Module._load = load;
  }
});
