//! `cargo xtask msrv`: the reader with the oldest compiler that it promises.

use crate::Failure;
use crate::ci::cargo_command;
use crate::paths::workspace_root;
use crate::tools::{skip, succeed};
use std::path::{Path, PathBuf};
use std::process::Command;

/// `rust-version` of lipz-bank.
const OLDEST: &str = "1.63";

/// Where `.ci/install` unpacks Debian's packages of that compiler, below the workspace.
const UNPACKED: &str = "target/msrv/usr";

pub(crate) fn run() -> Result<(), Failure> {
    let root = workspace_root();
    let Some(oldest) = Oldest::find(&root.join(UNPACKED)) else {
        return skip("`rustup toolchain install 1.63`, or Debian's rustc and cargo as .ci/install unpacks them");
    };
    let manifest = root.join("xtask/msrv/Cargo.toml");
    let vendored = root.join("target/msrv/vendor");
    // That cargo can read neither our workspace nor today's index: it gets the crates as a folder.
    let mut vendor = cargo_command();
    vendor.args(["vendor", "--quiet", "--locked", "--manifest-path"]).args([&manifest, &vendored]);
    succeed(vendor.stdout(std::process::Stdio::null()), "cargo vendor")?;
    let mut build = oldest.cargo();
    build.args(["build", "--offline", "--locked", "--features", "std", "--manifest-path"]).arg(&manifest);
    build.args(["--config", "source.crates-io.replace-with=\"vendored\""]);
    build.args(["--config", &format!("source.vendored.directory={:?}", vendored.display().to_string())]);
    build.env("CARGO_TARGET_DIR", root.join("target/msrv/build"));
    succeed(&mut build, "the build with the oldest compiler")?;
    println!("the reader builds with Rust {OLDEST}");
    Ok(())
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
