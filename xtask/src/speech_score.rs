//! `cargo xtask speech-score`: how good lip sync is, on sentences of speech synthesisers. `xtask/speech_score/README.md` tells more.

use crate::Failure;
use crate::paths::workspace_root;
use crate::tools::succeed;
use std::fs;
use std::path::Path;
use std::process::Command;

/// What lipz is compared with.
const PEER: &str = "pocketsphinx==5.1.1";
/// What makes the sounds, and of which Debian package it is.
const SYNTHESISERS: [&str; 2] = ["flite", "festival"];

/// Makes the sentences, aligns them, and prints the table.
pub(crate) fn run() -> Result<(), Failure> {
    for program in SYNTHESISERS {
        let found = Command::new(program).arg("--version").output();
        found.map_err(|_| format!("`{program}` is missing: xtask/speech_score/README.md lists Debian's packages"))?;
    }
    let (scripts, folder) = (workspace_root().join("xtask/speech_score"), workspace_root().join("target/speech-score"));
    let (sounds, python) = (folder.join("sounds"), folder.join("python/bin/python"));
    if !python.exists() {
        succeed(Command::new("python3").args(["-m", "venv"]).arg(folder.join("python")), "python3 -m venv")?;
    }
    succeed(Command::new(&python).args(["-m", "pip", "install", "--quiet", PEER]), "pip install")?;
    let (ours, theirs) = (folder.join("lipz"), folder.join("pocketsphinx"));
    for made in [&sounds, &ours, &theirs].into_iter().filter(|made| made.exists()) {
        fs::remove_dir_all(made).map_err(|error| format!("{}: {error}", made.display()))?;
    }
    let script = |name: &str| {
        let mut command = Command::new(&python);
        command.arg(scripts.join(name));
        command
    };
    succeed(script("make.py").arg(&sounds), "make.py")?;
    let mut cargo = Command::new("cargo");
    cargo.args(["run", "--release", "--quiet", "--package", "lipz-speech", "--example", "sync_folder", "--"]);
    succeed(cargo.current_dir(workspace_root()).args([&sounds, &ours]), "sync_folder")?;
    succeed(script("sphinx.py").args([&sounds, &theirs]), "sphinx.py")?;
    let peer = |name: &str, folder: &Path| format!("{name}={}", folder.display());
    succeed(script("score.py").arg(&sounds).arg(peer("lipz", &ours)).arg(peer("PocketSphinx", &theirs)), "score.py")
}
