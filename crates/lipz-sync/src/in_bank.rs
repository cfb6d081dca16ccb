//! What a bank says about the recordings of its clips.

use crate::KnownRecordings;
use lipz_bank::Recording;
use lipz_compiler::Input;
use lipz_compiler::settings::Settings;
use lipz_diagnostics::Report;
use std::collections::BTreeMap;

/// Length and content hash of the recording of each of these clips that has one, by key: for
/// [`Options::recordings`](lipz_compiler::Options::recordings). Nothing if the project does not want them in its bank
/// ([`Audio::in_bank`](lipz_compiler::settings::Audio::in_bank)). Reports what cannot be read.
///
/// Each recording is read. A program that packs again and again keeps [`KnownRecordings`].
pub fn in_bank(settings: &Settings, inputs: &[Input]) -> (BTreeMap<String, Recording>, Vec<Report>) {
    KnownRecordings::default().in_bank(settings, inputs)
}
