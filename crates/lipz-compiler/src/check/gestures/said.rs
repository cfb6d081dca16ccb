//! The gestures for the words and marks of a text.

use super::clock::Clock;
use super::gesture::{Gesture, MOST};
use super::lists::Lists;
use super::shapes::GestureKind;
use super::words::{SpokenWord, Words};
use crate::clip::{ClipData, Key};
use crate::project::options::Gestures;
use lipz_bank::curve::CurveValue;
use lipz_bank::face::Emotion;

/// The maximum number of words of a phrase in the lists.
const LONGEST_PHRASE: usize = 5;

/// The strength of the head at a stressed word, on a scale to 10, and of the brows and shoulders, on a scale to 1, in
/// thousandths.
const STRESS: i32 = 1500;
const STRESSED_BROWS: i32 = 600;
const ASKING_BROWS: i32 = 400;
const SHRUG: i32 = 600;

const EXCLAMATION_MARKS: &[char] = &['!', '！', '՜'];
const QUESTION_MARKS: &[char] = &['?', '？', '؟', '፧', '՞'];
/// A Greek question mark looks like a semicolon, and is usually typed as one.
const GREEK_QUESTION_MARKS: &[char] = &[';', '\u{37E}', '?'];
const GREEK: &str = "el";

/// Adds the nods, shakes and shrugs for the words of a text that are in the `lists` of its language.
pub(super) fn of_lists(words: &Words<'_>, lists: &Lists, clock: &Clock<'_>, own: &Gestures, to: &mut Vec<Gesture<'_>>) {
    let lower: Vec<String> = words.words.iter().map(SpokenWord::lower_case).collect();
    let mut next = 0;
    for (number, word) in words.words.iter().enumerate() {
        if number < next {
            continue;
        }
        let more = words.words[number..].iter().take(LONGEST_PHRASE - 1).take_while(|word| word.leads_on()).count();
        let Some(found) = lists.longest(&lower[number..=number + more]) else { continue };
        next = number + found.word_count;
        let strength = if found.kind == GestureKind::Shrug { SHRUG } else { own.nods_thousandths };
        to.push(Gesture::new(found.kind, clock.start(word, found.letters_before), strength));
    }
}

/// Adds movements of brows and head at stressed words, and of brows at the ends of questions, for a text in this
/// locale.
pub(super) fn of_stress(words: &Words<'_>, tag: &str, clock: &Clock<'_>, to: &mut Vec<Gesture<'_>>) {
    let is_greek = tag.split('-').next() == Some(GREEK);
    let asks = |word: &SpokenWord<'_>| match is_greek {
        true => word.is_followed_by(GREEK_QUESTION_MARKS),
        false => word.is_before(QUESTION_MARKS),
    };
    let mut segment = usize::MAX;
    let mut has_small_letters = false;
    for (number, word) in words.words.iter().enumerate() {
        if word.segment != segment {
            segment = word.segment;
            let mut of_segment = words.words[number..].iter().take_while(|word| word.segment == segment);
            has_small_letters = of_segment.any(SpokenWord::has_small_letters);
        }
        // Capitals mark a stressed word only in a segment that is not all in capitals.
        let is_capital = has_small_letters && word.is_in_capitals();
        if is_capital || word.is_marked() || word.is_before(EXCLAMATION_MARKS) {
            let frame = clock.start(word, 0);
            to.push(Gesture::new(GestureKind::Stress, frame, STRESS));
            to.push(Gesture::new(GestureKind::Brows, frame, STRESSED_BROWS));
        } else if asks(word) {
            to.push(Gesture::new(GestureKind::Brows, clock.start(word, 0), ASKING_BROWS));
        }
    }
}

/// Adds a breath after each sentence of a clip. Exertion and fear make it deeper.
pub(super) fn of_breath(
    words: &Words<'_>,
    clip: &ClipData,
    clock: &Clock<'_>,
    own: &Gestures,
    to: &mut Vec<Gesture<'_>>,
) {
    let last = words.words.len().checked_sub(1);
    for (number, word) in words.words.iter().enumerate() {
        if word.ends_sentence() || Some(number) == last {
            let frame = clock.end(word);
            let effort = [Emotion::Exertion, Emotion::Fear].map(|emotion| value_of(emotion, clip, frame));
            let effort = effort.into_iter().max().unwrap_or(0).clamp(0, MOST);
            let calm = own.breath_thousandths;
            to.push(Gesture::new(GestureKind::Breath, frame, calm + (MOST - calm) * (effort / 10) / (MOST / 10)));
        }
    }
}

/// Returns the value of a speaker's emotion at a frame, in thousandths.
fn value_of(emotion: Emotion, clip: &ClipData, frame: u32) -> i32 {
    let Some((_, keys)) = clip.curves.iter().find(|(name, _)| *name == emotion.name()) else { return 0 };
    let next = keys.partition_point(|(at, _)| *at <= frame);
    let before = next.checked_sub(1).and_then(|before| keys.get(before));
    match (before, keys.get(next)) {
        (Some((at, value)), Some(to)) => between(*at, *value, to, frame),
        (Some((_, value)), None) | (None, Some((_, value))) => value.thousandths(),
        (None, None) => 0,
    }
}

fn between(at: u32, value: CurveValue, to: &Key, frame: u32) -> i32 {
    value.towards(to.1, u64::from(frame - at), u64::from(to.0 - at)).thousandths()
}
