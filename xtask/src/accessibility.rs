//! `cargo xtask accessibility`: axe looks at the page of `lipz preview` in Chromium.

use crate::Failure;
use crate::cargo;
use crate::paths::workspace_root;
use crate::tools::{has_program, skip, succeed};
use std::process::Command;

/// Where npm brings axe, beside the tests that use it.
const FOLDER: &str = "crates/lipz/tests/preview_page";

pub(crate) fn run() -> Result<(), Failure> {
    for program in ["npm", "chromium"] {
        if !has_program(program) {
            return skip(program);
        }
    }
    let mut npm = Command::new("npm");
    npm.args(["ci", "--no-audit", "--silent"]).current_dir(workspace_root().join(FOLDER));
    succeed(&mut npm, "npm ci")?;
    let mut tests = cargo::tests("preview_page");
    // What needs no axe is among the tests of the workspace.
    tests.args(["--", "the_page_keeps_nobody_out"]).env("LIPZ_TOOLS", "required");
    succeed(&mut tests, "the tests of the page")
}
