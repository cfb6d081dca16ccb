//! `lipz check --statistics`: how often each rule has reported, for projects with many diagnostics.

use crate::Abort;
use crate::console::grouped;
use crate::reporter::Reporter;
use lipz_diagnostics::Report;
use lipz_diagnostics::reports::{Frequency, frequencies};
use serde::Serialize;
use std::fmt::Write;

/// A rule in the JSON document.
#[derive(Serialize)]
struct Row {
    code: &'static str,
    name: &'static str,
    severity: String,
    count: usize,
    fixable: usize,
}

impl From<Frequency> for Row {
    fn from(frequency: Frequency) -> Row {
        let Frequency { code, severity, count, fixable, .. } = frequency;
        Row { code: code.number(), name: code.name(), severity: severity.to_string(), count, fixable }
    }
}

/// Prints a row for each rule that has reported, the most frequent one first.
pub(super) fn print(reports: &[Report], as_json: bool, reporter: &mut Reporter) -> Result<(), Abort> {
    let rows: Vec<Row> = frequencies(reports).into_iter().map(Row::from).collect();
    if as_json {
        return reporter.print_json(&rows);
    }
    reporter.print(&table(&rows))
}

fn table(rows: &[Row]) -> String {
    if rows.is_empty() {
        return "no diagnostics\n".to_owned();
    }
    let width = rows.iter().map(|row| row.name.len()).max().unwrap_or_default();
    let mut text = format!("{:>9} {:>8}  {:<8}  {:<6}  name\n", "count", "fixable", "severity", "code");
    for Row { code, name, severity, count, fixable } in rows {
        let (count, fixable) = (grouped(*count), grouped(*fixable));
        let _ = writeln!(text, "{count:>9} {fixable:>8}  {severity:<8}  {code}  {name:<width$}");
    }
    text.lines().flat_map(|line| [line.trim_end(), "\n"]).collect()
}
