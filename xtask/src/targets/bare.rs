//! A target without std, on which a reader with std does not build. It is a target of the firmware, and shares its
//! build of the standard library.

use super::cortex_m;
use crate::Failure;
use crate::toolchain::{Library, Toolchain, needs};
use crate::tools::{skip, succeed};
use std::process::Command;

pub(super) fn run() -> Result<(), Failure> {
    let Some(toolchain) = Toolchain::find(cortex_m::M4.target, Library::Core) else {
        return skip(&needs(cortex_m::M4.target));
    };
    succeed(&mut reader(&toolchain), "the build of the reader without std")?;
    // The negative control: with std, the build must fail. Otherwise the build above proves nothing.
    let output = reader(&toolchain).args(["--features", "std"]).output().map_err(|error| error.to_string())?;
    let errors = String::from_utf8_lossy(&output.stderr);
    if output.status.success() || !errors.contains("can't find crate for `std`") {
        return Err(format!("the reader with std must fail because of the missing std, but did not:\n{errors}"));
    }
    println!("the reader builds without std; with it, it does not");
    Ok(())
}

fn reader(toolchain: &Toolchain) -> Command {
    let mut command = toolchain.as_firmware("build");
    command.args(["--quiet", "--package", "lipz-bank", "--no-default-features"]);
    command
}
