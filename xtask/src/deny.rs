//! `cargo xtask deny`: checks licences and sources of all dependencies against the rules of `deny.toml`.
//!
//! Known vulnerabilities are not checked here, because their database is on the network. A job of
//! `.github/workflows/ci.yml` checks them, also once a week.

use crate::Failure;
use crate::paths::{target_folder, workspace_root};
use crate::tools::{has_program, skip, succeed};
use std::process::Command;

pub(crate) fn run() -> Result<(), Failure> {
    // In the folder of `.ci/install`, or on the path.
    let installed = target_folder().join("tools/bin/cargo-deny").display().to_string();
    let Some(deny) = [installed.as_str(), "cargo-deny"].into_iter().find(|program| has_program(program)) else {
        return skip("`cargo install --locked cargo-deny`");
    };
    let mut check = Command::new(deny);
    check.args(["--locked", "check", "--hide-inclusion-graph", "licenses", "bans", "sources"]);
    succeed(check.current_dir(workspace_root()), "cargo deny check")
}
