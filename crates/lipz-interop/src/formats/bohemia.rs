//! Bohemia Interactive, `.lip`: lines `time, shape`, with seconds and shapes 0 to 7. The first shape is 0 at 0.000; the
//! last line is the end, with -1. An optional first line `frame = 0.040` sets the step.

use super::Format;
use crate::{ImportOptions, Shape, Time, Track, source};
use lipz_diagnostics::{Code, Diagnostic};

/// The shape in the last line.
const END: &str = "-1";

pub(super) const FORMAT: Format = Format {
    name: "bohemia",
    about: "Bohemia Interactive (Arma, DayZ) .lip",
    extension: "lip",
    maps: &["bohemia"],
    is_binary: false,
    is_legacy: false,
    keeps_texts: false,
    read: Some(read),
    write: None,
};

fn read(bytes: &[u8], _: &ImportOptions<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Track> {
    let Some(text) = source::text(bytes, diagnostics) else { return Vec::new() };
    let mut track = Track::default();
    for (index, line) in source::lines(text).filter(|line| !line.text.trim().is_empty()).enumerate() {
        if index == 0 && line.text.trim_start().starts_with("frame") {
            let step = line.split_once('=').and_then(|(_, step)| Time::parse(step.text));
            if step.is_none() {
                diagnostics.push(line.not("`frame = ` and seconds"));
            }
            continue;
        }
        if let Some(end) = track.end.filter(|_| !line.text.trim().is_empty()) {
            let message = format!("a line follows the end at {end}");
            diagnostics.push(line.diagnostic(Code::ForeignOddity, message).note("it is not read"));
            break;
        }
        let Some((start, shape)) = line.split_once(',') else {
            diagnostics.push(line.not("a time, a comma and a shape"));
            continue;
        };
        match Time::parse(start.text) {
            None => diagnostics.push(start.not("a time in seconds")),
            Some(end) if shape.text == END => track.end = Some(end),
            Some(time) => track.shapes.push(Shape::at(shape.span(), time, shape.text)),
        }
    }
    if track.end.is_none() && diagnostics.is_empty() && !track.shapes.is_empty() {
        diagnostics.push(source::cut_off(text, "it has no line with -1 for the end of the recording"));
    }
    vec![track]
}
