//! Arbitrary files as files of other tools.

use super::file::is_about;
use lipz_diagnostics::{Diagnostic, Severity};
use lipz_interop::fallout::heads::{check_file, read_list};
use lipz_interop::fallout::lip::Lip;
use lipz_interop::fallout::msg;
use lipz_interop::subtitles::{SubtitleFormat, SubtitleOptions, clip, join};
use lipz_interop::textgrid::TextGrid;
use lipz_interop::{DEFAULT_RATE, Format, ImportOptions, Segments, formats, import};

/// The formats after those of visemes. All further numbers select the last one.
const OTHERS: [&str; 5] = ["srt", "vtt", "frm", "msg", "lip"];

/// Returns the kind of file that the target selects for the first byte `number`. Seeds have these names.
pub fn kind_of_foreign(number: u8) -> &'static str {
    let number = usize::from(number);
    let other = || OTHERS[(number - formats::ALL.len()).min(OTHERS.len() - 1)];
    formats::ALL.get(number).map_or_else(other, |format| format.name)
}

/// The first byte selects a format, and the rest is a file of it.
pub fn foreign(bytes: &[u8]) {
    let Some((number, file)) = bytes.split_first() else { return };
    match kind_of_foreign(*number) {
        "srt" => subtitles(SubtitleFormat::Srt, file),
        "vtt" => subtitles(SubtitleFormat::Vtt, file),
        "frm" => drop(check_file("eldgf1.frm", file)),
        "msg" => texts(&String::from_utf8_lossy(file)),
        "lip" => lip(file),
        name => {
            formats::find(name).into_iter().for_each(|format| shapes(format, file));
            if name == "textgrid" {
                textgrid(file);
            }
        }
    }
}

pub(super) fn has_errors(found: &[Diagnostic]) -> bool {
    found.iter().any(|found| found.severity == Severity::Error)
}

/// Importing returns a Lipz file, or nothing if there are errors.
fn shapes(format: &Format, file: &[u8]) {
    for segments in [Segments::Phrases, Segments::Pauses, Segments::Sentences] {
        let options = ImportOptions::new().segments(segments).locale("en-us").min_hold(2);
        let imported = import(format, file, &options);
        assert!(imported.clips.is_empty() || !has_errors(&imported.diagnostics), "{}", format.name);
        for clip in imported.clips {
            let written = lipz_file::write(&clip.document);
            assert_eq!(lipz_file::parse(written.as_bytes()).document.as_ref(), Some(&clip.document), "{written}");
        }
    }
}

/// A TextGrid that is written and read again is unchanged, and its labels are in the file.
fn textgrid(file: &[u8]) {
    let mut found = Vec::new();
    let grid = TextGrid::read(file, &mut found);
    if let Ok(text) = std::str::from_utf8(lipz_file::without_byte_order_mark(file)) {
        found.iter().for_each(|found| is_about(found, text));
    }
    let Some(grid) = grid else { return assert!(has_errors(&found), "no TextGrid, and no reason") };
    let written = grid.write();
    let again = TextGrid::read(written.as_bytes(), &mut Vec::new()).map(|again| again.write());
    assert_eq!(again.as_ref(), Some(&written));
}

/// Cues refer to positions in the file, and are unchanged after writing and reading.
fn subtitles(format: SubtitleFormat, file: &[u8]) {
    let mut found = Vec::new();
    let cues = format.read(file, &mut found);
    if let Ok(text) = std::str::from_utf8(lipz_file::without_byte_order_mark(file)) {
        found.iter().for_each(|found| is_about(found, text));
    }
    let document = clip(&cues, "en-us", DEFAULT_RATE, &mut Vec::new());
    let joined = join(document.clone(), &cues, "en-us", &SubtitleOptions::default(), &mut Vec::new());
    assert_eq!(joined.string("visemes"), document.string("visemes"));
    let once = format.write(&cues, &mut Vec::new());
    let mut again = format.read(once.as_bytes(), &mut Vec::new());
    let times =
        |cues: &[lipz_interop::subtitles::Cue]| cues.iter().map(|cue| (cue.start_ms, cue.end_ms)).collect::<Vec<_>>();
    assert_eq!(times(&again), times(&cues), "{once}");
    again.retain(|cue| cue.text.contains('|'));
    assert!(again.is_empty(), "a text that would divide segments");
}

/// A LIP file is written exactly as it was read.
fn lip(file: &[u8]) {
    if let Ok(lip) = Lip::read(file) {
        assert_eq!(lip.write(), file);
        lip.oddities("eld_1");
    }
}

/// The scripts of a game, and the list of its talking heads.
fn texts(file: &str) {
    let (entries, found) = msg::read(file);
    found.iter().for_each(|found| is_about(found, file));
    msg::by_sound(&entries);
    let (_, found) = read_list(file);
    found.iter().for_each(|found| is_about(found, file));
}
