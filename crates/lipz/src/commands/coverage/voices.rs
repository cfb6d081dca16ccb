//! The dubbed share of a dialogue in each voice.

use super::voice_documents;
use crate::Outcome;
use crate::console::{counted, grouped};
use crate::reporter::{Abort, CommandResult, Reporter};
use crate::shared::locales::locale_name;
use lipz_compiler::VoiceCoverage;
use lipz_diagnostics::{Code, Report, escape};
use lipz_file::locale::canonical_tag;
use std::fmt::Write;

/// The format of the output.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Look {
    /// A table for people.
    Table,
    Json,
    Csv,
    Html,
}

/// Prints the voices of a bank, or the lines that one of them lacks, if `missing` names it.
pub(super) fn run(
    found: &[VoiceCoverage],
    name: &str,
    missing: Option<&str>,
    look: Look,
    reporter: &mut Reporter,
) -> CommandResult {
    if found.is_empty() && (look != Look::Json || missing.is_some()) {
        let help = "add the voices and their keys to [voices] of lipz.toml, such as de-de = \"de/{key}\"";
        return Err(reporter.fail(Report::failure(
            name,
            Code::NoSuchLocale,
            "the bank does not contain dubs".to_owned(),
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

/// Prints the lines that a voice lacks.
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

/// Returns the voice with this tag, or a report with the available tags.
fn choose_voice<'v>(asked: &str, name: &str, found: &'v [VoiceCoverage]) -> Result<&'v VoiceCoverage, Report> {
    let canonical = canonical_tag(asked, true);
    let wanted = canonical.as_deref().unwrap_or(asked);
    found.iter().find(|voice| voice.tag == wanted).ok_or_else(|| {
        let tags: Vec<_> = found.iter().map(|voice| escape::text(&voice.tag)).collect();
        let help = format!(
            "choose one of {}, or add {wanted} = \"{wanted}/{{key}}\" to [voices] of lipz.toml",
            tags.join(", ")
        );
        let message = format!("the bank has no voice {}", escape::quoted(asked));
        Report::failure(name, Code::NoSuchLocale, message, &help)
    })
}

/// Returns the voices, one per line, or an empty string for a bank without dubs.
pub(super) fn table(found: &[VoiceCoverage]) -> String {
    let Some(first) = found.first() else { return String::new() };
    let mut text = format!("\n{} with visemes\n\n", counted(first.lines, "line"));
    let _ = writeln!(
        text,
        "  {:<12} {:>9} {:>7} {:>11} {:>8} {:>11}  other voices",
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
    text.push_str("\nmissing: the original plays; other voices: their dub plays\n");
    text
}
