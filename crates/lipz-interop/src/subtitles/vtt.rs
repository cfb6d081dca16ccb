//! WebVTT (W3C Recommendation track): `WEBVTT`, then blocks. The reader follows the section "WebVTT file parsing", so
//! that it finds the cues that players show.

use super::body::Body;
use super::{Cue, markup, timing};
use crate::source::Line;
use lipz_diagnostics::{Code, Diagnostic, Severity};
use lipz_file::text::is_white_space;
use std::fmt::Write;

const SIGNATURE: &str = "WEBVTT";
/// The first words of blocks other than cues.
const OTHER_BLOCKS: [&str; 3] = ["NOTE", "STYLE", "REGION"];

pub(super) fn read(text: &str, diagnostics: &mut Vec<Diagnostic>) -> Vec<Cue> {
    let lines = lines(text);
    let first = lines.first().copied().unwrap_or(Line { text: "", at: 0 });
    if !starts_with(first.text, SIGNATURE) {
        diagnostics.push(
            first
                .diagnostic(Code::SubtitleSyntax, "the file does not start with `WEBVTT`")
                .help("check the format; read SubRip files as srt"),
        );
        return Vec::new();
    }
    let mut cues = Vec::new();
    for block in blocks(&lines) {
        let Some(times) = block.times else {
            let is_other = |line: &&Line<'_>| OTHER_BLOCKS.iter().any(|word| starts_with(line.text, word));
            diagnostics.extend(block.lines.first().filter(|line| !is_other(line)).map(|line| {
                let message = "the line does not belong to a cue because it has no times above it";
                skipped(line.diagnostic(Code::SubtitleSyntax, message)).help(
                    "write the times, such as 00:01.000 --> 00:02.500, then the lines; end the cue with an empty line",
                )
            }));
            continue;
        };
        let mut own = Vec::new();
        let cue = timing::cue(times, &mut own);
        diagnostics.extend(own.into_iter().map(skipped));
        let Some(cue) = cue else { continue };
        let text = super::read_text(&Body::new(&block.lines), markup::from_vtt, diagnostics);
        cues.push(Cue { text: text.replace('\0', "\u{fffd}"), ..cue });
    }
    cues
}

/// Returns the diagnostic for a block that players skip. The rest of the file is imported.
fn skipped(mut diagnostic: Diagnostic) -> Diagnostic {
    diagnostic.severity = Severity::Warning;
    diagnostic.note("players skip this block of a WebVTT file, and so does lipz")
}

/// Whether a line is this word, alone or with a space or tab after it.
fn starts_with(line: &str, word: &str) -> bool {
    line.strip_prefix(word).is_some_and(|rest| rest.is_empty() || rest.starts_with([' ', '\t']))
}

/// Returns the lines of a file. CR, LF and both together end a line.
fn lines(text: &str) -> Vec<Line<'_>> {
    let mut at = 0;
    let mut lines = Vec::new();
    for line in text.split_inclusive(['\r', '\n']) {
        let is_end_of_crlf = line == "\n" && text.get(..at).is_some_and(|before| before.ends_with('\r'));
        if !is_end_of_crlf {
            lines.push(Line { text: line.trim_end_matches(['\r', '\n']), at });
        }
        at += line.len();
    }
    lines
}

/// A block of a file.
struct Block<'t> {
    /// The line with the times of a cue.
    times: Option<Line<'t>>,
    /// The lines after the times; without times, all lines.
    lines: Vec<Line<'t>>,
}

/// Returns the blocks after the header. An empty line ends a block, and so does a line with an arrow after the times.
/// A line of spaces does not end a cue (automatic captions contain such lines), and is dropped.
fn blocks<'t>(lines: &[Line<'t>]) -> Vec<Block<'t>> {
    let is_arrow = |line: &Line<'_>| line.text.contains(timing::ARROW);
    let ends_header = |line: &Line<'_>| line.text.is_empty() || is_arrow(line);
    let mut rest = lines.get(1..).unwrap_or_default();
    rest = rest.get(rest.iter().position(ends_header).unwrap_or(rest.len())..).unwrap_or_default();
    let mut blocks = Vec::new();
    while let Some(start) = rest.iter().position(|line| !line.text.is_empty()) {
        rest = rest.get(start..).unwrap_or_default();
        // The times are in the first line, or in the second one below an identifier.
        let times = rest.iter().take(2).take_while(|line| !line.text.is_empty()).position(is_arrow);
        let is_end = |(at, line): (usize, &Line<'_>)| line.text.is_empty() || (is_arrow(line) && Some(at) != times);
        let end = rest.iter().enumerate().position(is_end).unwrap_or(rest.len());
        let (block, after) = rest.split_at(end);
        let body = block.get(times.map_or(0, |at| at + 1)..).unwrap_or_default();
        let shown = body.iter().copied().filter(|line| !line.text.chars().all(is_white_space)).collect();
        let block = Block { times: times.and_then(|at| block.get(at).copied()), lines: shown };
        if block.times.is_some() || !block.lines.is_empty() {
            blocks.push(block);
        }
        rest = after;
    }
    blocks
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

#[cfg(test)]
mod tests {
    use super::*;

    fn cues(file: &str) -> (Vec<(u64, String)>, Vec<String>) {
        let mut diagnostics = Vec::new();
        let cues = read(file, &mut diagnostics).into_iter().map(|cue| (cue.start_ms / 1000, cue.text)).collect();
        assert!(diagnostics.iter().all(|diagnostic| diagnostic.severity == Severity::Warning), "{diagnostics:?}");
        (cues, diagnostics.into_iter().map(|diagnostic| diagnostic.message).collect())
    }

    /// The steps of the standard's parser, each with a file that needs it.
    #[test]
    fn cues_are_those_of_the_standard() {
        let (one, two) = ("00:01.000 --> 00:02.000", "00:02.000 --> 00:03.000");
        for (file, expected) in [
            (format!("WEBVTT\n\n{one}\nOne\n{two}\nTwo\n"), vec![(1, "One"), (2, "Two")]),
            (format!("WEBVTT\n\n{one}\nOne\n \n{two}\nTwo\n"), vec![(1, "One"), (2, "Two")]),
            (format!("WEBVTT\n{one}\nOne"), vec![(1, "One")]),
            (format!("WEBVTT\nKind: captions\n{one}\nOne\n"), vec![(1, "One")]),
            (format!("WEBVTT a title\r\rid\r{one}align:start\rOne\r"), vec![(1, "One")]),
            (format!("WEBVTT\r\n\r\n{one}\r\nOne\rand one\n\r\n{two}\r\nTwo"), vec![(1, "One\nand one"), (2, "Two")]),
            (format!("WEBVTT\n\nNOTE\n{one}\nOne\n"), vec![(1, "One")]),
            (format!("WEBVTT\n\nNOTE a\nb\n\nSTYLE\n::cue {{}}\n\nREGION\nid:a\n\n{one}\nOne"), vec![(1, "One")]),
            (format!("WEBVTT\n\n{one}\n{two}\nTwo"), vec![(1, ""), (2, "Two")]),
            (format!("WEBVTT\n\n{one}\n\n\n\n{two}\nTwo\0"), vec![(1, ""), (2, "Two\u{fffd}")]),
        ] {
            let expected: Vec<_> = expected.into_iter().map(|(start, text)| (start, text.to_owned())).collect();
            assert_eq!(cues(&file), (expected, Vec::new()), "{file:?}");
        }
    }

    #[test]
    fn skipped_blocks_are_told() {
        let (one, two) = ("00:01.000 --> 00:02.000", "00:02.000 --> 00:03.000");
        let no_time = "this is not the time of a cue";
        let no_cue = "the line does not belong to a cue because it has no times above it";
        for (file, messages) in [
            (format!("WEBVTT\n\na --> b\n{one}\nOne"), vec![no_time, no_time]),
            (format!("WEBVTT\n\n{one}\nOne\na --> b\nlost\n"), vec![no_time, no_time]),
            (format!("WEBVTT\n\n{one}\nOne\n\nlost\n"), vec![no_cue]),
            (format!("WEBVTT\n\nlost\nlost\n{one}\nOne\n"), vec![no_cue]),
            (format!("WEBVTT\n\n-{two}\nlost\n\n{one}\nOne\n"), vec![no_time]),
            (
                format!("WEBVTT\n\n00:03.000 --> 00:02.000\nlost\n\n{one}\nOne\n"),
                vec!["the subtitle ends before it starts"],
            ),
        ] {
            let messages: Vec<_> = messages.into_iter().map(str::to_owned).collect();
            assert_eq!(cues(&file), (vec![(1, "One".to_owned())], messages), "{file:?}");
        }
    }
}
