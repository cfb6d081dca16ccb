//! How much of a dialogue is dubbed in each voice.

use crate::Outcome;
use crate::console::{counted, grouped};
use crate::reporter::{Ended, Reporter};
use crate::shared::locales::{choose, locale_name};
use lipz_bank::Bank;
use lipz_compiler::{VoiceCoverage, voice_coverage};
use lipz_diagnostics::{Code, Report, escape};
use std::fmt::Write;

/// Prints the voices of a bank, or the keys of the lines that are `missing` in one of them.
pub(super) fn run(bank: &Bank<'_>, name: &str, missing: Option<&str>, json: bool, reporter: &mut Reporter) -> Ended {
    let found = voice_coverage(bank);
    if found.is_empty() && !json {
        let help = "name the voices and their keys in lipz.toml: [voices] de-de = \"de/{key}\"";
        return Err(reporter.fail(Report::failure(
            name,
            Code::NoSuchLocale,
            "no clip of the bank is a dub".to_owned(),
            help,
        )));
    }
    match missing {
        Some(tag) => {
            let voice = choose(tag, name, found.iter(), |voice| &voice.tag).map_err(|report| reporter.fail(report))?;
            let mut keys: Vec<&String> = voice.other_voices.values().flatten().chain(&voice.missing).collect();
            keys.sort_unstable();
            reporter.print(&keys.into_iter().flat_map(|key| [escape::text(key), "\n".into()]).collect::<String>())?;
        }
        None if json => reporter.print_json(&found)?,
        None => reporter.print(&format!("{name}{}", table(&found)))?,
    }
    Ok(Outcome::Clean)
}

/// The voices, a line each; empty for a bank without dubs.
pub(super) fn table(found: &[VoiceCoverage]) -> String {
    let Some(first) = found.first() else { return String::new() };
    let mut text = format!("\n{} with a mouth\n\n", counted(first.lines, "line"));
    let _ = writeln!(
        text,
        "  {:<12} {:>9} {:>7} {:>11} {:>8} {:>11}  others",
        "voice", "dubbed", "lines", "time", "missing", "to record"
    );
    for voice in found {
        let mut others: Vec<String> = voice
            .other_voices
            .iter()
            .map(|(tag, keys)| format!("{} {}", locale_name(tag), grouped(keys.len())))
            .collect();
        if voice.is_original {
            others.insert(0, "(original)".to_owned());
        }
        let line = format!(
            "  {:<12} {:>7.1} % {:>7} {:>9.1} s {:>8} {:>9.1} s  {}",
            escape::text(&voice.tag),
            (voice.percent() * 10.0).floor() / 10.0,
            grouped(voice.dubbed),
            voice.dubbed_us as f64 / 1e6,
            grouped(voice.missing.len()),
            voice.to_record_us as f64 / 1e6,
            others.join(", ")
        );
        let _ = writeln!(text, "{}", line.trim_end());
    }
    text.push_str("\nmissing: the original is played; others: the dub in another voice is\n");
    text
}
