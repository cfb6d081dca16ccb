//! `cargo xtask features`: each feature of the compiler by itself, and how many crates a build script needs.

use crate::Failure;
use crate::cargo;
use std::collections::BTreeSet;

const CRATE: &str = "lipz-compiler";

/// The features of the manifest, all but `full`, which the workspace builds.
const FEATURES: [&str; 10] =
    ["build", "cache", "diff", "ids", "inspect", "json", "parallel", "settings", "stats", "unpack"];

/// Crates that a build script compiles with the features that are on by default, with the compiler itself and
/// those of this project.
const MOST_CRATES: usize = 33;

pub(crate) fn run() -> Result<(), Failure> {
    check(&[])?;
    for feature in FEATURES {
        check(&["--features", feature])?;
    }
    let text =
        cargo::output(&["tree", "--locked", "-p", CRATE, "-e", "normal", "--prefix", "none", "--format", "{p}"])?;
    let crates: BTreeSet<_> = text.lines().map(|line| line.trim_end_matches(" (*)")).collect();
    println!("{} of at most {MOST_CRATES} crates are compiled for a build script", crates.len());
    match crates.len() {
        0 => Err("cargo tree shows no crates".to_owned()),
        count if count > MOST_CRATES => Err(format!("{count} crates: switch on by a feature what few need")),
        _ => Ok(()),
    }
}

/// Checks the library with these features only; what is unused without the others is an error, too.
fn check(features: &[&str]) -> Result<(), Failure> {
    let mut check = cargo::command();
    check.args(["clippy", "--quiet", "--locked", "-p", CRATE, "--no-default-features"]).args(features);
    check.args(["--", "-D", "warnings"]);
    println!("features: {}", features.last().unwrap_or(&"none"));
    match check.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(_) => Err(format!("{CRATE} does not compile with {}", features.last().unwrap_or(&"no features"))),
        Err(error) => Err(format!("cargo cannot run: {error}")),
    }
}
