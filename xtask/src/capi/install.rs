//! Header, libraries, and what pkg-config and CMake find them by.

use crate::{Failure, paths};
use std::fs;
use std::path::Path;

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The name that programs ask for at run time. While the first number of the version is 0, the second
/// one is part of it, because it may break programs.
pub(crate) fn soname() -> &'static str {
    concat!("liblipz.so.", env!("CARGO_PKG_VERSION_MAJOR"), ".", env!("CARGO_PKG_VERSION_MINOR"))
}

/// Installs what was built in `built` below `prefix`, in place of what is there.
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
    // The name that the linker looks for beside the one that programs ask for: no link, because not
    // every file system has them.
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
