//! What a bank says about the recordings of its clips.

use crate::{Facts, Recordings, threads};
use lipz_bank::Recording;
use lipz_compiler::Input;
use lipz_compiler::settings::Settings;
use lipz_diagnostics::Report;
use std::collections::BTreeMap;

/// Length and content hash of the recording of each of these clips that has one, by key: for
/// [`Options::recordings`](lipz_compiler::Options::recordings). Nothing if the project does not want them in its bank
/// ([`Audio::in_bank`](lipz_compiler::settings::Audio::in_bank)). Reports what cannot be read.
pub fn in_bank(settings: &Settings, inputs: &[Input]) -> (BTreeMap<String, Recording>, Vec<Report>) {
    if !settings.audio.in_bank {
        return Default::default();
    }
    let (recordings, mut reports) = Recordings::discover(settings);
    let found: Vec<_> = inputs.iter().filter_map(|input| Some((&input.key, recordings.find(&input.key)?))).collect();
    let facts = threads::map(&found, settings.options.threads, |(_, path)| Facts::read(path));
    let mut known = BTreeMap::new();
    for ((key, _), facts) in found.into_iter().zip(facts) {
        match facts {
            Ok(facts) => drop(known.insert(key.clone(), facts.into())),
            Err(report) => reports.push(report),
        }
    }
    (known, reports)
}
