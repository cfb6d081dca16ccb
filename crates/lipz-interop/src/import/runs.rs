//! Conversion of a track's shapes to runs of codes, with the losses.

use super::LostShape;
use super::document::spell;
use crate::frames::ShapeRun;
use crate::{Map, Shape, Time, Track, export};
use lipz_diagnostics::{Code, Diagnostic, Label, escape};
use lipz_file::rate::Rate;
use std::collections::HashMap;

/// The most frames of a clip. More than a day at 24 frames per second can only be a mistake.
const MAX_FRAMES: u64 = 1 << 22;
/// Losses that a diagnostic names; [`ImportedClip::lost`](crate::ImportedClip::lost) has all.
const LOSSES_SHOWN: usize = 8;

/// Returns the track with its shapes sorted by time. Reports times that run backwards.
pub(super) fn in_order(mut track: Track, diagnostics: &mut Vec<Diagnostic>) -> Track {
    let backwards = track.shapes.windows(2).filter_map(|pair| match pair {
        [before, after] if after.start < before.start => Some((before, after)),
        _ => None,
    });
    let count = backwards.clone().count();
    if let Some((before, after)) = backwards.clone().next() {
        let (earlier, later) = (after.start, before.start);
        let message = format!("times run backwards: {earlier} comes after {later}");
        let diagnostic = shape_diagnostic(Code::TimesBackwards, after, message)
            .note("the shapes are sorted by time")
            .help("check the clip at this time; the file may have been edited or joined from two");
        diagnostics.push(if count > 1 {
            diagnostic.note(format!("{} more times run backwards", count - 1))
        } else {
            diagnostic
        });
        track.shapes.sort_by_key(|shape| shape.start);
    }
    track
}

/// Returns the track with shapes for these codes, one per frame.
pub(super) fn with_codes(track: Track, codes: &str, map: &Map, rate: Rate) -> Track {
    let symbol = |code: u8| map.symbol(code).map_or_else(|| char::from(code).to_string(), str::to_owned);
    let shape = |(frame, code)| Shape::new(Time::of_frame(frame, rate), symbol(code));
    let shapes = export::runs(codes.as_bytes()).map(shape).collect();
    Track { shapes, end: Some(Time::of_frame(codes.len() as u64, rate)), ..track }
}

fn shape_diagnostic(code: Code, shape: &Shape, message: String) -> Diagnostic {
    match shape.span {
        Some(span) => Diagnostic::at(code, span, message),
        None => Diagnostic::new(code, message).note(format!("at {}", shape.start)),
    }
}

/// Returns the shapes as codes, each with its symbol, with equal neighbours merged. Reports symbols that are missing
/// from the table.
pub(super) fn runs<'t>(
    track: &'t Track,
    map: &Map,
    rate: Rate,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<(Vec<&'t str>, Vec<ShapeRun>)> {
    let last = track.shapes.last().map_or(Time::ZERO, |shape| shape.start);
    let a_frame_later = Time::of_frame(last.nearest_frame(rate).saturating_add(1), rate);
    let end = track.end.unwrap_or(if track.shapes.is_empty() { last } else { a_frame_later }).max(last);
    if end.nearest_frame(rate) > MAX_FRAMES {
        let message = format!("the clip ends at {end}, after more than {MAX_FRAMES} frames");
        diagnostics.push(
            Diagnostic::new(Code::ForeignValue, message).help("check whether the times have the unit of the format"),
        );
        return None;
    }
    let before = diagnostics.len();
    let mut unknown: Vec<Diagnostic> = Vec::new();
    let mut place_of: HashMap<&str, usize> = HashMap::new();
    let (mut symbols, mut runs): (Vec<&str>, Vec<ShapeRun>) = (Vec::new(), Vec::new());
    let first = track.shapes.first().map_or(end, |shape| shape.start);
    if first > Time::ZERO {
        symbols.push("-");
        runs.push(ShapeRun { code: REST, start: Time::ZERO, end: first });
    }
    for (index, shape) in track.shapes.iter().enumerate() {
        let Some(code) = map.code(&shape.symbol) else {
            let place = *place_of.entry(&shape.symbol).or_insert(unknown.len());
            match unknown.get_mut(place) {
                Some(known) => known.labels.extend(shape.span.map(|span| Label::new(span, "also here"))),
                None => unknown.push(unknown_symbol(shape, map)),
            }
            continue;
        };
        let end = track.shapes.get(index + 1).map_or(end, |next| next.start);
        match runs.last_mut() {
            Some(run) if run.code == code => run.end = end,
            _ => {
                symbols.push(&shape.symbol);
                runs.push(ShapeRun { code, start: shape.start, end });
            }
        }
    }
    diagnostics.append(&mut unknown);
    (diagnostics.len() == before).then_some((symbols, runs))
}

/// The code of rest in every viseme type.
pub(crate) const REST: u8 = b'-';

fn unknown_symbol(shape: &Shape, map: &Map) -> Diagnostic {
    let message =
        format!("{} is not in the mapping table `{}`", escape::quoted(&shape.symbol), escape::text(&map.name));
    let diagnostic = shape_diagnostic(Code::UnknownSymbol, shape, message);
    match map.nearest(&shape.symbol) {
        Some(known) => diagnostic.help(format!("did you mean {}?", escape::quoted(known))),
        None => diagnostic.help("use a mapping table that has it"),
    }
}

/// Reports the shapes without frames.
pub(super) fn report(lost: &[LostShape], all: usize, rate: Rate, diagnostics: &mut Vec<Diagnostic>) {
    if lost.is_empty() {
        return;
    }
    let (count, have) = (lost.len(), if lost.len() == 1 { "has" } else { "have" });
    let message = format!("{count} of {all} mouth shapes {have} no frame at {} frames per second", spell(rate));
    let mut diagnostic = Diagnostic::new(Code::ShapesLost, message);
    for loss in lost.iter().take(LOSSES_SHOWN) {
        diagnostic = diagnostic.note(loss.describe());
    }
    if count > LOSSES_SHOWN {
        diagnostic = diagnostic.note(format!("and {} more", count - LOSSES_SHOWN));
    }
    diagnostics.push(diagnostic.help("choose a higher `fps` if the game supports it"));
}
