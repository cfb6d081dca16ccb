//! `cargo xtask site`: makes the site of the documentation in `target/site/html`, with the API pages in `api` and a
//! page of `lipz preview` in `demo`, and checks every link.

mod demo;
mod links;
mod pages;

use crate::Failure;
use crate::cargo;
use crate::dist;
use crate::paths::{target_folder, workspace_root};
use crate::tools::{skip, succeed};
use pages::SETTINGS;
use std::fs;
use std::path::Path;
use std::process::Command;

/// The page that the link to the API leads to.
const API_PAGE: &str = "api/lipz_bank/index.html";

pub(crate) fn run() -> Result<(), Failure> {
    let Some(zensical) = dist::tool("zensical") else {
        return skip("zensical: `.ci/install --all`");
    };
    let folder = std::path::absolute(target_folder().join("site")).map_err(|error| error.to_string())?;
    let failed = |error: std::io::Error| format!("`{}`: {error}", folder.display());
    if folder.exists() {
        fs::remove_dir_all(&folder).map_err(failed)?;
    }
    let pages = pages::collect(&workspace_root())?;
    for (path, bytes) in &pages.files {
        write(&folder.join("docs").join(path), bytes)?;
    }
    let settings = fs::read_to_string(workspace_root().join("docs").join(SETTINGS)).map_err(failed)?;
    write(&folder.join(SETTINGS), settings.replace("nav = []", &pages.navigation).as_bytes())?;
    let mut build = Command::new(zensical);
    succeed(build.args(["build", "--clean", "--strict"]).env("NO_COLOR", "1").current_dir(&folder), "zensical")?;
    let html = folder.join("html");
    succeed(
        cargo::command().args(["doc", "--workspace", "--no-deps", "--locked", "--quiet"]).current_dir(workspace_root()),
        "cargo doc",
    )?;
    copy(&target_folder().join("doc"), &html.join("api")).map_err(failed)?;
    demo::write(&html.join("demo"))?;
    let dead = links::dead(&html).map_err(failed)?;
    if !dead.is_empty() {
        return Err(format!("dead links:\n{}", dead.join("\n")));
    }
    if !html.join(API_PAGE).is_file() {
        return Err(format!("`{API_PAGE}` is missing"));
    }
    println!("site: {}", html.display());
    Ok(())
}

/// Writes a file and the folders above it.
fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let parent = path.parent().unwrap_or(Path::new("."));
    fs::create_dir_all(parent)
        .and_then(|()| fs::write(path, bytes))
        .map_err(|error| format!("`{}`: {error}", path.display()))
}

/// Copies a folder with all folders in it.
fn copy(from: &Path, to: &Path) -> std::io::Result<()> {
    fs::create_dir_all(to)?;
    for entry in fs::read_dir(from)? {
        let entry = entry?;
        let target = to.join(entry.file_name());
        match entry.file_type()?.is_dir() {
            true => copy(&entry.path(), &target)?,
            false => fs::copy(entry.path(), target).map(|_| ())?,
        }
    }
    Ok(())
}
