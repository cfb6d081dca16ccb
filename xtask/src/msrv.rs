//! `cargo xtask msrv`: builds and runs the packages for old compilers like a game with such a compiler.
//!
//! The test uses the packages as they would be published, with the manifests that cargo writes. A program of a few
//! lines depends on all of them, plays a clip, and is built with a lock file that cargo resolves for that compiler.

use crate::Failure;
use crate::cargo::{self, Package};
use crate::packages;
use crate::paths::{target_folder, workspace_root};
use crate::tools::{skip, succeed};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The `rust-version` of the packages that this task tests.
const OLDEST: &str = "1.63";

/// The folder below the workspace in which `.ci/install` unpacks Debian's packages of that compiler.
const UNPACKED: &str = "target/msrv/usr";

/// The program, which reads the bank that comes with the reader.
const PROGRAM: &str = r#"fn main() -> Result<(), Box<dyn std::error::Error>> {
    let bytes = std::fs::read(std::env::args().nth(1).ok_or("no path")?)?;
    let bank = lipz_bank::Bank::open(&bytes)?.verify()?;
    let clip = bank.clip_by_key("act1/mara-good-evening").ok_or("no such clip")?;
    let english = bank.locale("en-us").ok_or("no English")?;
    let segment = clip.segment_at(lipz_bank::Micros(1_500_000)).ok_or("no segment at this time")?;
    let text = segment.text(english).map(|text| text.as_str());
    if text != Some("You are late,") {
        return Err(format!("different text: {:?}", text).into());
    }
    Ok(())
}
"#;

pub(crate) fn run() -> Result<(), Failure> {
    let Some(oldest) = Oldest::find(&workspace_root().join(UNPACKED)) else {
        return skip("`rustup toolchain install 1.63`, or Debian's rustc and cargo as .ci/install unpacks them");
    };
    let mut packages = cargo::workspace()?;
    packages.retain(|package| package.is_published() && package.rust_version.as_deref() == Some(OLDEST));
    let folder = target_folder().join("msrv");
    let unpacked = packages::unpack(&packages, &folder.join("packages-of-lipz"))?;
    let program = folder.join("program");
    write_program(&program, &packages, &unpacked).map_err(|error| format!("`{}`: {error}", program.display()))?;

    let vendored = folder.join("vendor");
    let mut lock = cargo::command();
    lock.args(["generate-lockfile", "--quiet"]).env("CARGO_RESOLVER_INCOMPATIBLE_RUST_VERSIONS", "fallback");
    succeed(lock.current_dir(&program), "cargo generate-lockfile")?;
    // The old cargo cannot read the current index, so it gets the crates as a folder.
    let mut vendor = cargo::command();
    vendor.args(["vendor", "--quiet", "--locked"]).arg(&vendored).stdout(Stdio::null());
    succeed(vendor.current_dir(&program), "cargo vendor")?;

    let mut build = oldest.cargo();
    build.args(["run", "--quiet", "--offline", "--locked"]);
    build.args(["--config", "source.crates-io.replace-with=\"vendored\""]);
    build.args(["--config", &format!("source.vendored.directory={:?}", vendored.display().to_string())]);
    let reader = packages.iter().position(|package| package.name == "lipz-bank").and_then(|index| unpacked.get(index));
    let bank = reader.ok_or("lipz-bank does not promise that compiler")?.join("examples/act1.lipzbank");
    build.arg("--").arg(bank).env("CARGO_TARGET_DIR", folder.join("build")).current_dir(&program);
    succeed(&mut build, "the program of the oldest compiler")?;
    let names: Vec<&str> = packages.iter().map(|package| package.name.as_str()).collect();
    println!("with Rust {OLDEST}, these packages build and play a clip: {}", names.join(", "));
    Ok(())
}

/// Writes a workspace with one program that depends on the unpacked packages.
fn write_program(folder: &Path, packages: &[Package], unpacked: &[PathBuf]) -> std::io::Result<()> {
    let mut dependencies = String::new();
    let mut patches = String::new();
    for (Package { name, version, .. }, path) in packages.iter().zip(unpacked) {
        dependencies += &format!("{name} = \"{version}\"\n");
        patches += &format!("{name} = {{ path = {:?} }}\n", path.display().to_string());
    }
    let manifest = format!(
        "[package]\nname = \"program\"\nversion = \"0.0.0\"\nedition = \"2021\"\nrust-version = \"{OLDEST}\"\n\n\
         [workspace]\n\n[dependencies]\n{dependencies}\n[patch.crates-io]\n{patches}"
    );
    fs::create_dir_all(folder.join("src"))?;
    fs::write(folder.join("Cargo.toml"), manifest)?;
    fs::write(folder.join("src/main.rs"), PROGRAM)
}

/// The oldest compiler.
enum Oldest {
    Rustup,
    /// Unpacked below a folder, not installed.
    Unpacked(PathBuf),
}

impl Oldest {
    fn find(unpacked: &Path) -> Option<Oldest> {
        let found = [Oldest::Unpacked(unpacked.to_owned()), Oldest::Rustup];
        found.into_iter().find(|oldest| oldest.cargo().arg("--version").output().is_ok_and(|out| out.status.success()))
    }

    fn cargo(&self) -> Command {
        let mut command = match self {
            Oldest::Rustup => {
                let mut command = Command::new("rustup");
                command.args(["run", OLDEST, "cargo"]);
                command
            }
            Oldest::Unpacked(folder) => {
                let libraries = [folder.join("lib/x86_64-linux-gnu"), folder.join("lib")];
                let mut command = Command::new(folder.join("bin/cargo"));
                command.env("RUSTC", folder.join("bin/rustc"));
                command.env("LD_LIBRARY_PATH", std::env::join_paths(libraries).unwrap_or_default());
                command
            }
        };
        command.env_remove("CARGO").env_remove("RUSTUP_TOOLCHAIN");
        command
    }
}
