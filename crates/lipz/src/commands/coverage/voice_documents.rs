//! Coverage of voices for spreadsheets, programs and browsers.

use crate::console::{counted, grouped};
use lipz_compiler::VoiceCoverage;
use lipz_texts::{csv_table, html, html_page};
use serde::Serialize;
use std::fmt::Write;

/// The most lines per voice that the page lists. It counts the rest.
const SHOWN: usize = 500;

/// A line that a voice lacks.
#[derive(Serialize)]
pub(super) struct Line<'v> {
    /// The key of the original.
    pub(super) key: &'v str,
    voice: &'v str,
    /// The voice that plays instead.
    played: &'v str,
}

/// Returns the lines that a voice lacks, sorted by key.
pub(super) fn lines<'v>(voice: &'v VoiceCoverage, all: &'v [VoiceCoverage]) -> Vec<Line<'v>> {
    let original = all.iter().find(|voice| voice.is_original).map_or("", |voice| &voice.tag);
    let line = |played: &'v str| move |key: &'v String| Line { key, voice: &voice.tag, played };
    let others = voice.other_voices.iter().flat_map(|(other, keys)| keys.iter().map(line(other)));
    let mut lines: Vec<Line<'v>> = others.chain(voice.missing.iter().map(line(original))).collect();
    lines.sort_unstable_by_key(|line| line.key);
    lines
}

/// Returns a row for each line that a voice lacks.
pub(super) fn csv_of_lines(lines: &[Line<'_>]) -> Vec<u8> {
    let head = ["key", "voice", "played"];
    let rows = lines.iter().map(|line| [line.key, line.voice, line.played]);
    csv_table(std::iter::once(head).chain(rows).map(|row| row.map(str::to_owned).to_vec()))
}

/// Returns a row for each voice, with all numbers.
pub(super) fn csv(found: &[VoiceCoverage]) -> Vec<u8> {
    let head = [
        "voice",
        "lines",
        "dubbed",
        "dubbed percent",
        "dubbed seconds",
        "seconds of recordings",
        "in other voices",
        "missing",
        "seconds to record",
    ];
    let rows = found.iter().map(|voice| {
        let cells = [
            voice.tag.clone(),
            voice.lines.to_string(),
            voice.dubbed.to_string(),
            format!("{:.1}", percent(voice)),
            seconds(voice.dubbed_us),
            seconds(voice.recordings_us),
            others(voice).to_string(),
            voice.missing.len().to_string(),
            seconds(voice.to_record_us),
        ];
        cells.to_vec()
    });
    csv_table(std::iter::once(head.map(str::to_owned).to_vec()).chain(rows))
}

/// Returns a page for people.
pub(super) fn page(found: &[VoiceCoverage], name: &str) -> String {
    let lines_of_bank = found.first().map_or(0, |voice| voice.lines);
    let mut out = format!(
        "<p>{} with visemes.</p>\n<div class=\"wide\"><table>\n<caption>Lines by voice</caption>\n\
         <tr><th>voice</th><th class=\"bar\"></th><th class=\"n\">done</th><th class=\"n\">dubbed</th>\
         <th class=\"n\">other voices</th><th class=\"n\">missing</th><th class=\"n\">to record</th></tr>\n",
        counted(lines_of_bank, "line")
    );
    for voice in found {
        let tag = html(&voice.tag);
        let has_open = others(voice) + voice.missing.len() > 0;
        let linked = if has_open { format!("<a href=\"#{tag}\">{tag}</a>") } else { tag };
        let note = if voice.is_original { " (original)" } else { "" };
        let _ = writeln!(
            out,
            "<tr><th>{linked}{note}</th><td class=\"bar\"><span class=\"bar\" aria-hidden=\"true\"><i class=\"final\" \
             style=\"width:{:.2}%\"></i></span></td><td class=\"n\">{:.1} %</td><td class=\"n\">{}</td><td class=\"n\">{}</td>\
             <td class=\"n\">{}</td><td class=\"n\"><b>{} s</b></td></tr>",
            voice.percent(),
            percent(voice),
            grouped(voice.dubbed),
            grouped(others(voice)),
            grouped(voice.missing.len()),
            seconds(voice.to_record_us)
        );
    }
    out.push_str("</table></div>\n");
    found.iter().for_each(|voice| details(voice, found, &mut out));
    html_page(&format!("Dubs of {name}"), &out)
}

/// Adds the lines that a voice lacks.
fn details(voice: &VoiceCoverage, found: &[VoiceCoverage], out: &mut String) {
    let lines = lines(voice, found);
    if lines.is_empty() {
        return;
    }
    let tag = html(&voice.tag);
    let _ = writeln!(
        out,
        "<h2 id=\"{tag}\">{tag}</h2>\n<details open=\"\"><summary>{} to record</summary>\n<div class=\"wide\"><table>\n\
         <tr><th>clip</th><th>plays in</th></tr>",
        counted(lines.len(), "line")
    );
    for line in lines.iter().take(SHOWN) {
        let _ = writeln!(out, "<tr><td class=\"key\">{}</td><td>{}</td></tr>", html(line.key), html(line.played));
    }
    out.push_str("</table></div>\n");
    if let Some(rest) = lines.len().checked_sub(SHOWN).filter(|rest| *rest > 0) {
        let _ = writeln!(out, "<p>{} more are not shown.</p>", grouped(rest));
    }
    out.push_str("</details>\n");
}

/// Returns the number of lines that play in neither this voice nor the original's.
fn others(voice: &VoiceCoverage) -> usize {
    voice.other_voices.values().map(Vec::len).sum()
}

/// Returns the percentage, truncated to one decimal place.
fn percent(voice: &VoiceCoverage) -> f64 {
    (voice.percent() * 10.0).floor() / 10.0
}

fn seconds(time_us: u64) -> String {
    format!("{:.1}", time_us as f64 / 1e6)
}
