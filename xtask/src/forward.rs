//! Tasks that are programs of their own: the command `lipz`, and the measurements of `benches`.
//!
//! They are run, not linked: the tasks of the workspace build in seconds.

use crate::Failure;
use crate::cargo;
use crate::paths::{target_folder, workspace_root};
use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;

/// The commands of `lipz` that the project is driven by.
const LIPZ: [&str; 4] = ["pack", "unpack", "verify", "inspect"];

/// The program that counts.
const INSTRUCTIONS: &str = "instructions";

/// Programs of `lipz-benches`, with what they do.
const BENCHES: [(&str, &str); 6] = [
    ("generate", "Write a folder of made-up clips of realistic size and shape"),
    ("measure", "Measure packing against reading the same files"),
    ("scale", "Measure how packing on several machines grows with clips, as a Markdown table"),
    ("lip-sync", "Measure lip sync up to an hour of sound: times real time, and peak memory"),
    ("compare", "Compare the reader with other ways to keep clips in a file, as a Markdown table"),
    (INSTRUCTIONS, "Count the instructions of the reader's queries and of packing, and hold them to their limits"),
];

/// What the help says about them.
pub(crate) fn help() -> String {
    let mut help =
        format!("Commands of lipz: {}; all others with `cargo run -p lipz --`\n\nMeasurements:\n", LIPZ.join(", "));
    for (name, about) in BENCHES {
        help.push_str(&format!("  {name:<12}  {about}\n"));
    }
    help
}

/// Runs the program that the first argument names, if it names one.
pub(crate) fn command(arguments: &[OsString]) -> Option<ExitCode> {
    let (task, rest) = arguments.split_first()?;
    let mut run = cargo::command();
    if LIPZ.iter().any(|name| task == name) {
        let manifest = workspace_root().join("Cargo.toml");
        run.args(["run", "--package", "lipz", "--manifest-path"]).arg(manifest).arg("--").args(arguments);
    } else if task == INSTRUCTIONS {
        // Only what is counted is optimised, and that needs little: the program that counts is built with the tests.
        let (Ok(queries), Ok(packing)) = (counted("queries", ""), packing()) else {
            return Some(ExitCode::FAILURE);
        };
        run.args(["run", "--quiet", "--package", "lipz-benches", "--bin", INSTRUCTIONS, "--", "--queries"]);
        run.arg(queries).arg("--packing").arg(packing).args(rest).current_dir(workspace_root());
    } else {
        let (name, _) = BENCHES.iter().find(|(name, _)| task == name)?;
        // All programs, because one runs another; from the root, from which their files are named.
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

/// The program that packs, with a compiler without features.
pub(crate) fn packing() -> Result<PathBuf, Failure> {
    counted("packing", "packing")
}

/// A program whose instructions are counted.
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
        assert!(help().contains("pack, unpack, verify, inspect"));
    }
}
