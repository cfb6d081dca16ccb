//! Emotions in texts and events: what is wrong with them, and the curves that they become.

mod keys;
mod markup;

use super::Spoken;
use super::elements::Roles;
use super::share::share_of_segment;
use crate::clip::{ClipData, Locales};
use crate::options::{EmotionCurves, Face};
use crate::{KnownNames, Options, WordTime};
use keys::Change;
use lipz_bank::Emotion;
use lipz_diagnostics::{Code, Diagnostic, Span, escape, suggest};
use lipz_file::emotion::{Blend, Term};
use lipz_file::{JsonString, event, text};
use markup::Markup;
use std::collections::BTreeMap;

/// Highest value of an attribute, and highest sum of all, in thousandths.
const MOST: i32 = 10_000;

/// Gives the clip the curves of the emotions in its texts and events, unless its file has curves of those names.
pub(super) fn curves(
    roles: &Roles<'_>,
    options: &Options,
    spoken: Spoken<'_>,
    locales: &Locales,
    clip: &mut ClipData,
    diagnostics: &mut Vec<Diagnostic>,
) {
    if options.emotions.curves == EmotionCurves::Off {
        return;
    }
    let known = Known { options, names: &options.known_names };
    let mut faces = Faces { clip, options, changes: BTreeMap::new(), has_value: false, found: Vec::new() };
    if let Some(events) = roles.events.filter(|_| !clip.has_joined) {
        for (segment, range) in text::segments(&events.text).enumerate() {
            let parts = event::parts(&events.text[range.clone()]);
            for (event, blend) in parts.filter_map(event::Part::feeling) {
                let span = |term: &Term<'_>| span_of(events, range.start, term);
                known.unknown_terms(&blend, Some(event.command.object()), &span, &mut faces.found);
                let whole = span_of_blend(events, range.start, &blend);
                let character = event.character.map(|word| word.text);
                faces.change(character, faces.clip.segment_start(segment), &blend, whole, &span);
            }
        }
    }
    let may_have_meta = !options.literal_braces && !clip.has_joined;
    // The first text is that of the voice, if it has emotions; else the first one that has.
    let mut voice: Option<(&JsonString<'_>, Vec<Markup<'_>>)> = None;
    for text in roles.texts_by_voice(options, spoken, locales).into_iter().filter(|_| may_have_meta) {
        let markup = Markup::all(&text.string.text, &known);
        match &voice {
            _ if markup.is_empty() => {}
            None => voice = Some((text.string, markup)),
            Some((_, of_voice)) => faces.found.extend(markup::difference(text.string, &markup, of_voice, options)),
        }
    }
    if let Some((string, markup)) = &voice {
        let words = spoken.times.map(|times| times.of_text(&string.text)).unwrap_or_default();
        for mark in markup {
            let span = |term: &Term<'_>| span_of(string, mark.start, term);
            known.unknown_terms(&mark.blend, None, &span, &mut faces.found);
            let whole = string.span_of(mark.range.clone());
            faces.change(None, faces.at(mark, &words), &mark.blend, whole, &span);
        }
    }
    let Faces { changes, has_value, found, .. } = faces;
    if !has_value && options.emotions.curves == EmotionCurves::Values {
        return;
    }
    diagnostics.extend(found);
    keys::add(changes, clip);
}

/// Whether a face in the events of a segment becomes a curve.
pub(super) fn are_in_events(segment: &str, options: &Options) -> bool {
    become_curves(event::parts(segment).filter_map(event::Part::feeling).map(|(_, blend)| blend), options)
}

/// Whether a face in the meta of a text becomes a curve.
pub(super) fn are_in_text(text: &str, options: &Options) -> bool {
    let known = Known { options, names: &options.known_names };
    become_curves(Markup::all(text, &known).into_iter().map(|mark| mark.blend), options)
}

fn become_curves<'t>(mut blends: impl Iterator<Item = Blend<'t>>, options: &Options) -> bool {
    match options.emotions.curves {
        EmotionCurves::Off => false,
        EmotionCurves::Values => blends.any(|blend| blend.has_value()),
        EmotionCurves::All => blends.next().is_some(),
    }
}

/// The names of emotions.
struct Known<'o> {
    options: &'o Options,
    names: &'o KnownNames,
}

impl Known<'_> {
    fn has(&self, name: &str) -> bool {
        self.options.emotions.knows(name) || self.names.emotions.contains(name)
    }

    /// The name that was probably meant.
    fn nearest(&self, name: &str) -> Option<&str> {
        suggest::nearest(name, self.options.emotions.names().chain(self.names.emotions.iter().map(String::as_str)))
    }

    /// Reports the unknown emotions of a blend, but for the `object` of an event, which is reported with others.
    fn unknown_terms(
        &self,
        blend: &Blend<'_>,
        object: Option<Option<event::Word<'_>>>,
        span: &impl Fn(&Term<'_>) -> Span,
        found: &mut Vec<Diagnostic>,
    ) {
        let is_reported = |term: &&Term<'_>| object.flatten() == Some(term.name);
        for term in blend.terms.iter().filter(|term| !self.has(term.name.text) && !is_reported(term)) {
            let message = format!("{} is not a known emotion", escape::quoted(term.name.text));
            found.push(Diagnostic::at(Code::UnknownEmotion, span(term), message).help(
                match self.nearest(term.name.text) {
                    Some(near) => format!("did you mean {}?", escape::quoted(near)),
                    None => {
                        "docs/FACE.md lists the emotions; a project adds its own in [emotions] of lipz.toml".to_owned()
                    }
                },
            ));
        }
    }
}

fn span_of(string: &JsonString<'_>, start: usize, term: &Term<'_>) -> Span {
    let range = term.name.range();
    string.span_of(start + range.start..start + range.end)
}

/// From the first name to the last.
fn span_of_blend(string: &JsonString<'_>, start: usize, blend: &Blend<'_>) -> Span {
    let range = |term: &Term<'_>| term.name.range();
    let first = blend.terms.first().map_or(0, |term| range(term).start);
    let last = blend.terms.last().map_or(0, |term| range(term).end);
    string.span_of(start + first..start + last)
}

/// What becomes of a clip's emotions.
struct Faces<'c> {
    clip: &'c ClipData,
    options: &'c Options,
    /// By character, the speaker without a name.
    changes: BTreeMap<Option<String>, Vec<Change>>,
    has_value: bool,
    found: Vec<Diagnostic>,
}

impl Faces<'_> {
    /// The frame of a mark: when the word behind it starts, if that is known; else its share of the segment, by the letters
    /// before it. What stands before the first word holds from the start of the segment.
    fn at(&self, mark: &Markup<'_>, words: &[WordTime]) -> u32 {
        let (start, end) = (self.clip.segment_start(mark.segment), self.clip.segment_start(mark.segment + 1));
        let is_inside = 0 < mark.letters_before && mark.letters_before < mark.letters;
        let next = words.get(words.partition_point(|word| word.range.start < mark.range.end)).filter(|_| is_inside);
        if let Some((next, fps)) = next.zip(self.clip.fps) {
            let frame = fps.frame_at(lipz_bank::Micros(i64::from(next.start_ms) * 1000)).unwrap_or(0);
            return frame.clamp(start, end);
        }
        share_of_segment(start..end, mark.letters_before, mark.letters)
    }

    /// Notes that a face changes at a frame, and what is wrong with that.
    fn change(
        &mut self,
        character: Option<&str>,
        frame: u32,
        blend: &Blend<'_>,
        whole: Span,
        span: &impl Fn(&Term<'_>) -> Span,
    ) {
        self.has_value |= blend.has_value();
        for term in &blend.terms {
            if let Some(value) = term.thousandths.filter(|value| !(0..=MOST).contains(value)) {
                let value = lipz_bank::CurveValue::from_thousandths(value);
                let message = format!("{} {value} is outside of 0 to 10", term.name.text);
                self.found.push(
                    Diagnostic::at(Code::EmotionValue, span(term), message)
                        .help("write a value from 0, nothing, to 10, the most that a face can show"),
                );
            }
        }
        let face = self.options.emotions.face(blend);
        self.found.extend(self.over_the_top(&face, frame, whole));
        let over_ms = blend.over_ms.unwrap_or(self.options.emotions.over_ms);
        let micros = u64::from(over_ms) * 1000;
        let over = self.clip.fps.map_or(0, |fps| fps.frame_at(lipz_bank::Micros(micros as i64)).unwrap_or(0));
        let over = if over_ms == 0 { 0 } else { over.max(1) };
        self.changes.entry(character.map(str::to_owned)).or_default().push(Change { frame, face, over });
    }

    /// The diagnostic for a face whose attributes add up to more than it can show.
    fn over_the_top(&self, face: &Face, frame: u32, whole: Span) -> Option<Diagnostic> {
        let sum: i32 = face.iter().fold(0, |sum: i32, value| sum.saturating_add(*value));
        // A value that is too large by itself is reported already.
        if sum <= MOST || face.iter().any(|value| *value > MOST) {
            return None;
        }
        let sum = lipz_bank::CurveValue::from_thousandths(sum);
        let when = match self.clip.fps {
            Some(fps) => format!("frame {frame} ({:.2} s)", fps.start_of_frame_us(frame) as f64 / 1e6),
            None => format!("frame {frame}"),
        };
        let parts = Emotion::ALL.iter().filter(|emotion| face[**emotion as usize] != 0).map(|emotion| {
            format!("{} {}", emotion.name(), lipz_bank::CurveValue::from_thousandths(face[*emotion as usize]))
        });
        let note = parts.collect::<Vec<_>>().join(" + ");
        let message = format!("the emotions add up to {sum} from {when} on");
        Some(Diagnostic::at(Code::EmotionSum, whole, message).note(note).help(
            "keep the sum at 10 or below, as 3.3 for each of three: more pulls a face apart, since emotions are added",
        ))
    }
}
