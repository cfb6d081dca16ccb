//! The data of a bank about the recordings of its clips.

use crate::recordings::FactsCache;
use lipz_bank::Recording;
use lipz_compiler::Input;
use lipz_compiler::settings::Settings;
use lipz_diagnostics::DiagnosticsError;
use std::collections::BTreeMap;

/// Returns the length and content hash of each clip's recording, by key, for
/// [`Options::recordings`](lipz_compiler::Options::recordings). Empty if the project does not store them in its bank
/// ([`Audio::in_bank`](lipz_compiler::settings::Audio::in_bank)).
///
/// Each recording is read. Programs that pack repeatedly should keep a [`FactsCache`].
///
/// # Errors
/// A diagnostic for each recording or folder that cannot be read.
pub fn in_bank(settings: &Settings, inputs: &[Input]) -> Result<BTreeMap<String, Recording>, DiagnosticsError> {
    FactsCache::default().in_bank(settings, inputs)
}
