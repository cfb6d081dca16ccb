//! SubRip: a number, the times, the lines, an empty line. There is no specification; this is the form that players
//! read.

use super::body::Body;
use super::{Cue, markup, timing};
use crate::source::{self, Line};
use lipz_diagnostics::{Code, Diagnostic, escape};
use lipz_file::text::is_white_space;
use std::fmt::Write;

/// The replacement for an arrow in a text, which players would read as a line with times.
const ARROW_IN_TEXT: &str = "\u{2192}";

pub(super) fn read(text: &str, diagnostics: &mut Vec<Diagnostic>) -> Vec<Cue> {
    let mut cues = Vec::new();
    for block in divided(joined(text, diagnostics), diagnostics) {
        let Some(at) = block.iter().take(2).position(|line| line.text.contains(timing::ARROW)) else {
            diagnostics.extend(block.first().map(|line| without_times(*line)));
            continue;
        };
        let Some(cue) = block.get(at).and_then(|line| timing::cue(*line, diagnostics)) else { continue };
        let body = Body::new(block.get(at + 1..).unwrap_or_default());
        let text = super::read_text(&body, markup::from_srt, diagnostics);
        cues.push(Cue { text, ..cue });
    }
    cues
}

fn without_times(line: Line<'_>) -> Diagnostic {
    line.diagnostic(Code::SubtitleSyntax, "the line does not belong to a cue because it has no times above it").help(
        "write the times, such as 00:00:01,000 --> 00:00:02,500, then the lines; end the subtitle with an empty line",
    )
}

/// Returns the blocks of a file, which are separated by blank lines. A blank line inside a cue does not end it: blocks
/// without times are added to the cue before them, which is reported once.
fn joined<'t>(text: &'t str, diagnostics: &mut Vec<Diagnostic>) -> Vec<Vec<Line<'t>>> {
    let tries_times =
        |block: &[Line<'_>]| block.iter().take(2).any(|line| line.text.contains('>') && line.text.contains(':'));
    let has_times = |block: &[Line<'_>]| block.iter().take(2).any(|line| line.text.contains(timing::ARROW));
    let mut blocks: Vec<Vec<Line<'t>>> = Vec::new();
    let mut is_told = false;
    for block in blocks_between(text) {
        // Text above the first times does not belong to a cue.
        match blocks.last_mut().filter(|last| has_times(last)) {
            Some(last) if !has_times(&block) && !tries_times(&block) => {
                if let (Some(line), false) = (block.first(), is_told) {
                    is_told = true;
                    let message = "an empty line splits the subtitle, which continues here";
                    diagnostics.push(
                        line.diagnostic(Code::SubtitleText, message)
                            .note("the rest is read as a part of the subtitle above it; players may not show it")
                            .help("remove the empty line"),
                    );
                }
                last.extend(block);
            }
            _ => blocks.push(block),
        }
    }
    blocks
}

fn blocks_between(text: &str) -> Vec<Vec<Line<'_>>> {
    // The classic Mac OS ends lines with CR alone.
    let lines: Vec<Line<'_>> = match text.contains('\n') {
        true => source::lines(text).collect(),
        false => source::lines_of(text, '\r').collect(),
    };
    let is_blank = |line: &Line<'_>| line.text.chars().all(is_white_space);
    lines.split(is_blank).filter(|block| !block.is_empty()).map(<[_]>::to_vec).collect()
}

/// Divides blocks with the times of several cues, because many tools do not write the empty lines. The line above the
/// times is the number of a cue if it is a number, and the cue above it has one. The first division is reported.
fn divided<'t>(blocks: Vec<Vec<Line<'t>>>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Vec<Line<'t>>> {
    let mut cues = Vec::with_capacity(blocks.len());
    let mut is_told = false;
    for block in blocks {
        let mut times = (0..block.len()).filter(|&at| block.get(at).is_some_and(|line| timing::has_times(*line)));
        let Some(first) = times.next().filter(|first| *first < 2) else {
            cues.push(block);
            continue;
        };
        let is_number = |at: usize| {
            let line = block.get(at).map_or("", |line| line.text.trim());
            !line.is_empty() && line.bytes().all(|byte| byte.is_ascii_digit())
        };
        let (mut start, mut times_before, is_numbered) = (0, first, first == 1 && is_number(0));
        for at in times {
            let number = at.checked_sub(1).filter(|&number| is_numbered && number > times_before && is_number(number));
            let end = number.unwrap_or(at);
            if let (Some(line), false) = (block.get(end), is_told) {
                is_told = true;
                let message = "a subtitle starts here, without an empty line above it";
                diagnostics.push(line.diagnostic(Code::SubtitleText, message).help("insert an empty line above it"));
            }
            cues.push(block.get(start..end).unwrap_or_default().to_vec());
            (start, times_before) = (end, at);
        }
        cues.push(block.get(start..).unwrap_or_default().to_vec());
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
        if let Some(name) = markup::later_speaker(&cue.text) {
            let name = escape::quoted(name);
            diagnostics.push(loss(cue, format!("the subtitle does not show that {name} speaks a part of the text")));
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

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(file: &str) -> (Vec<String>, Vec<String>) {
        let mut diagnostics = Vec::new();
        let cues = read(file, &mut diagnostics);
        let messages = diagnostics.into_iter().map(|diagnostic| diagnostic.message).collect();
        (cues.into_iter().map(|cue| cue.text).collect(), messages)
    }

    #[test]
    fn times_start_a_cue_without_an_empty_line() {
        let (one, two, three) = ("00:01,0 --> 00:02,0", "00:02,0 --> 00:03,0", "00:03,0 --> 00:04,0");
        let told = vec!["a subtitle starts here, without an empty line above it".to_owned()];
        let of = |texts: &[&str]| texts.iter().map(|text| (*text).to_owned()).collect::<Vec<_>>();
        for (file, expected) in [
            (format!("1\n{one}\nOne\n2\n{two}\nTwo\n3\n{three}\nThree\n"), ["One", "Two", "Three"]),
            (format!("{one}\nOne\n{two}\nTwo\n{three}\nThree"), ["One", "Two", "Three"]),
            (format!("1\n{one}\n2\n{two}\nTwo\n3\n3\n{three}\n42\n"), ["", "Two\n3", "42"]),
            (format!("1\n{one}\n{two}\n3\n{three}\nThree"), ["", "", "Three"]),
            (format!("{one}\nOne\n2\n{two}\nTwo\n3\n{three}\nThree"), ["One\n2", "Two\n3", "Three"]),
            (format!("1\n{one}\nOne\n2\n{two}\nTwo\n\n3\n{three}\na --> b\n"), ["One", "Two", "a --> b"]),
        ] {
            assert_eq!(texts(&file), (of(&expected), told.clone()), "{file}");
        }
        let file = format!("1\n{one}\nOne\n2\n\n2\n{two}\nTwo\n");
        assert_eq!(texts(&file), (of(&["One\n2", "Two"]), Vec::new()));
    }
}
