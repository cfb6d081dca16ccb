//! Pamela, `.pam`: the section `[Speech]` with lines `position:PHONEME`. A frame has 15 positions, and a second has 24
//! frames. Phonemes are those of the CMU dictionary, with a digit for the stress of vowels; `None` rests.

use super::Format;
use crate::{DEFAULT_RATE, ImportOptions, Shape, Time, Track, source};
use lipz_diagnostics::{Code, Diagnostic};
use lipz_file::rate::Rate;
use std::fmt::Write;

/// The positions on the time line per frame.
const POSITIONS_PER_FRAME: u32 = 15;
const SECTION: &str = "[Speech]";
const REST: &str = "None";

pub(super) const FORMAT: Format = Format {
    name: "pamela",
    about: "Pamela lip sync",
    extension: "pam",
    maps: &["cmu"],
    is_binary: false,
    is_legacy: true,
    keeps_texts: false,
    read: Some(read),
    write: Some(write),
};

fn read(bytes: &[u8], options: &ImportOptions<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Track> {
    let Some(text) = source::text(bytes, diagnostics) else { return Vec::new() };
    let rate = options.file_rate.unwrap_or(DEFAULT_RATE);
    let mut track = Track { rate: Some(rate), ..Track::default() };
    let (mut in_speech, mut has_speech) = (false, false);
    for line in source::lines(text) {
        let line = source::Line { text: line.text.split("//").next().unwrap_or_default(), at: line.at }.trimmed();
        if line.text.is_empty() {
            continue;
        }
        if line.text.starts_with('[') {
            in_speech = line.text.eq_ignore_ascii_case(SECTION);
            has_speech |= in_speech;
            continue;
        }
        if !in_speech {
            continue;
        }
        let Some((position, phoneme)) = line.split_once(':') else {
            diagnostics.push(line.not("a position, `:` and a phoneme"));
            continue;
        };
        let Some(position) = position.number("a position", diagnostics) else { continue };
        if phoneme.text.is_empty() {
            diagnostics.push(phoneme.not("a phoneme"));
            continue;
        }
        let symbol = phoneme.text.trim_end_matches(['0', '1', '2']);
        track.shapes.push(Shape::at(phoneme.span(), time(position, rate), symbol));
    }
    if !has_speech {
        let missing = format!("it has no section {SECTION}");
        diagnostics.push(source::cut_off(text, &missing));
    }
    // Programs that write Pamela files sort by name as often as by time, so the order is not reported.
    track.shapes.sort_by_key(|shape| shape.start);
    if track.shapes.len() > 1 && track.shapes.last().is_some_and(|last| last.symbol.eq_ignore_ascii_case(REST)) {
        track.end = track.shapes.pop().map(|rest| rest.start);
    }
    vec![track]
}

fn time(position: u64, rate: Rate) -> Time {
    let positions = rate.numerator.saturating_mul(POSITIONS_PER_FRAME);
    Time::new(position.saturating_mul(u64::from(rate.denominator)), positions)
}

fn write(track: &Track, diagnostics: &mut Vec<Diagnostic>) -> Vec<u8> {
    let rate = track.rate.unwrap_or(DEFAULT_RATE);
    if rate != DEFAULT_RATE {
        diagnostics.push(
            Diagnostic::new(Code::ExportLoss, "the clip does not have the frame rate of Pamela, 24")
                .note("frames start at the nearest position of Pamela"),
        );
    }
    let position = |time: Time| time.in_units(DEFAULT_RATE.numerator * POSITIONS_PER_FRAME);
    let mut text = format!("{SECTION}\n");
    for shape in &track.shapes {
        let _ = writeln!(text, "{}:{}", position(shape.start), shape.symbol);
    }
    let _ = writeln!(text, "{}:{REST}", position(track.end.unwrap_or(Time::ZERO)));
    text.into_bytes()
}
