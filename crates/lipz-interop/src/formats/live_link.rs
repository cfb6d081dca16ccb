//! Face shapes of ARKit as recorded by Live Link Face, CSV: a line per frame with its timecode and 52 weights. The
//! strongest shape that concerns the lips becomes the viseme of the frame; for loudness (rms), the opening of the jaw
//! is used.

use super::Format;
use super::timecode::{Timecode, Timecodes};
use crate::source::{self, Line};
use crate::{ImportOptions, Map, Shape, Time, Track, find_map};
use lipz_diagnostics::{Code, Diagnostic};
use lipz_types::VisemeType;

const TIMECODE: &str = "Timecode";
const JAW: &str = "JawOpen";
const TABLE: &str = "arkit";
/// The table's name for rest.
const REST: &str = "rest";
/// Weaker shapes are ignored, because a tracked face never lies still.
const FLOOR: f64 = 0.15;

pub(super) const FORMAT: Format = Format {
    name: "live-link",
    about: "Live Link Face (ARKit) recordings, CSV",
    extension: "csv",
    maps: &[TABLE, "rms"],
    is_binary: false,
    is_legacy: false,
    keeps_texts: false,
    read: Some(read),
    write: None,
};

fn read(bytes: &[u8], options: &ImportOptions<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Track> {
    let Some(text) = source::text(bytes, diagnostics) else { return Vec::new() };
    let mut lines = source::lines(text).filter(|line| !line.text.trim().is_empty());
    let Some(header) = lines.next() else { return vec![Track::default()] };
    let names: Vec<Line<'_>> = fields(header).collect();
    let place = |name: &str| names.iter().position(|field| field.text.eq_ignore_ascii_case(name));
    let (Some(timecode), Some(jaw)) = (place(TIMECODE), place(JAW)) else {
        diagnostics.push(
            header
                .not("a line of names with `Timecode` and `JawOpen`")
                .help("check whether this is a CSV file of Live Link Face"),
        );
        return Vec::new();
    };
    let Some(map) = options.map.or_else(|| find_map(TABLE)) else { return Vec::new() };
    let is_loudness = options.map.is_none() && options.viseme_type == Some(VisemeType::Rms);
    let rows: Vec<Vec<Line<'_>>> = lines.map(|line| fields(line).collect()).collect();
    let codes: Vec<Option<Timecode>> =
        rows.iter().map(|row| row.get(timecode).and_then(|field| Timecode::parse(field.text))).collect();
    let origin = codes.iter().flatten().next().copied();
    let codes = Timecodes::new(codes, options.file_rate);
    let rate = codes.rate;
    let mut track = Track { rate: Some(rate), map: Some(if is_loudness { "rms" } else { TABLE }), ..Track::default() };
    if options.file_rate.is_none() {
        let unit = if codes.has_milliseconds { ", which count milliseconds" } else { "" };
        track.remarks.push(format!("{} frames per second, from the timecodes{unit}", rate.numerator));
    }
    for (row, code) in rows.iter().zip(&codes.all) {
        let Some(first) = row.first() else { continue };
        if row.len() != names.len() {
            let message = format!("a frame has {} columns, not {}", row.len(), names.len());
            diagnostics.push(first.diagnostic(Code::ForeignSyntax, message));
            continue;
        }
        let place = row.get(timecode).unwrap_or(first);
        let (Some(code), Some(origin)) = (code, origin) else {
            diagnostics.push(place.not("a timecode, hours:minutes:seconds:frames"));
            continue;
        };
        if !codes.has_frame(*code) {
            let message = format!("the timecode counts more than {} frames in a second", rate.numerator);
            diagnostics
                .push(place.diagnostic(Code::ForeignValue, message).help("name the frame rate with `--file-rate`"));
            continue;
        }
        let start = codes.time_since(*code, origin);
        let symbol = match is_loudness {
            true => row.get(jaw).and_then(|field| weight(*field, diagnostics)).map(loudness),
            false => strongest(&names, row, map, diagnostics),
        };
        let Some(symbol) = symbol else { continue };
        track.shapes.push(Shape::at(first.span(), start, symbol));
        track.end = Some(Time::of_frame(start.nearest_frame(rate).saturating_add(1), rate));
    }
    vec![track]
}

/// Returns the shape with the largest weight among those in the table.
fn strongest(names: &[Line<'_>], row: &[Line<'_>], map: &Map, diagnostics: &mut Vec<Diagnostic>) -> Option<String> {
    let mut strongest = (REST, FLOOR);
    for (name, field) in names.iter().zip(row).filter(|(name, _)| map.code(name.text).is_some()) {
        let weight = weight(*field, diagnostics)?;
        if weight > strongest.1 {
            strongest = (name.text, weight);
        }
    }
    Some(strongest.0.to_owned())
}

fn weight(field: Line<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<f64> {
    let weight = field.text.parse().ok().filter(|weight: &f64| weight.is_finite());
    if weight.is_none() {
        diagnostics.push(field.not("a weight from 0 to 1"));
    }
    weight
}

/// Returns the digit for an opening from 0 to 1.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 9")]
fn loudness(opening: f64) -> String {
    ((opening * 10.0).clamp(0.0, 9.0) as u32).to_string()
}

fn fields(line: Line<'_>) -> impl Iterator<Item = Line<'_>> {
    let mut at = line.at;
    line.text.split(',').map(move |text| {
        let field = Line { text, at };
        at += text.len() + 1;
        field.trimmed()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn jaws_are_loud() {
        assert_eq!([-0.1, 0.0, 0.55, 1.0, 7.0].map(loudness), ["0", "0", "5", "9", "9"]);
    }
}
