//! The page of `lipz preview` in Chromium: `preview_page/page.test.js` uses it as people do.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::process::{Command, Stdio};
use support::repository;

/// Whether a program can be started.
fn has_program(name: &str) -> bool {
    Command::new(name).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok()
}

#[test]
fn the_page_does_what_it_says() {
    if !has_program("node") || !has_program("chromium") {
        assert!(std::env::var_os("LIPZ_TOOLS").is_none(), "needs node and chromium, which `.ci/install` brings");
        eprintln!("skipped: node and chromium are not on this machine");
        return;
    }
    let test = repository().join("crates/lipz/tests/preview_page/page.test.js");
    let mut node = Command::new("node");
    node.args(["--test", "--test-reporter=spec"]).arg(test).env("LIPZ", env!("CARGO_BIN_EXE_lipz"));
    let output = node.output().unwrap();
    let told = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{told}");
    assert!(told.contains("tests ") && !told.contains("tests 0"), "{told}");
}
