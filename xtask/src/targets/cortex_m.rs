//! Firmware on a Cortex-M in QEMU, with a bank in memory outside of the image.

use super::controls;
use crate::Failure;
use crate::toolchain::{Library, Toolchain, needs};
use crate::tools::{has_program, skip, succeed};
use std::path::Path;
use std::process::{Command, Output, Stdio};

const EMULATOR: &str = "qemu-system-arm";

/// The address at which the emulator loads the bank and the expected answers, as in firmware/cortex-m/mps2.ld.
const BANK_ADDRESS: &str = "0x21000000";
const ANSWERS_ADDRESS: &str = "0x21800000";

/// A processor and its machine.
pub(super) struct Processor {
    pub(super) target: &'static str,
    machine: &'static str,
}

pub(super) const M4: Processor = Processor { target: "thumbv7em-none-eabi", machine: "mps2-an386" };

/// QEMU has no Cortex-M0 with enough memory for a bank. A Cortex-M3 runs its instructions.
pub(super) const M0: Processor = Processor { target: "thumbv6m-none-eabi", machine: "mps2-an385" };

pub(super) fn run(processor: &Processor) -> Result<(), Failure> {
    if !has_program(EMULATOR) {
        return skip(EMULATOR);
    }
    let Some(toolchain) = Toolchain::find(processor.target, Library::Core) else {
        return skip(&needs(processor.target));
    };
    let mut build = toolchain.firmware("build");
    succeed(build.args(["--quiet", "--release", "--package", "firmware-cortex-m"]), "the build of the firmware")?;
    let firmware = toolchain.release_folder().join("firmware-cortex-m");
    controls::check(|bank, answers| emulate(processor, &firmware, bank, answers))
}

fn emulate(processor: &Processor, firmware: &Path, bank: &Path, answers: &Path) -> std::io::Result<Output> {
    let load = |file: &Path, address| format!("loader,file={},addr={address},force-raw=on", file.display());
    Command::new(EMULATOR)
        .args(["-M", processor.machine, "-nographic", "-semihosting-config", "enable=on,target=native"])
        .arg("-kernel")
        .arg(firmware)
        .args(["-device", &load(bank, BANK_ADDRESS), "-device", &load(answers, ANSWERS_ADDRESS)])
        .stdin(Stdio::null())
        .output()
}
