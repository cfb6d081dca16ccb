//! `cargo xtask dist --check`: tests the finished packages as users get them, and holds them to their limits.

mod commands;
mod limits;
mod npm;
mod pages;
mod pip;
mod services;
mod unpacked;

use super::Packages;
use super::platform::Platform;
use crate::Failure;
use crate::paths::temporary_folder;
use std::path::Path;

/// Tests an archive with only the library for C.
pub(super) fn library(target: &str, archive: &Path) -> Result<(), Failure> {
    let folder = temporary_folder()?;
    unpacked::static_library(target, archive, folder.path())
}

/// Tests the packages for one platform.
pub(super) fn run(packages: &Packages) -> Result<(), Failure> {
    let folder = temporary_folder()?;
    unpacked::archive(packages, &folder.path().join("archive"))?;
    unpacked::library(packages, &folder.path().join("library"))?;
    pip::metadata(packages)?;
    npm::contents(packages, &folder.path().join("contents"))?;
    // Neither installer accepts packages for a different machine.
    if Platform::host() == Some(packages.platform) {
        let installed = pip::install(packages, &folder.path().join("pip"))?;
        npm::install(packages, &folder.path().join("npm"))?;
        npm::install_without_program(packages, &folder.path().join("npm-without"))?;
        // Scripts for a shell of Unix, tested where most services run them.
        if packages.platform.is_linux() {
            pages::run(packages, &folder.path().join("pages"))?;
            services::github(packages, &folder.path().join("github"))?;
            services::gitlab(&installed, &folder.path().join("gitlab"))?;
            services::pre_commit(packages, &folder.path().join("pre-commit"))?;
        }
    }
    let faults = limits::faults(packages)?;
    if faults.is_empty() { Ok(()) } else { Err(faults.join("\n")) }
}
