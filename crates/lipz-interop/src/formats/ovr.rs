//! Frames of Oculus (Meta) OVRLipSync as CSV: a line per frame with the weights of its 15 visemes, in their
//! order. The strongest one is the shape of the frame; below a floor, it is silence.

use super::Format;
use crate::source::{self, Line};
use crate::{ImportOptions, Shape, Time, Track};
use lipz_diagnostics::{Code, Diagnostic};
use lipz_file::rate::Rate;

/// The visemes in the order of their weights.
const VISEMES: [&str; 15] = ["sil", "PP", "FF", "TH", "DD", "kk", "CH", "SS", "nn", "RR", "aa", "E", "ih", "oh", "ou"];
/// No viseme weaker than this is shown, as in OpenFaceFX.
const FLOOR: f64 = 0.1;
/// Frames a second of a dump, if it is not told.
const RATE: Rate = Rate { numerator: 60, denominator: 1, is_exact: true };

pub(super) const FORMAT: Format = Format {
    name: "ovr",
    about: "OVRLipSync frames, CSV with 15 weights a line",
    extension: "csv",
    examples: &["lipz import ovr dumps/*.csv --file-fps 60 --fps 30 -o voices"],
    maps: &["ovr"],
    is_binary: false,
    read: Some(read),
    write: None,
};

fn read(bytes: &[u8], options: &ImportOptions<'_>, findings: &mut Vec<Diagnostic>) -> Vec<Track> {
    let Some(text) = source::text(bytes, findings) else { return Vec::new() };
    let rate = options.file_rate.unwrap_or(RATE);
    let mut track = Track { rate: Some(rate), ..Track::default() };
    let mut frame = 0;
    for (index, line) in source::lines(text).filter(|line| !line.text.trim().is_empty()).enumerate() {
        let fields = fields(line);
        if index == 0 && fields.first().is_some_and(|field| field.text.parse::<f64>().is_err()) {
            continue; // the names of the columns
        }
        if fields.len() != VISEMES.len() {
            let message = format!("a frame has {} weights, not {}", fields.len(), VISEMES.len());
            findings.push(line.finding(Code::ForeignSyntax, message));
            continue;
        }
        let mut strongest = ("sil", FLOOR, line);
        for (viseme, field) in VISEMES.into_iter().zip(fields) {
            match field.text.parse::<f64>() {
                Ok(weight) if weight.is_finite() => {
                    if weight > strongest.1 {
                        strongest = (viseme, weight, field);
                    }
                }
                _ => findings.push(field.not("a weight from 0 to 1")),
            }
        }
        track.shapes.push(Shape::at(strongest.2.span(), Time::of_frame(frame, rate), strongest.0));
        frame += 1;
    }
    track.end = Some(Time::of_frame(frame, rate));
    vec![track]
}

/// The fields between commas or semicolons, without quotes: weights have none.
fn fields(line: Line<'_>) -> Vec<Line<'_>> {
    let mut at = line.at;
    let field = |text| {
        let field = Line { text, at };
        at += text.len() + 1;
        field.trimmed()
    };
    line.text.split([',', ';']).map(field).collect()
}
