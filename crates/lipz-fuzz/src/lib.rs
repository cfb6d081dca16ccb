//! What must hold of lipz for any bytes.
//!
//! Each check takes bytes from anywhere and panics if something does not hold that the crates promise.
//! The fuzz targets in `fuzz/` hand it what libFuzzer makes up, a test of this crate what is in
//! `fuzz/seeds`, with a fixed number of changes.
// A check fails by panicking: that is what a fuzzer notices.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::cast_possible_truncation)]

mod bank;
mod file;
mod foreign;
mod forged_bank;
mod round_trip;
mod second_life;

/// The helpers of the reader's own tests, and with them every query that they know.
#[path = "../../lipz-bank/tests/common/mod.rs"]
#[allow(clippy::unnecessary_map_or, reason = "the tests of the reader are as old as the reader")]
mod common;

/// The tools of the compiler, as its own tests use them.
#[path = "../../lipz-compiler/tests/support/used.rs"]
mod used;

pub use bank::{bank, text_bank};
pub use file::{parse, rewrite};
pub use foreign::foreign;
pub use forged_bank::forged_bank;
pub use round_trip::round_trip;
pub use second_life::second_life;

/// One fuzz target: `fuzz/fuzz_targets/NAME.rs` with the seeds in `fuzz/seeds/NAME`.
pub struct Target {
    /// How the target is called.
    pub name: &'static str,
    /// What must hold.
    pub check: fn(&[u8]),
    /// The longest input that is worth the time: it has room for all that a check can look at.
    pub longest_bytes: usize,
}

/// All fuzz targets.
pub const TARGETS: [Target; 8] = [
    Target { name: "bank", check: bank, longest_bytes: 8192 },
    Target { name: "text_bank", check: text_bank, longest_bytes: 4096 },
    Target { name: "forged_bank", check: forged_bank, longest_bytes: 512 },
    Target { name: "parse", check: parse, longest_bytes: 4096 },
    Target { name: "foreign", check: foreign, longest_bytes: 2048 },
    Target { name: "second_life", check: second_life, longest_bytes: 2048 },
    Target { name: "rewrite", check: rewrite, longest_bytes: 4096 },
    Target { name: "round_trip", check: round_trip, longest_bytes: 4096 },
];
