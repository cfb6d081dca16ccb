//! `cargo xtask targets`: tests the reader on other machines.
//!
//! Each kind of machine has a file: processors without a system, machines that run the whole test suite, wasm, and a
//! target without std on which nothing runs.

mod bare;
mod controls;
mod cortex_m;
mod test_suite;
mod wasm;

use crate::Failure;
use clap::{Args, ValueEnum};
use std::time::Instant;

/// The machines to test.
#[derive(Args, Debug)]
pub(crate) struct Settings {
    /// Targets to run [default: all]
    #[arg(value_enum)]
    targets: Vec<Target>,
}

#[derive(ValueEnum, Clone, Copy, Debug)]
enum Target {
    /// A build without std, and one with it that must fail
    NoStd,
    /// Firmware with the instructions of a Cortex-M4
    CortexM4,
    /// Firmware with the instructions of a Cortex-M0
    CortexM0,
    /// A wasm module in node
    Wasm,
    /// The test suite of the reader on a big-endian machine: s390x
    BigEndian,
    /// The test suite of the reader on a 32-bit machine: i686
    #[value(name = "32-bit")]
    Bits32,
}

impl Target {
    fn run(self) -> Result<(), Failure> {
        match self {
            Target::NoStd => bare::run(),
            Target::CortexM4 => cortex_m::run(&cortex_m::M4),
            Target::CortexM0 => cortex_m::run(&cortex_m::M0),
            Target::Wasm => wasm::run(),
            Target::BigEndian => test_suite::run(&test_suite::BIG_ENDIAN),
            Target::Bits32 => test_suite::run(&test_suite::BITS_32),
        }
    }

    fn name(self) -> String {
        self.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
    }
}

pub(crate) fn run(settings: &Settings) -> Result<(), Failure> {
    let all = Target::value_variants();
    let chosen = if settings.targets.is_empty() { all } else { &settings.targets };
    for target in chosen {
        let name = target.name();
        let start = Instant::now();
        println!("target {name}");
        target.run().map_err(|failure| format!("target `{name}`: {failure}"))?;
        println!("target {name}: {:.1} s", start.elapsed().as_secs_f64());
    }
    Ok(())
}
