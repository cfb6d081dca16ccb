//! Builds the command for a platform, and strips it.
//!
//! Programs for Linux are linked by zig for an old glibc. Programs for Windows are linked by zig too if they are built
//! on a different system.

use super::platform::{GLIBC, Platform, WINE_LIBRARIES};
use crate::Failure;
use crate::paths::{target_folder, workspace_root};
use crate::toolchain::{Library, Toolchain, needs, rust_lld};
use crate::tools::{has_program, succeed};
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The profile of published programs.
const PROFILE: &str = "dist";

/// Options of the compiler for only the program itself: the level of the last pass over all crates (see the profile in
/// Cargo.toml), and symbols, which cargo would strip.
const LAST_PASS: [&str; 4] = ["-C", "opt-level=3", "-C", "strip=none"];

/// The target that zig links on a different system.
const MINGW: &str = "x86_64-pc-windows-gnu";

/// Libraries that Debian's compiler passes to the linker for [`MINGW`]. zig does not have them, and no code needs them.
const EMPTY_LIBRARIES: [&str; 1] = ["libssp_nonshared.a"];

/// The tools from `.ci/dist-tools.txt`, installed by `.ci/install --all`.
pub(super) fn tools_folder() -> PathBuf {
    let folder = workspace_root().join("target/dist-tools/bin");
    std::path::absolute(&folder).unwrap_or(folder)
}

/// Returns the search path with [`tools_folder`] at its start.
pub(super) fn path_with_tools() -> OsString {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let folders = std::iter::once(tools_folder()).chain(std::env::split_paths(&path));
    std::env::join_paths(folders).unwrap_or(path.clone())
}

/// Returns a tool, if it is in [`tools_folder`] or on the path.
pub(crate) fn tool(name: &str) -> Option<PathBuf> {
    [tools_folder().join(name), PathBuf::from(name)].into_iter().find(|path| has_program(&path.to_string_lossy()))
}

/// A built program.
pub(super) struct Program {
    /// With symbols, for `cargo xtask size command` and for addresses in reports of crashes.
    pub(super) with_symbols: PathBuf,
    /// Without symbols, as published.
    pub(super) stripped: PathBuf,
}

/// Builds `lipz`. Nothing is compiled if it is up to date.
pub(super) fn command(platform: &Platform) -> Result<Program, Failure> {
    let (mut build, folder) = cargo(platform)?;
    build.args(["--profile", PROFILE, "--package", "lipz", "--bin", "lipz", "--quiet", "--"]);
    build.args(LAST_PASS);
    if platform.target == MINGW {
        build.args(["-L", &format!("native={}", empty_libraries()?.display())]);
    }
    succeed(&mut build, &format!("the build of lipz for {}", platform.target))?;
    let folder = folder.join(platform.target).join(PROFILE);
    let with_symbols = folder.join(platform.program());
    let stripped = folder.join("stripped").join(platform.program());
    strip(&with_symbols, &stripped, Symbols::None)?;
    if platform.target == MINGW {
        library_for_wine()?;
    }
    Ok(Program { with_symbols, stripped })
}

/// Writes [`EMPTY_LIBRARIES`], and returns their folder.
fn empty_libraries() -> Result<PathBuf, Failure> {
    let folder = std::path::absolute(target_folder().join("empty-libraries")).map_err(|error| error.to_string())?;
    let written = std::fs::create_dir_all(&folder)
        .and_then(|()| EMPTY_LIBRARIES.iter().try_for_each(|name| std::fs::write(folder.join(name), "!<arch>\n")));
    written.map_err(|error| format!("`{}`: {error}", folder.display()))?;
    Ok(folder)
}

/// Compiles the library that old versions of Wine lack. The program finds it in [`WINE_LIBRARIES`].
fn library_for_wine() -> Result<(), Failure> {
    let folder = target_folder().join(WINE_LIBRARIES);
    std::fs::create_dir_all(&folder).map_err(|error| format!("`{}`: {error}", folder.display()))?;
    let mut compile = Command::new(tools_folder().join("python"));
    compile.args(["-m", "ziglang", "cc", "-target", "x86_64-windows-gnu", "-shared", "-ladvapi32", "-o"]);
    compile.arg(folder.join("bcryptprimitives.dll")).arg(workspace_root().join("xtask/src/dist/wine.c"));
    succeed(&mut compile, "zig cc")
}

/// Returns `cargo rustc` for a platform, and its folder.
pub(super) fn cargo(platform: &Platform) -> Result<(Command, PathBuf), Failure> {
    let toolchain =
        Toolchain::find(platform.target, Library::Std).ok_or_else(|| format!("needs {}", needs(platform.target)))?;
    let mut command = if platform.is_linux() || platform.target == MINGW {
        let zig = tool("cargo-zigbuild")
            .ok_or("needs cargo-zigbuild and zig: `.ci/install --all`, or pip with .ci/dist-tools.txt")?;
        let glibc = if platform.is_linux() { format!(".{}.{}", GLIBC.0, GLIBC.1) } else { String::new() };
        toolchain.cargo_with(Some(&zig), "rustc", &format!("{}{glibc}", platform.target))
    } else {
        toolchain.cargo("rustc")
    };
    // Shared with other builds of this compiler.
    let folder = if toolchain.is_installed() { target_folder() } else { Toolchain::build_folder() };
    let folder = std::path::absolute(&folder).map_err(|error| format!("`{}`: {error}", folder.display()))?;
    command.env("CARGO_TARGET_DIR", &folder).env("CARGO_BUILD_BUILD_DIR", &folder).env("PATH", path_with_tools());
    Ok((command, folder))
}

/// The symbols that remain in a file.
#[derive(Clone, Copy)]
pub(super) enum Symbols {
    /// Only those that are needed to load it.
    None,
    /// Those that are needed to link it.
    ForLinking,
}

/// Writes a copy of a program or library without symbols, with the tool that comes with Rust.
pub(super) fn strip(from: &Path, to: &Path, symbols: Symbols) -> Result<(), Failure> {
    let tool = rust_lld().map(|linker| linker.with_file_name(format!("rust-objcopy{}", std::env::consts::EXE_SUFFIX)));
    let tool = tool.filter(|tool| tool.is_file()).ok_or("needs rust-objcopy, which comes with Rust")?;
    if let Some(parent) = to.parent() {
        std::fs::create_dir_all(parent).map_err(|error| format!("`{}`: {error}", parent.display()))?;
    }
    let option = match symbols {
        Symbols::None => "--strip-all",
        Symbols::ForLinking => "--strip-debug",
    };
    let mut command = Command::new(&tool);
    // It is linked to the LLVM of the compiler, which is not next to it.
    if let Some(libraries) = tool.ancestors().nth(4) {
        for variable in ["LD_LIBRARY_PATH", "DYLD_LIBRARY_PATH"] {
            command.env(variable, libraries);
        }
    }
    succeed(command.arg(option).arg(from).arg(to), "rust-objcopy")
}
