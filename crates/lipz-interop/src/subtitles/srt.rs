//! SubRip: a number, the times, the lines, an empty line. There is no specification; this is the form that players
//! read.

use super::{Cue, markup, timing};
use lipz_diagnostics::{Code, Diagnostic};
use std::fmt::Write;

/// The replacement for an arrow in a text, which players would read as a line with times.
const ARROW_IN_TEXT: &str = "\u{2192}";

pub(super) fn read(text: &str, diagnostics: &mut Vec<Diagnostic>) -> Vec<Cue> {
    let mut cues = Vec::new();
    for block in timing::srt_blocks(text, diagnostics) {
        let Some((cue, body)) = timing::cue(&block, diagnostics) else { continue };
        let text = super::read_text(&body, markup::from_srt, diagnostics);
        cues.push(Cue { text, ..cue });
    }
    cues
}

pub(super) fn write(cues: &[Cue], diagnostics: &mut Vec<Diagnostic>) -> String {
    let mut file = String::new();
    for (number, cue) in (1..).zip(cues) {
        let mut text = markup::to_plain(&cue.text);
        let told = diagnostics.len();
        if text.contains(timing::ARROW) {
            text = text.replace(timing::ARROW, ARROW_IN_TEXT);
            let arrow = timing::ARROW;
            diagnostics.push(loss(cue, format!("`{arrow}` in the text is written as `{ARROW_IN_TEXT}`")));
        }
        if markup::from_srt(&text).lost_tag.is_some() {
            diagnostics.push(loss(cue, "players read a part of the text as a tag".to_owned()));
        }
        if diagnostics.len() == told {
            diagnostics.extend(super::changed(cue, &text, markup::from_srt));
        }
        let (start, end) = (timing::timestamp(cue.start_ms, ','), timing::timestamp(cue.end_ms, ','));
        let _ = writeln!(file, "{number}\n{start} {} {end}\n{text}\n", timing::ARROW);
    }
    file
}

fn loss(cue: &Cue, message: String) -> Diagnostic {
    Diagnostic::at(Code::SubtitleLoss, cue.span, message).help("export WebVTT, which can store it")
}
