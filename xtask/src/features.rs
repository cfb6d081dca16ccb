//! `cargo xtask features`: builds each feature of the libraries alone, checks that no feature of the compiler changes a
//! byte of a bank, and counts the crates of a build script.

use crate::Failure;
use crate::cargo;
use crate::forward::packing;
use crate::paths::{temporary_folder, workspace_root};
use crate::tools::succeed;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

const CRATE: &str = "lipz-compiler";

/// The features of its manifest, except `full`, which the workspace builds.
const FEATURES: [&str; 12] =
    ["build", "cache", "diff", "human", "ids", "inspect", "json", "parallel", "settings", "shards", "stats", "unpack"];

/// The maximal number of crates that a build script compiles with default features, including the compiler itself and
/// those of this project.
const MOST_CRATES: usize = 33;

/// The sources that are packed with all features and with none.
const SOURCES: &str = "fixtures/drama";

pub(crate) fn run() -> Result<(), Failure> {
    // Unused code without other features is also an error.
    let check = ["clippy", "--quiet", "--locked", "-p", CRATE, "--no-default-features"];
    for feature in [""].iter().chain(&FEATURES) {
        println!("{CRATE} with `{feature}`");
        cargo_run(&[&check[..], &["--features", feature, "--", "-D", "warnings"]].concat())?;
    }
    for feature in ["", "json"] {
        println!("tests of lipz-diagnostics with `{feature}`");
        let test = ["test", "--quiet", "--locked", "-p", "lipz-diagnostics", "--no-default-features"];
        cargo_run(&[&test[..], &["--features", feature]].concat())?;
    }
    same_bytes()?;
    let text =
        cargo::output(&["tree", "--locked", "-p", CRATE, "-e", "normal", "--prefix", "none", "--format", "{p}"])?;
    let crates: BTreeSet<_> = text.lines().map(|line| line.trim_end_matches(" (*)")).collect();
    println!("{} of at most {MOST_CRATES} crates are compiled for a build script", crates.len());
    match crates.len() {
        0 => Err("cargo tree shows no crates".to_owned()),
        count if count > MOST_CRATES => {
            Err(format!("{count} crates: make dependencies optional that only few users need"))
        }
        _ => Ok(()),
    }
}

fn cargo_run(arguments: &[&str]) -> Result<(), Failure> {
    succeed(cargo::command().args(arguments).current_dir(workspace_root()), &format!("cargo {}", arguments.join(" ")))
}

/// Packs a folder with the command, which has all features, and with the program `packing`, whose compiler has none,
/// and compares the banks.
fn same_bytes() -> Result<(), Failure> {
    let folder = temporary_folder()?;
    let [none, all] = ["none.lipzbank", "all.lipzbank"].map(|name| folder.path().join(name));
    let mut packing = Command::new(packing()?);
    succeed(packing.arg(SOURCES).arg(&none).current_dir(workspace_root()), "packing")?;
    let mut pack = Command::new(cargo::lipz()?);
    pack.args(["pack", SOURCES, "--no-config", "--config", "default-locale=en-us", "--quiet", "-o"]).arg(&all);
    succeed(pack.current_dir(workspace_root()), "lipz pack")?;
    let read = |path: &Path| fs::read(path).map_err(|error| format!("`{}`: {error}", path.display()));
    if read(&none)? == read(&all)? {
        println!("{SOURCES} produces the same bank without features and with all of them");
        return Ok(());
    }
    let (none, all, _kept) = (none.display(), all.display(), folder.keep());
    Err(format!("a feature of {CRATE} changes the bank of {SOURCES}: compare {none} and {all}"))
}
