//! The common parts of formats that record a face: a row of weights per frame.
//!
//! All weights become curves. The strongest one that concerns the lips becomes the viseme of the frame.

use crate::json::Node;
use crate::source::Line;
use crate::{ImportOptions, Map, Shape, Time, Track, WeightRow, find_map};
use lipz_diagnostics::{Code, Diagnostic, Span};
use lipz_file::curve;
use lipz_file::rate::Rate;
use lipz_types::VisemeType;
use std::collections::HashSet;

/// The mapping table for the shapes of ARKit, and its name for rest.
pub(super) const TABLE: &str = "arkit";
const REST: &str = "rest";
/// Weaker shapes of ARKit are ignored, because a tracked face never lies still.
const FLOOR: f32 = 0.15;

/// The largest weight. Curves store weights in thousandths of 32 bits.
pub(super) const LARGEST: f32 = 2_000_000.0;
/// The most shapes of a face. A file with more could name a different one in each frame, and would take memory beyond
/// its size.
pub(super) const MOST_SHAPES: usize = 1_000;
/// The curve that is the loudness of a face (rms).
const JAW: &str = "jawOpen";

/// The symbols of the frames of a face.
#[derive(Clone, Copy)]
pub(super) enum Symbols<'m> {
    /// The strongest weight in a table if it is above the floor, or else its name for rest.
    Strongest { map: &'m Map, floor: f32, rest: &'m str },
    /// The opening of the jaw, as a digit.
    Loudness,
}

/// Returns the curve for a shape of ARKit in any of its spellings, or the name itself.
pub(super) fn curve_name(name: &str) -> String {
    let known = curve::ARKIT.into_iter().find(|known| known.eq_ignore_ascii_case(name));
    known.map_or_else(|| name.to_owned(), str::to_owned)
}

/// Returns the symbols that the options select, and the mapping table.
pub(super) fn symbols<'m>(options: &ImportOptions<'m>) -> Option<(Symbols<'m>, &'static str)> {
    let map = options.map.or_else(|| find_map(TABLE))?;
    Some(match options.map.is_none() && options.viseme_type == Some(VisemeType::Rms) {
        true => (Symbols::Loudness, "rms"),
        false => (Symbols::Strongest { map, floor: FLOOR, rest: REST }, TABLE),
    })
}

/// Returns the curves for a list of names. Reports other values, and names that occur twice.
pub(super) fn names(list: &[Node<'_>], diagnostics: &mut Vec<Diagnostic>) -> Option<Vec<String>> {
    let mut names: Vec<String> = Vec::with_capacity(list.len());
    let mut known = HashSet::new();
    for node in list {
        match node.string().map(|name| curve_name(&name)) {
            Some(name) if name.is_empty() => diagnostics.push(node.not("the name of a shape")),
            Some(name) if !known.insert(name.clone()) => {
                diagnostics.push(Diagnostic::at(Code::ForeignSyntax, node.span(), "a second shape has the same name"));
            }
            Some(name) => names.push(name),
            None => diagnostics.push(node.not("the name of a shape")),
        }
    }
    (names.len() == list.len()).then_some(names)
}

/// Returns a list of weights with this length. Reports anything else.
pub(super) fn row(node: Node<'_>, length: usize, diagnostics: &mut Vec<Diagnostic>) -> Option<Vec<f32>> {
    let Some(items) = node.items() else {
        diagnostics.push(node.lacks("a list of weights"));
        return None;
    };
    if items.len() != length {
        let message = format!("a frame has {} weights, not {length}", items.len());
        diagnostics.push(Diagnostic::at(Code::ForeignSyntax, node.span(), message));
        return None;
    }
    items.into_iter().map(|item| weight(item.line, diagnostics)).collect()
}

/// Parses a weight. Reports anything else.
pub(super) fn weight(field: Line<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<f32> {
    let weight = field.text.parse().ok().filter(|weight: &f32| weight.abs() <= LARGEST);
    if weight.is_none() {
        diagnostics.push(field.not("a weight, such as 0.25"));
    }
    weight
}

/// Returns the frame rate that a file states under one of these names. Reports a value that is not a rate.
pub(super) fn stated_rate(root: Node<'_>, names: &[&str], diagnostics: &mut Vec<Diagnostic>) -> Option<Rate> {
    let node = root.get(names)?;
    let rate = node.number().and_then(|number| lipz_file::rate::parse(&number));
    if rate.is_none() {
        diagnostics.push(node.not("a frame rate"));
    }
    rate
}

/// Adds a frame with its weights, in the order of the track's names, and the viseme that they show.
pub(super) fn add(track: &mut Track, symbols: Symbols<'_>, span: Option<Span>, start: Time, weights: Vec<f32>) {
    let named = || track.weights.names.iter().zip(&weights);
    let symbol = match symbols {
        Symbols::Loudness => {
            loudness(named().find(|(name, _)| *name == JAW).map_or(0.0, |(_, weight)| f64::from(*weight)))
        }
        Symbols::Strongest { map, floor, rest } => {
            let mut strongest = (rest, floor);
            for (name, &weight) in named().filter(|(name, _)| map.code(name).is_some()) {
                if weight > strongest.1 {
                    strongest = (name, weight);
                }
            }
            strongest.0.to_owned()
        }
    };
    track.shapes.push(Shape { start, symbol, span });
    track.weights.rows.push(WeightRow { start, weights });
}

/// Sets the end of a track to a frame after its last row.
pub(super) fn finish(track: &mut Track, rate: Rate) {
    let last = track.weights.rows.iter().map(|row| row.start).max();
    track.end = last.map(|last| Time::of_frame(last.nearest_frame(rate).saturating_add(1), rate));
}

/// Returns the digit for an opening from 0 to 1.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 9")]
fn loudness(opening: f64) -> String {
    ((opening * 10.0).clamp(0.0, 9.0) as u32).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn jaws_are_loud() {
        assert_eq!([-0.1, 0.0, 0.55, 1.0, 7.0].map(loudness), ["0", "0", "5", "9", "9"]);
    }
}
