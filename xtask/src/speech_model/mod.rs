//! `cargo xtask speech-model`: makes the acoustic model of lipz-speech from CMU Sphinx's model of US English.
//!
//! pip fetches the package, Python unpacks it, [`sphinx`] reads its files, [`pack`] writes ours: the same bytes each time.

mod pack;
mod pairs;
mod sphinx;

use crate::tools::succeed;
use crate::{Failure, paths};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The package, and what its file must hash to. Packages for all systems hold the same model.
const REQUIREMENT: &str =
    "pocketsphinx==5.1.1 --hash=sha256:bb8fd0fc7fb08dd8f85da21f5121f34ebf4186a5bee91ce85e2d358e69a448bf\n";

/// For which system to fetch it, so that the hash is the same everywhere.
const SYSTEM: [&str; 4] = ["--platform", "manylinux2014_x86_64", "--python-version", "3.11"];

/// Where the model is in the package.
const FOLDER: &str = "pocketsphinx/model/en-us/en-us";

/// Where its dictionary is: the one from which phones are known that follow each other.
const DICTIONARY: &str = "pocketsphinx/model/en-us/cmudict-en-us.dict";

/// Where ours is in the workspace.
const PACKED: &str = "crates/lipz-speech/model/en-us.bin";

pub(crate) fn run() -> Result<(), Failure> {
    let temporary = paths::temporary_folder()?;
    let wheel = download(temporary.path())?;
    let unpacked = temporary.path().join("unpacked");
    let mut unzip = python(&["zipfile", "-e"]);
    succeed(unzip.arg(&wheel).arg(&unpacked), "python3 -m zipfile")?;
    let model = sphinx::Model::read(&unpacked.join(FOLDER))?;
    let dictionary = unpacked.join(DICTIONARY);
    let words = fs::read_to_string(&dictionary).map_err(|error| format!("`{}`: {error}", dictionary.display()))?;
    let bytes = pack::pack(&model, &words)?;
    let path = paths::workspace_root().join(PACKED);
    fs::write(&path, &bytes).map_err(|error| format!("`{}`: {error}", path.display()))?;
    println!("{}: {} bytes, {} phones", path.display(), bytes.len(), model.phones.len());
    Ok(())
}

/// Fetches the package from where pip fetches packages, and checks its hash.
fn download(folder: &Path) -> Result<PathBuf, Failure> {
    let requirements = folder.join("requirements.txt");
    fs::write(&requirements, REQUIREMENT).map_err(|error| format!("`{}`: {error}", requirements.display()))?;
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
