//! `cargo xtask mouth-score`: compares computed mouths with coils on jaw and lips. See `fixtures/mouth/README.md`.

use crate::Failure;
use crate::paths::{target_folder, temporary_folder, workspace_root};
use crate::tools::succeed;
use std::process::Command;

/// The packages of Python: arrays, and the program for comparison.
const PACKAGES: [&str; 2] = ["numpy==2.2.6", "openfacefx==0.24.0"];

/// Builds the command, and prints the table.
pub(crate) fn run() -> Result<(), Failure> {
    let root = workspace_root();
    let environment = target_folder().join("mouth-score");
    let python = environment.join("bin/python");
    if !python.exists() {
        succeed(Command::new("python3").args(["-m", "venv"]).arg(&environment), "python3 -m venv")?;
    }
    succeed(Command::new(&python).args(["-m", "pip", "install", "--quiet"]).args(PACKAGES), "pip install")?;
    let mut build = Command::new("cargo");
    succeed(build.current_dir(&root).args(["build", "--release", "--locked", "--quiet", "-p", "lipz"]), "cargo build")?;
    let work = temporary_folder()?;
    let mut score = Command::new(&python);
    score.arg(root.join("xtask/mouth_score/score.py")).arg(target_folder().join("release/lipz"));
    succeed(score.arg(root.join("fixtures/mouth")).arg(work.path()), "score.py")
}
