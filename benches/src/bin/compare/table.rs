//! Measurements as a Markdown table.

use crate::contest::Ask;
use std::fmt::Write;

/// The measurements of a rival.
pub(crate) struct Row {
    pub(crate) name: &'static str,
    pub(crate) file_bytes: usize,
    pub(crate) heap_bytes: usize,
    /// Nanoseconds or instructions for each of [`Ask::ALL`].
    pub(crate) costs: Vec<f64>,
    /// Allocations per query, the most of any kind.
    pub(crate) allocations: f64,
}

/// Returns the table of times.
pub(crate) fn times(rows: &[Row]) -> String {
    let mut table = String::from(
        "| | file MB | open | validate | heap MB | find ns | miss ns | frame ns | segment + text ns | event ns | tick ns | latency ns | allocations |\n\
         |---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n",
    );
    for row in rows {
        let cost = |ask: Ask| row.costs[ask as usize];
        // Writing to a string does not fail.
        let _ = writeln!(
            table,
            "| {} | {} | {} | {} | {} | {:.1} | {:.1} | {:.1} | {:.1} | {:.1} | {:.2} | {:.1} | {:.0} |",
            row.name,
            megabytes(row.file_bytes),
            duration(cost(Ask::Open)),
            duration(cost(Ask::Validate)),
            megabytes(row.heap_bytes),
            cost(Ask::Find),
            cost(Ask::Miss),
            cost(Ask::Frame),
            cost(Ask::Text),
            cost(Ask::Event),
            cost(Ask::Tick),
            cost(Ask::Latency),
            row.allocations,
        );
    }
    table
}

/// Returns the table of instructions.
pub(crate) fn instructions(rows: &[Row]) -> String {
    let mut table = String::from(
        "| | open | validate | find | miss | frame | segment + text | event | tick | one by one |\n\
         |---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n",
    );
    for row in rows {
        let _ = write!(table, "| {} ", row.name);
        for ask in Ask::ALL {
            let _ = write!(table, "| {} ", count(row.costs[ask as usize]));
        }
        table.push_str("|\n");
    }
    table
}

fn megabytes(bytes: usize) -> String {
    if bytes < 1000 { "0".to_owned() } else { format!("{:.2}", bytes as f64 / 1e6) }
}

fn count(instructions: f64) -> String {
    if instructions < 1e5 { format!("{instructions:.0}") } else { format!("{:.2} M", instructions / 1e6) }
}

fn duration(ns: f64) -> String {
    match ns {
        ..1e3 => format!("{ns:.0} ns"),
        ..1e6 => format!("{:.1} µs", ns / 1e3),
        _ => format!("{:.1} ms", ns / 1e6),
    }
}
