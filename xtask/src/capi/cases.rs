//! The playback cases in C and C++, with every compiler, with sanitizers, and under valgrind. Each program returns the
//! same answers as the reader in Rust, with the golden banks and with equivalent files.

use crate::tools::{has_program, skip_rest, succeed};
use crate::{Failure, cargo, paths};
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The cases with their answers: input and expected output of the programs.
const CASES: &str = "fixtures/playback/cases.txt";
const BANKS: &str = "fixtures/banks/v1";

/// Capabilities that a program is told to lack, so that it skips sections.
const LACKING: [&str; 2] = ["faces", "states"];

/// Each compiler with its language and the source.
const PROGRAMS: [(&str, &str, &str); 5] = [
    ("cc", "-std=c99", "cases.c"),
    ("clang", "-std=c99", "cases.c"),
    ("c++", "-std=c++17", "cases.cpp"),
    ("c++", "-std=c++20", "cases.cpp"),
    ("clang++", "-std=c++17", "cases.cpp"),
];
const WARNINGS: [&str; 5] = ["-Wall", "-Wextra", "-Werror", "-pedantic", "-Wconversion"];
const SANITIZERS: [&str; 3] = ["-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"];

pub(super) fn run(prefix: &Path) -> Result<(), Failure> {
    let folders = folders()?;
    for (compiler, language, source) in PROGRAMS {
        if !has_program(compiler) {
            skip_rest(compiler)?;
            continue;
        }
        // The sanitizers of the compiler that also links the other programs are enough.
        let is_sanitized = ["cc", "c++"].contains(&compiler);
        for flags in [&[][..], &SANITIZERS].into_iter().take(1 + usize::from(is_sanitized)) {
            let program = prefix.join("build").join(format!("{source}-{compiler}{language}-{}", flags.len()));
            let mut compile = Command::new(compiler);
            compile.arg(language).args(WARNINGS).args(flags).arg("-I").arg(prefix.join("include"));
            compile.arg(paths::workspace_root().join("crates/lipz-capi/tests").join(source));
            compile.arg(prefix.join("lib/liblipz.a")).arg("-o").arg(&program);
            succeed(&mut compile, &format!("{compiler} with {source}"))?;
            let name = format!("{source} of {compiler} {language} {}", flags.join(" "));
            for folder in &folders {
                answers(Command::new(&program), &name, folder, &[])?;
            }
            answers(Command::new(&program), &name, &folders[0], &LACKING)?;
            if flags.is_empty() {
                let under_valgrind = super::programs::under_valgrind(&program);
                answers(under_valgrind, &format!("{name} under valgrind"), &folders[0], &[])?;
            }
        }
    }
    Ok(())
}

/// Returns the folder of the golden banks, and those with several files instead of each.
fn folders() -> Result<Vec<PathBuf>, Failure> {
    let layouts = layouts()?;
    let unreadable = |error| format!("`{}`: {error}", layouts.display());
    let mut folders = vec![paths::workspace_root().join(BANKS)];
    for entry in fs::read_dir(&layouts).map_err(unreadable)? {
        folders.push(entry.map_err(unreadable)?.path());
    }
    folders.sort();
    Ok(folders)
}

/// Writes the golden banks as several files each, and returns the folder.
pub(crate) fn layouts() -> Result<PathBuf, Failure> {
    let folder = paths::target_folder().join("layouts");
    if folder.exists() {
        fs::remove_dir_all(&folder).map_err(|error| format!("`{}`: {error}", folder.display()))?;
    }
    let mut write = cargo::command();
    write.args(["run", "--quiet", "--locked", "--package", "lipz-testkit", "--features", "tools", "--bin", "layouts"]);
    succeed(write.arg("--").arg(&folder), "writing the banks in several files")?;
    Ok(folder)
}

/// Checks that the program reads the cases and prints them unchanged. It also reports the number of played and skipped
/// commands.
fn answers(mut program: Command, name: &str, folder: &Path, lacking: &[&str]) -> Result<(), Failure> {
    let path = paths::workspace_root().join(CASES);
    let unreadable = |error| format!("`{CASES}`: {error}");
    let expected = fs::read_to_string(&path).map_err(unreadable)?;
    let output = program.arg(folder).args(lacking).stdin(File::open(&path).map_err(unreadable)?).output();
    let output = output.map_err(|error| format!("{name} cannot be run: {error}"))?;
    let (found, told) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    let layout = folder.file_name().unwrap_or_default().to_string_lossy();
    if !output.status.success() || found != expected {
        let same = found.lines().zip(expected.lines()).take_while(|(found, expected)| found == expected).count();
        let [found, expected] = [&*found, &*expected].map(|text| text.lines().nth(same).unwrap_or("the end"));
        let place = format!("{name}, {layout}: {CASES}:{}", same + 1);
        return Err(format!("{place}: `{found}` instead of `{expected}`\n{told}"));
    }
    if told.contains(" 0 skipped") != lacking.is_empty() {
        return Err(format!("{name}, {layout}: {told}"));
    }
    println!("{name}, {layout}: {}", told.trim_end());
    Ok(())
}
