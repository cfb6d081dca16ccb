//! `cargo xtask size`, or `size reader`: measures the reader's size in firmware, and proves that it can neither panic nor allocate.
//!
//! firmware/size has an entry point for each query. A linker that drops unused code keeps only the parts of the reader
//! that a program with these queries needs (`groups`), and the sections of the result are measured (`elf`).
//! firmware/proof calls every public function. It is linked, but not measured.

mod command;
mod elf;
mod groups;
mod link;

use crate::Failure;
use crate::toolchain::{Library, Toolchain, rust_lld};
use crate::tools::{skip, succeed};
use elf::Sizes;
use groups::{C_PROGRAMS, Group, PROGRAMS, SINGLE};
use link::Linker;
use std::process::Command;

/// The processors: with limits, and without.
const M4: &str = "thumbv7em-none-eabi";
const M0: &str = "thumbv6m-none-eabi";

/// The program to measure.
#[derive(clap::Args, Debug)]
pub(crate) struct Settings {
    /// The reader in firmware, or the command as published
    #[arg(value_enum, default_value_t)]
    program: Program,
}

#[derive(clap::ValueEnum, Clone, Copy, Default, Debug)]
enum Program {
    #[default]
    Reader,
    Command,
}

pub(crate) fn run(settings: &Settings) -> Result<(), Failure> {
    match settings.program {
        Program::Reader => reader(),
        Program::Command => command::run(),
    }
}

fn reader() -> Result<(), Failure> {
    let toolchains = [M4, M0].map(|target| Toolchain::with_sources(target, Library::Core));
    let ([Some(m4), Some(m0)], Some(linker)) = (&toolchains, rust_lld()) else {
        return skip("the sources of Rust (`rustup component add rust-src`, or Debian's rust-web-src), and rust-lld");
    };
    // One command for both, because one codegen unit keeps only one core busy.
    let mut build = m4.firmware("build");
    build.args(["--target", M0, "--quiet", "--release", "--package", "firmware-size", "--package", "firmware-proof"]);
    succeed(&mut build, "the build of the entry points")?;
    for toolchain in [m4, m0] {
        succeed(&mut c_library(toolchain), "the build of the library for C")?;
    }
    let of = |library: &str| -> Result<Vec<Linker>, Failure> {
        let libraries = [m4, m0].map(|toolchain| toolchain.release_folder().join(library));
        libraries.iter().map(|library| Linker::new(&linker, library)).collect()
    };
    let (linkers, c_linkers) = (of("libfirmware_size.a")?, of("liblipz_capi.a")?);
    println!("| {}, opt-level s | M4 code | M4 constants | M0 code | M4 budget |", m4.version());
    println!("|---|--:|--:|--:|--:|");
    let mut above = Vec::new();
    for group in PROGRAMS.iter().chain(&SINGLE) {
        row(group, &linkers, &mut above)?;
    }
    for group in &C_PROGRAMS {
        row(group, &c_linkers, &mut above)?;
    }
    for toolchain in [m4, m0] {
        let proof = Linker::new(&linker, &toolchain.release_folder().join("libfirmware_proof.a"))?;
        proof.link(&["proof_every_function"])?;
    }
    for linker in &linkers {
        linker.must_not_link("control_panic", "panic_is_reachable")?;
        linker.must_not_link("control_allocator", "allocator_is_reachable")?;
    }
    println!(
        "\nno static memory; no public function can reach a panic or an allocator; the two controls that can do not link"
    );
    if above.is_empty() { Ok(()) } else { Err(format!("above the budget: {}", above.join(", "))) }
}

/// Returns the build of the library for C, with the options for firmware.
fn c_library(toolchain: &Toolchain) -> Command {
    let mut command = toolchain.as_firmware("rustc");
    command.args(["--quiet", "--package", "lipz-capi", "--lib"]);
    command.args(["--features", "panic-handler", "--crate-type", "staticlib"]);
    command
}

/// Prints the requirements of a group on each processor.
fn row(group: &Group, linkers: &[Linker], above: &mut Vec<&'static str>) -> Result<(), Failure> {
    let mut sizes = Vec::new();
    for linker in linkers {
        let of: Sizes = linker.link(&group.entries())?;
        if of.memory_bytes != 0 {
            return Err(format!("`{}` needs {} bytes of static memory", group.name, of.memory_bytes));
        }
        sizes.push(of);
    }
    if let [m4, m0] = sizes.as_slice() {
        let budget = group.budget_bytes.map_or_else(String::new, |bytes| bytes.to_string());
        println!("| {} | {} | {} | {} | {budget} |", group.name, m4.code_bytes, m4.constant_bytes, m0.code_bytes);
        if group.budget_bytes.is_some_and(|bytes| m4.code_bytes > bytes) {
            above.push(group.name);
        }
    }
    Ok(())
}
