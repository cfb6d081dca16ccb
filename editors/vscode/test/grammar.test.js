// The colours of Lipz files, by the engine that Visual Studio Code has.

const assert = require("node:assert");
const { readFile } = require("node:fs/promises");
const { join } = require("node:path");
const test = require("node:test");
const oniguruma = require("vscode-oniguruma");
const { INITIAL, parseRawGrammar, Registry } = require("vscode-textmate");

const FOLDER = join(__dirname, "..");

async function grammar() {
  const wasm = await readFile(require.resolve("vscode-oniguruma/release/onig.wasm"));
  await oniguruma.loadWASM(wasm);
  const path = join(FOLDER, "syntaxes/lipz.tmLanguage.json");
  const registry = new Registry({
    onigLib: Promise.resolve({
      createOnigScanner: (sources) => new oniguruma.OnigScanner(sources),
      createOnigString: (text) => new oniguruma.OnigString(text),
    }),
    loadGrammar: async () => parseRawGrammar(await readFile(path, "utf8"), path),
  });
  return registry.loadGrammar("source.lipz");
}

test("each part of a Lipz file has its colour", async () => {
  const lines = [
    '{ "visemes": "MA-|E", "fps": 24,',
    '"events": "mara points door|feels sad|nods 4, otto looks away",',
    '"text_en-us": "Hi {softly}\\n|there", "x": "a|b", "open": "',
    '"viseme_type": "blair" }',
  ];
  const expected = [
    ["M", "constant.character.viseme.lipz"],
    ["-", "comment.rest.lipz"],
    ["|", "keyword.operator.segment.lipz"],
    ["24", "constant.numeric.lipz"],
    ["points", "keyword.control.verb.lipz"],
    ["nods", "keyword.control.verb.lipz"],
    ["looks away", "keyword.control.verb.lipz"],
    ["{softly}", "comment.block.meta.lipz"],
    ["\\n", "constant.character.escape.lipz"],
    ["a|b", "string.quoted.double.lipz"],
    ['"viseme_type"', "support.type.property-name.lipz"],
    ["blair", "string.quoted.double.lipz"],
  ];
  const found = [];
  const loaded = await grammar();
  let state = INITIAL;
  for (const line of lines) {
    const { tokens, ruleStack } = loaded.tokenizeLine(line, state);
    state = ruleStack;
    for (const { startIndex, endIndex, scopes } of tokens) found.push([line.slice(startIndex, endIndex), scopes.at(-1)]);
  }
  for (const [text, scope] of expected) {
    const scopes = found.filter(([token]) => token === text).map(([, scope]) => scope);
    assert.ok(scopes.includes(scope), `${text}: ${scopes.join(", ")} instead of ${scope}`);
  }
});
