//! Compilers for other machines: with an installed target, or with the sources of the standard library, from which
//! cargo builds the required parts.

use crate::cargo;
use crate::paths::workspace_root;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Returns the packages to install if there is no compiler for a target.
pub(crate) fn needs(target: &str) -> String {
    format!("`rustup target add {target}`, or Debian's rustc-web, cargo-web and rust-web-src")
}

/// The required parts of the standard library.
#[derive(Clone, Copy)]
pub(crate) enum Library {
    /// Core and alloc.
    Core,
    /// All of it, with the test harness.
    Std,
}

/// A compiler that can build for a target.
pub(crate) struct Toolchain {
    folder: Option<PathBuf>,
    target: &'static str,
    /// The parts that cargo builds from source, if the target is not installed.
    builds: Option<Library>,
}

impl Toolchain {
    /// Returns this project's compiler if the target is installed, otherwise any that has its sources.
    pub(crate) fn find(target: &'static str, library: Library) -> Option<Toolchain> {
        if has_target(target) {
            return Some(Toolchain { folder: None, target, builds: None });
        }
        Toolchain::with_sources(target, library)
    }

    /// Returns a compiler that has its sources: this one, or the system's.
    pub(crate) fn with_sources(target: &'static str, library: Library) -> Option<Toolchain> {
        [None, Some(PathBuf::from("/usr/bin"))]
            .into_iter()
            .map(|folder| Toolchain { folder, target, builds: Some(library) })
            .find(Toolchain::has_sources)
    }

    fn program(&self, name: &str) -> PathBuf {
        self.folder.as_ref().map_or_else(|| PathBuf::from(name), |folder| folder.join(name))
    }

    fn has_sources(&self) -> bool {
        printed(Command::new(self.program("rustc")).args(["--print", "sysroot"]))
            .is_some_and(|sysroot| Path::new(&sysroot).join("lib/rustlib/src/rust/library/Cargo.toml").is_file())
    }

    /// Returns the version of the compiler.
    pub(crate) fn version(&self) -> String {
        printed(Command::new(self.program("rustc")).arg("--version")).unwrap_or_default()
    }

    /// Whether this project's compiler has the target.
    pub(crate) fn is_installed(&self) -> bool {
        self.folder.is_none() && self.builds.is_none()
    }

    /// Returns the folder for builds of this target, which is separate from that of the project's own compiler.
    pub(crate) fn build_folder() -> PathBuf {
        workspace_root().join("target/machines")
    }

    /// Returns the folder of a release build.
    pub(crate) fn release_folder(&self) -> PathBuf {
        Toolchain::build_folder().join(self.target).join("release")
    }

    /// Returns `cargo <task>` for the target.
    pub(crate) fn cargo(&self, task: &str) -> Command {
        self.cargo_with(None, task, self.target)
    }

    /// The same, run by a program that changes how cargo links, with the name of the target that it expects.
    pub(crate) fn cargo_with(&self, runner: Option<&Path>, task: &str, target: &str) -> Command {
        let mut command = match (&self.folder, runner) {
            (None, None) => cargo::command(),
            (None, Some(runner)) => Command::new(runner),
            // Rustup and `cargo run` have set these for the project's own compiler.
            (Some(_), _) => {
                let cargo = self.program("cargo");
                let mut command = Command::new(runner.unwrap_or(&cargo));
                command.env_remove("LD_LIBRARY_PATH").env_remove("RUSTUP_TOOLCHAIN").env("CARGO", &cargo);
                command.env("RUSTC", self.program("rustc")).env("RUSTDOC", self.program("rustdoc"));
                command
            }
        };
        let folder = Toolchain::build_folder();
        command.arg(task).args(["--locked", "--target", target]);
        command.env("CARGO_TARGET_DIR", &folder).env("CARGO_BUILD_BUILD_DIR", &folder).current_dir(workspace_root());
        if let Some(library) = self.builds {
            command.env("RUSTC_BOOTSTRAP", "1");
            command.args(match library {
                Library::Core => &["-Zbuild-std=core,alloc"][..],
                // Without symbol names in backtraces, and without support for procedural macros.
                Library::Std => &["-Zbuild-std=std,panic_unwind,test", "-Zbuild-std-features=panic-unwind"],
            });
        }
        command
    }

    /// Returns `cargo <task>` for a crate of this workspace, with the release profile of the workspace `firmware`, so
    /// that both share the built parts of the standard library.
    pub(crate) fn as_firmware(&self, task: &str) -> Command {
        let mut command = self.cargo(task);
        command.arg("--release");
        for (setting, value) in [("OPT_LEVEL", "s"), ("LTO", "fat"), ("PANIC", "abort")] {
            command.env(format!("CARGO_PROFILE_RELEASE_{setting}"), value);
        }
        command
    }

    /// Returns `cargo <task>` in the workspace `firmware`, with the linker that comes with Rust.
    pub(crate) fn firmware(&self, task: &str) -> Command {
        let mut command = self.cargo(task);
        if let Some(linker) = rust_lld() {
            command.env(variable(self.target, "LINKER"), linker);
        }
        command.current_dir(workspace_root().join("firmware"));
        command
    }
}

/// Returns the environment variable that configures cargo for a target.
pub(crate) fn variable(target: &str, name: &str) -> String {
    format!("CARGO_TARGET_{}_{name}", target.to_uppercase().replace('-', "_"))
}

/// Returns the linker that comes with Rust, which links for all targets.
pub(crate) fn rust_lld() -> Option<PathBuf> {
    let library = printed(Command::new("rustc").args(["--print", "target-libdir"]))?;
    Some(Path::new(&library).with_file_name("bin").join("rust-lld")).filter(|linker| linker.is_file())
}

fn has_target(target: &str) -> bool {
    printed(Command::new("rustc").args(["--print", "target-libdir", "--target", target]))
        .is_some_and(|folder| std::fs::read_dir(folder).is_ok_and(|mut files| files.next().is_some()))
}

/// Returns the output of a command, if it succeeds.
fn printed(command: &mut Command) -> Option<String> {
    let output = command.output().ok().filter(|output| output.status.success())?;
    Some(String::from_utf8_lossy(&output.stdout).trim().to_owned())
}
