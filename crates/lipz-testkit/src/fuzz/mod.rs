//! What must hold of lipz for any bytes.
//!
//! Each check takes bytes from anywhere and panics if something does not hold that the crates promise.
//! The fuzz targets in `fuzz/` hand it what libFuzzer makes up, the test `replay` what is in
//! `fuzz/seeds`, with a fixed number of changes.

mod bank;
mod file;
mod foreign;
mod forged_bank;
mod layers;
mod round_trip;
mod second_life;
mod sound;
mod texts;

pub use bank::{bank, text_bank};
pub use file::{parse, rewrite};
pub use foreign::{foreign, kind_of_foreign};
pub use forged_bank::forged_bank;
pub use layers::layers;
pub use round_trip::round_trip;
pub use second_life::second_life;
pub use sound::{sound, sync_record};
pub use texts::texts;

/// One fuzz target: `fuzz/fuzz_targets/NAME.rs` with the seeds in `fuzz/seeds/NAME`.
pub struct Target {
    /// How the target is called.
    pub name: &'static str,
    /// What must hold.
    pub check: fn(&[u8]),
}

/// All fuzz targets.
pub const TARGETS: [Target; 12] = [
    Target { name: "bank", check: bank },
    Target { name: "text_bank", check: text_bank },
    Target { name: "forged_bank", check: forged_bank },
    Target { name: "layers", check: layers },
    Target { name: "parse", check: parse },
    Target { name: "foreign", check: foreign },
    Target { name: "second_life", check: second_life },
    Target { name: "texts", check: texts },
    Target { name: "rewrite", check: rewrite },
    Target { name: "round_trip", check: round_trip },
    Target { name: "sound", check: sound },
    Target { name: "sync_record", check: sync_record },
];
