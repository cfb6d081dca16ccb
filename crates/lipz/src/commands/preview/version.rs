//! One state of a project: its bank, and what is known about each clip besides.

use super::characters::{self, Characters};
use super::hearing::Hearing;
use crate::console;
use crate::shared::inputs::with_inputs;
use lipz_bank::files::DialogueFile;
use lipz_bank::{Bank, Dialogue};
use lipz_compiler::settings::Settings;
use lipz_compiler::{Compiled, Compiler, Content, Input, Memory, Options, WordTimes};
use lipz_diagnostics::Report;
use lipz_sync::{KnownPhones, KnownRecordings, Recordings};
use std::collections::{BTreeMap, HashSet};
use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

/// What one packing leaves to the next, which reads only what changed.
#[derive(Default)]
pub(super) struct Remembered {
    clips: Memory,
    recordings: KnownRecordings,
    phones: Arc<KnownPhones>,
    has_looked: bool,
}

/// A state of the project.
#[derive(Clone, Default)]
pub(super) struct Version {
    /// Which one: each has the number behind that of the one before.
    pub(super) number: u64,
    /// What is shown, for the title of the page.
    pub(super) name: String,
    /// The bank of all clips without errors.
    pub(super) bank: Arc<Vec<u8>>,
    /// The Lipz files by their keys; none of a bank.
    pub(super) files: BTreeMap<String, PathBuf>,
    /// The diagnostics of files, by their names.
    reports: BTreeMap<String, Vec<Report>>,
    pub(super) words: BTreeMap<String, WordTimes>,
    pub(super) recordings: Arc<Recordings>,
    pub(super) hearing: Arc<Hearing>,
    /// How drafts of a clip are packed.
    pub(super) options: Options,
    /// Found when a list is first asked for, and kept: diagnostics that are added later are of the same clips.
    characters: Arc<OnceLock<Characters>>,
}

impl Version {
    /// The only state of a bank.
    pub(super) fn of_bank(name: &str, bank: Vec<u8>, recordings: Recordings) -> Version {
        let (bank, recordings) = (Arc::new(bank), Arc::new(recordings));
        Version { name: name.to_owned(), bank, recordings, ..Version::default() }
    }

    /// Who is in the clips.
    pub(super) fn characters(&self) -> &Characters {
        let find = || {
            let mut files = [DialogueFile::ABSENT];
            let dialogue = Dialogue::open_unverified(&mut files, [self.bank.as_slice()]);
            dialogue.map(|dialogue| characters::of_clips(self, &dialogue)).unwrap_or_default()
        };
        self.characters.get_or_init(find)
    }

    /// The diagnostics of a clip: of its Lipz file, and of its recording.
    pub(super) fn reports_of(&self, key: &str) -> Vec<Report> {
        let paths = self.files.get(key).map(PathBuf::as_path).into_iter().chain(self.recordings.find(key));
        paths.filter_map(|path| self.reports.get(&console::path(path))).flatten().cloned().collect()
    }

    /// All diagnostics.
    pub(super) fn all_reports(&self) -> Vec<Report> {
        self.reports.values().flatten().cloned().collect()
    }

    /// The diagnostics that belong to no clip of the project.
    pub(super) fn other_reports(&self) -> impl Iterator<Item = &Report> {
        let recordings = self.files.keys().filter_map(|key| self.recordings.find(key));
        let own: HashSet<String> =
            self.files.values().map(PathBuf::as_path).chain(recordings).map(console::path).collect();
        self.reports.iter().filter(move |(name, _)| !own.contains(*name)).flat_map(|(_, reports)| reports)
    }

    /// The same with more diagnostics.
    pub(super) fn with(&self, reports: &[Report]) -> Version {
        let mut next = self.clone();
        next.add(reports);
        next
    }

    /// The same with this report about its file, and no other.
    pub(super) fn with_only(&self, report: &Report) -> Version {
        let mut next = self.clone();
        next.reports.insert(report.source.path.clone(), vec![report.clone()]);
        next
    }

    fn add(&mut self, reports: &[Report]) {
        for report in reports {
            let known = self.reports.entry(report.source.path.clone()).or_default();
            if !known.contains(report) {
                known.push(report.clone());
            }
        }
    }

    /// Takes the bank of the state before, if this one has none: what can be seen stays to be seen.
    pub(super) fn keep_bank_of(&mut self, before: &Version) {
        if self.bank.is_empty() {
            self.bank = Arc::clone(&before.bank);
        }
    }

    /// The hash of the bank's bytes in hexadecimal, by which the page knows whether it has them: JavaScript has no integers of
    /// 64 bits in JSON.
    pub(super) fn bank_tag(&self) -> String {
        format!("{:016x}", Bank::open(&self.bank).map_or(0, |bank| bank.checksum()))
    }
}

/// Packs the project in memory: all files without errors.
pub(super) fn load(settings: &Settings, remembered: &mut Remembered) -> (Version, Vec<Input>) {
    let Remembered { clips, recordings, phones, has_looked } = remembered;
    if !*has_looked && let (Some(cache), Some(output)) = (&settings.cache, &settings.output) {
        // A cache that is none is told by `lipz pack`, which would write it; this run can do without.
        *clips = Memory::read(cache, output).unwrap_or_default();
    }
    *has_looked = true;
    let mut options = Options::default();
    let worked = with_inputs(settings, Some(recordings), true, |compiler, inputs| {
        options = compiler.options().clone();
        packed(compiler, inputs, clips)
    });
    let mut version = Version {
        name: settings.sources.iter().map(|source| console::path(source)).collect::<Vec<_>>().join(", "),
        bank: Arc::new(worked.compiled.bank.unwrap_or_default()),
        words: lipz_sync::word_times(settings, &worked.inputs).unwrap_or_default(),
        recordings: Arc::new(Recordings::discover_with_reports(settings).0),
        hearing: Arc::new(Hearing::new(settings.clone(), Arc::clone(phones))),
        options,
        ..Version::default()
    };
    version.files.extend(worked.inputs.iter().filter_map(|input| match &input.content {
        Content::File(path) => Some((input.key.clone(), path.clone())),
        Content::Bytes { .. } => None,
    }));
    version.add(&worked.reports);
    (version, worked.inputs.into_owned())
}

/// The bank of all files that have no errors, with the diagnostics of all.
fn packed(compiler: &Compiler<'_>, inputs: &[Input], memory: &mut Memory) -> Compiled {
    let whole = compiler.compile_again(inputs, memory);
    if whole.bank.is_some() {
        return whole;
    }
    let wrong: HashSet<&str> =
        whole.reports.iter().filter(|report| report.has_errors()).map(|report| report.source.path.as_str()).collect();
    let right: Vec<Input> = inputs.iter().filter(|input| !wrong.contains(input.name().as_str())).cloned().collect();
    let mut rest = compiler.compile(&right);
    rest.reports = whole.reports;
    rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_are_found_once_for_all_lists_of_a_bank() {
        let version = Version::default();
        assert!(std::ptr::eq(version.characters(), version.with(&[]).characters()));
    }
}
