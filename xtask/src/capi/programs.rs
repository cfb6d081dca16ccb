//! The programs in `crates/lipz-capi/examples`, built as their readers would build them.

use crate::{Failure, place, tools};
use std::path::Path;
use std::process::Command;

/// What the programs play, and what they print then.
const BANK: &str = "fixtures/banks/v1/drama.lipzbank";
const CLIP: [&str; 2] = ["act1/mara-good-evening", "de-de"];
const EXPECTED: &str = "play.expected";

const SANITIZERS: &str = "-g -fsanitize=address,undefined -fno-sanitize-recover=all";

pub(super) fn run(prefix: &Path) -> Result<(), Failure> {
    let sources = place::workspace_root().join("crates/lipz-capi/examples");
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
    tools::output(Command::new("cmake").arg("-S").arg(sources).arg("-B").arg(build).arg(found))?;
    tools::output(Command::new("cmake").arg("--build").arg(build)).map(|_| ())
}

fn make(sources: &Path, prefix: &Path, build: &Path, flags: &str) -> Result<(), Failure> {
    let variable = |name: &str, value: &str| format!("{name}={value}");
    tools::output(
        Command::new("make")
            .arg("--always-make")
            .arg("-C")
            .arg(sources)
            .arg(variable("BUILD", &build.to_string_lossy()))
            .args([variable("CFLAGS", flags), variable("CXXFLAGS", flags)])
            .env("PKG_CONFIG_PATH", prefix.join("lib/pkgconfig")),
    )
    .map(|_| ())
}

fn under_valgrind(program: &Path) -> Command {
    let mut command = Command::new("valgrind");
    command.args(["--quiet", "--leak-check=full", "--error-exitcode=99"]).arg(program);
    command
}

/// The program plays the clip and prints what it should.
fn plays(mut program: Command, prefix: &Path, expected: &str) -> Result<(), Failure> {
    let found = tools::output(with_library(&mut program, prefix).arg(place::workspace_root().join(BANK)).args(CLIP))?;
    if found == expected { Ok(()) } else { Err(format!("it printed something else than {EXPECTED}:\n{found}")) }
}

/// The program says of a file that is no bank that it is none.
fn refuses(mut program: Command, prefix: &Path) -> Result<(), Failure> {
    let file = place::workspace_root().join("Cargo.toml");
    match tools::output(with_library(&mut program, prefix).arg(file).args(CLIP)) {
        Err(failure) if failure.contains("not a lipz bank") => Ok(()),
        other => Err(format!("a file that is no bank is not refused: {other:?}")),
    }
}

/// Lets the program find the shared library.
fn with_library<'command>(program: &'command mut Command, prefix: &Path) -> &'command mut Command {
    program.env("LD_LIBRARY_PATH", prefix.join("lib"))
}
