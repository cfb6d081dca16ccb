//! Tasks for the page of `lipz preview` in browsers. `cargo xtask firefox` runs its test in Firefox instead of
//! Chromium. `cargo xtask first-picture` measures how soon a large project is shown.

use crate::Failure;
use crate::cargo;
use crate::paths::workspace_root;
use crate::tools::{has_program, skip, succeed};
use std::path::PathBuf;
use std::process::Command;

/// The folder of the test and of the code that drives browsers.
const FOLDER: &str = "crates/lipz/tests/preview_page";

/// Tests of the page that use most of a browser: keys, pointers, drawing, audio, saving, a page on disk.
const MAIN: [&str; 4] = [
    "a clip is seen, heard and moved in with keys alone",
    "what is edited is drawn, undone, and saved as the file is laid out",
    "a file that has changed on disk is not overwritten",
    "an exported page plays from a disk, without a server",
];

/// The tests to run in Firefox.
#[derive(Debug, clap::Args)]
pub(crate) struct FirefoxSettings {
    /// Run only the main tests, because all of them take four times as long as in Chromium
    #[arg(long)]
    main: bool,
}

pub(crate) fn firefox(settings: &FirefoxSettings) -> Result<(), Failure> {
    if !has_program("firefox") {
        return skip("firefox");
    }
    // Its driver uses a WebSocket, which node supports without a flag since version 22.
    let mut test = node(cargo::lipz()?)?;
    test.args(["--experimental-websocket", "--test", "--test-reporter=spec"]).env("BROWSER", "firefox");
    if settings.main {
        test.args(MAIN.iter().map(|name| format!("--test-name-pattern=^{name}$")));
    }
    succeed(test.arg("page.test.js"), "the test of the page")
}

pub(crate) fn first_picture() -> Result<(), Failure> {
    if !has_program("chromium") {
        return skip("chromium");
    }
    succeed(node(cargo::lipz_release()?)?.arg("first_picture.js"), "the measurement")
}

/// Returns node with the path of this command in its environment.
fn node(lipz: PathBuf) -> Result<Command, Failure> {
    if !has_program("node") {
        return Err("needs node, 20 or later".to_owned());
    }
    let mut node = Command::new("node");
    node.current_dir(workspace_root().join(FOLDER)).env("LIPZ", lipz);
    Ok(node)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_main_tests_are_those_of_the_page() {
        let tests = std::fs::read_to_string(workspace_root().join(FOLDER).join("page.test.js"));
        let tests = tests.unwrap_or_default();
        for name in MAIN {
            assert_eq!(tests.matches(&format!("\ntest(\"{name}\", ")).count(), 1, "{name}");
        }
    }
}
