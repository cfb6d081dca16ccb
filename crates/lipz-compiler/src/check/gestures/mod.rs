//! Curves for the movements of faces during speech and pauses: nods and shakes of the head, breath, brows, shrugs.

mod clock;
mod events;
mod gesture;
mod keys;
mod lists;
mod pauses;
mod poses;
mod said;
mod shapes;
mod words;

use super::ClipSpeech;
use super::elements::Roles;
use super::word_clock::WordClock;
use crate::clip::{ClipData, Key, Locales};
use crate::project::Options;
use crate::project::options::GestureKeys;
use clock::Clock;
pub(super) use events::are_in_events;
use gesture::Gesture;
use lipz_bank::Fps;
use lipz_bank::face::FaceCurve;
use lipz_diagnostics::Diagnostic;
use lists::Lists;
use words::Words;

/// Adds the curves of gestures to the clip, whose emotions are known, unless its file has curves with these names.
pub(super) fn curves(
    roles: &Roles<'_>,
    options: &Options,
    spoken: ClipSpeech<'_>,
    locales: &Locales,
    clip: &mut ClipData,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let keys = options.gestures.keys;
    if keys == GestureKeys::Off || !clip.has_visemes {
        return;
    }
    let events = roles.events.filter(|_| !clip.has_joined);
    let of_events = events.map(|events| events::of_events(events, clip, &options.gestures, diagnostics));
    let of_events = of_events.unwrap_or_default();
    let Some(fps) = clip.fps else { return diagnostics.extend(of_events.first().map(events::without_fps)) };
    let mut gestures: Vec<Gesture<'_>> = of_events.iter().map(|(gesture, _)| *gesture).collect();
    let mut poses = Vec::new();
    if keys == GestureKeys::Words {
        poses = of_words(roles, options, spoken, locales, clip, fps, &mut gestures);
    }
    let (mut curves, moves) = keys::keys(&gestures, fps, clip.frames.len() as u32);
    if !poses.is_empty() {
        curves.insert(FaceCurve::Pose.name().to_owned(), poses);
    }
    for ((gesture, span), moves) in of_events.iter().zip(moves) {
        // A curve that moves there shows the gesture already, hand-edited or written by `lipz convert --write-curves`.
        let is_still = keys::are_still(gesture, fps, clip);
        if !moves || is_still {
            diagnostics.push(events::hidden(gesture, *span, is_still, clip));
        }
    }
    clip.curves.add_missing(curves);
}

/// Adds the speaker's gestures for the spoken words and the pauses. Returns the keys of poses.
fn of_words(
    roles: &Roles<'_>,
    options: &Options,
    spoken: ClipSpeech<'_>,
    locales: &Locales,
    clip: &ClipData,
    fps: Fps,
    to: &mut Vec<Gesture<'_>>,
) -> Vec<Key> {
    let mut poses = Vec::new();
    if let Some(text) = roles.texts_by_voice(options, spoken, locales).first().filter(|_| !clip.has_joined) {
        let words = Words::of(&text.string.text, options.literal_braces);
        let times = WordClock::new(clip, &text.string.text, options.literal_braces, spoken.times);
        let clock = Clock::new(times, &clip.frames);
        if let Some(lists) = Lists::of(locales.tag(text.locale)) {
            said::of_lists(&words, lists, &clock, &options.gestures, to);
        }
        said::of_stress(&words, locales.tag(text.locale), &clock, to);
        said::of_breath(&words, clip, &clock, &options.gestures, to);
        poses = poses::of_words(&words, clip, &clock, fps);
    }
    pauses::of_listening(clip, fps, to);
    poses
}
