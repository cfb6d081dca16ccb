#!/usr/bin/env node
// Starts the program from the optional package for this machine.
"use strict";
const { spawn } = require("node:child_process");

const name = `@lipz/cli-${process.platform}-${process.arch}`;

function program() {
  const file = process.platform === "win32" ? "lipz.exe" : "lipz";
  try {
    return require.resolve(`${name}/bin/${file}`);
  } catch {
    console.error(
      `lipz: the package ${name} with the program is not installed

  * Supported machines are linux-x64, linux-arm64 (both with glibc), darwin-x64, darwin-arm64 and win32-x64.
  * If npm ran with --omit=optional or --no-optional, install lipz again without this option.
  * If node_modules was copied from a different machine, run npm ci here.

Other ways to install lipz:
  pip install lipz
  cargo binstall lipz
  cargo install --locked lipz`,
    );
    process.exit(1);
  }
}

const child = spawn(program(), process.argv.slice(2), { stdio: "inherit" });
// The terminal sends Ctrl-C to both processes. Other requests to end reach only this one.
process.on("SIGINT", () => {});
for (const signal of ["SIGTERM", "SIGHUP"]) {
  process.on(signal, () => child.kill(signal));
}
child.on("error", (error) => {
  console.error(`lipz: ${error.message}`);
  process.exit(1);
});
child.on("exit", (code, signal) => {
  if (signal === null) {
    process.exit(code);
  }
  process.removeAllListeners(signal);
  process.kill(process.pid, signal);
});
