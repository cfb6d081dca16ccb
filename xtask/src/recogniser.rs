//! `cargo xtask recogniser`: the neural network that hears phones, for the machine of whoever runs this. Its licence is
//! not settled (docs/guides/lip-sync.md), so it stays below `target`, and is in no crate and no package.

use crate::tools::succeed;
use crate::{Failure, cargo, paths, wheel};
use std::fs;
use std::process::Command;

/// The package, and what its file must hash to.
const REQUIREMENT: &str =
    "hama==1.7.0 --hash=sha256:be48d6379d288fc588ff9a5f609462b2fb81287dd84afaa2dfb1d283cb280c4d\n";

/// Where the network is in the package.
const FOLDER: &str = "hama/assets";

/// Where ours is below `target`.
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
    succeed(lipz.arg("recogniser").arg(&assets).arg("--output").arg(&output).arg("--quiet"), "lipz recogniser")?;
    println!("{}", output.display());
    Ok(())
}
