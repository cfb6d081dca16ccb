//! The measurements as one Markdown table.

use super::work::{Measurement, Work};
use std::fmt::Write;

/// The head of the table.
pub(super) fn start(locales: usize, threads: u16) -> String {
    format!(
        "{locales} locales, {threads} threads, page cache warm; medians of interleaved runs, each in a process of its own.\n\
         Times in round brackets are sums over the threads.\n\n\
         | clips | work | ms | × list, read | bank MB | peak MB | × bank |\n|--:|---|--:|--:|--:|--:|--:|\n"
    )
}

/// The rows for one number of clips.
pub(super) fn rows(clips: usize, json_bytes: u64, measured: &[(Work, Vec<Measurement>)]) -> String {
    let mut rows = String::new();
    let reading = measured.iter().find(|(work, _)| *work == Work::Read).map(|(_, all)| median(all).seconds);
    let mut row = |clips: &str, work: &str, seconds: f64, memory: &str| {
        let ratio = reading.map_or_else(String::new, |reading| format!("{:.2}", seconds / reading));
        // Writing to a string does not fail.
        let _ = writeln!(rows, "| {clips} | {work} | {:.1} | {ratio} | {memory} |", seconds * 1e3);
    };
    let mut first = format!("{clips} ({} MB)", megabytes(json_bytes));
    for (work, measurements) in measured {
        let median = median(measurements);
        row(&first, work.name(), median.seconds, &memory(&median));
        first.clear();
        if matches!(work, Work::Pack | Work::Again) {
            for (name, seconds) in &median.phases {
                row("", &format!("… {name}"), *seconds, " | | ");
            }
        }
    }
    rows
}

/// The cells of a measurement's memory: the bank, the peak, and how often the bank goes into it.
fn memory(measurement: &Measurement) -> String {
    let bank = measurement.bank_bytes.map_or_else(String::new, megabytes);
    let peak = measurement.peak_bytes.map_or_else(|| "not measured".to_owned(), megabytes);
    let both = measurement.peak_bytes.zip(measurement.bank_bytes);
    let ratio = both.map_or_else(String::new, |(peak, bank)| format!("{:.2}", peak as f64 / bank as f64));
    format!("{bank} | {peak} | {ratio}")
}

/// The run with the median time. The parts that are shown with it are its own, so that they add up.
fn median(measurements: &[Measurement]) -> Measurement {
    let mut sorted: Vec<&Measurement> = measurements.iter().collect();
    sorted.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    sorted.get(sorted.len() / 2).map_or_else(Measurement::default, |median| (*median).clone())
}

fn megabytes(bytes: u64) -> String {
    format!("{:.2}", bytes as f64 / 1e6)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_and_ratios() {
        let of = |seconds: &[f64]| {
            seconds.iter().map(|&seconds| Measurement { seconds, ..Measurement::default() }).collect::<Vec<_>>()
        };
        let mut pack = of(&[0.9, 0.2, 0.3]);
        pack[2] = Measurement {
            seconds: 0.3,
            phases: vec![("lower".into(), 0.05)],
            peak_bytes: Some(12_000_000),
            bank_bytes: Some(6_340_000),
        };
        let rows = rows(10_000, 7_140_000, &[(Work::Read, of(&[0.5, 0.1, 0.2])), (Work::Pack, pack)]);
        assert_eq!(
            rows,
            "| 10000 (7.14 MB) | list, read | 200.0 | 1.00 |  | not measured |  |\n\
             |  | **pack** | 300.0 | 1.50 | 6.34 | 12.00 | 1.89 |\n\
             |  | … lower | 50.0 | 0.25 |  | |  |\n"
        );
    }
}
