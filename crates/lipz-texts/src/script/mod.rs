//! Recording scripts for studios: the lines of each character, with direction, lengths and columns for takes.

mod cues;
mod page;
mod table;
#[cfg(feature = "xlsx")]
mod workbook;

pub use cues::CharacterCues;

use crate::exchange::Unit;
use std::ops::RangeInclusive;

/// The lines that one voice records, ordered by character and key.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct RecordingScript {
    /// The name of the project.
    pub title: String,
    /// The locale of the source texts.
    pub source_locale: String,
    /// The spoken locale; `None` for recordings of the source texts.
    pub locale: Option<String>,
    /// The lines.
    pub lines: Vec<ScriptLine>,
}

/// A line of a recording script: a clip.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct ScriptLine {
    /// The texts, with the translation into the spoken locale, if the script has one.
    pub unit: Unit,
    /// The names of the characters who speak the line, separated by `, `; empty if they are unknown.
    pub character: String,
    /// The session of the character in which the line is recorded, from 1.
    pub session: usize,
    /// The length of the original, in microseconds, if it is known.
    pub original_us: Option<u64>,
    /// The sync status: `lip-sync`; empty for an original.
    pub sync_status: String,
    /// The allowed lengths of the recording, in microseconds; `None` for any length.
    pub allowed_us: Option<RangeInclusive<u64>>,
    /// The path of the recording.
    pub recording: String,
    /// The reason to record the line (again); `None` if its recording is current.
    pub reason: Option<String>,
}

impl ScriptLine {
    /// Returns the scene, which is the folder of the key; empty for a key without a folder.
    pub fn scene(&self) -> &str {
        self.unit.key.rsplit_once('/').map_or("", |(folder, _)| folder)
    }

    /// Returns the number of words to speak, in the spoken locale.
    pub fn word_count(&self) -> usize {
        self.spoken().map(crate::exchange::words).sum()
    }

    /// Returns the spoken text of each segment, with `{meta}`.
    fn spoken(&self) -> impl Iterator<Item = &str> {
        let sources = self.unit.segments.iter().map(|segment| segment.source.as_str());
        let translated = self.unit.translations.first().map(|translation| translation.texts.iter().map(String::as_str));
        let has_translation = translated.is_some();
        translated.into_iter().flatten().chain(sources.filter(move |_| !has_translation))
    }
}

impl RecordingScript {
    /// Sorts the lines by character, scene and key, and numbers the sessions of each character, each with at most
    /// `lines_per_session` lines.
    pub fn arrange(&mut self, lines_per_session: Option<usize>) {
        self.lines
            .sort_by_cached_key(|line| (line.character.to_lowercase(), line.scene().to_owned(), line.unit.key.clone()));
        let mut character = None;
        let mut count = 0;
        for line in &mut self.lines {
            if character.as_ref() != Some(&line.character) {
                (character, count) = (Some(line.character.clone()), 0);
            }
            line.session = lines_per_session.map_or(1, |most| count / most.max(1) + 1);
            count += 1;
        }
    }
}

/// Returns microseconds as seconds with two decimals, as in a script.
fn seconds(us: u64) -> String {
    hundredths((us + 5_000) / 10_000)
}

/// Returns a range of lengths that is inside the allowed one: `1.90 to 2.10`.
fn seconds_within(range: &RangeInclusive<u64>) -> String {
    let [start, end] = [range.start().div_ceil(10_000), range.end() / 10_000];
    if start < end {
        return format!("{} to {}", hundredths(start), hundredths(end));
    }
    // Hundredths are too coarse for a short line.
    let thousandths = |us: u64| format!("{}.{:03}", us / 1_000_000, us / 1000 % 1000);
    format!("{} to {}", thousandths(range.start().next_multiple_of(1000)), thousandths(*range.end()))
}

fn hundredths(count: u64) -> String {
    format!("{}.{:02}", count / 100, count % 100)
}
