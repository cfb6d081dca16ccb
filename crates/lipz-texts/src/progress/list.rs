//! The list of untranslated segments, as a table.

use super::{LocaleWork, Progress};
use crate::exchange::words;
use crate::formats::csv::defused;
use csv::{Terminator, WriterBuilder};

impl LocaleWork {
    /// Returns the segments with the given progress, such as missing or stale ones, as a CSV file (RFC 4180), with a
    /// row for each segment and its source text. Cells are never formulas. With a cost per word, a column has the cost
    /// of the segment.
    pub fn csv(&self, is_meant: impl Fn(Progress) -> bool, cost_per_word: Option<f64>) -> Vec<u8> {
        let head = ["key", "segment", "locale", "state", "source", "translated from", "translation", "words", "match"];
        let cost_name = cost_per_word.map(|_| "cost".to_owned());
        let mut rows = vec![head.map(str::to_owned).into_iter().chain(cost_name).collect::<Vec<_>>()];
        let open = self.open.iter().zip(self.matches());
        for (open, found) in open.filter(|(open, _)| is_meant(open.progress())) {
            let count = words(&open.source);
            let cells = [
                open.key.clone(),
                open.number.map(|number| number.to_string()).unwrap_or_default(),
                self.locale.clone(),
                open.progress().name().to_owned(),
                open.source.clone(),
                open.made_from.clone().unwrap_or_default(),
                open.text.clone(),
                count.to_string(),
                found.name(),
            ];
            rows.push(cells.into_iter().chain(cost_per_word.map(|cost| cost_of(count, cost))).collect());
        }
        csv_table(rows)
    }
}

/// Returns a CSV file (RFC 4180) with these rows. Cells are never formulas.
pub fn csv_table(rows: impl IntoIterator<Item = Vec<String>>) -> Vec<u8> {
    let mut writer = WriterBuilder::new().terminator(Terminator::CRLF).from_writer(Vec::new());
    for row in rows {
        // Writing to memory cannot fail.
        let _ = writer.write_record(row.iter().map(|cell| defused(cell).into_owned().into_bytes()));
    }
    writer.into_inner().unwrap_or_default()
}

/// Returns the cost of words, with two decimals.
pub fn cost_of(words: usize, cost_per_word: f64) -> String {
    format!("{:.2}", words as f64 * cost_per_word)
}
