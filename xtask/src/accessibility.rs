//! `cargo xtask accessibility`: checks the page of `lipz preview` with axe in Chromium.

use crate::Failure;
use crate::cargo;
use crate::paths::workspace_root;
use crate::tools::{has_program, skip, succeed};
use std::process::Command;

/// The folder in which npm installs axe, next to the tests that use it.
const FOLDER: &str = "crates/lipz/tests/preview_page";

/// The test of the page with axe.
const TEST: &str = "the_page_keeps_nobody_out";

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
    // The tests without axe are among those of the workspace.
    tests.args(["--", "--exact", TEST]).env("LIPZ_TOOLS", "required");
    succeed(&mut tests, "the tests of the page")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_test_is_there() {
        let file = workspace_root().join("crates/lipz/tests/preview_page.rs");
        let tests = std::fs::read_to_string(file).unwrap_or_default();
        assert!(tests.contains(&format!("#[test]\nfn {TEST}()")));
    }
}
