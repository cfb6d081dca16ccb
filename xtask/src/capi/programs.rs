//! The programs in `crates/lipz-capi/examples`, built as their readers would build them.

use crate::tools::succeed;
use crate::{Failure, paths};
use std::ffi::OsStr;
use std::path::Path;
use std::process::{Command, Output};

/// What the programs play, and what they print then.
const BANK: &str = "fixtures/banks/v1/drama.lipzbank";
const CLIP: [&str; 2] = ["act1/mara-good-evening", "de-de"];
const EXPECTED: &str = "play.expected";

const SANITIZERS: &str = "-g -fsanitize=address,undefined -fno-sanitize-recover=all";

pub(super) fn run(prefix: &Path) -> Result<(), Failure> {
    let sources = paths::workspace_root().join("crates/lipz-capi/examples");
    let build = prefix.join("build");
    let expected = std::fs::read_to_string(sources.join(EXPECTED))
        .map_err(|error| format!("`{EXPECTED}` cannot be read: {error}"))?;
    cmake(&sources, prefix, &build.join("cmake"))?;
    make(&sources, prefix, &build.join("make"), "")?;
    make(&sources, prefix, &build.join("sanitized"), SANITIZERS)?;
    for how in ["cmake", "make", "sanitized"] {
        for program in ["play-c", "play-cpp"] {
            let program = build.join(how).join(program);
            plays(Command::new(&program), prefix, &expected)?;
            refuses(Command::new(&program), prefix)?;
            if how != "sanitized" {
                plays(under_valgrind(&program), prefix, &expected)?;
            }
        }
    }
    Ok(())
}

fn cmake(sources: &Path, prefix: &Path, build: &Path) -> Result<(), Failure> {
    let found = format!("-DCMAKE_PREFIX_PATH={}", prefix.display());
    let mut configure = Command::new("cmake");
    configure.args(["--log-level=ERROR", "-S"]).arg(sources).arg("-B").arg(build).arg(found);
    succeed(&mut configure, "CMake")?;
    succeed(Command::new("cmake").arg("--build").arg(build), "the build with CMake")
}

fn make(sources: &Path, prefix: &Path, build: &Path, flags: &str) -> Result<(), Failure> {
    let variable = |name: &str, value: &str| format!("{name}={value}");
    succeed(
        Command::new("make")
            .args(["--always-make", "--no-print-directory", "-C"])
            .arg(sources)
            .arg(variable("BUILD", &build.to_string_lossy()))
            .args([variable("CFLAGS", flags), variable("CXXFLAGS", flags)])
            .env("PKG_CONFIG_PATH", prefix.join("lib/pkgconfig")),
        "the build with pkg-config",
    )
}

fn under_valgrind(program: &Path) -> Command {
    let mut command = Command::new("valgrind");
    command.args(["--quiet", "--leak-check=full", "--error-exitcode=99"]).arg(program);
    command
}

/// The program plays the clip and prints what it should.
fn plays(program: Command, prefix: &Path, expected: &str) -> Result<(), Failure> {
    let (shown, output) = played(program, prefix, BANK)?;
    if output.status.success() && output.stdout == expected.as_bytes() {
        println!("{shown}: as expected");
        return Ok(());
    }
    let [printed, errors] = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes));
    Err(format!("`{shown}` ended with {}, and did not print {EXPECTED}:\n{printed}{errors}", output.status))
}

/// The program says of a file that is no bank that it is none.
fn refuses(program: Command, prefix: &Path) -> Result<(), Failure> {
    let (shown, output) = played(program, prefix, "Cargo.toml")?;
    let errors = String::from_utf8_lossy(&output.stderr);
    if output.status.code() == Some(1) && errors.contains("not a lipz bank") {
        return Ok(());
    }
    Err(format!("`{shown}` ended with {}, although its file is no bank:\n{errors}", output.status))
}

/// Plays the clip of a bank.
fn played(mut program: Command, prefix: &Path, bank: &str) -> Result<(String, Output), Failure> {
    let words = std::iter::once(program.get_program()).chain(program.get_args());
    let shown = words.map(OsStr::to_string_lossy).collect::<Vec<_>>().join(" ");
    program.env("LD_LIBRARY_PATH", prefix.join("lib")).arg(paths::workspace_root().join(bank)).args(CLIP);
    let output = program.output().map_err(|error| format!("`{shown}` cannot be run: {error}"))?;
    Ok((shown, output))
}
