//! `cargo xtask dist`: builds the published packages in `target/dist-packages`: archives, wheels, npm packages, and the library
//! for C. With `--check`, installs and tests them. With `--ports`, builds the archives of the readers for engines.
//!
//! All packages for a platform contain the same program. The files of this folder are in the order of the steps:
//! `build` compiles it, `contents` and `notices` collect the other files, `archive`, `wheel`, `npm` and `library` wrap
//! them. `check` uses only the finished packages.

pub(crate) mod archive;
mod build;
mod check;
mod contents;
mod library;
mod notices;
mod npm;
mod platform;
mod ports;
mod wheel;

use crate::Failure;
use crate::paths::target_folder;
pub(crate) use build::tool;

use archive::{Entry, checksum_line, tar_gz, zip};
use clap::Args;
use contents::{Contents, read};
use platform::{PLATFORMS, Platform, archive_extension};
use std::fs;
use std::path::{Path, PathBuf};
use wheel::VERSION;

/// The packages to build.
#[derive(Args, Debug)]
pub(crate) struct Settings {
    /// Targets of the compiler [default: that of this machine]
    #[arg(long, value_name = "TARGET", value_parser = platform)]
    target: Vec<&'static Platform>,
    /// Only the archives of the library for C for targets on which the command does not run: phones, musl, WebAssembly
    /// and boards
    #[arg(long, conflicts_with = "target")]
    libraries: bool,
    /// Only the archives of the readers for engines, which are the same on all platforms; their contents are checked
    #[arg(long, conflicts_with_all = ["target", "libraries"])]
    ports: bool,
    /// Also install the packages in empty folders, run them, and hold them to their limits
    #[arg(long)]
    check: bool,
}

fn platform(target: &str) -> Result<&'static Platform, String> {
    let known = || PLATFORMS.iter().map(|platform| platform.target).collect::<Vec<_>>().join(", ");
    PLATFORMS.iter().find(|platform| platform.target == target).ok_or_else(|| format!("expected one of {}", known()))
}

/// The packages for one platform.
struct Packages {
    platform: &'static Platform,
    program: PathBuf,
    archive: PathBuf,
    wheel: PathBuf,
    npm: PathBuf,
    library: PathBuf,
    /// The npm package that is the same for all platforms.
    npm_starter: PathBuf,
}

pub(crate) fn run(settings: &Settings) -> Result<(), Failure> {
    // Not `dist`, which is cargo's folder for the profile of this name.
    let folder = target_folder().join("dist-packages");
    fs::create_dir_all(&folder).map_err(|error| format!("`{}`: {error}", folder.display()))?;
    if settings.ports {
        ports::run(&folder)?;
    } else if settings.libraries {
        libraries(&folder, settings.check)?;
    } else {
        platforms(&folder, settings)?;
    }
    println!("packages: {}", folder.display());
    Ok(())
}

/// Builds the packages for the chosen platforms.
fn platforms(folder: &Path, settings: &Settings) -> Result<(), Failure> {
    let host = Platform::host().into_iter().collect();
    let platforms: &Vec<&Platform> = if settings.target.is_empty() { &host } else { &settings.target };
    if platforms.is_empty() {
        return Err("there are no packages for this machine".to_owned());
    }
    for platform in platforms {
        let packages = packages(platform, folder)?;
        if settings.check {
            check::run(&packages)?;
        }
    }
    Ok(())
}

/// Builds the archives with only the library for C.
fn libraries(folder: &Path, is_checked: bool) -> Result<(), Failure> {
    for target in library::TARGETS {
        let archive = archived(folder, "liblipz", target, &library::static_files(target)?)?;
        if is_checked {
            check::library(target, &archive)?;
        }
    }
    Ok(())
}

/// Builds the command for this machine and returns its path. It has symbols.
pub(crate) fn program_with_symbols() -> Result<PathBuf, Failure> {
    let host = Platform::host().ok_or("there are no packages for this machine")?;
    Ok(build::command(host)?.with_symbols)
}

/// Makes all packages for a platform.
fn packages(platform: &'static Platform, folder: &Path) -> Result<Packages, Failure> {
    let program = build::command(platform)?;
    let contents = Contents::of(platform, &program.stripped)?;
    let symbols = format!("symbols/lipz-v{VERSION}-{}", platform.target);
    write(folder, &symbols, &read(&program.with_symbols)?)?;
    let npm_starter = write(folder, &npm::name("lipz"), &npm::starter(&contents)?)?;
    Ok(Packages {
        platform,
        archive: archived(folder, "lipz", platform.target, &in_archive(platform, &contents))?,
        wheel: write(folder, &wheel::name(platform), &wheel::wheel(platform, &contents)?)?,
        npm: write(folder, &npm::name(&platform.npm_package()), &npm::program(platform, &contents)?)?,
        library: archived(folder, "liblipz", platform.target, &library::files(platform)?)?,
        npm_starter,
        program: program.stripped,
    })
}

/// Returns the files of the archive of the command.
fn in_archive(platform: &Platform, contents: &Contents) -> Vec<Entry> {
    let mut entries = vec![
        Entry::program(platform.program(), contents.program.clone()),
        Entry::file("README.md", contents.readme.as_bytes()),
        Entry::file("CHANGELOG.md", contents.changelog.as_slice()),
    ];
    entries.extend(contents.licences.iter().cloned());
    entries.extend(contents.completions.iter().map(|completion| completion.below("completions")));
    entries.extend(contents.manual.iter().map(|page| page.below("man")));
    entries
}

/// Returns the name of an archive without its extension, and of the folder in it.
fn stem(package: &str, target: &str) -> String {
    format!("{package}-v{VERSION}-{target}")
}

/// Writes an archive with a folder of its name, and its checksum. Returns the path of the archive.
fn archived(folder: &Path, package: &str, target: &str, entries: &[Entry]) -> Result<PathBuf, Failure> {
    let stem = stem(package, target);
    let entries: Vec<Entry> = entries.iter().map(|entry| entry.below(&stem)).collect();
    let extension = archive_extension(target);
    let archive = if extension == "zip" { zip(&entries) } else { tar_gz(&entries) };
    let archive = archive.map_err(|error| format!("`{stem}`: {error}"))?;
    let name = format!("{stem}.{extension}");
    write(folder, &format!("{name}.sha256"), checksum_line(&name, &archive).as_bytes())?;
    write(folder, &name, &archive)
}

/// Writes a file and returns its path.
fn write(folder: &Path, name: &str, bytes: &[u8]) -> Result<PathBuf, Failure> {
    let path = std::path::absolute(folder.join(name)).map_err(|error| error.to_string())?;
    let parent = path.parent().unwrap_or(folder);
    fs::create_dir_all(parent)
        .and_then(|()| fs::write(&path, bytes))
        .map_err(|error| format!("`{}`: {error}", path.display()))?;
    Ok(path)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::paths::workspace_root;

    #[test]
    fn cargo_binstall_finds_the_archives_and_the_program() {
        let manifest = fs::read_to_string(workspace_root().join("crates/lipz/Cargo.toml")).unwrap();
        let (general, for_windows) = manifest.split_once(".overrides.x86_64-pc-windows-msvc]").unwrap();
        let value = |section: &str, key: &str| {
            let start = format!("{key} = \"");
            section.lines().find_map(|line| Some(line.strip_prefix(&start)?.trim_end_matches('"').to_owned())).unwrap()
        };
        for platform in PLATFORMS.iter().filter(|platform| platform.is_released) {
            let section = if platform.is_windows() { for_windows } else { general };
            let filled = |text: String| {
                let names = [("repo", "R"), ("version", VERSION), ("name", "lipz"), ("target", platform.target)];
                let binary = platform.program().strip_prefix("lipz").unwrap();
                names
                    .into_iter()
                    .chain([("bin", "lipz"), ("binary-ext", binary)])
                    .fold(text, |text, (name, value)| text.replace(&format!("{{ {name} }}"), value))
            };
            let stem = stem("lipz", platform.target);
            let archive = format!("R/releases/download/v{VERSION}/{stem}.{}", archive_extension(platform.target));
            assert_eq!(filled(value(section, "pkg-url")), archive);
            assert_eq!(filled(value(general, "bin-dir")), format!("{stem}/{}", platform.program()));
            assert_eq!(value(section, "pkg-fmt"), if platform.is_windows() { "zip" } else { "tgz" });
        }
    }
}
