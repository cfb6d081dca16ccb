//! The page of `lipz preview` in Chromium: `preview_page/page.test.js` uses it like a person, and
//! `preview_page/accessibility.test.js` checks it with axe.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::process::{Command, Stdio};
use support::repository;

/// Whether a program can be started.
fn has_program(name: &str) -> bool {
    Command::new(name).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok()
}

/// Runs these tests in node if the required programs are installed.
fn pass(name: &str, is_there: bool, what_is_needed: &str) {
    if !is_there || !has_program("node") || !has_program("chromium") {
        assert!(std::env::var_os("LIPZ_TOOLS").is_none(), "needs {what_is_needed}");
        eprintln!("skipped: {what_is_needed} are not on this machine");
        return;
    }
    let test = repository().join("crates/lipz/tests/preview_page").join(name);
    let mut node = Command::new("node");
    node.args(["--test", "--test-reporter=spec"]).arg(test).env("LIPZ", env!("CARGO_BIN_EXE_lipz"));
    let output = node.output().unwrap();
    let told = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{told}");
    assert!(told.contains("tests ") && !told.contains("tests 0"), "{told}");
}

#[test]
fn the_page_does_what_it_says() {
    pass("page.test.js", true, "node and chromium, which `.ci/install` brings");
}

#[test]
fn the_page_keeps_nobody_out() {
    let axe = repository().join("crates/lipz/tests/preview_page/node_modules/axe-core");
    pass("accessibility.test.js", axe.is_dir(), "node, chromium, and axe, which `cargo xtask accessibility` brings,");
}
