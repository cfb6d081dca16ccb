//! The archives of liblipz, the library for C: headers, libraries, and files for CMake and pkg-config.

use super::archive::Entry;
use super::build::{Symbols, cargo, strip};
use super::contents::{licences, read};
use super::platform::Platform;
use crate::Failure;
use crate::capi::install::{self, Names};
use crate::paths::workspace_root;
use crate::toolchain::{Library, Toolchain, needs};
use crate::tools::succeed;
use std::path::Path;
use std::process::Command;

/// The profile of the libraries.
const PROFILE: &str = "library";

/// The targets for which there is only the library. It is static, because that needs neither a linker nor a system.
pub(super) static TARGETS: [&str; 7] = [
    "aarch64-apple-ios",
    "aarch64-linux-android",
    "aarch64-unknown-linux-musl",
    "riscv32imac-unknown-none-elf",
    "thumbv7em-none-eabihf",
    "wasm32-unknown-emscripten",
    "x86_64-unknown-linux-musl",
];

/// Builds the libraries for a platform of the command, and returns the files of the archive.
pub(super) fn files(platform: &Platform) -> Result<Vec<Entry>, Failure> {
    let (build, folder) = cargo(platform)?;
    // A DLL would need a start function, which a library without std does not have.
    let names = if platform.is_windows() { Names::of_static(platform.target) } else { Names::of(platform.target) };
    built(build, &folder, platform.target, &names)
}

/// Builds the static library for one of [`TARGETS`], and returns the files of the archive.
pub(super) fn static_files(target: &'static str) -> Result<Vec<Entry>, Failure> {
    let toolchain = Toolchain::find(target, Library::Core).ok_or_else(|| format!("needs {}", needs(target)))?;
    built(toolchain.cargo("rustc"), &Toolchain::build_folder(), target, &Names::of_static(target))
}

/// Builds the libraries with these names in a folder of cargo.
fn built(mut build: Command, folder: &Path, target: &str, names: &Names) -> Result<Vec<Entry>, Failure> {
    build.args(["--package", "lipz-capi", "--lib", "--profile", PROFILE, "--quiet", "--features", "panic-handler"]);
    build.args(["--crate-type", if names.built_shared.is_some() { "staticlib,cdylib" } else { "staticlib" }]);
    if names.built_shared.is_some_and(|name| name.ends_with(".so")) {
        build.args(["--", "-C", &install::soname_argument()]);
    }
    succeed(&mut build, &format!("the build of liblipz for {target}"))?;
    let built = folder.join(target).join(PROFILE);
    let stripped = built.join("stripped");
    strip(&built.join(names.built_static), &stripped.join(names.built_static), Symbols::ForLinking)?;
    if let Some(shared) = names.built_shared {
        strip(&built.join(shared), &stripped.join(shared), Symbols::None)?;
    }
    let mut entries = install::files(&stripped, names)?;
    let root = workspace_root();
    for name in ["play.c", "play.cpp", "CMakeLists.txt"] {
        let bytes = read(&root.join("crates/lipz-capi/examples").join(name))?;
        entries.push(Entry::file(format!("examples/{name}"), bytes));
    }
    entries.push(Entry::file("README.md", read(&root.join("crates/lipz-capi/README.md"))?));
    entries.extend(licences("lipz-capi", target)?);
    Ok(entries)
}
