//! Face shapes of ARKit as recorded by Live Link Face, CSV: a line per frame with its timecode and 61 weights, 52 of
//! them shapes. All of them become curves. The strongest shape that concerns the lips becomes the viseme of the frame;
//! for loudness (rms), the opening of the jaw is used.

use super::Format;
use super::face_frames::{self, TABLE};
use super::timecode::{Timecode, Timecodes};
use crate::source::{self, Line};
use crate::{ImportOptions, Track};
use lipz_diagnostics::{Code, Diagnostic};
use std::collections::HashSet;

const TIMECODE: &str = "Timecode";
const JAW: &str = "JawOpen";
/// A column with the number of the other columns.
const COUNT: &str = "BlendShapeCount";

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
    let (Some(timecode), Some(_)) = (place(TIMECODE), place(JAW)) else {
        diagnostics.push(
            header
                .not("a line of names with `Timecode` and `JawOpen`")
                .help("check whether this is a CSV file of Live Link Face"),
        );
        return Vec::new();
    };
    let Some((symbols, table)) = face_frames::symbols(options) else { return Vec::new() };
    let columns: Vec<usize> = weight_columns(&names, diagnostics);
    let rows: Vec<Vec<Line<'_>>> = lines.map(|line| fields(line).collect()).collect();
    let codes: Vec<Option<Timecode>> =
        rows.iter().map(|row| row.get(timecode).and_then(|field| Timecode::parse(field.text))).collect();
    let origin = codes.iter().flatten().next().copied();
    let codes = Timecodes::new(codes, options.file_rate);
    let rate = codes.rate;
    let mut track = Track { rate: Some(rate), map: Some(table), ..Track::default() };
    let name_of = |column: &usize| names.get(*column).map(|name| face_frames::curve_name(name.text));
    track.weights.names = columns.iter().filter_map(name_of).collect();
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
        let weights: Option<Vec<f32>> =
            columns.iter().map(|&column| face_frames::weight(*row.get(column)?, diagnostics)).collect();
        let Some(weights) = weights else { continue };
        face_frames::add(&mut track, symbols, Some(first.span()), start, weights);
    }
    face_frames::finish(&mut track, rate);
    vec![track]
}

/// Returns the columns with weights. Reports columns with the same name, of which the first counts.
fn weight_columns(names: &[Line<'_>], diagnostics: &mut Vec<Diagnostic>) -> Vec<usize> {
    let mut known = HashSet::new();
    let mut columns = Vec::new();
    for (column, name) in names.iter().enumerate() {
        if [TIMECODE, COUNT].iter().any(|other| other.eq_ignore_ascii_case(name.text)) || name.text.is_empty() {
            continue;
        }
        if known.insert(name.text.to_ascii_lowercase()) {
            columns.push(column);
        } else {
            diagnostics.push(name.diagnostic(Code::ForeignOddity, "a second column with this name is not read"));
        }
    }
    columns
}

fn fields(line: Line<'_>) -> impl Iterator<Item = Line<'_>> {
    let mut at = line.at;
    line.text.split(',').map(move |text| {
        let field = Line { text, at };
        at += text.len() + 1;
        field.trimmed()
    })
}
