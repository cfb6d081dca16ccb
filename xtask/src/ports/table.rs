//! The table of measurements of all readers.

use crate::Failure;
use std::fmt::{self, Display, Formatter};

/// The columns: the name of a measurement in the output of a program, the heading, and the divisor of its values.
const COLUMNS: [(&str, &str, f64); 6] = [
    ("viseme_ns", "viseme, ns", 1.0),
    ("viseme_bytes", "bytes", 1.0),
    ("tick_ns", "tick, ns", 1.0),
    ("tick_bytes", "bytes", 1.0),
    ("weights_ns", "35 weights, µs", 1000.0),
    ("weights_bytes", "bytes", 1.0),
];

/// A row for each reader, with a value for each column.
#[derive(Default, Debug)]
pub(super) struct Table(Vec<(String, [Option<f64>; COLUMNS.len()])>);

impl Table {
    /// Adds the measurements in the output of a program, and returns their number. Other lines, and measurements without
    /// a column, are skipped.
    pub(super) fn add(&mut self, output: &str) -> Result<usize, Failure> {
        let mut count = 0;
        for line in output.lines() {
            let Some(rest) = line.strip_prefix("bench ") else { continue };
            let [name, value, reader] = rest.splitn(3, ' ').collect::<Vec<_>>()[..] else {
                return Err(format!("`{line}` is not `bench NAME VALUE READER`"));
            };
            let value: f64 = value.parse().map_err(|error| format!("`{line}`: {error}"))?;
            let Some(column) = COLUMNS.iter().position(|column| column.0 == name) else { continue };
            self.row(reader)[column] = Some(value / COLUMNS[column].2);
            count += 1;
        }
        Ok(count)
    }

    /// Returns the row of a reader, which is new if necessary.
    fn row(&mut self, reader: &str) -> &mut [Option<f64>; COLUMNS.len()] {
        let index = self.0.iter().position(|row| row.0 == reader).unwrap_or(self.0.len());
        if index == self.0.len() {
            self.0.push((reader.to_owned(), [None; COLUMNS.len()]));
        }
        &mut self.0[index].1
    }
}

impl Display for Table {
    fn fmt(&self, out: &mut Formatter<'_>) -> fmt::Result {
        let headings: Vec<&str> = COLUMNS.iter().map(|column| column.1).collect();
        writeln!(out, "| reader | {} |", headings.join(" | "))?;
        writeln!(out, "| --- |{}", " --: |".repeat(COLUMNS.len()))?;
        for (reader, values) in &self.0 {
            let cells: Vec<String> = values.iter().map(|value| value.map_or("not measured".into(), cell)).collect();
            writeln!(out, "| {reader} | {} |", cells.join(" | "))?;
        }
        Ok(())
    }
}

/// Returns a value with two significant digits or more, and with separated thousands.
fn cell(value: f64) -> String {
    let decimals = if value == 0.0 || value >= 10.0 { 0 } else { 1 };
    let digits = format!("{value:.decimals$}");
    match digits.len() {
        4.. if decimals == 0 => format!("{},{}", &digits[..digits.len() - 3], &digits[digits.len() - 3..]),
        _ => digits,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn lines_become_rows_in_order() {
        let mut table = Table::default();
        let output = "cases: 526\nbench viseme_ns 31.24 C#\nbench weights_ns 305163.3 Lua 5.4\nbench open_ns 9 C#\n";
        assert_eq!(table.add(output).unwrap(), 2);
        assert_eq!(
            table.add("bench tick_ns 4171.6 C#\nbench tick_bytes 0 C#\nbench viseme_ns 2.21 Rust\n").unwrap(),
            3
        );
        let missing = "not measured | not measured";
        let expected = format!(
            "| reader | viseme, ns | bytes | tick, ns | bytes | 35 weights, µs | bytes |\n\
             | --- | --: | --: | --: | --: | --: | --: |\n\
             | C# | 31 | not measured | 4,172 | 0 | {missing} |\n\
             | Lua 5.4 | {missing} | {missing} | 305 | not measured |\n\
             | Rust | 2.2 | not measured | {missing} | {missing} |\n"
        );
        assert_eq!(table.to_string(), expected);
    }

    #[test]
    fn a_damaged_line_is_an_error() {
        for line in ["bench viseme_ns 31.2", "bench viseme_ns fast C#", "bench "] {
            assert!(Table::default().add(line).is_err(), "{line}");
        }
    }
}
