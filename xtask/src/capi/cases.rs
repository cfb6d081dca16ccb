//! The cases of playback in C and C++, and stacks in C++: with every compiler, with sanitizers, and under valgrind, each program answers as
//! the reader in Rust does.

use crate::tools::{has_program, skip, succeed};
use crate::{Failure, paths};
use std::fs::{self, File};
use std::path::Path;
use std::process::Command;

/// The cases with their answers: what the programs read, and what they print.
const CASES: &str = "fixtures/playback/cases.txt";
const BANKS: &str = "fixtures/banks/v1";

/// What the program about stacks prints.
const LAYERS: &str = "crates/lipz-capi/tests/layers.expected";

/// Each compiler with its language, the source, and the answers.
const PROGRAMS: [(&str, &str, &str, &str); 6] = [
    ("cc", "-std=c99", "cases.c", CASES),
    ("clang", "-std=c99", "cases.c", CASES),
    ("c++", "-std=c++17", "cases.cpp", CASES),
    ("clang++", "-std=c++17", "cases.cpp", CASES),
    ("c++", "-std=c++17", "layers.cpp", LAYERS),
    ("clang++", "-std=c++17", "layers.cpp", LAYERS),
];
const WARNINGS: [&str; 5] = ["-Wall", "-Wextra", "-Werror", "-pedantic", "-Wconversion"];
const SANITIZERS: [&str; 3] = ["-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"];

pub(super) fn run(prefix: &Path) -> Result<(), Failure> {
    for (compiler, language, source, expected) in PROGRAMS {
        if !has_program(compiler) {
            skip(compiler)?;
            continue;
        }
        // The sanitizers of the compiler that also links the other programs are enough.
        let is_sanitized = ["cc", "c++"].contains(&compiler);
        for flags in [&[][..], &SANITIZERS].into_iter().take(1 + usize::from(is_sanitized)) {
            let program = prefix.join("build").join(format!("{source}-{compiler}-{}", flags.len()));
            let mut compile = Command::new(compiler);
            compile.arg(language).args(WARNINGS).args(flags).arg("-I").arg(prefix.join("include"));
            compile.arg(paths::workspace_root().join("crates/lipz-capi/tests").join(source));
            compile.arg(prefix.join("lib/liblipz.a")).arg("-o").arg(&program);
            succeed(&mut compile, &format!("{compiler} with {source}"))?;
            answers(Command::new(&program), &format!("{source} of {compiler} {}", flags.join(" ")), expected)?;
            if flags.is_empty() {
                let under_valgrind = super::programs::under_valgrind(&program);
                answers(under_valgrind, &format!("{source} of {compiler} under valgrind"), expected)?;
            }
        }
    }
    Ok(())
}

/// The program may read what is expected, and prints the same.
fn answers(mut program: Command, name: &str, answers: &str) -> Result<(), Failure> {
    let path = paths::workspace_root().join(answers);
    let unreadable = |error| format!("`{answers}`: {error}");
    let expected = fs::read_to_string(&path).map_err(unreadable)?;
    let output =
        program.arg(paths::workspace_root().join(BANKS)).stdin(File::open(&path).map_err(unreadable)?).output();
    let output = output.map_err(|error| format!("{name} cannot be run: {error}"))?;
    let found = String::from_utf8_lossy(&output.stdout);
    if output.status.success() && found == expected {
        println!("{name}: the answers of {answers}");
        return Ok(());
    }
    let same = found.lines().zip(expected.lines()).take_while(|(found, expected)| found == expected).count();
    let [found, expected] = [&*found, &*expected].map(|text| text.lines().nth(same).unwrap_or("the end"));
    let errors = String::from_utf8_lossy(&output.stderr);
    Err(format!("{name}: {answers}:{}: `{found}` instead of `{expected}`\n{errors}", same + 1))
}
