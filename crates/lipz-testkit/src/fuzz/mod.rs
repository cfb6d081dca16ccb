//! Guarantees of lipz for any bytes.
//!
//! Each check takes arbitrary bytes and panics if a guarantee of the crates is violated. The fuzz targets in `fuzz/`
//! pass it the inputs of libFuzzer. The test `replay` passes the seeds in `fuzz/seeds`, and a fixed number of changed
//! copies.

mod bank;
mod file;
mod foreign;
mod forged_bank;
mod layers;
mod learnt;
mod round_trip;
mod second_life;
mod set;
mod sound;
mod texts;

pub use bank::{bank, text_bank};
pub use file::{parse, rewrite};
pub use foreign::{foreign, kind_of_foreign};
pub use forged_bank::forged_bank;
pub use layers::layers;
pub use learnt::{recogniser, trained_model};
pub use round_trip::round_trip;
pub use second_life::second_life;
pub use set::set;
pub use sound::{sound, sync_record};
pub use texts::{text_record, texts};

/// One fuzz target: `fuzz/fuzz_targets/NAME.rs` with the seeds in `fuzz/seeds/NAME`.
pub struct Target {
    /// The name of the target.
    pub name: &'static str,
    /// The guarantee.
    pub check: fn(&[u8]),
    /// The number of changed copies of each seed in the tests, which is smaller if a check takes milliseconds.
    pub copies: u64,
}

/// For checks of less than a millisecond.
const QUICK: u64 = 2_000;
/// For checks of milliseconds.
const SLOW: u64 = 100;

/// All fuzz targets.
pub const TARGETS: [Target; 16] = [
    Target { name: "bank", check: bank, copies: QUICK },
    Target { name: "text_bank", check: text_bank, copies: QUICK },
    Target { name: "forged_bank", check: forged_bank, copies: QUICK },
    Target { name: "layers", check: layers, copies: SLOW },
    Target { name: "set", check: set, copies: QUICK },
    Target { name: "parse", check: parse, copies: QUICK },
    Target { name: "foreign", check: foreign, copies: QUICK },
    Target { name: "second_life", check: second_life, copies: QUICK },
    Target { name: "texts", check: texts, copies: QUICK },
    Target { name: "text_record", check: text_record, copies: QUICK },
    Target { name: "rewrite", check: rewrite, copies: QUICK },
    Target { name: "round_trip", check: round_trip, copies: QUICK },
    Target { name: "sound", check: sound, copies: QUICK },
    Target { name: "sync_record", check: sync_record, copies: QUICK },
    Target { name: "trained_model", check: trained_model, copies: SLOW },
    Target { name: "recogniser", check: recogniser, copies: SLOW },
];
