//! `cargo xtask deny`: licences and sources of all dependencies, by the rules of `deny.toml`.
//!
//! Known vulnerabilities are not checked here, because their database is on the network: a job of
//! `.github/workflows/ci.yml` does that, every week too.

use crate::Failure;
use crate::paths::{target_folder, workspace_root};
use crate::tools::{has_program, skip, succeed};
use std::process::Command;

pub(crate) fn run() -> Result<(), Failure> {
    // Where `.ci/install` puts it, or on the path.
    let installed = target_folder().join("tools/bin/cargo-deny").display().to_string();
    let Some(deny) = [installed.as_str(), "cargo-deny"].into_iter().find(|program| has_program(program)) else {
        return skip("`cargo install --locked cargo-deny`");
    };
    let mut check = Command::new(deny);
    check.args(["--locked", "check", "--hide-inclusion-graph", "licenses", "bans", "sources"]);
    succeed(check.current_dir(workspace_root()), "cargo deny check")
}
