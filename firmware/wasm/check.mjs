// Runs the module on a bank and its expected answers: node check.mjs MODULE BANK ANSWERS
import { readFileSync } from "node:fs";

const REFUSED = 0xffff_ffff;
const PAGE_BYTES = 65_536;
const [wasm, bank, answers] = process.argv.slice(2).map((path) => readFileSync(path));

const module = new WebAssembly.Module(wasm);
const imports = WebAssembly.Module.imports(module);
if (imports.length !== 0) {
  throw new Error(`the module imports ${imports.map((each) => each.name).join(", ")}`);
}
const { memory, check } = new WebAssembly.Instance(module).exports;
const start = memory.buffer.byteLength;
memory.grow(Math.ceil((bank.length + answers.length) / PAGE_BYTES));
const bytes = new Uint8Array(memory.buffer);
bytes.set(bank, start);
bytes.set(answers, start + bank.length);

const result = check(start, bank.length, start + bank.length, answers.length) >>> 0;
if (result === REFUSED) {
  console.log("refused");
} else if (result !== 0) {
  console.log(`answer ${result} differs; expected: ${answers.toString().split("\n")[result - 1]}`);
} else {
  console.log(`${wasm.length} bytes of wasm give the expected answers`);
}
process.exitCode = result === 0 ? 0 : 1;
