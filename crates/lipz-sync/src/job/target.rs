//! The Lipz file that gets visemes. Its other elements stay.

use crate::job::SyncOptions;
use crate::job::mouth::HeardMouth;
use crate::job::soft_opening;
use lipz_diagnostics::Diagnostic;
use lipz_file::format::{LineEnding, Style, format, rewrite};
use lipz_file::rate::Rate;
use lipz_file::{Document, Element, JsonString, RawJson, Value, curve, phones};
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
    if opening.is_empty() && !was_guessed {
        return;
    }
    let element = document.elements.iter().position(|element| element.name.text == curve::ELEMENT);
    let mut diagnostics = Vec::new();
    let own = match element.and_then(|at| document.elements.get(at)).map(|element| &element.value) {
        Some(Value::Other(value)) => curve::parse(value, &mut diagnostics).unwrap_or_default(),
        Some(_) => return,
        None => Vec::new(),
    };
    // Invalid keys would get lost.
    if !diagnostics.is_empty() {
        return;
    }
    let keys = |curve: &curve::Curve<'_>| curve.keys.iter().map(|key| (key.frame, key.value)).collect::<Vec<_>>();
    let is_made = was_guessed && (opening.is_empty() || !is_same_take);
    let is_kept = |curve: &&curve::Curve<'_>| !is_made || curve.name.text != soft_opening::NAME;
    let mut all: Vec<_> = own.iter().filter(is_kept).map(|curve| (curve.name.text.as_ref(), keys(curve))).collect();
    if !opening.is_empty() && all.iter().all(|(name, _)| *name != soft_opening::NAME) {
        all.push((soft_opening::NAME, opening.to_vec()));
    }
    let written = (!all.is_empty()).then(|| Value::Other(RawJson::new(curve::write(all))));
    let name = JsonString::from(Cow::Borrowed(curve::ELEMENT));
    match (element, written) {
        (Some(at), Some(value)) => document.elements[at].value = value,
        (Some(at), None) => _ = document.elements.remove(at),
        (None, Some(value)) => document.elements.push(Element { name, value }),
        (None, None) => {}
    }
}
