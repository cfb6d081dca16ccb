//! Runs cargo: its commands, their output, and the metadata of the workspace.

use crate::Failure;
use crate::paths::{target_folder, workspace_root};
use crate::tools::succeed;
use serde::Deserialize;
use std::path::PathBuf;
use std::process::Command;

/// A package of the workspace: the required part of the output of `cargo metadata`.
#[derive(Deserialize, Debug)]
pub(crate) struct Package {
    pub(crate) name: String,
    pub(crate) version: String,
    /// The oldest supported compiler.
    pub(crate) rust_version: Option<String>,
    /// The registries to which it may be published: none for an empty list, any without a list.
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

/// Returns the cargo that runs this task, or the one on the path.
pub(crate) fn command() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// Returns a command for the tests with this name, of all crates. `--package` would build nearly everything again,
/// because the features of dependencies depend on the packages in the build.
pub(crate) fn tests(name: &str) -> Command {
    let mut command = command();
    command.args(["test", "--workspace", "--locked", "--quiet", "--test", name]).current_dir(workspace_root());
    command
}

/// Builds the command `lipz`, if necessary, and returns its path. The build has the same features as for all tests.
pub(crate) fn lipz() -> Result<PathBuf, Failure> {
    succeed(tests("command_line").arg("--no-run"), "cargo build of lipz")?;
    let program = target_folder().join("debug").join(format!("lipz{}", std::env::consts::EXE_SUFFIX));
    program.canonicalize().map_err(|error| format!("`{}`: {error}", program.display()))
}

/// Builds the command `lipz` as for users, to be measured, and returns its path.
pub(crate) fn lipz_release() -> Result<PathBuf, Failure> {
    let mut build = command();
    build.args(["build", "--quiet", "--locked", "--release", "--package", "lipz"]).current_dir(workspace_root());
    succeed(&mut build, "cargo build of lipz")?;
    let program = target_folder().join("release").join(format!("lipz{}", std::env::consts::EXE_SUFFIX));
    program.canonicalize().map_err(|error| format!("`{}`: {error}", program.display()))
}

/// Returns the output of cargo, run at the root of the workspace.
pub(crate) fn output(arguments: &[&str]) -> Result<String, Failure> {
    let shown = format!("cargo {}", arguments.join(" "));
    let output = command().args(arguments).current_dir(workspace_root()).output();
    let output = output.map_err(|error| format!("`{shown}` cannot be run: {error}"))?;
    if !output.status.success() {
        let error = String::from_utf8_lossy(&output.stderr);
        return Err(format!("`{shown}` ended with {}: {}", output.status, error.trim()));
    }
    String::from_utf8(output.stdout).map_err(|_| format!("the output of `{shown}` is not UTF-8"))
}

/// Returns the packages of the workspace.
pub(crate) fn workspace() -> Result<Vec<Package>, Failure> {
    #[derive(Deserialize)]
    struct Metadata {
        packages: Vec<Package>,
    }
    let printed = output(&["metadata", "--no-deps", "--format-version", "1", "--locked"])?;
    let metadata: Metadata = serde_json::from_str(&printed)
        .map_err(|error| format!("`cargo metadata` printed unexpected output: {error}"))?;
    Ok(metadata.packages)
}
