//! `cargo xtask windows`: compiles all crates for Windows.
//!
//! Nothing is linked or run: this only keeps the code under `cfg(windows)` compiling. A job of
//! `.github/workflows/ci.yml` runs the tests on Windows.

use crate::Failure;
use crate::toolchain::{Library, Toolchain, needs};
use crate::tools::{skip, succeed};

const TARGET: &str = "x86_64-pc-windows-gnu";

pub(crate) fn run() -> Result<(), Failure> {
    let Some(toolchain) = Toolchain::find(TARGET, Library::Std) else {
        return skip(&needs(TARGET));
    };
    succeed(toolchain.cargo("check").args(["--workspace", "--quiet"]), "cargo check for Windows")
}
