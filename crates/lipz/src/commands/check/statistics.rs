//! `lipz check --show stats`: the number of reports of each rule, for projects with many diagnostics.

use crate::Abort;
use crate::console::grouped;
use crate::reporter::Reporter;
use lipz_diagnostics::Report;
use lipz_diagnostics::reports::{Frequency, frequencies};
use serde::Serialize;
use std::fmt::Write;

/// A rule in the JSON document.
#[derive(Serialize)]
struct RuleRow {
    code: &'static str,
    name: &'static str,
    severity: String,
    count: usize,
    fixable: usize,
}

impl From<Frequency> for RuleRow {
    fn from(frequency: Frequency) -> RuleRow {
        let Frequency { code, severity, count, fixable, .. } = frequency;
        RuleRow { code: code.number(), name: code.name(), severity: severity.to_string(), count, fixable }
    }
}

/// Prints a row for each rule with reports, the most frequent first.
pub(super) fn print(reports: &[Report], as_json: bool, reporter: &mut Reporter) -> Result<(), Abort> {
    let rows: Vec<RuleRow> = frequencies(reports).into_iter().map(RuleRow::from).collect();
    if as_json {
        return reporter.print_json(&rows);
    }
    reporter.print(&table(&rows))
}

fn table(rows: &[RuleRow]) -> String {
    if rows.is_empty() {
        return "no diagnostics\n".to_owned();
    }
    let width = rows.iter().map(|row| row.name.len()).max().unwrap_or_default();
    let mut text = format!("{:>9} {:>8}  {:<8}  {:<6}  name\n", "count", "fixable", "severity", "code");
    for RuleRow { code, name, severity, count, fixable } in rows {
        let (count, fixable) = (grouped(*count), grouped(*fixable));
        let _ = writeln!(text, "{count:>9} {fixable:>8}  {severity:<8}  {code}  {name:<width$}");
    }
    text.lines().flat_map(|line| [line.trim_end(), "\n"]).collect()
}
