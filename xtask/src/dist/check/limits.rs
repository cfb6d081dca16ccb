//! Sizes, symbols, and the oldest system on which a program runs.

use crate::Failure;
use crate::dist::Packages;
use crate::dist::contents::read;
use crate::dist::platform::{GLIBC, Platform};
use object::{Object, ObjectSection};
use std::path::Path;

/// The most bytes of a program without symbols.
const MOST_PROGRAM_BYTES: usize = 18_000_000;

/// The most bytes of an archive, a wheel or an npm package: those that users download.
const MOST_PACKAGE_BYTES: usize = 9_000_000;

/// Returns the limits that packages exceed, and prints their sizes.
pub(super) fn faults(packages: &Packages) -> Result<Vec<String>, Failure> {
    let program = read(&packages.program)?;
    let mut faults = in_program(packages.platform, &program)?;
    faults.extend(too_large(&packages.program, program.len(), MOST_PROGRAM_BYTES));
    for path in [&packages.archive, &packages.wheel, &packages.npm, &packages.npm_starter, &packages.library] {
        faults.extend(too_large(path, read(path)?.len(), MOST_PACKAGE_BYTES));
    }
    Ok(faults)
}

fn too_large(path: &Path, bytes: usize, most_bytes: usize) -> Option<String> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    println!("{bytes:>12} bytes  {name}");
    (bytes > most_bytes).then(|| format!("`{name}` has {bytes} bytes, and the limit is {most_bytes}"))
}

/// Returns the faults of a program: symbols, debug information, and functions of a newer glibc.
fn in_program(platform: &Platform, program: &[u8]) -> Result<Vec<String>, Failure> {
    // The symbols that remain in a program for macOS are those of libraries.
    if !platform.is_linux() && !platform.is_windows() {
        return Ok(Vec::new());
    }
    let file = object::File::parse(program).map_err(|error| format!("the program of {}: {error}", platform.target))?;
    let mut faults = Vec::new();
    let symbol_count = file.symbols().count();
    if symbol_count > 0 {
        faults.push(format!("the program has {symbol_count} symbols: it is not stripped"));
    }
    for section in file.sections() {
        let name = section.name().unwrap_or_default();
        if name.starts_with(".debug") || name.starts_with(".zdebug") {
            faults.push(format!("the program has the section `{name}`: it is not stripped"));
        }
        // The names of required versions are among the strings for loading.
        if name == ".dynstr" {
            let strings = section.data().map_err(|error| format!("`{name}`: {error}"))?;
            faults.extend(newer_versions(strings));
        }
    }
    Ok(faults)
}

/// Returns a fault for each required version of glibc that is newer than the limit.
fn newer_versions(strings: &[u8]) -> impl Iterator<Item = String> {
    let names = strings.split(|byte| *byte == 0).filter_map(|name| std::str::from_utf8(name).ok());
    let newer = names.filter(|name| {
        let version = name.strip_prefix("GLIBC_").and_then(|version| {
            let mut numbers = version.split('.').map(|number| number.parse().unwrap_or(0));
            Some((numbers.next()?, numbers.next().unwrap_or(0)))
        });
        version.is_some_and(|version| version > GLIBC)
    });
    newer.map(|name| format!("the program needs {name}, newer than GLIBC_{}.{}", GLIBC.0, GLIBC.1))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn newer_versions_of_glibc_are_found() {
        let found = |strings: &[u8]| newer_versions(strings).count();
        assert_eq!(found(b"\0GLIBC_2.2.5\0GLIBC_2.17\0GLIBC_PRIVATE\0memcpy\0GCC_3.0\0"), 0);
        assert_eq!(found(b"\0GLIBC_2.18\0GLIBC_2.34\0GLIBC_3\0"), 3);
    }

    #[test]
    fn symbols_are_found() {
        // Tests have symbols.
        let Some(platform) = Platform::host().filter(|platform| platform.is_linux()) else { return };
        let program = std::fs::read(std::env::current_exe().unwrap()).unwrap();
        let faults = in_program(platform, &program).unwrap();
        assert!(faults.iter().any(|fault| fault.ends_with("symbols: it is not stripped")), "{faults:?}");
    }

    #[test]
    fn a_large_file_is_a_fault() {
        assert_eq!(too_large(Path::new("a"), 9, 9), None);
        assert_eq!(too_large(Path::new("b/a"), 10, 9).unwrap(), "`a` has 10 bytes, and the limit is 9");
    }
}
