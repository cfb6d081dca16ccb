//! What mouths were made from: a text file that belongs to the Lipz files, and that version control merges.

mod line;

pub(crate) use line::parse_hash;
pub use line::{Line, Made, OriginalThen};

use super::spoken::Spoken;
use crate::facts::unreadable;
use crate::recordings::shown;
use lipz_compiler::replace_file;
use lipz_compiler::settings::Settings;
use lipz_diagnostics::{Code, Diagnostic, Report, Source, Span};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Name of the file, unless a project names another.
pub const RECORD_NAME: &str = "lipz-sync.txt";

/// Where the record of a project is: where its settings say, or beside its Lipz files ([`SyncRecord::place`]).
pub fn record_place(settings: &Settings) -> PathBuf {
    let folder = |path: &Path| path.ancestors().find(|path| path.is_dir()).map(Path::to_owned);
    let sources = || settings.sources.first().and_then(|source| folder(source));
    let beside = || settings.root.clone().or_else(sources).unwrap_or_else(|| PathBuf::from("."));
    settings.audio.record.clone().unwrap_or_else(|| SyncRecord::place(&beside()))
}

/// What the file begins with, for people.
const HEAD: &str = "\
# lipz sync: what each mouth was made from, as hashes of recording, text, settings and mouth shapes, and when its words are said.
# Keep this file with the Lipz files. A mouth that is in no line counts as made by hand.
# `spoken:` is the text that a recording was made for, if that is not the one of its mouth.
";

/// The record of a project. A file may have several lines: after a merge, or a run that was killed. Each of them is true.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct SyncRecord {
    path: PathBuf,
    /// By the paths of Lipz files below the folder of the record.
    lines: BTreeMap<String, Vec<Line>>,
    /// By the same paths, what recordings say beside what these lines say.
    spoken: BTreeMap<String, Vec<Spoken>>,
    warnings: Option<Report>,
}

impl SyncRecord {
    /// Where the record of Lipz files in `folder` is: in it or the nearest folder above it that has one; a new one is made
    /// in it.
    pub fn place(folder: &Path) -> PathBuf {
        let existing = folder.ancestors().map(|above| above.join(RECORD_NAME)).find(|path| path.is_file());
        existing.unwrap_or_else(|| folder.join(RECORD_NAME))
    }

    /// Reads the record at `path`; an empty one if the file does not exist. It keeps the [warnings](SyncRecord::warnings)
    /// about its lines.
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

    /// Reads the record in `bytes`, those of the file at `path`, as [`read`](SyncRecord::read) does.
    ///
    /// # Errors
    /// If it is not a record.
    pub fn parse(path: &Path, bytes: &[u8]) -> Result<SyncRecord, Report> {
        let empty = SyncRecord { path: path.to_owned(), ..SyncRecord::default() };
        let text = String::from_utf8_lossy(lipz_file::without_byte_order_mark(bytes));
        if !text.is_empty() && !text.starts_with("# lipz sync") && !text.starts_with("<<<<<<<") {
            let message =
                format!("`{}` is not a record of mouths and their recordings, and is left alone", shown(path));
            let help = "name another file: `record` of [audio]";
            return Err(Report::failure(shown(path), Code::OutputFailed, message, help));
        }
        let (mut record, mut diagnostics) = (empty, Vec::new());
        let mut start = 0;
        for line in text.split_inclusive('\n') {
            let content = line.trim_end_matches(['\n', '\r']);
            match (Line::parse(content), Spoken::parse(content)) {
                (Some((line, file)), _) => record.lines.entry(file.to_owned()).or_default().push(line),
                (_, Some((spoken, file))) => record.spoken.entry(file.to_owned()).or_default().push(spoken),
                _ if content.is_empty() || content.starts_with('#') => {}
                _ => {
                    let span = Span::new(start, start + content.len());
                    let diagnostic = Diagnostic::at(Code::SyncRecordLine, span, "the line says nothing about a mouth");
                    diagnostics.push(diagnostic.help("remove it: the next run that makes mouths writes the file anew"));
                }
            }
            start += line.len();
        }
        let source = || Source::new(shown(path), text);
        record.warnings = (!diagnostics.is_empty()).then(|| Report::new(source(), diagnostics));
        Ok(record)
    }

    /// The warnings about lines of the file that were passed over. They have the levels of their rules, not those of a
    /// project.
    pub fn warnings(&self) -> &[Report] {
        self.warnings.as_slice()
    }

    /// All that is known of how the mouth of a Lipz file was made.
    pub fn lines_for(&self, lipz_file: &Path) -> &[Line] {
        if self.lines.is_empty() {
            return &[];
        }
        self.lines.get(&self.name(lipz_file)).map_or(&[], Vec::as_slice)
    }

    /// All that is known of which text this recording of a Lipz file was made for: what somebody has accepted or a run has
    /// kept, otherwise what its mouth was made from.
    pub fn spoken_for(&self, lipz_file: &Path, sound: u64) -> Vec<Spoken> {
        let spoken = if self.spoken.is_empty() { None } else { self.spoken.get(&self.name(lipz_file)) };
        let is_in_it = |spoken: &Spoken| spoken.sound == sound;
        let spoken: Vec<Spoken> = spoken.into_iter().flatten().copied().filter(is_in_it).collect();
        if !spoken.is_empty() {
            return spoken;
        }
        self.lines_for(lipz_file).iter().map(Spoken::from).filter(is_in_it).collect()
    }

    /// The same, as it would be written today if the recording says `text` and its original `of_original`.
    pub(crate) fn spoken_now(
        &self,
        lipz_file: &Path,
        sound: u64,
        text: Option<&str>,
        of_original: Option<&str>,
    ) -> Vec<Spoken> {
        let known = self.spoken_for(lipz_file, sound).into_iter();
        known.map(|spoken| spoken.renewed(text, of_original)).collect()
    }

    /// What is known of all recordings of a Lipz file.
    pub(crate) fn all_spoken(&self, lipz_file: &Path) -> &[Spoken] {
        self.spoken.get(&self.name(lipz_file)).map_or(&[], Vec::as_slice)
    }

    /// Notes that a recording of a Lipz file says this, and nothing else.
    pub(crate) fn accept(&mut self, lipz_file: &Path, spoken: Spoken) {
        self.say(self.name(lipz_file), spoken.sound, vec![spoken]);
    }

    /// Makes this all that is known of a recording. What others say stays: a take that was replaced may come back.
    fn say(&mut self, name: String, sound: u64, mut spoken: Vec<Spoken>) {
        let known = self.spoken.remove(&name).unwrap_or_default();
        spoken.extend(known.into_iter().filter(|other| other.sound != sound));
        spoken.sort_unstable(); // as in the file
        if !spoken.is_empty() {
            self.spoken.insert(name, spoken);
        }
    }

    /// Adds lines to the file at once, before the mouth is written: if the run ends in between, the old line is still there.
    ///
    /// # Errors
    /// If it cannot be written.
    pub(crate) fn append(&self, lipz_file: &Path, line: &Line, spoken: &[Spoken]) -> Result<(), Report> {
        let write = || {
            if let Some(folder) = self.path.parent() {
                fs::create_dir_all(folder)?;
            }
            let mut file = OpenOptions::new().append(true).create(true).open(&self.path)?;
            let head = if file.metadata()?.len() == 0 { HEAD } else { "" };
            let name = self.name(lipz_file);
            let spoken: String = spoken.iter().map(|spoken| spoken.written(&name) + "\n").collect();
            // One write: what is killed half-way leaves a line that says nothing.
            file.write_all(format!("{head}{spoken}{}\n", line.written(&name)).as_bytes())
        };
        write().map_err(|error: io::Error| {
            let message = format!("`{}` cannot be written: {error}", shown(&self.path));
            let help = "check that you may write there, or name another file: `record` of [audio]";
            Report::failure(shown(&self.path), Code::OutputFailed, message, help)
        })
    }

    /// Makes these the only lines about the mouth of a file and the recording that it was made from.
    pub(crate) fn set(&mut self, lipz_file: &Path, line: Line, spoken: Vec<Spoken>) {
        let name = self.name(lipz_file);
        self.say(name.clone(), line.made.sound, spoken);
        self.lines.insert(name, vec![line]);
    }

    /// Replaces the file: one line a mouth, in the order of their paths.
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

    /// What the record calls a Lipz file: its path below the folder of the record, with `/`.
    pub(crate) fn name(&self, lipz_file: &Path) -> String {
        let folder = self.path.parent().unwrap_or(Path::new(""));
        shown(lipz_file.strip_prefix(folder).unwrap_or(lipz_file))
    }
}

/// The file: one line a mouth, in the order of their paths.
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

    const MADE: Made = Made { sound: 1, text: 2, settings: 3, mouth: u64::MAX };
    const A: Line = Line { made: MADE, words: None, original: None, is_corrected: false, differences: None };

    fn b() -> Line {
        let words = Some("0badcafe:0-3@40-250,4-9@300-410?".parse().unwrap());
        let differences = Some("0badcafe:4-9@300-410".parse().unwrap());
        let original = Some(OriginalThen { sound: 10, text: 11 });
        Line { made: Made { mouth: 0, ..MADE }, words, original, is_corrected: true, differences }
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
            "{zeros}1 {zeros}2 {zeros}3 {zeros}0 dub-of:{zeros}a,{zeros}b from:textgrid differs:0badcafe:4-9@300-410 said:0badcafe:0-3@40-250,4-9@300-410? a/x.lipz\n{zeros}1 {zeros}2 {zeros}3 ffffffffffffffff b c.lipz\n"
        );
        assert_eq!(text.strip_prefix(HEAD), Some(expected.as_str()));
    }

    #[test]
    fn what_a_recording_says_is_what_was_accepted_or_else_what_its_mouth_was_made_from() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(RECORD_NAME);
        let file = folder.path().join("x.lipz");
        let mut record = SyncRecord::read(&path).unwrap();
        let (made, of_dub) = (Spoken::from(&A), Spoken { sound: 1, text: 9, original: b().original });
        assert_eq!(record.spoken_for(&file, 1), []);
        record.append(&file, &A, &[of_dub]).unwrap();
        record = SyncRecord::read(&path).unwrap();
        assert_eq!((record.spoken_for(&file, 1), record.spoken_for(&file, 2)), (vec![of_dub], vec![]));
        record.accept(&file, Spoken { sound: 5, ..of_dub });
        let other = Spoken { sound: 5, ..of_dub };
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
            assert_eq!(Spoken::parse(&damaged), None, "{damaged}");
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
        assert_eq!(&report.source.text[span.range()], "\u{fffd}\u{fffd} nothing", "the place in what is shown");
        for at in 0..conflict.len() {
            fs::write(&path, &conflict[..at]).unwrap();
            let _ = SyncRecord::read(&path); // no panic
        }
    }

    #[test]
    fn damaged_fields_say_nothing() {
        let whole = b().written("x.lipz");
        assert!(Line::parse(&whole).is_some());
        for (field, damaged) in [("said:0badcafe:", "said:0badcafe"), ("dub-of:0", "dub-of:x"), (" x.lipz", "")] {
            assert_eq!(Line::parse(&whole.replace(field, damaged)), None, "{damaged}");
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
