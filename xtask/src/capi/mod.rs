//! `cargo xtask capi`: builds the libraries for C, installs them below `target/capi`, and runs programs in C and C++
//! with them. The examples and the playback cases run plainly, under valgrind, and with sanitizers.
//!
//! The libraries do not link if a panic is reachable (see `crates/lipz-capi/src/panic.rs`).

mod cases;
pub(crate) mod install;
pub(crate) mod programs;

pub(crate) use cases::layouts;

use crate::cargo;
use crate::tools::{has_program, skip, skip_rest, succeed};
use crate::{Failure, paths};
use std::path::Path;

/// The tools for the programs. The libraries only need Rust.
const TOOLS: [&str; 6] = ["cc", "c++", "cmake", "make", "pkg-config", "valgrind"];

pub(crate) fn run() -> Result<(), Failure> {
    if !cfg!(target_os = "linux") {
        return skip("Linux, for the names of the libraries");
    }
    let target = std::path::absolute(paths::target_folder()).map_err(|error| error.to_string())?;
    build(&target)?;
    let prefix = target.join("capi");
    let names = install::Names::of("x86_64-unknown-linux-gnu");
    install::install(&install::files(&target.join("library"), &names)?, &prefix)?;
    println!("installed below {}", prefix.display());
    match TOOLS.iter().find(|tool| !has_program(tool)) {
        Some(tool) => skip_rest(tool),
        None => programs::run(&prefix).and_then(|()| cases::run(&prefix)),
    }
}

/// Builds the static and the shared library.
fn build(target: &Path) -> Result<(), Failure> {
    succeed(
        cargo::command()
            .args(["rustc", "--package", "lipz-capi", "--lib", "--profile", "library", "--locked", "--quiet"])
            .args(["--features", "panic-handler", "--crate-type", "staticlib,cdylib", "--target-dir"])
            .arg(target)
            .args(["--", "-C", &install::soname_argument()]),
        "the build of the libraries",
    )
}
