//! `cargo xtask compare`: the reader beside its rivals.
//!
//! The program that compares is a workspace of its own, `benches/compare`, so that the rivals are
//! compiled only here.

use crate::{Failure, ci, needs, place};
use clap::Args;
use std::ffi::OsString;

/// What the program is asked for.
#[derive(Args, Debug)]
#[command(disable_help_flag = true)]
pub(crate) struct Settings {
    /// Arguments of the program; `--help` lists them
    #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
    arguments: Vec<OsString>,
}

pub(crate) fn run(settings: &Settings) -> Result<(), Failure> {
    let mut cargo = ci::cargo_command();
    cargo.args(["run", "--release", "--quiet", "--locked", "--manifest-path"]);
    cargo.arg(place::workspace_root().join("benches/compare/Cargo.toml")).arg("--").args(&settings.arguments);
    needs::succeed(&mut cargo, "the comparison")
}
