//! Packing a shard: an object is a bank of its clips as they are checked, before anything is decided that depends on the
//! clips of other shards.

use super::ContentHash;
use super::export::Export;
use super::wire::WireReport;
use crate::compile::Run;
use crate::{Compiled, Compiler, Input, Options};
use lipz_diagnostics::{Code, Report, reports};
use std::collections::BTreeMap;

/// What an object says beside its clips.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct Shard {
    /// Its number.
    pub shard: u16,
    /// How many shards there are.
    pub shards: u16,
    /// Path and contents of the settings file: an object says how it is linked.
    pub settings: Option<(String, String)>,
    /// What was reported about the files before they were packed.
    pub reports: Vec<Report>,
}

impl Shard {
    /// Shard number `shard` of so many.
    pub fn new(shard: u16, shards: u16) -> Shard {
        Shard { shard, shards, settings: None, reports: Vec::new() }
    }
}

impl Compiler<'_> {
    /// Checks `inputs`, the clips of a shard, and makes an object of them: a bank with their own texts only, and a table for
    /// [`link`](Compiler::link). Fallback, dubs and coverage are for that. The bytes depend on inputs, options and `shard`
    /// only.
    pub fn object(&self, inputs: &[Input], shard: &Shard) -> Compiled {
        self.run(|options| {
            let mut run = Run::read(inputs, options, None, &self.progress);
            run.add_reports(shard.reports.clone());
            let export = |reports: &[Report], locales: &[Box<str>]| {
                let mut by_key: Vec<&Input> = inputs.iter().collect();
                by_key.sort_by(|one, other| one.key.cmp(&other.key));
                Export {
                    settings: shard.settings.clone(),
                    locales: locales.iter().map(ToString::to_string).collect(),
                    names: by_key.into_iter().map(Input::name).collect(),
                    reports: to_wire(reports),
                    ..Export::new(shard.shard, shard.shards, options_hash(options))
                }
                .encode()
            };
            run.object(inputs, options, export)
        })
    }
}

/// The reports that linking does not make again: keys are compared there.
fn to_wire(found: &[Report]) -> Vec<WireReport> {
    let mut found = found.to_vec();
    found.iter_mut().for_each(|report| report.diagnostics.retain(|found| found.code != Code::KeyClash));
    reports::sort(&mut found);
    found.iter().map(WireReport::of).collect()
}

/// The hash of canonical options, without what changes no byte and what is about single clips, which an object has.
pub(super) fn options_hash(options: &Options) -> ContentHash {
    let common = Options { threads: None, recordings: BTreeMap::new(), word_times: BTreeMap::new(), ..options.clone() };
    ContentHash::of(format!("{common:?}").as_bytes())
}
