//! Cargo, as a program: commands, what they print, and what it says about the workspace.

use crate::Failure;
use crate::paths::{target_folder, workspace_root};
use crate::tools::succeed;
use serde::Deserialize;
use std::path::PathBuf;
use std::process::Command;

/// A package of the workspace: as much as is needed of what `cargo metadata` prints.
#[derive(Deserialize, Debug)]
pub(crate) struct Package {
    pub(crate) name: String,
    pub(crate) version: String,
    /// The oldest compiler that it promises.
    pub(crate) rust_version: Option<String>,
    /// The registries that it may go to; none if the list is empty, any if there is no list.
    publish: Option<Vec<String>>,
    pub(crate) dependencies: Vec<Dependency>,
}

#[derive(Deserialize, Debug)]
pub(crate) struct Dependency {
    pub(crate) name: String,
    kind: Option<String>,
}

impl Package {
    pub(crate) fn is_published(&self) -> bool {
        self.publish.is_none()
    }
}

impl Dependency {
    pub(crate) fn is_for_tests(&self) -> bool {
        self.kind.as_deref() == Some("dev")
    }
}

/// The cargo that runs this task, or else the one on the path.
pub(crate) fn command() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// The tests with this name, of all crates. `--package` would build nearly everything once more: which features the crates of
/// others have depends on what is built together.
pub(crate) fn tests(name: &str) -> Command {
    let mut command = command();
    command.args(["test", "--workspace", "--locked", "--quiet", "--test", name]).current_dir(workspace_root());
    command
}

/// The command `lipz` as the tests run it, built if it is not. A test that needs it has cargo build it with the features that
/// it has for all tests.
pub(crate) fn lipz() -> Result<PathBuf, Failure> {
    succeed(tests("command_line").arg("--no-run"), "cargo build of lipz")?;
    let program = target_folder().join("debug").join(format!("lipz{}", std::env::consts::EXE_SUFFIX));
    program.canonicalize().map_err(|error| format!("`{}`: {error}", program.display()))
}

/// The command `lipz` as people have it, built: to be measured.
pub(crate) fn lipz_release() -> Result<PathBuf, Failure> {
    let mut build = command();
    build.args(["build", "--quiet", "--locked", "--release", "--package", "lipz"]).current_dir(workspace_root());
    succeed(&mut build, "cargo build of lipz")?;
    let program = target_folder().join("release").join(format!("lipz{}", std::env::consts::EXE_SUFFIX));
    program.canonicalize().map_err(|error| format!("`{}`: {error}", program.display()))
}

/// What cargo prints, at the root of the workspace.
pub(crate) fn output(arguments: &[&str]) -> Result<String, Failure> {
    let shown = format!("cargo {}", arguments.join(" "));
    let output = command().args(arguments).current_dir(workspace_root()).output();
    let output = output.map_err(|error| format!("`{shown}` cannot be run: {error}"))?;
    if !output.status.success() {
        let error = String::from_utf8_lossy(&output.stderr);
        return Err(format!("`{shown}` ended with {}: {}", output.status, error.trim()));
    }
    String::from_utf8(output.stdout).map_err(|_| format!("`{shown}` printed something that is not UTF-8"))
}

/// The packages of the workspace.
pub(crate) fn workspace() -> Result<Vec<Package>, Failure> {
    #[derive(Deserialize)]
    struct Metadata {
        packages: Vec<Package>,
    }
    let printed = output(&["metadata", "--no-deps", "--format-version", "1", "--locked"])?;
    let metadata: Metadata =
        serde_json::from_str(&printed).map_err(|error| format!("`cargo metadata` printed something else: {error}"))?;
    Ok(metadata.packages)
}
