//! The installed files: headers, libraries, and files for pkg-config and CMake.

use crate::dist::archive::{Content, Entry};
use crate::{Failure, paths};
use std::fs;
use std::path::Path;

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Returns the name that programs load at run time. While the first number of the version is 0, it includes the second
/// one, whose change may break programs.
pub(crate) fn soname() -> &'static str {
    concat!("liblipz.so.", env!("CARGO_PKG_VERSION_MAJOR"), ".", env!("CARGO_PKG_VERSION_MINOR"))
}

/// Returns the option of rustc's `-C` that writes the name into the library.
pub(crate) fn soname_argument() -> String {
    format!("link-arg=-Wl,-soname,{}", soname())
}

/// The names of the libraries on a system.
pub(crate) struct Names {
    /// As built by cargo.
    pub(crate) built_static: &'static str,
    pub(crate) built_shared: Option<&'static str>,
    /// As installed.
    pub(crate) installed_static: &'static str,
    /// The file that programs load, and the links to it.
    installed_shared: Option<(String, Vec<String>)>,
}

impl Names {
    /// Returns the names for a target of the compiler on which the shared library is built, too.
    pub(crate) fn of(target: &str) -> Names {
        let (built_shared, installed_shared) = if target.contains("apple") {
            ("liblipz_capi.dylib", ("liblipz.dylib".to_owned(), Vec::new()))
        } else {
            let links = vec![soname().to_owned(), "liblipz.so".to_owned()];
            ("liblipz_capi.so", (format!("liblipz.so.{VERSION}"), links))
        };
        let installed_shared = Some(installed_shared);
        Names { built_shared: Some(built_shared), installed_shared, ..Names::of_static(target) }
    }

    /// Returns the names for a target of the compiler with only the static library.
    pub(crate) fn of_static(target: &str) -> Names {
        let (built_static, installed_static) =
            if target.ends_with("-msvc") { ("lipz_capi.lib", "lipz.lib") } else { ("liblipz_capi.a", "liblipz.a") };
        Names { built_static, built_shared: None, installed_static, installed_shared: None }
    }
}

/// Returns the files to install, with the libraries in `built`.
pub(crate) fn files(built: &Path, names: &Names) -> Result<Vec<Entry>, Failure> {
    let sources = paths::workspace_root().join("crates/lipz-capi");
    let read = |path: &Path| fs::read(path).map_err(|error| format!("`{}`: {error}", path.display()));
    let mut entries = Vec::new();
    for header in ["lipz.h", "lipz.hpp"] {
        entries.push(Entry::file(format!("include/{header}"), read(&sources.join("include").join(header))?));
    }
    entries.push(Entry::file(format!("lib/{}", names.installed_static), read(&built.join(names.built_static))?));
    if let (Some(built_shared), Some((name, links))) = (names.built_shared, &names.installed_shared) {
        entries.push(Entry::program(format!("lib/{name}"), read(&built.join(built_shared))?));
        let link = |path: &String| Entry { path: format!("lib/{path}"), content: Content::Link(name.clone()) };
        entries.extend(links.iter().map(link));
    }
    let shared = names.installed_shared.as_ref().map_or("", |(name, _)| name);
    for path in ["pkgconfig/lipz.pc", "cmake/lipz/lipz-config.cmake", "cmake/lipz/lipz-config-version.cmake"] {
        let name = path.rsplit('/').next().unwrap_or(path);
        let template = String::from_utf8_lossy(&read(&sources.join("package").join(name))?).into_owned();
        let text = template
            .replace("@VERSION@", VERSION)
            .replace("@STATIC@", names.installed_static)
            .replace("@SHARED@", shared)
            .replace("@SONAME@", if shared.contains(".so.") { soname() } else { shared });
        entries.push(Entry::file(format!("lib/{path}"), text));
    }
    Ok(entries)
}

/// Installs the files below `prefix`, and replaces existing ones.
pub(super) fn install(entries: &[Entry], prefix: &Path) -> Result<(), Failure> {
    entries
        .iter()
        .try_for_each(|entry| entry.write(prefix))
        .map_err(|error| format!("`{}` cannot be written: {error}", prefix.display()))
}
