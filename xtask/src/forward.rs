//! Tasks that are separate programs: `examples/bank-tool`, and the measurements of `benches`.
//!
//! They are run, not linked, so that the tasks of the workspace build in seconds.

use crate::Failure;
use crate::cargo;
use crate::paths::{target_folder, workspace_root};
use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;

/// The commands of `examples/bank-tool`, which needs a tenth of the crates of `lipz`.
const BANK_TOOL: [&str; 3] = ["pack", "verify", "inspect"];

/// The program that counts.
const INSTRUCTIONS: &str = "instructions";

/// Programs of `lipz-benches`, with their descriptions.
const BENCHES: [(&str, &str); 6] = [
    ("generate", "Write a folder of made-up clips of realistic size and shape"),
    ("measure", "Measure packing against reading the same files"),
    ("scale", "Measure packing on several machines by number of clips, as a Markdown table"),
    ("lip-sync", "Measure the speed and peak memory of lip sync, up to an hour of audio"),
    ("compare", "Compare the reader with other file formats for clips, as a Markdown table"),
    (INSTRUCTIONS, "Count the instructions of the reader's queries and of packing, and check their limits"),
];

/// Returns their lines of the help.
pub(crate) fn help() -> String {
    let mut help = format!(
        "Commands of examples/bank-tool: {}; `cargo run -p lipz --` has all\n\nMeasurements:\n",
        BANK_TOOL.join(", ")
    );
    for (name, about) in BENCHES {
        help.push_str(&format!("  {name:<12}  {about}\n"));
    }
    help
}

/// Returns the exit code of the program that the first argument names, after running it.
pub(crate) fn command(arguments: &[OsString]) -> Option<ExitCode> {
    let (task, rest) = arguments.split_first()?;
    let mut run = cargo::command();
    if BANK_TOOL.iter().any(|name| task == name) {
        let manifest = workspace_root().join("Cargo.toml");
        eprintln!("building examples/bank-tool, which packs and inspects banks; the first time takes half a minute");
        run.args(["run", "--quiet", "--package", "bank-tool", "--manifest-path"]);
        run.arg(manifest).arg("--").args(arguments);
    } else if task == INSTRUCTIONS {
        // Only the counted programs are optimised, and they need few crates: the counting program is built with the
        // tests.
        let (Ok(queries), Ok(packing)) = (counted("queries", ""), packing()) else {
            return Some(ExitCode::FAILURE);
        };
        run.args(["run", "--quiet", "--package", "lipz-benches", "--bin", INSTRUCTIONS, "--", "--queries"]);
        run.arg(queries).arg("--packing").arg(packing).args(rest).current_dir(workspace_root());
    } else {
        let (name, _) = BENCHES.iter().find(|(name, _)| task == name)?;
        // All programs, because one runs another; at the root, to which their file names are relative.
        let features = if *name == "compare" { "compare" } else { "" };
        if !is_built(&["--bins", "--features", features]) {
            return Some(ExitCode::FAILURE);
        }
        run.args(["run", "--release", "--quiet", "--package", "lipz-benches", "--features", features, "--bin", name]);
        run.arg("--").args(rest).current_dir(workspace_root());
    }
    let code = match run.status() {
        Ok(status) => status.code().and_then(|code| u8::try_from(code).ok()).unwrap_or(1),
        Err(error) => {
            eprintln!("xtask: cargo cannot be run: {error}");
            2
        }
    };
    Some(ExitCode::from(code))
}

/// Builds the program that packs, with a compiler without features.
pub(crate) fn packing() -> Result<PathBuf, Failure> {
    counted("packing", "packing")
}

/// Builds a program whose instructions are counted.
fn counted(name: &str, features: &str) -> Result<PathBuf, Failure> {
    if !is_built(&["--bin", name, "--no-default-features", "--features", features]) {
        return Err(format!("`{name}` cannot be built"));
    }
    Ok(target_folder().join("release").join(format!("{name}{}", std::env::consts::EXE_SUFFIX)))
}

/// Builds programs of `lipz-benches` for measurements.
fn is_built(arguments: &[&str]) -> bool {
    let mut build = cargo::command();
    build.args(["build", "--release", "--quiet", "--package", "lipz-benches"]).args(arguments);
    eprintln!("building the programs of lipz-benches: {}", arguments.join(" ").trim());
    build.current_dir(workspace_root()).status().is_ok_and(|status| status.success())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_tasks_are_not_forwarded() {
        assert!(command(&[]).is_none());
        assert!(command(&["ci".into()]).is_none());
        assert!(help().contains("pack, verify, inspect"));
    }
}
