//! `cargo xtask features`: each feature of the libraries by itself, that no feature of the compiler changes a byte
//! of a bank, and how many crates a build script needs.

use crate::Failure;
use crate::cargo;
use crate::paths::{target_folder, workspace_root};
use crate::tools::succeed;
use std::collections::BTreeSet;
use std::fs;
use std::process::Command;

const CRATE: &str = "lipz-compiler";

/// The features of its manifest, all but `full`, which the workspace builds.
const FEATURES: [&str; 11] =
    ["build", "cache", "diff", "ids", "inspect", "json", "parallel", "settings", "shards", "stats", "unpack"];

/// Crates that a build script compiles with the features that are on by default, with the compiler itself and
/// those of this project.
const MOST_CRATES: usize = 33;

/// What is packed with all features and with none.
const SOURCES: &str = "fixtures/drama";

/// Packs a folder into a file.
const PROGRAM: &str = r#"fn main() -> Result<(), Box<dyn std::error::Error>> {
    let paths: Vec<std::path::PathBuf> = std::env::args_os().skip(1).map(From::from).collect();
    let (inputs, _) = lipz_compiler::discover(&paths[..1], None);
    let options = lipz_compiler::Options::new().default_locale("en-us");
    let bank = lipz_compiler::Compiler::new(options).compile(&inputs).into_bank()?;
    Ok(std::fs::write(&paths[1], bank)?)
}
"#;

pub(crate) fn run() -> Result<(), Failure> {
    // What is unused without other features is an error, too.
    let check = ["clippy", "--quiet", "--locked", "-p", CRATE, "--no-default-features"];
    for feature in [""].iter().chain(&FEATURES) {
        println!("{CRATE} with `{feature}`");
        cargo_run(&[&check[..], &["--features", feature, "--", "-D", "warnings"]].concat())?;
    }
    for feature in ["", "json"] {
        println!("tests of lipz-diagnostics with `{feature}`");
        let test = ["test", "--quiet", "--locked", "-p", "lipz-diagnostics", "--no-default-features"];
        cargo_run(&[&test[..], &["--features", feature]].concat())?;
    }
    same_bytes()?;
    let text =
        cargo::output(&["tree", "--locked", "-p", CRATE, "-e", "normal", "--prefix", "none", "--format", "{p}"])?;
    let crates: BTreeSet<_> = text.lines().map(|line| line.trim_end_matches(" (*)")).collect();
    println!("{} of at most {MOST_CRATES} crates are compiled for a build script", crates.len());
    match crates.len() {
        0 => Err("cargo tree shows no crates".to_owned()),
        count if count > MOST_CRATES => Err(format!("{count} crates: switch on by a feature what few need")),
        _ => Ok(()),
    }
}

fn cargo_run(arguments: &[&str]) -> Result<(), Failure> {
    succeed(cargo::command().args(arguments).current_dir(workspace_root()), &format!("cargo {}", arguments.join(" ")))
}

/// Packs a folder with the command, which has all features, and with a program outside of the workspace, which has
/// none: inside of it, cargo would give it those of the tests.
fn same_bytes() -> Result<(), Failure> {
    let folder = target_folder().join("features");
    let manifest = format!(
        "[package]\nname = \"program\"\nversion = \"0.0.0\"\nedition = \"2024\"\n\n[workspace]\n\n[dependencies]\n\
         {CRATE} = {{ path = {:?}, default-features = false }}\n",
        workspace_root().join("crates").join(CRATE)
    );
    let write = || {
        fs::create_dir_all(folder.join("src"))?;
        fs::write(folder.join("Cargo.toml"), manifest)?;
        fs::write(folder.join("src/main.rs"), PROGRAM)?;
        fs::copy(workspace_root().join("Cargo.lock"), folder.join("Cargo.lock"))
    };
    write().map_err(|error| format!("`{}`: {error}", folder.display()))?;
    let [none, all] = ["none.lipzbank", "all.lipzbank"].map(|name| folder.join(name).display().to_string());
    let program = folder.join("Cargo.toml").display().to_string();
    let built = folder.join("build").display().to_string();
    cargo_run(&["run", "--quiet", "--manifest-path", &program, "--target-dir", &built, "--", SOURCES, &none])?;
    let mut pack = Command::new(cargo::lipz()?);
    pack.args(["pack", SOURCES, "-o", &all, "--default-locale", "en-us", "--no-config", "--quiet"]);
    succeed(pack.current_dir(workspace_root()), "lipz pack")?;
    let read = |path: &str| fs::read(path).map_err(|error| format!("`{path}`: {error}"));
    if read(&none)? == read(&all)? {
        println!("{SOURCES} gives the same bank without features and with all of them");
        return Ok(());
    }
    Err(format!("a feature of {CRATE} changes the bank of {SOURCES}: compare {none} and {all}"))
}
