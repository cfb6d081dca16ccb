//! Emotions in the meta of a text.

use super::allowed_names::AllowedNames;
use crate::check::names::inside;
use crate::project::Options;
use crate::project::options::Face;
use lipz_diagnostics::{Code, Diagnostic, escape};
use lipz_file::emotion::{Blend, NearBlend};
use lipz_file::{JsonString, text};
use std::ops::Range;

/// Meta that is a blend of emotions.
pub(super) struct Markup<'t> {
    pub(super) segment: usize,
    /// Its range in the text, including its braces.
    pub(super) range: Range<usize>,
    /// The offset in bytes of the contents of the braces.
    pub(super) start: usize,
    pub(super) blend: Blend<'t>,
    /// Whether a word of the segment comes before it.
    pub(super) is_behind_word: bool,
}

impl<'t> Markup<'t> {
    /// Returns all blends of a text, in order.
    pub(super) fn all(whole: &'t str, known: &AllowedNames<'_>) -> Vec<Markup<'t>> {
        let mut found: Vec<Markup<'t>> = Vec::new();
        if !whole.contains('{') {
            return found;
        }
        for (segment, range) in text::segments(whole).enumerate() {
            let (mut is_behind_word, mut end) = (false, range.start);
            for meta in text::meta_ranges(&whole[range.clone()]) {
                let meta = range.start + meta.start..range.start + meta.end;
                is_behind_word |= whole[end..meta.start].contains(char::is_alphanumeric);
                end = meta.end;
                let inner = &whole[meta.start + 1..meta.end - 1];
                if let Some(blend) = Blend::parse(inner, 0).filter(|blend| is_meant(blend, known)) {
                    let start = meta.start + 1;
                    found.push(Markup { segment, range: meta, start, blend, is_behind_word });
                }
            }
        }
        found
    }
}

/// Whether meta means emotions and not another kind of note (`{take 3}`): either all of its names are known, or it has
/// a value and its other names are misspelt.
fn is_meant(blend: &Blend<'_>, known: &AllowedNames<'_>) -> bool {
    let names = || blend.terms.iter().map(|term| term.name.text);
    let is_near = |name: &str| known.has(name) || known.nearest(name).is_some();
    names().all(|name| known.has(name)) || blend.has_value() && names().all(is_near)
}

/// Returns the blend that was probably meant by meta, including its braces, that is nearly a blend of emotions.
pub(super) fn near_miss<'t>(meta: &'t str, known: &AllowedNames<'_>) -> Option<NearBlend<'t>> {
    let inner = meta.strip_prefix('{')?.strip_suffix('}')?;
    if Blend::parse(inner, 0).is_some_and(|blend| is_meant(&blend, known)) {
        return None;
    }
    NearBlend::of(inner, |name| known.has(name))
}

/// Returns the diagnostics of all meta in a text that is nearly a blend of emotions.
pub(super) fn near_misses(string: &JsonString<'_>, known: &AllowedNames<'_>) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    // Once for all segments, because a clip may have tens of thousands.
    if !string.text.contains('{') {
        return found;
    }
    for segment in text::segments(&string.text) {
        for meta in text::meta_ranges(&string.text[segment.clone()]) {
            let range = segment.start + meta.start..segment.start + meta.end;
            let written = &string.text[range.clone()];
            let Some(near) = near_miss(written, known) else { continue };
            let message = format!("{} is nearly a blend of emotions, and is read as meta", escape::quoted(written));
            let note = near.note.map(|note| format!(" Put the note into its own braces: {{{}}}", escape::text(note)));
            let help = format!("did you mean `{{{}}}`?{}", near.meant, note.unwrap_or_default());
            let rest = near.note.map(|note| format!(" {{{note}}}")).unwrap_or_default();
            let (span, meant) = (string.span_of(range), format!("{{{}}}{rest}", near.meant));
            found.push(Diagnostic::at(Code::NearEmotion, span, message).help(help).suggest(span, inside(&meant)));
        }
    }
    found
}

/// Returns the diagnostic for the first emotion of a translation that differs from the voice's.
pub(super) fn difference(
    string: &JsonString<'_>,
    markup: &[Markup<'_>],
    of_voice: &[Markup<'_>],
    options: &Options,
) -> Option<Diagnostic> {
    let face = |mark: &Markup<'_>| -> (usize, Face) { (mark.segment, options.emotions.face(&mark.blend)) };
    let at =
        (0..markup.len().max(of_voice.len())).find(|&at| markup.get(at).map(face) != of_voice.get(at).map(face))?;
    let span = markup.get(at).map_or(string.span(), |mark| string.span_of(mark.range.clone()));
    let message = match (markup.get(at), of_voice.get(at)) {
        (Some(_), Some(voice)) => {
            format!("the text of the voice has a different emotion here, in segment {}", voice.segment)
        }
        (Some(_), None) => "the text of the voice does not have this emotion".to_owned(),
        _ => format!("the text of the voice has {} emotions, but this text has {}", of_voice.len(), markup.len()),
    };
    Some(
        Diagnostic::at(Code::EmotionLocales, span, message)
            .note(
                "lipz uses the emotions of the voice: those of the text in the spoken locale, or else in the default \
                    locale, or else of the first text that has any",
            )
            .help("remove the emotions from the translation, or repeat those of the voice"),
    )
}
