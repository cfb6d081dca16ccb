//! Packing a shard into an object: a bank of its checked clips, without the results that depend on clips of other
//! shards.

use super::ContentHash;
use super::export::ExportTable;
use super::wire::WireReport;
use crate::project::Options;
use crate::run::compile::CompileRun;
use crate::run::{Compiled, Compiler};
use crate::sources::Input;
use lipz_diagnostics::{Code, Report, reports};
use std::collections::BTreeMap;

/// Data of an object in addition to its clips.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct Shard {
    /// Its number.
    pub shard: u16,
    /// The number of shards.
    pub shards: u16,
    /// Path and contents of the settings file, which determines how the object is linked.
    pub settings: Option<(String, String)>,
    /// Reports about the files from before they were packed.
    pub reports: Vec<Report>,
}

impl Shard {
    /// Creates the data for shard number `shard` of `shards`.
    pub fn new(shard: u16, shards: u16) -> Shard {
        Shard { shard, shards, settings: None, reports: Vec::new() }
    }
}

impl Compiler<'_> {
    /// Checks `inputs`, the clips of a shard, and makes an object from them: a bank with only their own texts, and a
    /// table for [`link`](Compiler::link), which resolves fallback, dubs and coverage. The bytes depend only on inputs,
    /// options and `shard`.
    pub fn object(&self, inputs: &[Input], shard: &Shard) -> Compiled {
        self.compile_in_pool(|options| {
            let mut run = CompileRun::read(inputs, options, None, &self.progress);
            run.add_reports(shard.reports.clone());
            let export = |reports: &[Report], locales: &[Box<str>]| {
                let mut by_key: Vec<&Input> = inputs.iter().collect();
                by_key.sort_by(|one, other| one.key.cmp(&other.key));
                ExportTable {
                    settings: shard.settings.clone(),
                    locales: locales.iter().map(ToString::to_string).collect(),
                    names: by_key.into_iter().map(Input::name).collect(),
                    reports: to_wire(reports),
                    ..ExportTable::new(shard.shard, shard.shards, options_hash(options))
                }
                .encode()
            };
            run.object(inputs, options, export)
        })
    }
}

/// Returns the reports that linking does not produce again. It compares keys itself.
fn to_wire(found: &[Report]) -> Vec<WireReport> {
    let mut found = found.to_vec();
    found.iter_mut().for_each(|report| report.diagnostics.retain(|found| found.code != Code::KeyClash));
    reports::sort(&mut found);
    found.iter().map(WireReport::of).collect()
}

/// Returns the hash of canonical options, without those that change no byte or concern single clips in the object.
pub(super) fn options_hash(options: &Options) -> ContentHash {
    let common = Options { threads: None, recordings: BTreeMap::new(), word_times: BTreeMap::new(), ..options.clone() };
    ContentHash::of(format!("{common:?}").as_bytes())
}
