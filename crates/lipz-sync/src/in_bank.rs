//! What a bank says about the recordings of its clips.

use crate::KnownRecordings;
use lipz_bank::Recording;
use lipz_compiler::Input;
use lipz_compiler::settings::Settings;
use lipz_diagnostics::DiagnosticsError;
use std::collections::BTreeMap;

/// Length and content hash of the recording of each of these clips that has one, by key: for
/// [`Options::recordings`](lipz_compiler::Options::recordings). Nothing if the project does not want them in its bank
/// ([`Audio::in_bank`](lipz_compiler::settings::Audio::in_bank)).
///
/// Each recording is read. A program that packs again and again keeps [`KnownRecordings`].
///
/// # Errors
/// A diagnostic for each recording or folder that cannot be read.
pub fn in_bank(settings: &Settings, inputs: &[Input]) -> Result<BTreeMap<String, Recording>, DiagnosticsError> {
    KnownRecordings::default().in_bank(settings, inputs)
}
