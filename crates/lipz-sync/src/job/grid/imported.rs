//! Imported TextGrids: the visemes of their phones, by the rules of a project.

use super::tiers::{read_phones, tier, us};
use super::up_to;
use crate::job::options::rules;
use lipz_compiler::settings::Sync;
use lipz_diagnostics::Diagnostic;
use lipz_interop::Mouth;
use lipz_interop::textgrid::TextGrid;
use lipz_speech::{Alignment, render};
use lipz_types::Fps;

/// The visemes of a TextGrid's phones.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct CodesOfPhones {
    /// The codes of the frames.
    pub codes: String,
    /// The number of frames whose shapes in the TextGrid differ, and are ignored.
    pub frames_of_other_shapes: usize,
}

/// Returns the visemes of a TextGrid's phones, by the rules of `[sync]`; `None` if it does not have both phones and
/// shapes, like those written by a [`SyncRun`](crate::SyncRun). Reports labels that are not phones.
///
/// `mouth` is the track of the TextGrid's shapes, in its rate and type. `before` is the existing clip, if it has the
/// same rate and type. Where shapes and phones differ, one of them was corrected by hand: the shapes if the phones
/// match the clip, otherwise the phones.
pub fn codes_of_phones(
    bytes: &[u8],
    sync: &Sync,
    mouth: &Mouth,
    before: Option<&Mouth>,
) -> (Option<CodesOfPhones>, Vec<Diagnostic>) {
    let mut diagnostics = Vec::new();
    let codes = phones(bytes, sync, mouth, &mut diagnostics).map(|phones| corrected(&phones, mouth, before));
    (codes, diagnostics)
}

/// Returns the codes of the frames from the phones alone.
fn phones(bytes: &[u8], sync: &Sync, mouth: &Mouth, diagnostics: &mut Vec<Diagnostic>) -> Option<String> {
    // The import reports errors in the file itself.
    let grid = TextGrid::read(bytes, &mut Vec::new())?;
    let is_of_shapes = |name: &str| name.rsplit(" - ").next().is_some_and(|own| own.trim().starts_with("visemes"));
    let tier = tier(&grid, "phones").filter(|_| grid.tiers.iter().any(|tier| is_of_shapes(&tier.name)))?;
    let (start, end) = (us(grid.start), us(grid.end));
    let phones = read_phones(tier, start, end, diagnostics)?;
    let fps = Fps::new(mouth.rate.numerator, mouth.rate.denominator)?;
    // An exported TextGrid ends with a frame, which is longer than its recording.
    let duration_us = end.saturating_sub(start);
    let (words, breaks_us, mismatches) = Default::default();
    let phones = up_to(duration_us, phones);
    let alignment = Alignment { duration_us, phones, words, breaks_us, mismatches };
    Some(render(&alignment, fps, mouth.viseme_type, &rules(sync).0).frames)
}

/// Returns the codes of the phones, replaced with those of corrected shapes.
fn corrected(phones: &str, shapes: &Mouth, before: Option<&Mouth>) -> CodesOfPhones {
    let before = before.filter(|before| (before.rate, before.viseme_type) == (shapes.rate, shapes.viseme_type));
    let before = before.map_or(&[][..], |before| before.codes.as_bytes());
    let mut frames_of_other_shapes = 0;
    let code = |(frame, phone): (usize, char)| {
        let own = shapes.codes.as_bytes().get(frame).map_or(phone, |&code| char::from(code));
        let before = before.get(frame).map(|&code| char::from(code));
        if own != phone && before == Some(phone) {
            return own;
        }
        frames_of_other_shapes += usize::from(own != phone && before != Some(own));
        phone
    };
    let codes = phones.chars().enumerate().map(code).collect();
    CodesOfPhones { codes, frames_of_other_shapes }
}
