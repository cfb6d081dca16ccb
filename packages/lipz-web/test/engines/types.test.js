// The type declarations of the installed package.

import { spawnSync } from "node:child_process";
import assert from "node:assert/strict";
import { test } from "node:test";
import { fileURLToPath } from "node:url";

const COMPILER = fileURLToPath(new URL("../node_modules/typescript/bin/tsc", import.meta.url));
const SETTINGS =
  "--noEmit --strict --noUncheckedIndexedAccess --target esnext --module nodenext --lib esnext,dom".split(" ");

test("programs in TypeScript use the package", () => {
  const cwd = fileURLToPath(new URL(".", import.meta.url));
  const { status, stdout } = spawnSync("node", [COMPILER, ...SETTINGS, "types.ts"], { cwd, encoding: "utf8" });
  assert.equal(status, 0, stdout);
});
