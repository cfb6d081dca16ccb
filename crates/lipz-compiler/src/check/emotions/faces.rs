//! The changes of faces that a clip's emotions cause, and the diagnostics about them.

use super::keys::{self, BlendChange};
use super::markup::Markup;
use crate::check::word_clock::WordClock;
use crate::clip::ClipData;
use crate::project::Options;
use crate::project::options::Face;
use lipz_bank::Micros;
use lipz_bank::curve::CurveValue;
use lipz_bank::face::Emotion;
use lipz_diagnostics::{Code, Diagnostic, Span, escape};
use lipz_file::emotion::{Blend, Term};
use std::collections::BTreeMap;

/// The maximum value of an attribute, and the maximum sum of all attributes, in thousandths.
pub(super) const MOST: i32 = 10_000;

/// The changes of each character. The key of the speaker is `None`.
pub(super) type Changes = BTreeMap<Option<String>, Vec<BlendChange>>;

/// The face that a blend means in a project.
#[derive(Clone, Debug)]
pub(super) struct FaceBlend {
    face: Face,
    over_ms: u32,
    /// Whether the file sets the duration of the change.
    is_timed: bool,
}

impl FaceBlend {
    pub(super) fn new(blend: &Blend<'_>, options: &Options) -> FaceBlend {
        FaceBlend {
            face: options.emotions.face(blend),
            over_ms: blend.over_ms.unwrap_or(options.emotions.over_ms),
            is_timed: blend.over_ms.is_some(),
        }
    }

    /// Returns the change that the blend causes from a frame on. A clip starts with its first faces, because the previous
    /// line may have ended with them. They grow only if the file sets a duration.
    pub(super) fn change(&self, frame: u32, clip: &ClipData) -> BlendChange {
        let frames = |fps: lipz_bank::Fps| fps.frame_at(Micros(i64::from(self.over_ms) * 1000)).unwrap_or(0);
        let is_there = self.over_ms == 0 || frame == 0 && !self.is_timed;
        let over = if is_there { 0 } else { clip.fps.map_or(0, frames).max(1) };
        BlendChange { frame, face: self.face, over }
    }
}

/// Whether a term has a value that a face cannot show.
pub(super) fn is_outside(term: &Term<'_>) -> bool {
    term.thousandths.is_some_and(|value| !(0..=MOST).contains(&value))
}

/// Returns the sum of all attributes.
pub(super) fn sum(face: &Face) -> i32 {
    face.iter().fold(0, |sum: i32, value| sum.saturating_add(*value))
}

/// Returns the name of a frame for messages.
pub(super) fn when(clip: &ClipData, frame: u32) -> String {
    match clip.fps {
        Some(fps) => format!("frame {frame} ({:.2} s)", fps.start_of_frame_us(frame) as f64 / 1e6),
        None => format!("frame {frame}"),
    }
}

/// The changes of faces that a clip's emotions cause.
pub(super) struct Faces<'c> {
    pub(super) clip: &'c ClipData,
    options: &'c Options,
    changes: Changes,
    /// For each character and emotion, the first position that makes it show.
    places: BTreeMap<Option<String>, [Option<Span>; Emotion::ALL.len()]>,
    pub(super) has_value: bool,
    pub(super) found: Vec<Diagnostic>,
}

impl<'c> Faces<'c> {
    pub(super) fn new(clip: &'c ClipData, options: &'c Options) -> Faces<'c> {
        Faces { clip, options, changes: BTreeMap::new(), places: BTreeMap::new(), has_value: false, found: Vec::new() }
    }

    /// Returns the frame of a mark. It is the start of the next word, which the clock estimates if the time of that word
    /// is unknown. A mark before the first word is valid from the start of the segment.
    pub(super) fn at(&self, mark: &Markup<'_>, clock: &WordClock<'_>) -> u32 {
        if !mark.is_behind_word {
            return self.clip.segment_start(mark.segment);
        }
        let next = clock.next_letter(mark.segment, mark.range.end).and_then(|letter| clock.word_at(letter));
        match next {
            Some(word) => clock.frame_at(mark.segment, word.start_ms),
            None => clock.share(mark.segment, mark.range.end),
        }
    }

    /// Adds a change of a character's face at a frame, and the diagnostics about it.
    pub(super) fn change(
        &mut self,
        character: Option<&str>,
        frame: u32,
        blend: &Blend<'_>,
        whole: Span,
        span: &impl Fn(&Term<'_>) -> Span,
    ) {
        self.has_value |= blend.has_value();
        for term in blend.terms.iter().filter(|term| is_outside(term)) {
            let value = CurveValue::from_thousandths(term.thousandths.unwrap_or(0));
            let message = format!("{} {value} is outside 0 to 10", term.name.text);
            self.found.push(Diagnostic::at(Code::EmotionValue, span(term), message).help("write a value from 0 to 10"));
        }
        let change = FaceBlend::new(blend, self.options).change(frame, self.clip);
        self.found.extend(self.over_the_top(&change.face, frame, whole));
        if self.clip.has_visemes && frame as usize >= self.clip.frames.len() && sum(&change.face) > 0 {
            let message = "the emotion starts at the end of the clip and makes no curve";
            self.found.push(
                Diagnostic::at(Code::EmotionHidden, whole, message).help("move it to an earlier segment, or remove it"),
            );
        }
        let who = character.map(str::to_owned);
        let first = self.places.entry(who.clone()).or_default();
        for (first, value) in std::iter::zip(first, &change.face) {
            *first = first.or_else(|| (*value != 0).then_some(whole));
        }
        self.changes.entry(who).or_default().push(change);
    }

    /// Returns the diagnostic for a face whose attributes add up to more than a face can show.
    fn over_the_top(&self, face: &Face, frame: u32, whole: Span) -> Option<Diagnostic> {
        // A value that is too large by itself has been reported already.
        if sum(face) <= MOST || face.iter().any(|value| *value > MOST) {
            return None;
        }
        Some(too_much(face, self.clip, frame, whole))
    }

    /// Returns the curves by name, and all diagnostics.
    pub(super) fn into_curves(mut self) -> (BTreeMap<String, Vec<keys::Key>>, Vec<Diagnostic>) {
        let curves = keys::curves(self.changes, self.clip.frames.len() as u32);
        for (name, keys) in self.clip.curves.iter() {
            let is_still = keys.windows(2).all(|pair| pair[0].1 == pair[1].1);
            if !is_still || !curves.contains_key(name) {
                continue;
            }
            let (who, emotion) = name.rsplit_once('.').map_or((None, name), |(who, emotion)| (Some(who), emotion));
            let place = |emotion: Emotion| self.places.get(&who.map(str::to_owned))?[emotion as usize];
            if let Some(span) = Emotion::from_name(emotion).and_then(place) {
                let quoted = escape::quoted(name);
                let message = format!("the constant curve {quoted} of the file hides the emotion {emotion}");
                self.found.push(
                    Diagnostic::at(Code::EmotionHidden, span, message)
                        .help("write the emotion into the curve, or remove one of the two"),
                );
            }
        }
        (curves, self.found)
    }
}

/// Returns the diagnostic for emotions that add up to more than a face can show.
pub(super) fn too_much(face: &Face, clip: &ClipData, frame: u32, span: Span) -> Diagnostic {
    let parts = Emotion::ALL.iter().filter(|emotion| face[**emotion as usize] != 0);
    let parts =
        parts.map(|emotion| format!("{} {}", emotion.name(), CurveValue::from_thousandths(face[*emotion as usize])));
    let note = parts.collect::<Vec<_>>().join(" + ");
    let sum = CurveValue::from_thousandths(sum(face));
    let message = format!("the emotions add up to {sum} from {} on", when(clip, frame));
    Diagnostic::at(Code::EmotionSum, span, message)
        .note(note)
        .help("keep the sum at 10 or below, such as 3.3 for each of three emotions; a face shows their sum")
}

#[cfg(test)]
mod tests {
    use super::*;
    use lipz_file::event;

    /// Only one position is kept per character and emotion, however often the emotion appears.
    #[test]
    fn one_place_is_kept_of_each_emotion_of_a_character() {
        let (clip, options) =
            (ClipData { frames: vec![b'-'; 9], starts: vec![0], ..ClipData::default() }, Options::default());
        let mut faces = Faces::new(&clip, &options);
        let feels = |faces: &mut Faces<'_>, events: &str, at: usize| {
            let span = |_: &Term<'_>| Span::new(at, at + 1);
            for (event, blend) in event::feelings(events) {
                faces.change(event.character.map(|word| word.text), 0, &blend, Span::new(at, at + 1), &span);
            }
        };
        (0..1000).for_each(|at| feels(&mut faces, "feels joy, amy feels joy + sad", at));
        assert_eq!(faces.places.values().flatten().flatten().count(), 3, "joy of both, and Amy's sadness");
        assert!(
            faces.places.values().all(|places| places[Emotion::Joy as usize] == Some(Span::new(0, 1))),
            "the first"
        );
    }
}
