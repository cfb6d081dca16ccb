//! `cargo xtask web`: builds the npm package in `target/web`, and tests it in node and in Chromium. `cargo xtask
//! pictures` draws the images of the documentation with it.
//!
//! Its wasm module is lipz-capi without additional code, because JavaScript uses the ABI of C.

use crate::toolchain::{Library, Toolchain, needs, rust_lld, variable};
use crate::tools::{has_program, skip, skip_rest, succeed};
use crate::{Failure, paths};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const TARGET: &str = "wasm32-unknown-unknown";

/// The banks of the demo and the tests, with their names there.
const DEMO_BANKS: [(&str, &str); 2] = [("drama", "dialogue"), ("faces", "faces")];

/// The playback cases.
const CASES: &str = "fixtures/playback/cases.txt";
const BANKS: &str = "fixtures/banks/v1";
/// A set, and its banks.
const SETS: &str = "fixtures/banks/sets";

/// The example whose output is compared.
const EXAMPLE: &str = "examples/node";

/// The folders of the package, the first of which is the package itself.
const FOLDERS: [&str; 6] = ["", "demo", "examples", "face", "test", "test/engines"];

/// The folder of the examples, one in each subfolder.
const ENGINE_EXAMPLES: &str = "packages/lipz-web/examples";

/// The module in the sources of `lipz preview`, which `cargo install` cannot build.
const PREVIEW_MODULE: &str = "crates/lipz/src/commands/preview/web/lipz.wasm";

/// The extension of test files, and the test that needs a browser.
const TEST: &str = ".test.js";
const BROWSER_TEST: &str = "browser.test.js";

/// The folder of the images that the package draws.
const PICTURES: &str = "docs/pictures";

pub(crate) fn run() -> Result<(), Failure> {
    let Some(package) = package()? else { return Ok(()) };
    let files = tests(&package).map_err(|error| format!("`{}`: {error}", package.display()))?;
    for file in &files {
        test(&package, file)?;
    }
    example(&package)?;
    if !has_program("chromium") {
        return skip_rest("chromium");
    }
    test(&package, BROWSER_TEST)
}

/// Tests the package with the bundlers and engines that its examples are for.
pub(crate) fn engines() -> Result<(), Failure> {
    for program in ["npm", "chromium"] {
        if !has_program(program) {
            return skip(program);
        }
    }
    let Some(package) = package()? else { return Ok(()) };
    let tests = package.join("test/engines/run.js");
    succeed(Command::new("node").arg(tests).arg(paths::target_folder().join("web-engines")), "the test of engines")
}

/// Returns the files with tests for node, ordered by name.
fn tests(package: &Path) -> std::io::Result<Vec<String>> {
    let names = fs::read_dir(package.join("test"))?.map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned()));
    let mut files = names.collect::<std::io::Result<Vec<String>>>()?;
    files.retain(|name| name.ends_with(TEST) && name != BROWSER_TEST);
    files.sort();
    Ok(files)
}

/// Draws the images of the documentation.
pub(crate) fn pictures() -> Result<(), Failure> {
    let Some(package) = package()? else { return Ok(()) };
    let folder = paths::workspace_root().join(PICTURES);
    succeed(Command::new("node").arg(package.join("test/pictures.js")).arg(&folder), "drawing")?;
    println!("pictures: {}", folder.display());
    Ok(())
}

/// Builds the package and returns its folder; `None` if this machine lacks a tool to build or run it.
fn package() -> Result<Option<PathBuf>, Failure> {
    let Some(toolchain) = Toolchain::find(TARGET, Library::Core) else {
        return skip(&needs(TARGET)).map(|()| None);
    };
    build(&toolchain)?;
    let package = paths::target_folder().join("web");
    assemble(&package, &toolchain.release_folder(), &crate::capi::layouts()?)
        .map_err(|error| format!("`{}` cannot be written: {error}", package.display()))?;
    println!("npm package: {}", package.display());
    compare_module(&package.join("lipz.wasm"))?;
    if !has_program("node") {
        return skip_rest("node").map(|()| None);
    }
    Ok(Some(package))
}

/// Checks that `lipz preview` has the built module. With `LIPZ_BLESS=1`, copies it there.
fn compare_module(built: &Path) -> Result<(), Failure> {
    let committed = paths::workspace_root().join(PREVIEW_MODULE);
    let failed = |error: std::io::Error| format!("`{}`: {error}", committed.display());
    let bytes = fs::read(built).map_err(failed)?;
    if fs::read(&committed).is_ok_and(|committed| committed == bytes) {
        return Ok(());
    }
    if std::env::var_os("LIPZ_BLESS").is_some_and(|value| value == "1") {
        return fs::write(&committed, bytes).map_err(failed);
    }
    Err(format!("`{PREVIEW_MODULE}` differs from the current lipz-capi: run `LIPZ_BLESS=1 cargo xtask web`"))
}

fn build(toolchain: &Toolchain) -> Result<(), Failure> {
    // Small code is faster here: a page waits longer for loading the module than for its answers.
    let mut command = toolchain.as_firmware("rustc");
    if let Some(linker) = rust_lld() {
        command.env(variable(TARGET, "LINKER"), linker);
    }
    command.args(["--package", "lipz-capi", "--lib", "--quiet"]);
    command.args(["--features", "panic-handler", "--crate-type", "cdylib", "--", "-C", "strip=symbols"]);
    succeed(&mut command, "the build of the module")
}

/// Assembles the package, and replaces an existing one. The module is in `built`.
fn assemble(package: &Path, built: &Path, layouts: &Path) -> std::io::Result<()> {
    let root = paths::workspace_root();
    if package.exists() {
        fs::remove_dir_all(package)?;
    }
    for folder in FOLDERS {
        copy_files(&root.join("packages/lipz-web").join(folder), &package.join(folder))?;
    }
    copy_folders(&root.join(ENGINE_EXAMPLES), &package.join("examples"))?;
    fs::copy(built.join("lipz_capi.wasm"), package.join("lipz.wasm"))?;
    for licence in ["LICENSE-MIT", "LICENSE-APACHE"] {
        fs::copy(root.join(licence), package.join(licence))?;
    }
    for (bank, name) in DEMO_BANKS {
        let from = root.join(BANKS).join(bank).with_extension("lipzbank");
        fs::copy(from, package.join("demo").join(name).with_extension("lipzbank"))?;
    }
    fs::copy(root.join("crates/lipz-capi/include/lipz.h"), package.join("test/lipz.h"))?;
    fs::copy(root.join(CASES), package.join("test/cases.txt"))?;
    copy_files(&root.join(BANKS), &package.join("test/banks"))?;
    copy_files(&root.join(SETS), &package.join("test/sets"))?;
    copy_folders(layouts, &package.join("test/layouts"))?;
    fs::copy(root.join("docs/guides/faces.md"), package.join("test/faces.md"))?;
    copy_files(&root.join(PICTURES), &package.join("test/pictures"))?;
    Ok(())
}

/// Copies the files of a folder, without subfolders.
fn copy_files(from: &Path, to: &Path) -> std::io::Result<()> {
    fs::create_dir_all(to)?;
    for entry in fs::read_dir(from)? {
        let entry = entry?;
        if entry.file_type()?.is_file() {
            fs::copy(entry.path(), to.join(entry.file_name()))?;
        }
    }
    Ok(())
}

/// Copies the folders in a folder, each with its files.
fn copy_folders(from: &Path, to: &Path) -> std::io::Result<()> {
    for entry in fs::read_dir(from)? {
        let entry = entry?;
        if entry.file_type()?.is_dir() {
            copy_files(&entry.path(), &to.join(entry.file_name()))?;
        }
    }
    Ok(())
}

/// Runs the example from inside the package, which resolves its own name.
fn example(package: &Path) -> Result<(), Failure> {
    let from = paths::workspace_root().join(EXAMPLE);
    let program = package.join("test/play.js");
    let failed = |error| format!("`{EXAMPLE}`: {error}");
    fs::copy(from.join("play.js"), &program).map_err(failed)?;
    let expected = fs::read_to_string(from.join("expected.txt")).map_err(failed)?;
    let bank = paths::workspace_root().join(BANKS).join("drama.lipzbank");
    let output = Command::new("node").arg(&program).args(["act1/otto-ticking", "de-de"]).arg(bank).output();
    let output = output.map_err(failed)?;
    let found = String::from_utf8_lossy(&output.stdout);
    if found != expected {
        return Err(format!(
            "`{EXAMPLE}` prints different output:\n{found}{}",
            String::from_utf8_lossy(&output.stderr)
        ));
    }
    println!("{EXAMPLE}: as expected");
    Ok(())
}

fn test(package: &Path, file: &str) -> Result<(), Failure> {
    let mut command = Command::new("node");
    command.args(["--test", "--test-reporter=spec"]).arg(package.join("test").join(file));
    succeed(&mut command, file)
}
