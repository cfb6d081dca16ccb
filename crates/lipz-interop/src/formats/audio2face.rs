//! Animations of NVIDIA's Audio2Face, JSON: the names of the shapes in `facsNames`, and a row of weights per frame in
//! `weightMat`. All weights become curves, as in Live Link recordings.

use super::Format;
use super::face_frames::{self, TABLE};
use crate::json::{self, Node};
use crate::{ImportOptions, Time, Track, source};
use lipz_diagnostics::Diagnostic;
use lipz_file::rate::Rate;

/// The frame rate of files that do not state one, as in Audio2Face's settings.
const RATE: Rate = Rate { numerator: 30, denominator: 1, is_exact: true };

pub(super) const FORMAT: Format = Format {
    name: "audio2face",
    about: "Audio2Face animations (ARKit), JSON",
    extension: "json",
    maps: &[TABLE, "rms"],
    is_binary: false,
    is_legacy: false,
    keeps_texts: false,
    read: Some(read),
    write: None,
};

fn read(bytes: &[u8], options: &ImportOptions<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Track> {
    let Some(root) = source::text(bytes, diagnostics).and_then(|text| json::root(text, diagnostics)) else {
        return Vec::new();
    };
    let names = root.get(&["facsNames"]).and_then(Node::items);
    let rows = root.get(&["weightMat"]).and_then(Node::items);
    let (Some(names), Some(rows)) = (names, rows) else {
        let missing = root.lacks("a list \"facsNames\" with a list \"weightMat\"");
        diagnostics.push(missing.help("check whether this is an animation that Audio2Face exported with weights"));
        return Vec::new();
    };
    let Some((symbols, table)) = face_frames::symbols(options) else { return Vec::new() };
    let stated = face_frames::stated_rate(root, &["exportFps", "fps"], diagnostics);
    let rate = options.file_rate.or(stated).unwrap_or(RATE);
    let mut track = Track { rate: Some(rate), map: Some(table), ..Track::default() };
    let Some(names) = face_frames::names(&names, diagnostics) else { return Vec::new() };
    track.weights.names = names;
    for (frame, row) in (0..).zip(rows) {
        let Some(weights) = face_frames::row(row, track.weights.names.len(), diagnostics) else { continue };
        face_frames::add(&mut track, symbols, Some(row.span()), Time::of_frame(frame, rate), weights);
    }
    face_frames::finish(&mut track, rate);
    vec![track]
}
