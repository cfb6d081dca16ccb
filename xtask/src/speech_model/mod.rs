//! `cargo xtask speech-model`: makes the acoustic model of lipz-speech from CMU Sphinx's model of US English.
//!
//! [`wheel`] fetches the package, [`sphinx`] reads its files, [`pack`] writes the model. The bytes are the same each
//! time.

mod pack;
mod pairs;
mod sphinx;

use crate::{Failure, paths, wheel};
use std::fs;

/// The package, with the expected hash of its file. Packages for all systems contain the same model.
const REQUIREMENT: &str =
    "pocketsphinx==5.1.1 --hash=sha256:bb8fd0fc7fb08dd8f85da21f5121f34ebf4186a5bee91ce85e2d358e69a448bf\n";

/// The folder of the model in the package.
const FOLDER: &str = "pocketsphinx/model/en-us/en-us";

/// The path of its dictionary, from which the sequences of phones are counted.
const DICTIONARY: &str = "pocketsphinx/model/en-us/cmudict-en-us.dict";

/// The path of the packed model in the workspace.
const PACKED: &str = "crates/lipz-speech/model/en-us.bin";

pub(crate) fn run() -> Result<(), Failure> {
    let temporary = paths::temporary_folder()?;
    let unpacked = wheel::unpacked(REQUIREMENT, temporary.path())?;
    let model = sphinx::Model::read(&unpacked.join(FOLDER))?;
    let dictionary = unpacked.join(DICTIONARY);
    let words = fs::read_to_string(&dictionary).map_err(|error| format!("`{}`: {error}", dictionary.display()))?;
    let bytes = pack::pack(&model, &words)?;
    let path = paths::workspace_root().join(PACKED);
    fs::write(&path, &bytes).map_err(|error| format!("`{}`: {error}", path.display()))?;
    println!("{}: {} bytes, {} phones", path.display(), bytes.len(), model.phones.len());
    Ok(())
}
