//! The npm packages: their contents, and their installation into an empty folder.

use super::commands::{answers, output, printed, quickly};
use crate::Failure;
use crate::dist::Packages;
use crate::tools::{has_program, skip};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// npm, which is a script on Windows.
const NPM: &str = if cfg!(windows) { "npm.cmd" } else { "npm" };

/// Checks that npm would publish every file of the packages.
pub(super) fn contents(packages: &Packages, folder: &Path) -> Result<(), Failure> {
    if !has_program(NPM) {
        return skip("npm");
    }
    for package in [&packages.npm, &packages.npm_starter] {
        let folder = folder.join(package.file_stem().unwrap_or_default());
        let failed = |error: std::io::Error| format!("`{}`: {error}", folder.display());
        fs::create_dir_all(&folder).map_err(failed)?;
        printed(Command::new("tar").arg("-xzf").arg(package).arg("-C").arg(&folder))?;
        let folder = folder.join("package");
        let listed = printed(Command::new(NPM).args(["pack", "--dry-run", "--json"]).current_dir(&folder))?;
        let listed: serde_json::Value =
            serde_json::from_str(&listed).map_err(|error| format!("npm pack printed something else: {error}"))?;
        let count = listed[0]["entryCount"].as_u64().unwrap_or(0);
        let own = count_files(&folder).map_err(failed)?;
        if count != own {
            return Err(format!("npm would publish {count} of {own} files of `{}`", package.display()));
        }
        println!("npm pack --dry-run: {} with {count} files", listed[0]["filename"].as_str().unwrap_or("?"));
    }
    Ok(())
}

fn count_files(folder: &Path) -> std::io::Result<u64> {
    let mut count = 0;
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        count += if entry.file_type()?.is_dir() { count_files(&entry.path())? } else { 1 };
    }
    Ok(count)
}

/// Installs the packages into an empty folder, and runs the program.
pub(super) fn install(packages: &Packages, folder: &Path) -> Result<(), Failure> {
    if !has_program(NPM) {
        return skip("npm");
    }
    quickly("npm", npm_install(folder)?.arg(&packages.npm_starter).arg(&packages.npm))?;
    answers("npm", || Command::new(program(folder)), folder)?;
    let npx = || {
        let mut command = Command::new(NPM);
        command.args(["exec", "--offline", "--no", "--prefix"]).arg(folder).args(["--", "lipz"]);
        command
    };
    answers("npx", npx, folder)
}

/// Installs only the starter, as if npm had skipped the program, and checks its message.
pub(super) fn install_without_program(packages: &Packages, folder: &Path) -> Result<(), Failure> {
    if !has_program(NPM) {
        return skip("npm");
    }
    printed(npm_install(folder)?.arg("--omit=optional").arg(&packages.npm_starter))?;
    let output = output(Command::new(program(folder)).arg("--version"))?;
    let errors = String::from_utf8_lossy(&output.stderr);
    let name = packages.platform.npm_package();
    let needed = [name.as_str(), "--omit=optional", "pip install lipz", "cargo install"];
    if output.status.code() != Some(1) || !needed.iter().all(|part| errors.contains(part)) {
        return Err(format!("without {name}, lipz ended with {}: {errors}", output.status));
    }
    println!("npm without {name}: lipz prints other ways to install");
    Ok(())
}

fn npm_install(folder: &Path) -> Result<Command, Failure> {
    fs::create_dir_all(folder).map_err(|error| format!("`{}`: {error}", folder.display()))?;
    let mut npm = Command::new(NPM);
    // Without the network, so that the time is that of the installation.
    npm.args(["install", "--offline", "--no-audit", "--no-fund", "--silent", "--prefix"]).arg(folder);
    npm.current_dir(folder);
    Ok(npm)
}

fn program(folder: &Path) -> PathBuf {
    folder.join("node_modules/.bin").join(if cfg!(windows) { "lipz.cmd" } else { "lipz" })
}
