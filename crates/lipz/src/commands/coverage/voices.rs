//! How much of a dialogue is dubbed in each voice.

use super::voice_documents;
use crate::Outcome;
use crate::console::{counted, grouped};
use crate::reporter::{Abort, Ended, Reporter};
use crate::shared::locales::locale_name;
use lipz_compiler::VoiceCoverage;
use lipz_diagnostics::{Code, Report, escape};
use lipz_file::locale::canonical_tag;
use std::fmt::Write;

/// How the answer looks.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Look {
    /// For people.
    Table,
    Json,
    Csv,
    Html,
}

/// Prints the voices of a bank, or the lines that are `missing` in one of them.
pub(super) fn run(
    found: &[VoiceCoverage],
    name: &str,
    missing: Option<&str>,
    look: Look,
    reporter: &mut Reporter,
) -> Ended {
    if found.is_empty() && (look != Look::Json || missing.is_some()) {
        let help = "name the voices and their keys in lipz.toml: [voices] de-de = \"de/{key}\"";
        return Err(reporter.fail(Report::failure(
            name,
            Code::NoSuchLocale,
            "no clip of the bank is a dub".to_owned(),
            help,
        )));
    }
    let missing = missing.map(|tag| choose_voice(tag, name, found)).transpose();
    match missing.map_err(|report| reporter.fail(report))? {
        Some(voice) => print_lines(voice, found, look, reporter)?,
        None => match look {
            Look::Json => reporter.print_json(&found)?,
            Look::Csv => reporter.print_bytes(&voice_documents::csv(found))?,
            Look::Html => reporter.print(&voice_documents::page(found, name))?,
            Look::Table => reporter.print(&format!("{name}{}", table(found)))?,
        },
    }
    Ok(Outcome::Clean)
}

/// The lines that a voice does not have.
fn print_lines(
    voice: &VoiceCoverage,
    found: &[VoiceCoverage],
    look: Look,
    reporter: &mut Reporter,
) -> Result<(), Abort> {
    let lines = voice_documents::lines(voice, found);
    if lines.is_empty() {
        reporter.remark("no line is missing\n");
    }
    match look {
        Look::Json => reporter.print_json(&lines),
        Look::Csv => reporter.print_bytes(&voice_documents::csv_of_lines(&lines)),
        _ => {
            let keys = lines.iter().flat_map(|line| [escape::text(line.key), "\n".into()]);
            reporter.print(&keys.collect::<String>())
        }
    }
}

/// The voice with this tag; if there is none, the report names those that there are.
fn choose_voice<'v>(asked: &str, name: &str, found: &'v [VoiceCoverage]) -> Result<&'v VoiceCoverage, Report> {
    let canonical = canonical_tag(asked, true);
    let wanted = canonical.as_deref().unwrap_or(asked);
    found.iter().find(|voice| voice.tag == wanted).ok_or_else(|| {
        let tags: Vec<_> = found.iter().map(|voice| escape::text(&voice.tag)).collect();
        let help = format!(
            "there are {}; [voices] in lipz.toml names others: {wanted} = \"{wanted}/{{key}}\"",
            tags.join(", ")
        );
        let message = format!("no voice is {}", escape::quoted(asked));
        Report::failure(name, Code::NoSuchLocale, message, &help)
    })
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
