//! One state of a project: its bank, and other data about each clip.

use super::characters::{self, Characters};
use super::hearing::Hearing;
use super::sprites::SpriteSets;
use crate::console;
use crate::shared::inputs::with_inputs;
use lipz_bank::files::DialogueFile;
use lipz_bank::{Bank, Dialogue};
use lipz_compiler::settings::Settings;
use lipz_compiler::{Compiled, Compiler, Content, Input, Memory, Options, WordTimes};
use lipz_diagnostics::Report;
use lipz_sync::{FactsCache, PhoneTimeCache, Recordings};
use std::collections::{BTreeMap, HashSet};
use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

/// Results that one run of packing keeps for the next, which reads only changed files.
#[derive(Default)]
pub(super) struct PreviewMemory {
    clips: Memory,
    recordings: FactsCache,
    phones: Arc<PhoneTimeCache>,
    has_looked: bool,
}

/// A state of the project.
#[derive(Clone, Default)]
pub(super) struct Version {
    /// Its number, one more than that of the previous version.
    pub(super) number: u64,
    /// The name of the project or bank, for the title of the page.
    pub(super) name: String,
    /// The bank of all clips without errors.
    pub(super) bank: Arc<Vec<u8>>,
    /// The Lipz files by key; empty for a bank.
    pub(super) files: BTreeMap<String, PathBuf>,
    /// The diagnostics of files, by file name.
    reports: BTreeMap<String, Vec<Report>>,
    pub(super) words: BTreeMap<String, WordTimes>,
    pub(super) recordings: Arc<Recordings>,
    pub(super) hearing: Arc<Hearing>,
    pub(super) sprites: Arc<SpriteSets>,
    /// The options for packing drafts of a clip.
    pub(super) options: Options,
    /// Computed for the first list, then kept, because diagnostics that are added later do not change the clips.
    characters: Arc<OnceLock<Characters>>,
}

impl Version {
    /// Returns the only state of a bank.
    pub(super) fn of_bank(name: &str, bank: Vec<u8>, recordings: Recordings) -> Version {
        let (bank, recordings) = (Arc::new(bank), Arc::new(recordings));
        Version { name: name.to_owned(), bank, recordings, ..Version::default() }
    }

    /// Returns the characters of the clips.
    pub(super) fn characters(&self) -> &Characters {
        let find = || {
            let mut files = [DialogueFile::ABSENT];
            let dialogue = Dialogue::open_unverified(&mut files, [self.bank.as_slice()]);
            dialogue.map(|dialogue| characters::of_clips(self, &dialogue)).unwrap_or_default()
        };
        self.characters.get_or_init(find)
    }

    /// Returns the diagnostics of a clip's Lipz file and of its recording.
    pub(super) fn reports_of(&self, key: &str) -> Vec<Report> {
        let paths = self.files.get(key).map(PathBuf::as_path).into_iter().chain(self.recordings.find(key));
        paths.filter_map(|path| self.reports.get(&console::path(path))).flatten().cloned().collect()
    }

    /// Returns all diagnostics.
    pub(super) fn all_reports(&self) -> Vec<Report> {
        self.reports.values().flatten().cloned().collect()
    }

    /// Returns the diagnostics that belong to no clip of the project.
    pub(super) fn other_reports(&self) -> impl Iterator<Item = &Report> {
        let recordings = self.files.keys().filter_map(|key| self.recordings.find(key));
        let own: HashSet<String> =
            self.files.values().map(PathBuf::as_path).chain(recordings).map(console::path).collect();
        self.reports.iter().filter(move |(name, _)| !own.contains(*name)).flat_map(|(_, reports)| reports)
    }

    /// Returns this version with additional diagnostics.
    pub(super) fn with(&self, reports: &[Report]) -> Version {
        let mut next = self.clone();
        next.add(reports);
        next
    }

    /// Returns this version with this report as the only one about its file.
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

    /// Takes the bank of the previous state if this one has none, so that the clips stay visible.
    pub(super) fn keep_bank_of(&mut self, before: &Version) {
        if self.bank.is_empty() {
            self.bank = Arc::clone(&before.bank);
        }
    }

    /// Returns the hash of the bank's bytes in hexadecimal, which identifies the bank for the page. It is not a number,
    /// because JSON in JavaScript has no 64-bit integers.
    pub(super) fn bank_tag(&self) -> String {
        format!("{:016x}", Bank::open(&self.bank).map_or(0, |bank| bank.checksum()))
    }
}

/// Packs all files of the project without errors in memory.
pub(super) fn load(settings: &Settings, remembered: &mut PreviewMemory) -> (Version, Vec<Input>) {
    let PreviewMemory { clips, recordings, phones, has_looked } = remembered;
    if !*has_looked && let (Some(cache), Some(output)) = (&settings.cache, &settings.output) {
        // Ignore an invalid cache. `lipz pack`, which would write it, reports it.
        *clips = Memory::read(cache, output).unwrap_or_default();
    }
    *has_looked = true;
    let mut options = Options::default();
    let worked = with_inputs(settings, Some(recordings), true, |compiler, inputs| {
        options = compiler.options().clone();
        packed(compiler, inputs, clips)
    });
    let (sprites, missing) = SpriteSets::read(settings);
    let mut version = Version {
        sprites: Arc::new(sprites),
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
    version.add(&missing);
    (version, worked.inputs.into_owned())
}

/// Returns the bank of all files without errors, with the diagnostics of all files.
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
