//! Emotions in texts and events: their diagnostics, and the curves that they become.

mod allowed_names;
mod faces;
mod keys;
mod markup;
mod of_file;

use super::ClipSpeech;
use super::elements::Roles;
use super::word_clock::WordClock;
use crate::clip::{ClipData, Locales};
use crate::project::Options;
use crate::project::options::EmotionCurves;
use allowed_names::AllowedNames;
use faces::{Changes, FaceBlend, Faces, MOST};
use lipz_diagnostics::{Code, Diagnostic, Span, escape};
use lipz_file::emotion::{Blend, Term};
use lipz_file::{JsonString, event, text};
use markup::Markup;
pub(super) use of_file::sums;

/// Adds the curves of the emotions in a clip's texts and events, unless the file has curves with these names.
pub(super) fn curves(
    roles: &Roles<'_>,
    options: &Options,
    spoken: ClipSpeech<'_>,
    locales: &Locales,
    clip: &mut ClipData,
    diagnostics: &mut Vec<Diagnostic>,
) {
    if options.emotions.curves == EmotionCurves::Off {
        return;
    }
    let known = AllowedNames::new(options);
    let mut faces = Faces::new(clip, options);
    if let Some(events) = roles.events.filter(|_| !clip.has_joined) {
        for (segment, range) in text::segments(&events.text).enumerate() {
            for (event, blend) in event::feelings(&events.text[range.clone()]) {
                let span = |term: &Term<'_>| span_of(events, range.start, term);
                known.faults(&blend, Some(event.command.object()), &span, &mut faces.found);
                let whole = span_of_blend(events, range.start, &blend);
                let character = event.character.map(|word| word.text);
                faces.change(character, faces.clip.segment_start(segment), &blend, whole, &span);
            }
        }
    }
    let may_have_meta = !options.literal_braces && !clip.has_joined;
    // The first text with emotions is the text of the voice. Only the first text of all is spoken.
    let mut voice: Option<(&JsonString<'_>, Vec<Markup<'_>>, bool)> = None;
    for (number, text) in roles.texts_by_voice(options, spoken, locales).into_iter().enumerate() {
        if !may_have_meta {
            break;
        }
        diagnostics.extend(markup::near_misses(text.string, &known));
        let markup = Markup::all(&text.string.text, &known);
        match &voice {
            _ if markup.is_empty() => {}
            None => voice = Some((text.string, markup, number == 0)),
            Some((_, of_voice, _)) => faces.found.extend(markup::difference(text.string, &markup, of_voice, options)),
        }
    }
    if let Some((string, markup, is_spoken)) = &voice {
        let clock = WordClock::new(clip, &string.text, options.literal_braces, spoken.times);
        for mark in markup {
            let span = |term: &Term<'_>| span_of(string, mark.start, term);
            known.faults(&mark.blend, None, &span, &mut faces.found);
            let whole = string.span_of(mark.range.clone());
            if *is_spoken && spoken.times.is_some_and(|times| !times.is_empty()) {
                faces.found.extend(untimed(string, mark, &clock));
            }
            faces.change(None, faces.at(mark, &clock), &mark.blend, whole, &span);
        }
    }
    if !faces.has_value && options.emotions.curves == EmotionCurves::Values {
        return;
    }
    let (curves, found) = faces.into_curves();
    // Without visemes, the times are not known yet, so that there are no curves.
    let is_said = |diagnostic: &Diagnostic| clip.has_visemes || diagnostic.code != Code::EmotionHidden;
    diagnostics.extend(found.into_iter().filter(is_said));
    clip.curves.add_missing(curves);
}

/// Returns the diagnostic for an emotion at a word whose time is unknown, in a text with known times.
fn untimed(string: &JsonString<'_>, mark: &Markup<'_>, clock: &WordClock<'_>) -> Option<Diagnostic> {
    let letter = clock.next_letter(mark.segment, mark.range.end).filter(|_| mark.is_behind_word)?;
    if clock.word_at(letter).is_some() {
        return None;
    }
    let rest = &string.text[letter..];
    let word = &rest[..rest.find(|c: char| !c.is_alphanumeric()).unwrap_or(rest.len())];
    let message = format!("the time of {} is unknown, so the start of the emotion is estimated", escape::quoted(word));
    let note = "lipz-sync.txt has the times of other words of this text";
    let found = Diagnostic::at(Code::UntimedEmotion, string.span_of(mark.range.clone()), message).note(note);
    Some(found.help("run `lipz sync` to find the word in the recording"))
}

/// An emotion in the events of a segment.
#[derive(Clone, Debug)]
pub(super) struct Feeling {
    /// The character who feels it; `None` for the speaker.
    character: Option<String>,
    felt: FaceBlend,
    has_value: bool,
}

/// Returns the emotions in the events of a segment that is [clean](is_clean).
pub(super) fn feelings_of(segment: &str, options: &Options) -> Vec<Feeling> {
    if options.emotions.curves == EmotionCurves::Off {
        return Vec::new();
    }
    let feeling = |(event, blend): (event::Event<'_>, Blend<'_>)| Feeling {
        character: event.character.map(|word| word.text.to_owned()),
        felt: FaceBlend::new(&blend, options),
        has_value: blend.has_value(),
    };
    event::feelings(segment).map(feeling).collect()
}

/// Adds the curves of these emotions to a clip. Each emotion has the number of its segment. Returns false if there is a
/// diagnostic.
pub(super) fn of_clean_events(clip: &mut ClipData, feelings: &[(usize, Feeling)], options: &Options) -> bool {
    let mut changes = Changes::new();
    let mut has_value = false;
    for (segment, feeling) in feelings {
        let change = feeling.felt.change(clip.segment_start(*segment), clip);
        if clip.has_visemes && change.frame as usize >= clip.frames.len() {
            return false;
        }
        has_value |= feeling.has_value;
        changes.entry(feeling.character.clone()).or_default().push(change);
    }
    if has_value || options.emotions.curves == EmotionCurves::All {
        clip.curves.add_missing(keys::curves(changes, clip.frames.len() as u32));
    }
    true
}

/// Whether the emotions in the events of a segment do not need a diagnostic.
pub(super) fn is_clean(segment: &str, options: &Options) -> bool {
    let known = AllowedNames::new(options);
    options.emotions.curves == EmotionCurves::Off
        || event::feelings(segment).all(|(_, blend)| {
            let is_clean = |term: &Term<'_>| known.is_clean(term) && !faces::is_outside(term);
            blend.terms.iter().all(is_clean) && faces::sum(&options.emotions.face(&blend)) <= MOST
        })
}

/// Whether meta, including its braces, is a blend of emotions, or nearly one.
pub(super) fn are_in_text(meta: &str, options: &Options) -> bool {
    let known = AllowedNames::new(options);
    options.emotions.curves != EmotionCurves::Off
        && (!Markup::all(meta, &known).is_empty() || markup::near_miss(meta, &known).is_some())
}

fn span_of(string: &JsonString<'_>, start: usize, term: &Term<'_>) -> Span {
    let range = term.name.range();
    string.span_of(start + range.start..start + range.end)
}

/// Returns the span from the first name of a blend to its last.
fn span_of_blend(string: &JsonString<'_>, start: usize, blend: &Blend<'_>) -> Span {
    let range = |term: &Term<'_>| term.name.range();
    let first = blend.terms.first().map_or(0, |term| range(term).start);
    let last = blend.terms.last().map_or(0, |term| range(term).end);
    string.span_of(start + first..start + last)
}
