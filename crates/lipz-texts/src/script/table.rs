//! The script as a table, whose rows `lipz import texts` and `lipz import recordings` read.

use super::{RecordingScript, ScriptLine, seconds, seconds_within};
use crate::exchange::Mark;
use crate::exchange::model::joined;
use crate::formats::csv::{COMMENT, LOCK, TAKE};
use crate::progress::csv_table;
use lipz_file::text::{meta, speakers};

/// The columns before the texts.
pub(super) const HEAD: [&str; 10] = [
    "line",
    "key",
    "session",
    "speaker",
    "scene",
    "direction",
    "sync status",
    "original seconds",
    "allowed seconds",
    "to record",
];

impl RecordingScript {
    /// Returns the script as a CSV file (RFC 4180) with a row for each line.
    pub fn csv(&self) -> Vec<u8> {
        csv_table(self.rows())
    }

    /// Returns the rows of the table. The first has the names of the columns.
    pub(super) fn rows(&self) -> Vec<Vec<String>> {
        let own = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
        let locale = self.locale.as_deref();
        let after = locale.map_or_else(Vec::new, |locale| {
            vec![format!("{COMMENT} {locale}"), format!("{LOCK} {locale}"), format!("{LOCK} {COMMENT} {locale}")]
        });
        let texts = [vec![self.source_locale.clone()], locale.map(str::to_owned).into_iter().collect()].concat();
        let header = [own(&HEAD), texts, own(&["recording", TAKE]), after].concat();
        let rows = (1..).zip(&self.lines).map(|(number, line)| line.row(number));
        std::iter::once(header).chain(rows).collect()
    }
}

impl ScriptLine {
    fn row(&self, number: usize) -> Vec<String> {
        let mut cells = vec![
            number.to_string(),
            self.unit.key.clone(),
            self.session.to_string(),
            self.character.clone(),
            self.scene().to_owned(),
            self.direction(),
            self.sync_status.clone(),
            self.original_us.map(seconds).unwrap_or_default(),
            self.allowed(),
            self.reason.clone().unwrap_or_default(),
            self.source(),
        ];
        let translation = self.unit.translations.first();
        cells.extend(translation.map(|translation| joined(&translation.texts)));
        cells.extend([self.recording.clone(), String::new()]);
        if let Some(translation) = translation {
            let mark = Mark::of(&joined(&translation.texts)).to_string();
            let comments = Mark::of_comments(&translation.comments).to_string();
            cells.extend([translation.comments.join("\n"), mark, comments]);
        }
        cells
    }

    /// Returns the source text, with `|` between segments.
    pub(super) fn source(&self) -> String {
        joined(&self.unit.segments.iter().map(|segment| segment.source.as_str()).collect::<Vec<_>>())
    }

    /// Returns the allowed lengths in seconds: `1.90 to 2.10`; empty for any length.
    pub(super) fn allowed(&self) -> String {
        self.allowed_us.as_ref().map(seconds_within).unwrap_or_default()
    }

    /// Returns directions for the actor: the events, the `{meta}` of the source text, and the note.
    pub(super) fn direction(&self) -> String {
        let mut parts: Vec<String> = Vec::new();
        for segment in &self.unit.segments {
            parts.extend(segment.events.clone());
            let source = segment.source.as_str();
            for range in meta(source) {
                let meta = source.get(range).unwrap_or_default();
                if speakers(meta).next().is_none() {
                    parts.push(meta.trim_matches(['{', '}']).trim().to_owned());
                }
            }
        }
        parts.extend(self.unit.note.clone());
        parts.dedup();
        parts.join("; ")
    }
}
