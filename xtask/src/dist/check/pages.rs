//! The commands of the first pages, run as written in an environment with only the installed packages.

use super::commands::output;
use crate::Failure;
use crate::dist::Packages;
use crate::dist::contents::read;
use crate::paths::workspace_root;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The pages with their recordings, below the folder in which their commands begin.
const PAGES: [(&str, &[&str]); 3] = [
    ("README.md", &["recordings/mara-hello.wav"]),
    ("docs/start/getting-started.md", &[]),
    ("docs/start/from-a-spreadsheet.md", &["recordings/act1/bobby.wav", "recordings/act1/bobby-again.wav"]),
];

/// The tables of a page, in order.
const TABLES: [&str; 2] = ["lines.csv", "translations.csv"];

/// The recording of every line, and a program that records it.
const RECORDING: &str = "fixtures/speech/bobby.wav";
const RECORDER: &str = "arecord";

/// Runs the commands of each page in a new environment of Python, where `pip install lipz` installs the wheel.
pub(super) fn run(packages: &Packages, folder: &Path) -> Result<(), Failure> {
    let recording = std::path::absolute(workspace_root().join(RECORDING)).map_err(|error| error.to_string())?;
    for (page, recordings) in PAGES {
        let folder = folder.join(page.replace('/', "-"));
        let (project, environment) = (folder.join("project"), folder.join("environment"));
        let failed = |error: std::io::Error| format!("`{}`: {error}", folder.display());
        fs::create_dir_all(&project).map_err(failed)?;
        let text = String::from_utf8_lossy(&read(&workspace_root().join(page))?).into_owned();
        for (name, table) in TABLES.iter().zip(blocks(&text, "csv")) {
            fs::write(project.join(name), table).map_err(failed)?;
        }
        for name in recordings {
            let path = project.join(name);
            fs::create_dir_all(path.parent().unwrap_or(&project)).map_err(failed)?;
            fs::copy(&recording, path).map_err(failed)?;
        }
        super::commands::printed(Command::new("python3").args(["-m", "venv"]).arg(&environment))?;
        // Its last argument is the file.
        let recorder = format!("#!/bin/sh\nfor file; do :; done\ncp '{}' \"$file\"\n", recording.display());
        crate::dist::archive::Entry::program(RECORDER, recorder).write(&environment.join("bin")).map_err(failed)?;
        // Commands for a checkout are in blocks of `bash`.
        let script = blocks(&text, "sh").concat();
        if !script.contains("pip install lipz") || !script.contains("lipz pack") {
            return Err(format!("{page} does not lead from the installation to a bank"));
        }
        let folders = [environment.join("bin"), PathBuf::from("/usr/bin"), "/bin".into()];
        let path = std::env::join_paths(folders).map_err(|error| error.to_string())?;
        let mut shell = Command::new("sh");
        shell.args(["-e", "-c", &script]).current_dir(&project).env("PATH", path);
        shell.env("PIP_NO_INDEX", "1").env("PIP_FIND_LINKS", packages.wheel.parent().unwrap_or(Path::new(".")));
        let output = output(&mut shell)?;
        if !output.status.success() {
            let [printed, errors] = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
            return Err(format!("the commands of {page} ended with {}: {printed}{errors}", output.status));
        }
        println!("{page}: its commands work as written");
    }
    Ok(())
}

/// Returns the blocks of code in a language.
fn blocks(page: &str, language: &str) -> Vec<String> {
    let fence = format!("\n```{language}\n");
    page.split(&fence).skip(1).filter_map(|rest| Some(rest.split_once("```")?.0.to_owned())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_of_a_language_are_found() {
        assert_eq!(blocks("a\n```sh\nb\n```\n```text\nc\n```\n\n```sh\nd\n```\n", "sh"), ["b\n", "d\n"]);
    }
}
