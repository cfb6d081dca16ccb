//! `cargo xtask accessibility`: the page of `lipz preview` is used in Chromium, and axe looks at it.

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
    succeed(cargo::tests("preview_page").env("LIPZ_TOOLS", "required"), "the tests of the page")
}
