//! The sources of visemes, in a text file that accompanies the Lipz files and merges in version control.

mod approval;
mod dependencies;
mod doubtful_word;
pub(crate) mod expected_text;
pub(crate) mod hashes;
mod line;
mod recorded_text;
mod recording_state;
mod renamed;
mod word_times;

pub use approval::{UnapprovedRecording, unapproved, unapproved_with_reports};
pub use dependencies::dependencies;
pub use doubtful_word::DoubtfulWord;
pub(crate) use line::parse_hash;
pub use line::{MouthHashes, OriginalHashes, RecordLine};
pub use recorded_text::RecordedText;
pub use recording_state::{RecordedClip, SyncState};
pub use word_times::{word_times, word_times_of};

use crate::recordings::file_facts::unreadable;
use crate::recordings::paths::shown;
use lipz_compiler::settings::Settings;
use lipz_compiler::{WordTimes, replace_file, resolved_below};
use lipz_diagnostics::{Code, Diagnostic, Report, Source, Span};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The default name of the file.
pub const RECORD_NAME: &str = "lipz-sync.txt";

/// Returns the path of a project's record: from its settings, or next to its Lipz files ([`SyncRecord::place`]).
pub fn record_place(settings: &Settings) -> PathBuf {
    let folder = |path: &Path| path.ancestors().find(|path| path.is_dir()).map(Path::to_owned);
    let sources = || settings.sources.first().and_then(|source| folder(source));
    let beside = || settings.root.clone().or_else(sources).unwrap_or_else(|| PathBuf::from("."));
    settings.audio.record.clone().unwrap_or_else(|| SyncRecord::place(&beside()))
}

/// The start of the file, for people.
const HEAD: &str = "\
# lipz sync: the sources of all visemes, as hashes of recording, text, settings and visemes, and the times of their words.
# Keep this file with the Lipz files. Visemes without a line count as made by hand.
# `spoken:` is the text that a recording was made for, if it differs from the text of its visemes.
";

/// The record of a project. After a merge or an interrupted run, a Lipz file may have several lines, all of which are
/// true.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct SyncRecord {
    path: PathBuf,
    /// By the paths of Lipz files, relative to the folder of the record.
    lines: BTreeMap<String, Vec<RecordLine>>,
    /// By the same paths, the texts of recordings that are not in these lines.
    spoken: BTreeMap<String, Vec<RecordedText>>,
    warnings: Option<Report>,
}

impl SyncRecord {
    /// Returns the path of the record for Lipz files in `folder`: in it or the nearest parent folder that has one, or
    /// in `folder` if no folder has one.
    pub fn place(folder: &Path) -> PathBuf {
        let existing = folder.ancestors().map(|above| above.join(RECORD_NAME)).find(|path| path.is_file());
        existing.unwrap_or_else(|| folder.join(RECORD_NAME))
    }

    /// Reads the record at `path`, or returns an empty one if the file does not exist. It stores the
    /// [warnings](SyncRecord::warnings) about its lines.
    ///
    /// # Errors
    /// If the file cannot be read, or is not a record.
    pub fn read(path: &Path) -> Result<SyncRecord, Report> {
        match fs::read(path) {
            Ok(bytes) => SyncRecord::parse(path, &bytes),
            Err(error) if error.kind() == io::ErrorKind::NotFound => SyncRecord::parse(path, b""),
            Err(error) => Err(unreadable(path, &error)),
        }
    }

    /// Parses the record in `bytes`, from the file at `path`, like [`read`](SyncRecord::read).
    ///
    /// # Errors
    /// If it is not a record.
    pub fn parse(path: &Path, bytes: &[u8]) -> Result<SyncRecord, Report> {
        let empty = SyncRecord { path: path.to_owned(), ..SyncRecord::default() };
        let text = String::from_utf8_lossy(lipz_file::without_byte_order_mark(bytes));
        if !text.is_empty() && !text.starts_with("# lipz sync") && !text.starts_with("<<<<<<<") {
            let message =
                format!("`{}` is not a record of visemes and their recordings and is not overwritten", shown(path));
            let help = "name a different file in `record` of [audio]";
            return Err(Report::failure(shown(path), Code::OutputFailed, message, help));
        }
        let (mut record, mut diagnostics) = (empty, Vec::new());
        let mut start = 0;
        for line in text.split_inclusive('\n') {
            let content = line.trim_end_matches(['\n', '\r']);
            match (RecordLine::parse(content), RecordedText::parse(content)) {
                (Some((line, file)), _) => record.lines.entry(file.to_owned()).or_default().push(line),
                (_, Some((spoken, file))) => record.spoken.entry(file.to_owned()).or_default().push(spoken),
                _ if content.is_empty() || content.starts_with('#') => {}
                _ => {
                    let span = Span::new(start, start + content.len());
                    let diagnostic = Diagnostic::at(Code::SyncRecordLine, span, "the line is not a record of visemes");
                    diagnostics
                        .push(diagnostic.help("remove it; the next run that makes visemes writes the file again"));
                }
            }
            start += line.len();
        }
        let source = || Source::new(shown(path), text);
        record.warnings = (!diagnostics.is_empty()).then(|| Report::new(source(), diagnostics));
        Ok(record)
    }

    /// Returns the warnings about lines that were skipped. They have the levels of their rules, not those of a project.
    pub fn warnings(&self) -> &[Report] {
        self.warnings.as_slice()
    }

    /// Returns all lines about the visemes of a Lipz file.
    pub fn lines_for(&self, lipz_file: &Path) -> &[RecordLine] {
        if self.lines.is_empty() {
            return &[];
        }
        self.lines.get(&self.name(lipz_file)).map_or(&[], Vec::as_slice)
    }

    /// Returns the known texts of a Lipz file's recording: those that were approved or kept by a run, otherwise those
    /// from which its visemes were made.
    pub fn spoken_for(&self, lipz_file: &Path, sound: u64) -> Vec<RecordedText> {
        let spoken = if self.spoken.is_empty() { None } else { self.spoken.get(&self.name(lipz_file)) };
        let is_in_it = |spoken: &RecordedText| spoken.sound == sound;
        let spoken: Vec<RecordedText> = spoken.into_iter().flatten().copied().filter(is_in_it).collect();
        if !spoken.is_empty() {
            return spoken;
        }
        self.lines_for(lipz_file).iter().map(RecordedText::from).filter(is_in_it).collect()
    }

    /// Returns the same in the current form, if the recording has `text` and its original has `of_original`.
    pub(crate) fn spoken_now(
        &self,
        lipz_file: &Path,
        sound: u64,
        text: Option<&str>,
        of_original: Option<&str>,
    ) -> Vec<RecordedText> {
        let known = self.spoken_for(lipz_file, sound).into_iter();
        known.map(|spoken| spoken.renewed(text, of_original)).collect()
    }

    /// Returns the known texts of all recordings of a Lipz file.
    pub(crate) fn all_spoken(&self, lipz_file: &Path) -> &[RecordedText] {
        self.spoken.get(&self.name(lipz_file)).map_or(&[], Vec::as_slice)
    }

    /// Records the only text of a Lipz file's recording.
    pub(crate) fn approve(&mut self, lipz_file: &Path, spoken: RecordedText) {
        self.say(self.name(lipz_file), spoken.sound, vec![spoken]);
    }

    /// Replaces the known texts of a recording. Those of other recordings stay, because a replaced take may come back.
    fn say(&mut self, name: String, sound: u64, mut spoken: Vec<RecordedText>) {
        let known = self.spoken.remove(&name).unwrap_or_default();
        spoken.extend(known.into_iter().filter(|other| other.sound != sound));
        spoken.sort_unstable(); // as in the file
        if !spoken.is_empty() {
            self.spoken.insert(name, spoken);
        }
    }

    /// Appends lines to the file immediately, before the visemes are written. If the run ends in between, the old line
    /// is still there.
    ///
    /// # Errors
    /// If it cannot be written.
    pub(crate) fn append(&self, lipz_file: &Path, line: &RecordLine, spoken: &[RecordedText]) -> Result<(), Report> {
        let write = || {
            if let Some(folder) = self.path.parent() {
                fs::create_dir_all(folder)?;
            }
            let mut file = OpenOptions::new().append(true).create(true).open(&self.path)?;
            let head = if file.metadata()?.len() == 0 { HEAD } else { "" };
            let name = self.name(lipz_file);
            let spoken: String = spoken.iter().map(|spoken| spoken.written(&name) + "\n").collect();
            // One write, so that an interruption leaves at most one invalid line.
            file.write_all(format!("{head}{spoken}{}\n", line.written(&name)).as_bytes())
        };
        write().map_err(|error: io::Error| {
            let message = format!("`{}` cannot be written: {error}", shown(&self.path));
            let help = "check its permissions, or name a different file in `record` of [audio]";
            Report::failure(shown(&self.path), Code::OutputFailed, message, help)
        })
    }

    /// Replaces the lines about the visemes of a file and about the recording from which they were made.
    pub(crate) fn set(&mut self, lipz_file: &Path, line: RecordLine, spoken: Vec<RecordedText>) {
        let name = self.name(lipz_file);
        self.say(name.clone(), line.made.sound, spoken);
        self.lines.insert(name, vec![line]);
    }

    /// Replaces the times of words in the line of a file that provides them, if it is about this recording.
    pub(crate) fn set_words(&mut self, lipz_file: &Path, sound: u64, words: WordTimes) {
        let name = self.name(lipz_file);
        let lines = self.lines.get_mut(&name).into_iter().flatten();
        if let Some(line) = lines.rev().find(|line| line.words.is_some()).filter(|line| line.made.sound == sound) {
            line.words = Some(words);
        }
    }

    /// Replaces the file: one line per Lipz file, sorted by path.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn write(&self) -> Result<(), Report> {
        let text = self.to_string();
        if self.lines.is_empty() && self.spoken.is_empty()
            || fs::read(&self.path).is_ok_and(|before| before == text.as_bytes())
        {
            return Ok(());
        }
        replace_file(&self.path, text.as_bytes())
    }

    /// Returns the name of a Lipz file in the record: its path relative to the folder of the record, with `/`.
    pub(crate) fn name(&self, lipz_file: &Path) -> String {
        let folder = self.path.parent().unwrap_or(Path::new(""));
        if let Ok(below) = lipz_file.strip_prefix(folder) {
            return shown(below);
        }
        // Only the file system can resolve paths that start in a different folder. The file may not exist yet.
        resolved_below(lipz_file, folder).map_or_else(|| shown(lipz_file), |below| shown(&below))
    }
}

/// Prints the file: one line per Lipz file, sorted by path.
impl fmt::Display for SyncRecord {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(HEAD)?;
        let files: BTreeSet<&String> = self.lines.keys().chain(self.spoken.keys()).collect();
        for file in files {
            for line in self.lines.get(file).into_iter().flatten().collect::<BTreeSet<_>>() {
                writeln!(f, "{}", line.written(file))?;
            }
            for spoken in self.spoken.get(file).into_iter().flatten().collect::<BTreeSet<_>>() {
                writeln!(f, "{}", spoken.written(file))?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    const MADE: MouthHashes = MouthHashes { sound: 1, text: 2, settings: 3, mouth: u64::MAX };
    const A: RecordLine =
        RecordLine { made: MADE, words: None, original: None, is_corrected: false, differences: None };

    fn b() -> RecordLine {
        let words = Some("0badcafe:0-3#0001@40-250,4-9#beef@300-410?".parse().unwrap());
        let differences = Some("0badcafe:4-9@300-410".parse().unwrap());
        let original = Some(OriginalHashes { sound: 10, text: 11 });
        RecordLine { made: MouthHashes { mouth: 0, ..MADE }, words, original, is_corrected: true, differences }
    }

    #[test]
    fn a_record_is_written_sorted_and_read_back() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(RECORD_NAME);
        let mut record = SyncRecord::read(&path).unwrap();
        assert_eq!(record.warnings(), []);
        record.write().unwrap();
        assert!(!path.exists(), "nothing to say");
        let files = ["b c.lipz", "a/x.lipz"].map(|name| folder.path().join(name));
        record.append(&files[0], &A, &[]).unwrap();
        record.append(&files[1], &A, &[]).unwrap();
        record.append(&files[1], &b(), &[]).unwrap();
        let again = SyncRecord::read(&path).unwrap();
        assert_eq!((again.lines_for(&files[0]), again.lines_for(&files[1])), (&[A][..], &[A, b()][..]));
        assert_eq!(again.warnings(), []);
        record.set(&files[0], A, Vec::new());
        record.set(&files[1], b(), Vec::new());
        record.write().unwrap();
        let text = fs::read_to_string(&path).unwrap();
        let zeros = "0".repeat(15);
        let expected = format!(
            "{zeros}1 {zeros}2 {zeros}3 {zeros}0 dub-of:{zeros}a,{zeros}b from:textgrid differs:0badcafe:4-9@300-410 said:0badcafe:0-3#0001@40-250,4-9#beef@300-410? a/x.lipz\n{zeros}1 {zeros}2 {zeros}3 ffffffffffffffff b c.lipz\n"
        );
        assert_eq!(text.strip_prefix(HEAD), Some(expected.as_str()));
    }

    #[test]
    fn a_file_has_the_same_name_from_each_folder_before_and_after_it_exists() {
        let folder = tempfile::tempdir().unwrap();
        let record = SyncRecord::read(&folder.path().join(RECORD_NAME)).unwrap();
        fs::create_dir_all(folder.path().join("act1")).unwrap();
        let roundabout = folder.path().parent().unwrap().join(".").join(folder.path().file_name().unwrap());
        let paths = [folder.path().join("act1/../act1/x.lipz"), roundabout.join("act1/./x.lipz")];
        let roundabout_record = SyncRecord::read(&roundabout.join("act1/..").join(RECORD_NAME)).unwrap();
        let names = || paths.each_ref().map(|path| roundabout_record.name(path));
        assert_eq!(names(), ["act1/x.lipz"; 2], "not there yet");
        fs::write(folder.path().join("act1/x.lipz"), "{}").unwrap();
        assert_eq!(names(), ["act1/x.lipz"; 2]);
        assert_eq!(record.name(&folder.path().join("act1/x.lipz")), "act1/x.lipz");
    }

    #[test]
    fn what_a_recording_says_is_what_was_accepted_or_else_what_its_mouth_was_made_from() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(RECORD_NAME);
        let file = folder.path().join("x.lipz");
        let mut record = SyncRecord::read(&path).unwrap();
        let (made, of_dub) = (RecordedText::from(&A), RecordedText { sound: 1, text: 9, original: b().original });
        assert_eq!(record.spoken_for(&file, 1), []);
        record.append(&file, &A, &[of_dub]).unwrap();
        record = SyncRecord::read(&path).unwrap();
        assert_eq!((record.spoken_for(&file, 1), record.spoken_for(&file, 2)), (vec![of_dub], vec![]));
        record.approve(&file, RecordedText { sound: 5, ..of_dub });
        let other = RecordedText { sound: 5, ..of_dub };
        assert_eq!((record.spoken_for(&file, 1), record.spoken_for(&file, 5)), (vec![of_dub], vec![other]));
        record.write().unwrap();
        assert_eq!(SyncRecord::read(&path).unwrap(), record);
        record.set(&file, A, Vec::new());
        assert_eq!(record.spoken_for(&file, 1), [made]);
        assert_eq!(record.spoken_for(&file, 5), [other], "a take that was replaced may come back");
        let line = of_dub.written("x.lipz");
        for damaged in ["spoken:1,2", "spoken:", "dub-of:0"] {
            let at = line.find(&damaged[..damaged.len().min(7)]).unwrap();
            let damaged = format!("{}{damaged} {}", &line[..at], &line[line.len() - 6..]);
            assert_eq!(RecordedText::parse(&damaged), None, "{damaged}");
        }
    }

    #[test]
    fn merges_with_conflicts_are_read_and_other_files_left_alone() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(RECORD_NAME);
        let conflict = format!(
            "{HEAD}<<<<<<< ours\n{}\n=======\n{}\n>>>>>>> theirs\n",
            A.written("x.lipz"),
            b().written("x.lipz")
        );
        fs::write(&path, &conflict).unwrap();
        let record = SyncRecord::read(&path).unwrap();
        assert_eq!(record.lines_for(&folder.path().join("x.lipz")), [A, b()]);
        assert_eq!(record.warnings()[0].diagnostics.len(), 3);
        fs::write(&path, "my notes").unwrap();
        assert!(SyncRecord::read(&path).is_err());
        let odd = [b"\xef\xbb\xbf# lipz sync\n\xff\xff nothing\n".as_slice(), A.written("x.lipz").as_bytes()].concat();
        let record = SyncRecord::parse(&path, &odd).unwrap();
        assert_eq!(record.lines_for(&folder.path().join("x.lipz")), [A]);
        let report = &record.warnings()[0];
        let span = report.diagnostics[0].primary.as_ref().unwrap().span;
        assert_eq!(&report.source.text[span.range()], "\u{fffd}\u{fffd} nothing", "the position in the shown text");
        for at in 0..conflict.len() {
            fs::write(&path, &conflict[..at]).unwrap();
            let _ = SyncRecord::read(&path); // no panic
        }
    }

    #[test]
    fn damaged_fields_say_nothing() {
        let whole = b().written("x.lipz");
        assert!(RecordLine::parse(&whole).is_some());
        for (field, damaged) in [("said:0badcafe:", "said:0badcafe"), ("dub-of:0", "dub-of:x"), (" x.lipz", "")] {
            assert_eq!(RecordLine::parse(&whole.replace(field, damaged)), None, "{damaged}");
        }
    }

    #[test]
    fn the_nearest_record_above_is_used() {
        let folder = tempfile::tempdir().unwrap();
        let inner = folder.path().join("act1");
        fs::create_dir(&inner).unwrap();
        assert_eq!(SyncRecord::place(&inner), inner.join(RECORD_NAME));
        fs::write(folder.path().join(RECORD_NAME), "").unwrap();
        assert_eq!(SyncRecord::place(&inner), folder.path().join(RECORD_NAME));
    }
}
