//! The demo: a recording with its lip sync, on the page that `lipz preview` exports.

use super::write as write_file;
use crate::Failure;
use crate::dist;
use crate::paths::{temporary_folder, workspace_root};
use crate::tools::succeed;
use std::fs;
use std::path::Path;
use std::process::Command;

/// The recording, its transcript, and its licence, which the demo contains as well.
const RECORDING: &str = "fixtures/speech/bobby.wav";
const TRANSCRIPT: &str = "Bobby ripped the ledger.";
const LICENCE: &str = "fixtures/speech/LICENSE-praatIO";

/// Makes a project, syncs it, and exports its page, as in the tutorial.
pub(super) fn write(folder: &Path) -> Result<(), Failure> {
    let program = dist::program_with_symbols()?;
    let project = temporary_folder()?;
    let read = |name: &str| fs::read(workspace_root().join(name)).map_err(|error| format!("`{name}`: {error}"));
    write_file(&project.path().join("recordings/bobby.wav"), &read(RECORDING)?)?;
    let lipz = |arguments: &[&str]| {
        let mut command = Command::new(&program);
        command.args(arguments).arg("--quiet").current_dir(project.path());
        succeed(&mut command, &format!("lipz {}", arguments.join(" ")))
    };
    lipz(&["init", ".", "--audio", "recordings"])?;
    lipz(&["new", "bobby", TRANSCRIPT])?;
    lipz(&["sync"])?;
    lipz(&["preview", "--output", &folder.to_string_lossy()])?;
    write_file(&folder.join("LICENSE-recording"), &read(LICENCE)?)
}
