//! Rhubarb Lip Sync, `-f tsv`: a line for each shape, with its start in seconds, a tab, and its letter. The last line
//! is the end of the recording (Rhubarb's README, "Output formats").

use super::{Format, rhubarb};
use crate::{ImportOptions, Shape, Time, Track, source};
use lipz_diagnostics::Diagnostic;
use std::fmt::Write;

pub(super) const FORMAT: Format = Format {
    name: "rhubarb-tsv",
    about: "Rhubarb Lip Sync, tab-separated (-f tsv)",
    extension: "tsv",
    maps: rhubarb::MAPS,
    is_binary: false,
    is_legacy: false,
    keeps_texts: false,
    read: Some(read),
    write: Some(write),
};

fn read(bytes: &[u8], _: &ImportOptions<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Track> {
    let Some(text) = source::text(bytes, diagnostics) else { return Vec::new() };
    let mut track = Track::default();
    for line in source::lines(text).filter(|line| !line.text.trim().is_empty()) {
        let Some((start, symbol)) = line.split_once('\t') else {
            diagnostics.push(line.not("a time, a tab and a mouth shape").help("write 0.25 and A, for example"));
            continue;
        };
        match Time::parse(start.text) {
            Some(time) if !symbol.text.is_empty() => track.shapes.push(Shape::at(symbol.span(), time, symbol.text)),
            Some(_) => diagnostics.push(source::cut_off(text, "a mouth shape is missing")),
            None => diagnostics.push(start.not("a time in seconds").help("write seconds with a dot, such as 0.25")),
        }
    }
    // The last line is not a shape, but the end of the one before it.
    if track.shapes.len() > 1 {
        track.end = track.shapes.pop().map(|end| end.start);
    } else if track.shapes.len() == 1 {
        diagnostics.push(source::cut_off(text, "it has no line for the end of the recording"));
    }
    vec![track]
}

fn write(track: &Track, _: &mut Vec<Diagnostic>) -> Vec<u8> {
    let mut text = String::new();
    for (start, symbol) in rhubarb::rows(track) {
        let _ = writeln!(text, "{start}\t{symbol}");
    }
    let _ = writeln!(text, "{}\t{}", rhubarb::seconds(rhubarb::end(track)), rhubarb::REST);
    text.into_bytes()
}
