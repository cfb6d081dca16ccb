//! The programs in `crates/lipz-capi/examples`, built in the same way as by users.

use crate::tools::succeed;
use crate::{Failure, paths};
use std::ffi::OsStr;
use std::path::Path;
use std::process::{Command, Output};

/// The bank for the programs.
const BANK: &str = "fixtures/banks/v1/drama.lipzbank";
const LOCALE: &str = "de-de";
/// The clips to play. The second and the third have an empty segment, the first or the last one, whose event fires as
/// well.
const CLIPS: [&str; 3] = ["act1/mara-good-evening", "act1/otto-ticking", "act3/nell-light"];
const EXPECTED: &str = "play.expected";

const SANITIZERS: &str = "-g -fsanitize=address,undefined -fno-sanitize-recover=all";

pub(super) fn run(prefix: &Path) -> Result<(), Failure> {
    let sources = paths::workspace_root().join("crates/lipz-capi/examples");
    let build = prefix.join("build");
    cmake(&sources, prefix, &build.join("cmake"))?;
    make(&sources, prefix, &build.join("make"), "")?;
    make(&sources, prefix, &build.join("sanitized"), SANITIZERS)?;
    page(&build, prefix)?;
    for how in ["cmake", "make", "sanitized"] {
        for program in ["play-c", "play-cpp"] {
            let program = build.join(how).join(program);
            plays(|| Command::new(&program), prefix)?;
            refuses(Command::new(&program), prefix)?;
            if how != "sanitized" {
                plays(|| under_valgrind(&program), prefix)?;
            }
        }
    }
    Ok(())
}

/// Builds both programs with CMake, and runs them.
pub(crate) fn with_cmake(sources: &Path, prefix: &Path, build: &Path) -> Result<(), Failure> {
    cmake(sources, prefix, build)?;
    for program in ["play-c", "play-cpp"] {
        let program = build.join(program);
        plays(|| Command::new(&program), prefix)?;
        refuses(Command::new(&program), prefix)?;
    }
    Ok(())
}

/// The page about C, and the ends of fences around its programs.
const PAGE: &str = "docs/guides/c.md";
/// The code required by the page's lines in C++.
const BEFORE: &str =
    "#include <iostream>\nvoid draw(char);\nvoid rig(std::string_view, std::optional<std::int32_t>);\n";

/// Compiles the programs of the page, and runs the first one. The lines in C++ become the body of a function.
fn page(build: &Path, prefix: &Path) -> Result<(), Failure> {
    let text =
        std::fs::read_to_string(paths::workspace_root().join(PAGE)).map_err(|error| format!("{PAGE}: {error}"))?;
    let block = |fence: &str| {
        let (_, rest) = text.split_once(fence)?;
        Some(rest.split_once("```")?.0.to_owned())
    };
    let (Some(first), Some(lines)) = (block("```c\n"), block("```cpp\n")) else {
        return Err(format!("{PAGE} has no program"));
    };
    let (include, body) = lines.split_once('\n').unwrap_or_default();
    let body = format!("{include}\n{BEFORE}void play(std::int64_t position) {{\n{body}\n}}\n");
    let (c, cpp, program) = (build.join("first.c"), build.join("lines.cpp"), build.join("first"));
    let failed = |error| format!("{}: {error}", build.display());
    std::fs::write(&c, first).and_then(|()| std::fs::write(&cpp, body)).map_err(failed)?;
    let compile = |compiler: &str, language: &str| {
        let mut command = Command::new(compiler);
        command.args([language, "-Wall", "-Wextra", "-Werror", "-pedantic", "-I"]).arg(prefix.join("include"));
        command
    };
    let mut to_c = compile("cc", "-std=c99");
    succeed(to_c.arg(&c).arg(prefix.join("lib/liblipz.a")).arg("-o").arg(&program), "the program of C.md")?;
    succeed(
        compile("c++", "-std=c++17").arg("-c").arg(&cpp).arg("-o").arg(build.join("lines.o")),
        "the lines of C.md",
    )?;
    let output = Command::new(&program).arg(paths::workspace_root().join(BANK)).arg(CLIPS[0]).output();
    let output = output.map_err(|error| format!("the program of {PAGE} cannot be run: {error}"))?;
    match String::from_utf8_lossy(&output.stdout).contains("Guten Abend, Otto.") {
        true => Ok(()),
        false => Err(format!("the program of {PAGE} does not show its subtitle: {output:?}")),
    }
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
    // Make treats spaces as ends of names, so the path of this checkout, which may contain some, is left out.
    let from_sources = build.strip_prefix(paths::workspace_root()).map(|build| Path::new("../../..").join(build));
    let build = from_sources.unwrap_or_else(|_| build.to_owned());
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

pub(super) fn under_valgrind(program: &Path) -> Command {
    let mut command = Command::new("valgrind");
    command.args(["--quiet", "--leak-check=full", "--error-exitcode=99"]).arg(program);
    command
}

/// Checks that the program plays the clips and prints the expected output.
pub(crate) fn plays(program: impl Fn() -> Command, prefix: &Path) -> Result<(), Failure> {
    let expected = paths::workspace_root().join("crates/lipz-capi/examples").join(EXPECTED);
    let expected =
        std::fs::read_to_string(expected).map_err(|error| format!("`{EXPECTED}` cannot be read: {error}"))?;
    let mut printed = String::new();
    for clip in CLIPS {
        let (shown, output) = played(program(), prefix, BANK, clip)?;
        // Programs for Windows end lines with both characters.
        printed.push_str(&String::from_utf8_lossy(&output.stdout).replace("\r\n", "\n"));
        if !output.status.success() || !expected.starts_with(&printed) {
            let errors = String::from_utf8_lossy(&output.stderr);
            return Err(format!(
                "`{shown}` ended with {}, and did not print {EXPECTED}:\n{printed}{errors}",
                output.status
            ));
        }
        println!("{shown} {clip}: as expected");
    }
    if printed == expected { Ok(()) } else { Err(format!("{EXPECTED} has more lines than the programs print")) }
}

/// Checks that the program reports a file that is not a bank.
fn refuses(program: Command, prefix: &Path) -> Result<(), Failure> {
    let (shown, output) = played(program, prefix, "Cargo.toml", CLIPS[0])?;
    let errors = String::from_utf8_lossy(&output.stderr);
    if output.status.code() == Some(1) && errors.contains("not a lipz bank") {
        return Ok(());
    }
    Err(format!("`{shown}` ended with {}, although its file is not a bank:\n{errors}", output.status))
}

/// Plays a clip of a bank.
fn played(mut program: Command, prefix: &Path, bank: &str, clip: &str) -> Result<(String, Output), Failure> {
    let words = std::iter::once(program.get_program()).chain(program.get_args());
    let shown = words.map(OsStr::to_string_lossy).collect::<Vec<_>>().join(" ");
    program.env("LD_LIBRARY_PATH", prefix.join("lib")).args([clip, LOCALE]).arg(paths::workspace_root().join(bank));
    let output = program.output().map_err(|error| format!("`{shown}` cannot be run: {error}"))?;
    Ok((shown, output))
}
