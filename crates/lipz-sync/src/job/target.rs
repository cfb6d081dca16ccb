//! The Lipz file that gets visemes. Its other elements stay.

use crate::job::SyncOptions;
use crate::job::mouth::HeardMouth;
use crate::job::soft_opening;
use lipz_diagnostics::Diagnostic;
use lipz_file::format::{LineEnding, Style, format, rewrite};
use lipz_file::rate::Rate;
use lipz_file::{Document, Element, JsonString, Value, curve, phones};
use lipz_interop::{MergeOptions, Mouth, Time, merge};
use lipz_speech::Script;
use lipz_types::{CurveValue, Fps, VisemeType};
use std::borrow::Cow;

/// A Lipz file that gets visemes.
pub(super) struct Target<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) before: &'a Document<'a>,
    pub(super) is_new: bool,
    /// The spoken locale.
    pub(super) locale: Option<&'a str>,
    /// The name of the element and the text, if it comes from the file of the original.
    pub(super) borrowed: Option<(String, &'a str)>,
    pub(super) fps: Fps,
    pub(super) viseme_type: VisemeType,
}

/// Returns the file with its new visemes, and the diagnostics about guesses.
pub(super) fn merged(
    heard: &HeardMouth,
    script: &Script,
    options: &SyncOptions,
    target: &Target<'_>,
) -> (String, Vec<Diagnostic>) {
    let rate = |fps: Fps| Rate { numerator: fps.numerator(), denominator: fps.denominator(), is_exact: true };
    let time = |&frame: &usize| Time::of_frame(frame as u64, rate(target.fps));
    let starts = || heard.segment_starts.iter().skip(1).map(time).collect::<Vec<_>>();
    let mouth = Mouth::new(heard.codes.as_str(), rate(target.fps), target.viseme_type)
        .segment_starts((!script.words.is_empty()).then(starts))
        .phones(heard.phone_track.clone().filter(|_| options.phones || target.before.get(phones::ELEMENT).is_some()));
    let merge_options = MergeOptions::new()
        .locale(target.locale)
        .default_locale(options.options.get_default_locale())
        .default_rate(options.options.get_default_fps().map(rate))
        .default_viseme_type(options.options.get_default_viseme_type());
    let mut merged = merge(&divided(target), &mouth, &merge_options);
    set_opening(&mut merged.document, target.before, &heard.opening);
    if let Some((name, _)) = &target.borrowed {
        merged.document.elements.retain(|element| element.name.text != *name);
    }
    let text = String::from_utf8_lossy(target.bytes);
    let default_locale = options.options.get_default_locale();
    let style = Style { default_locale, line_ending: LineEnding::detect(&text) };
    let after = match target.is_new {
        true => format(&merged.document, style),
        false => rewrite(&text, target.before, &merged.document, style),
    };
    (after, merged.diagnostics)
}

/// Returns the file with the borrowed text, which determines the segments.
fn divided<'a>(target: &Target<'a>) -> Document<'a> {
    let mut document = target.before.clone();
    document.elements.extend(target.borrowed.as_ref().map(|(name, text)| Element {
        name: JsonString::from(Cow::Owned(name.clone())),
        value: Value::String(JsonString::from(Cow::Borrowed(*text))),
    }));
    document
}

/// Replaces the opening of the lips in a recording without a text. A curve with this name belongs to the animator, unless
/// the file has guessed phones, which state that the curve is from an earlier run. If the visemes are the same as before,
/// the curve stays, because it may have been edited.
fn set_opening(document: &mut Document<'_>, before: &Document<'_>, opening: &[(u32, CurveValue)]) {
    let was_guessed = before.string(phones::ELEMENT).is_some_and(phones::are_guessed);
    let is_same_take = document.string("visemes") == before.string("visemes");
    let is_kept = !was_guessed || (is_same_take && !opening.is_empty());
    if is_kept && (opening.is_empty() || has_curve(document, soft_opening::NAME)) {
        return;
    }
    let added = if opening.is_empty() { Vec::new() } else { vec![(soft_opening::NAME, opening.to_vec())] };
    // Curves with errors stay as they are.
    curve::change(document, |name| name == soft_opening::NAME, added);
}

fn has_curve(document: &Document<'_>, name: &str) -> bool {
    let Some(Value::Other(curves)) = document.get(curve::ELEMENT).map(|element| &element.value) else { return false };
    curves.members(&mut Vec::new()).is_some_and(|curves| curves.iter().any(|curve| curve.name.text == name))
}
