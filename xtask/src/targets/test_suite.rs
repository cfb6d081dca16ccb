//! The whole test suite of the reader on machines with a different byte order or word size.

use crate::Failure;
use crate::toolchain::{Library, Toolchain, needs, rust_lld, variable};
use crate::tools::{has_program, skip, succeed};

const STATIC: &str = "-Ctarget-feature=+crt-static";

/// The number of cases of a property, instead of 256: the byte order affects either all cases or none.
const EMULATED_CASES: &str = "32";

/// A machine with a system.
pub(super) struct Machine {
    target: &'static str,
    /// A C compiler for the target, used to link. Debian's package has the same name.
    linker: &'static str,
    /// The emulator for its programs, if this machine cannot run them.
    emulator: Option<&'static str>,
}

/// 64 bits, big-endian.
pub(super) const BIG_ENDIAN: Machine =
    Machine { target: "s390x-unknown-linux-gnu", linker: "s390x-linux-gnu-gcc", emulator: Some("qemu-s390x") };

/// 32 bits, little-endian: a 64-bit processor runs its programs.
pub(super) const BITS_32: Machine =
    Machine { target: "i686-unknown-linux-gnu", linker: "i686-linux-gnu-gcc", emulator: None };

pub(super) fn run(machine: &Machine) -> Result<(), Failure> {
    let programs = [Some(machine.linker), machine.emulator];
    if let Some(missing) = programs.into_iter().flatten().find(|program| !has_program(program)) {
        return skip(missing);
    }
    if machine.emulator.is_none() && !cfg!(target_arch = "x86_64") {
        return skip("a processor that runs its programs");
    }
    let Some(toolchain) = Toolchain::find(machine.target, Library::Std) else {
        return skip(&needs(machine.target));
    };
    let mut tests = toolchain.cargo("test");
    tests.args(["--quiet", "--package", "lipz-bank"]);
    tests.env(variable(machine.target, "LINKER"), machine.linker);
    // The programs are linked statically.
    let mut flags = STATIC.to_owned();
    if let Some(linker) = rust_lld() {
        // The C compiler finds it as `ld.lld` in the folder. The linkers of Debian's cross compilers take longer.
        flags += &format!(" -Clink-arg=-fuse-ld=lld -Clink-arg=-B{}", linker.with_file_name("gcc-ld").display());
    }
    tests.env("RUSTFLAGS", &flags).env("RUSTDOCFLAGS", &flags);
    // These programs are not debugged, and without debug information they build in half the time.
    tests.env("CARGO_PROFILE_DEV_DEBUG", "0");
    if let Some(emulator) = machine.emulator {
        // Emulation is so slow that optimising everything pays off.
        tests.env("CARGO_PROFILE_DEV_OPT_LEVEL", "1");
        tests.env("PROPTEST_CASES", EMULATED_CASES);
        tests.env(variable(machine.target, "RUNNER"), emulator);
    }
    succeed(&mut tests, "the test suite")
}
