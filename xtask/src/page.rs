//! What is done with the page of `lipz preview` in browsers by hand: `cargo xtask firefox` uses it in Firefox as its test does
//! in Chromium, `cargo xtask first-picture` measures how soon a large project is seen.

use crate::Failure;
use crate::cargo;
use crate::paths::workspace_root;
use crate::tools::{has_program, skip, succeed};
use std::path::PathBuf;
use std::process::Command;

/// Where the test and what drives browsers are.
const FOLDER: &str = "crates/lipz/tests/preview_page";

pub(crate) fn firefox() -> Result<(), Failure> {
    if !has_program("firefox") {
        return skip("firefox");
    }
    // Its driver speaks over a socket, which node has without a flag from version 22 on.
    let mut test = node(cargo::lipz()?)?;
    test.args(["--experimental-websocket", "--test", "--test-reporter=spec", "page.test.js"]).env("BROWSER", "firefox");
    succeed(&mut test, "the test of the page")
}

pub(crate) fn first_picture() -> Result<(), Failure> {
    if !has_program("chromium") {
        return skip("chromium");
    }
    succeed(node(cargo::lipz_release()?)?.arg("first_picture.js"), "the measurement")
}

/// Node, which finds this command.
fn node(lipz: PathBuf) -> Result<Command, Failure> {
    if !has_program("node") {
        return Err("needs node, 20 or later".to_owned());
    }
    let mut node = Command::new("node");
    node.current_dir(workspace_root().join(FOLDER)).env("LIPZ", lipz);
    Ok(node)
}
