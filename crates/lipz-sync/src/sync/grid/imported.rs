//! TextGrids that are imported: what their phones say, by the rules of a project.

use super::tiers::{read_phones, tier, us};
use super::up_to;
use crate::sync::options::rules;
use lipz_compiler::settings::Sync;
use lipz_diagnostics::Diagnostic;
use lipz_interop::Mouth;
use lipz_interop::textgrid::TextGrid;
use lipz_speech::{Alignment, render};
use lipz_types::Fps;

/// A mouth as the phones of a TextGrid say it.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct CodesOfPhones {
    /// The codes of its frames.
    pub codes: String,
    /// Frames whose shapes in the TextGrid are others, and do not count.
    pub frames_of_other_shapes: usize,
}

/// The mouth that the phones of a TextGrid make, by the rules of `[sync]`; `None` if it does not have both phones and shapes, as
/// a [`SyncRun`](crate::SyncRun) writes them. Reports labels that are no phones.
///
/// `mouth` is what the shapes of the TextGrid say, in its rate and its type, and `before` the clip that exists, if it is of the
/// same rate and type. Where shapes and phones differ, somebody has corrected one of them. It is the shapes, where the phones
/// say what the clip has; otherwise the phones count.
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

/// The codes of the frames by the phones alone.
fn phones(bytes: &[u8], sync: &Sync, mouth: &Mouth, diagnostics: &mut Vec<Diagnostic>) -> Option<String> {
    // What is wrong with the file as such, its import tells.
    let grid = TextGrid::read(bytes, &mut Vec::new())?;
    let is_of_shapes = |name: &str| name.rsplit(" - ").next().is_some_and(|own| own.trim().starts_with("visemes"));
    let tier = tier(&grid, "phones").filter(|_| grid.tiers.iter().any(|tier| is_of_shapes(&tier.name)))?;
    let (start, end) = (us(grid.start), us(grid.end));
    let phones = read_phones(tier, start, end, diagnostics)?;
    let fps = Fps::new(mouth.rate.numerator, mouth.rate.denominator)?;
    // One that was exported ends with a frame, which is longer than its recording.
    let duration_us = end.saturating_sub(start);
    let (words, breaks_us, mismatches) = Default::default();
    let phones = up_to(duration_us, phones);
    let alignment = Alignment { duration_us, phones, words, breaks_us, mismatches };
    Some(render(&alignment, fps, mouth.viseme_type, &rules(sync).0).frames)
}

/// The codes of the phones, but where the shapes are what somebody has corrected.
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
