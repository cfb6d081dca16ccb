//! The reader as a wasm module in node.

use super::controls;
use crate::Failure;
use crate::paths::workspace_root;
use crate::toolchain::{Library, Toolchain, needs};
use crate::tools::{has_program, skip, succeed};
use std::process::Command;

const TARGET: &str = "wasm32-unknown-unknown";

pub(super) fn run() -> Result<(), Failure> {
    if !has_program("node") {
        return skip("node");
    }
    let Some(toolchain) = Toolchain::find(TARGET, Library::Core) else {
        return skip(&needs(TARGET));
    };
    let mut build = toolchain.firmware("build");
    succeed(build.args(["--quiet", "--release", "--package", "firmware-wasm"]), "the build of the module")?;
    let module = toolchain.release_folder().join("firmware_wasm.wasm");
    let script = workspace_root().join("firmware/wasm/check.mjs");
    controls::check(|bank, answers| Command::new("node").arg(&script).args([&module, bank, answers]).output())
}
