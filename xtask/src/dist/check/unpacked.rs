//! The archives, unpacked and used as their README says, in an emulator for a different machine.

use super::commands::{answers, printed};
use crate::Failure;
use crate::capi;
use crate::capi::install::Names;
use crate::dist::Packages;
use crate::dist::archive::checksum_line;
use crate::dist::build::tools_folder;
use crate::dist::contents::read;
use crate::dist::platform::{EMULATORS, GLIBC, Platform, archive_extension, emulated};
use crate::tools::{has_program, skip};
use object::read::archive::ArchiveFile;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The files that the archive of the command must have, besides the program.
const FILES: [&str; 8] = [
    "README.md",
    "CHANGELOG.md",
    "LICENSE-MIT",
    "LICENSE-APACHE",
    "NOTICES.txt",
    "completions/lipz.bash",
    "completions/_lipz",
    "man/lipz.1",
];

/// Checks the checksum of the command's archive, its files and the program.
pub(super) fn archive(packages: &Packages, folder: &Path) -> Result<(), Failure> {
    let unpacked = unpack(packages.platform.target, &packages.archive, folder)?;
    if let Some(missing) = FILES.iter().find(|file| !unpacked.join(file).is_file()) {
        return Err(format!("`{}` lacks `{missing}`", packages.archive.display()));
    }
    let program = unpacked.join(packages.platform.program());
    if packages.platform.runner(&program).is_none() {
        return skip(EMULATORS);
    }
    // It has just been found.
    let run = || packages.platform.runner(&program).unwrap_or_else(|| Command::new(&program));
    answers(&format!("archive for {}", packages.platform.target), run, folder)
}

/// Compiles the example with the archive of the library for a platform, and runs it.
pub(super) fn library(packages: &Packages, folder: &Path) -> Result<(), Failure> {
    let platform = packages.platform;
    let prefix = unpack(platform.target, &packages.library, folder)?;
    exports(platform.target, &prefix)?;
    if Platform::host() == Some(platform) && platform.is_linux() {
        if !has_program("cmake") {
            return skip("cmake");
        }
        return capi::programs::with_cmake(&prefix.join("examples"), &prefix, &folder.join("build"));
    }
    plays(platform.target, &prefix, folder)
}

/// Checks an archive with only the static library, and runs the example on targets with an emulator.
pub(super) fn static_library(target: &str, archive: &Path, folder: &Path) -> Result<(), Failure> {
    let prefix = unpack(target, archive, folder)?;
    exports(target, &prefix)?;
    plays(target, &prefix, folder)
}

/// Checks that the static library has all functions of the header.
fn exports(target: &str, prefix: &Path) -> Result<(), Failure> {
    let names = Names::of_static(target);
    let path = prefix.join("lib").join(names.installed_static);
    let bytes = read(&path)?;
    let failed = |error: object::Error| format!("`{}`: {error}", path.display());
    let archive = ArchiveFile::parse(&*bytes).map_err(failed)?;
    let symbols = archive.symbols().map_err(failed)?.ok_or("the library has no table of symbols")?;
    let mut found = BTreeSet::new();
    for symbol in symbols {
        let name = String::from_utf8_lossy(symbol.map_err(failed)?.name()).into_owned();
        // On systems of Apple, each name has an underscore in front.
        found.insert(name.trim_start_matches('_').to_owned());
    }
    let header = String::from_utf8_lossy(&read(&prefix.join("include/lipz.h"))?).into_owned();
    let missing: Vec<&str> = functions(&header).filter(|name| !found.contains(*name)).collect();
    if !missing.is_empty() {
        return Err(format!("`{}` lacks {}", path.display(), missing.join(", ")));
    }
    println!("liblipz for {target}: all {} functions", functions(&header).count());
    Ok(())
}

/// Returns the names of the functions that a header declares, without those whose code is in the header.
fn functions(header: &str) -> impl Iterator<Item = &str> {
    header.lines().filter_map(|line| {
        let is_declaration = line.starts_with(|c: char| c.is_ascii_lowercase())
            && !["static", "typedef", "extern"].iter().any(|word| line.starts_with(word));
        let (before, _) = line.split_once('(').filter(|_| is_declaration)?;
        before.rsplit([' ', '*']).next().filter(|name| name.starts_with("lipz_"))
    })
}

/// Compiles the example for a target, and runs it in an emulator if there is one.
fn plays(target: &str, prefix: &Path, folder: &Path) -> Result<(), Failure> {
    let Some(zig_target) = zig_target(target) else { return Ok(()) };
    let program = folder.join(if target.contains("windows") { "play.exe" } else { "play" });
    let run = || match target == NATIVE_MUSL && cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        true => Some(Command::new(&program)),
        false => emulated(target, &program),
    };
    if run().is_none() {
        return skip(EMULATORS);
    }
    let mut compile = Command::new(tools_folder().join("python"));
    compile.args(["-m", "ziglang", "cc", "-target", &zig_target]);
    compile.args(["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic"]);
    compile.arg("-I").arg(prefix.join("include")).arg(prefix.join("examples/play.c"));
    printed(compile.arg(prefix.join("lib/liblipz.a")).arg("-o").arg(&program))?;
    capi::programs::plays(|| run().unwrap_or_else(|| Command::new(&program)), prefix)
}

/// The target whose programs run on any Linux with the same processor.
const NATIVE_MUSL: &str = "x86_64-unknown-linux-musl";

/// Returns the name of a target in zig, for those that it compiles and that run here or in an emulator.
fn zig_target(target: &str) -> Option<String> {
    match target {
        "aarch64-unknown-linux-gnu" => Some(format!("aarch64-linux-gnu.{}.{}", GLIBC.0, GLIBC.1)),
        "aarch64-unknown-linux-musl" => Some("aarch64-linux-musl".to_owned()),
        "x86_64-pc-windows-gnu" => Some("x86_64-windows-gnu".to_owned()),
        NATIVE_MUSL => Some("x86_64-linux-musl".to_owned()),
        _ => None,
    }
}

/// Unpacks an archive after comparing its checksum, and returns the folder in it.
fn unpack(target: &str, archive: &Path, folder: &Path) -> Result<PathBuf, Failure> {
    let name = archive.file_name().unwrap_or_default().to_string_lossy();
    let sum = PathBuf::from(format!("{}.sha256", archive.display()));
    if read(&sum)? != checksum_line(&name, &read(archive)?).as_bytes() {
        return Err(format!("`{}` is not the checksum of `{name}`", sum.display()));
    }
    fs::create_dir_all(folder).map_err(|error| format!("`{}`: {error}", folder.display()))?;
    let extension = archive_extension(target);
    let mut unpack = if extension == "zip" {
        let mut unzip = Command::new("python3");
        unzip.args(["-m", "zipfile", "-e"]).arg(archive).arg(folder);
        unzip
    } else {
        let mut tar = Command::new("tar");
        tar.arg("-xzf").arg(archive).arg("-C").arg(folder);
        tar
    };
    printed(&mut unpack)?;
    let stem = name.trim_end_matches(extension).trim_end_matches('.');
    Ok(folder.join(stem))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_of_a_header_are_found() {
        let header = "// lipz_a(1)\ntypedef int (*lipz_b)(void);\nlipz_status lipz_c(\n    int d);\n\
                      const char *lipz_e(void);\nstatic inline int lipz_f(void) {\n";
        assert_eq!(functions(header).collect::<Vec<_>>(), ["lipz_c", "lipz_e"]);
    }
}
