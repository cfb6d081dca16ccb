//! WebVTT (W3C Recommendation track): `WEBVTT`, then blocks between empty lines.

use super::{Cue, markup, timing};
use lipz_diagnostics::{Code, Diagnostic, Span};
use std::fmt::Write;

const SIGNATURE: &str = "WEBVTT";
/// The first words of blocks other than cues.
const OTHER_BLOCKS: [&str; 3] = ["NOTE", "STYLE", "REGION"];

pub(super) fn read(text: &str, diagnostics: &mut Vec<Diagnostic>) -> Vec<Cue> {
    let starts_with = |line: &str, word: &str| {
        line.strip_prefix(word).is_some_and(|rest| rest.is_empty() || rest.starts_with([' ', '\t']))
    };
    let first = text.lines().next().unwrap_or_default();
    if !starts_with(first, SIGNATURE) {
        diagnostics.push(
            Diagnostic::at(Code::SubtitleSyntax, Span::new(0, first.len()), "the file does not start with `WEBVTT`")
                .help("check the format; read SubRip files as srt"),
        );
        return Vec::new();
    }
    let mut cues = Vec::new();
    // Text directly after the signature belongs to the header.
    for block in timing::vtt_blocks(text).iter().skip(1) {
        let is_other = |line: &&str| OTHER_BLOCKS.iter().any(|word| starts_with(line, word));
        if block.first().map(|line| line.text).filter(is_other).is_some() {
            continue;
        }
        let Some((cue, body)) = timing::cue(block, diagnostics) else { continue };
        let text = super::read_text(&body, markup::from_vtt, diagnostics);
        cues.push(Cue { text, ..cue });
    }
    cues
}

pub(super) fn write(cues: &[Cue], diagnostics: &mut Vec<Diagnostic>) -> String {
    let mut file = format!("{SIGNATURE}\n");
    for cue in cues {
        let (start, end) = (timing::timestamp(cue.start_ms, '.'), timing::timestamp(cue.end_ms, '.'));
        let text = markup::to_vtt(&cue.text);
        diagnostics.extend(super::changed(cue, &text, markup::from_vtt));
        let _ = writeln!(file, "\n{start} {} {end}\n{text}", timing::ARROW);
    }
    file
}
