//! A target on which there is no std: a reader that needs it does not build. It is that of a firmware, with what is
//! built of the standard library for it.

use super::cortex_m;
use crate::Failure;
use crate::toolchain::{Library, NEEDS, Toolchain};
use crate::tools::{skip, succeed};
use std::process::Command;

pub(super) fn run() -> Result<(), Failure> {
    let Some(toolchain) = Toolchain::find(cortex_m::M4.target, Library::Core) else {
        return skip(NEEDS);
    };
    succeed(&mut reader(&toolchain), "the build of the reader without std")?;
    // The negative control: with std there must be an error, or the build above shows nothing.
    let output = reader(&toolchain).args(["--features", "std"]).output().map_err(|error| error.to_string())?;
    let errors = String::from_utf8_lossy(&output.stderr);
    if output.status.success() || !errors.contains("can't find crate for `std`") {
        return Err(format!("a reader that needs std does not fail as it must:\n{errors}"));
    }
    println!("the reader builds without std; with it, it does not");
    Ok(())
}

fn reader(toolchain: &Toolchain) -> Command {
    let mut command = toolchain.as_firmware("build");
    command.args(["--quiet", "--package", "lipz-bank", "--no-default-features"]);
    command
}
