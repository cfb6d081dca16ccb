//! The measurements as one Markdown table.

use super::work::{Measurement, Work};
use std::fmt::Write;

/// Returns the head of the table.
pub(super) fn start(locales: usize, threads: u16) -> String {
    format!(
        "{locales} locales, {threads} threads, page cache warm; medians of interleaved runs, each in a process of its own.\n\
         Times in round brackets are sums over the threads.\n\n\
         | clips | work | ms | × list, read | processor ms | × list, read | bank MB | peak MB | × bank |\n\
         |--:|---|--:|--:|--:|--:|--:|--:|--:|\n"
    )
}

/// Returns the rows for one number of clips.
pub(super) fn rows(clips: usize, json_bytes: u64, measured: &[(Work, Vec<Measurement>)]) -> String {
    let mut rows = String::new();
    let read = measured.iter().find(|(work, _)| *work == Work::Read).map(|(_, all)| all.as_slice()).unwrap_or_default();
    let (reading, processor_reading) = (median(read).seconds, median_processor_seconds(read));
    let mut row = |clips: &str, work: &str, times: &str, memory: &str| {
        // Writing to a string does not fail.
        let _ = writeln!(rows, "| {clips} | {work} | {times} | {memory} |");
    };
    let mut first = format!("{clips} ({} MB)", megabytes(json_bytes));
    for (work, measurements) in measured {
        let median = median(measurements);
        let processor = median_processor_seconds(measurements);
        let times = format!("{} | {}", time(median.seconds, reading), time(processor, processor_reading));
        row(&first, work.name(), &times, &memory(&median));
        first.clear();
        if matches!(work, Work::Pack | Work::Again | Work::Watch) {
            for (name, seconds) in &median.phases {
                row("", &format!("… {name}"), &format!("{} |  | ", time(*seconds, reading)), " | | ");
            }
        }
    }
    rows
}

/// Returns the cells of a time: the time itself, and its ratio to that of reading.
fn time(seconds: f64, reading: f64) -> String {
    let ratio = if reading > 0.0 { format!("{:.2}", seconds / reading) } else { String::new() };
    format!("{:.1} | {ratio}", seconds * 1e3)
}

/// Returns the cells of a measurement's memory: the bank, the peak, and its ratio to the bank.
fn memory(measurement: &Measurement) -> String {
    let bank = measurement.bank_bytes.map_or_else(String::new, megabytes);
    let peak = measurement.peak_bytes.map_or_else(|| "not measured".to_owned(), megabytes);
    let both = measurement.peak_bytes.zip(measurement.bank_bytes);
    let ratio = both.map_or_else(String::new, |(peak, bank)| format!("{:.2}", peak as f64 / bank as f64));
    format!("{bank} | {peak} | {ratio}")
}

/// Returns the run with the median time. Its phases are from the same run, so that they add up.
fn median(measurements: &[Measurement]) -> Measurement {
    let mut sorted: Vec<&Measurement> = measurements.iter().collect();
    sorted.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    sorted.get(sorted.len() / 2).map_or_else(Measurement::default, |median| (*median).clone())
}

/// Returns the median of the processor times, which is rarely that of the median run, because processor times depend
/// less on the load.
fn median_processor_seconds(measurements: &[Measurement]) -> f64 {
    let mut sorted: Vec<f64> = measurements.iter().map(|measurement| measurement.processor_seconds).collect();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or_default()
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
            let of =
                |&seconds: &f64| Measurement { seconds, processor_seconds: 2.0 * seconds, ..Measurement::default() };
            seconds.iter().map(of).collect::<Vec<_>>()
        };
        let mut pack = of(&[0.9, 0.2, 0.3]);
        pack[2] = Measurement {
            seconds: 0.3,
            processor_seconds: 0.5,
            phases: vec![("lower".into(), 0.05)],
            peak_bytes: Some(12_000_000),
            bank_bytes: Some(6_340_000),
        };
        let rows = rows(10_000, 7_140_000, &[(Work::Read, of(&[0.5, 0.1, 0.2])), (Work::Pack, pack)]);
        assert_eq!(
            rows,
            "| 10000 (7.14 MB) | list, read | 200.0 | 1.00 | 400.0 | 1.00 |  | not measured |  |\n\
             |  | **pack** | 300.0 | 1.50 | 500.0 | 1.25 | 6.34 | 12.00 | 1.89 |\n\
             |  | … lower | 50.0 | 0.25 |  |  |  | |  |\n"
        );
    }
}
