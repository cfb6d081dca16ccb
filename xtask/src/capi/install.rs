//! Installs header, libraries, and files for pkg-config and CMake.

use crate::{Failure, paths};
use std::fs;
use std::path::Path;

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Returns the name that programs load at run time. While the first number of the version is 0, it includes the second
/// one, whose change may break programs.
pub(crate) fn soname() -> &'static str {
    concat!("liblipz.so.", env!("CARGO_PKG_VERSION_MAJOR"), ".", env!("CARGO_PKG_VERSION_MINOR"))
}

/// Installs the files in `built` below `prefix`, and replaces existing ones.
pub(super) fn install(built: &Path, prefix: &Path) -> Result<(), Failure> {
    files(built, prefix).map_err(|error| format!("`{}` cannot be written: {error}", prefix.display()))
}

fn files(built: &Path, prefix: &Path) -> std::io::Result<()> {
    let sources = paths::workspace_root().join("crates/lipz-capi");
    let (include, lib) = (prefix.join("include"), prefix.join("lib"));
    let (pkgconfig, cmake) = (lib.join("pkgconfig"), lib.join("cmake/lipz"));
    for folder in [&include, &pkgconfig, &cmake] {
        fs::create_dir_all(folder)?;
    }
    for header in ["lipz.h", "lipz.hpp"] {
        fs::copy(sources.join("include").join(header), include.join(header))?;
    }
    fs::copy(built.join("liblipz_capi.a"), lib.join("liblipz.a"))?;
    // The name for the linker, in addition to the one for programs. Copied instead of linked, because not every file
    // system has links.
    for name in [soname(), "liblipz.so"] {
        fs::copy(built.join("liblipz_capi.so"), lib.join(name))?;
    }
    for (name, folder) in
        [("lipz.pc", pkgconfig), ("lipz-config.cmake", cmake.clone()), ("lipz-config-version.cmake", cmake)]
    {
        let template = fs::read_to_string(sources.join("package").join(name))?;
        fs::write(folder.join(name), template.replace("@VERSION@", VERSION).replace("@SONAME@", soname()))?;
    }
    Ok(())
}
