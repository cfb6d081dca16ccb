//! The gestures that a text calls for.

use super::clock::Clock;
use super::lists::Lists;
use super::shapes::Kind;
use super::words::{Word, Words};
use super::{Gesture, MOST};
use crate::clip::{ClipData, Key};
use crate::options::Gestures;
use lipz_bank::curve::CurveValue;
use lipz_bank::face::Emotion;

/// Words of the longest phrase in the lists.
const LONGEST_PHRASE: usize = 5;

/// How far the head goes down at a stressed word, of 10; how far brows and shoulders of a face go up, of 1.
const STRESS: i32 = 1500;
const STRESSED_BROWS: i32 = 600;
const ASKING_BROWS: i32 = 400;
const SHRUG: i32 = 600;

const EXCLAMATION_MARKS: &[char] = &['!', '！', '՜'];
const QUESTION_MARKS: &[char] = &['?', '？', '؟', '፧', '՞'];
/// In Greek, that of questions looks like a semicolon, and is written with one.
const GREEK_QUESTION_MARKS: &[char] = &[';', '\u{37E}', '?'];
const GREEK: &str = "el";

/// Adds the nods, shakes and shrugs of the words in a text, whose language has these `lists`.
pub(super) fn of_lists(words: &Words<'_>, lists: &Lists, clock: &Clock<'_>, own: &Gestures, to: &mut Vec<Gesture<'_>>) {
    let lower: Vec<String> = words.words.iter().map(Word::lower_case).collect();
    let mut next = 0;
    for (number, word) in words.words.iter().enumerate() {
        if number < next {
            continue;
        }
        let more = words.words[number..].iter().take(LONGEST_PHRASE - 1).take_while(|word| word.leads_on()).count();
        let Some(found) = lists.longest(&lower[number..=number + more]) else { continue };
        next = number + found.word_count;
        let strength = if found.kind == Kind::Shrug { SHRUG } else { own.nods_thousandths };
        to.push(Gesture::new(found.kind, clock.start(word, found.letters_before), strength));
    }
}

/// Adds what brows and head do at stressed words, and brows at the ends of questions, in a text of this locale.
pub(super) fn of_stress(words: &Words<'_>, tag: &str, clock: &Clock<'_>, to: &mut Vec<Gesture<'_>>) {
    let is_greek = tag.split('-').next() == Some(GREEK);
    let asks = |word: &Word<'_>| match is_greek {
        true => word.is_followed_by(GREEK_QUESTION_MARKS),
        false => word.is_before(QUESTION_MARKS),
    };
    let mut segment = usize::MAX;
    let mut has_small_letters = false;
    for (number, word) in words.words.iter().enumerate() {
        if word.segment != segment {
            segment = word.segment;
            let mut of_segment = words.words[number..].iter().take_while(|word| word.segment == segment);
            has_small_letters = of_segment.any(Word::has_small_letters);
        }
        // Who writes all in capitals stresses nothing with them.
        let is_capital = has_small_letters && word.is_in_capitals();
        if is_capital || word.is_marked() || word.is_before(EXCLAMATION_MARKS) {
            let frame = clock.start(word, 0);
            to.push(Gesture::new(Kind::Stress, frame, STRESS));
            to.push(Gesture::new(Kind::Brows, frame, STRESSED_BROWS));
        } else if asks(word) {
            to.push(Gesture::new(Kind::Brows, clock.start(word, 0), ASKING_BROWS));
        }
    }
}

/// Adds a breath behind each sentence of a clip, deeper with exertion or fear.
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
            to.push(Gesture::new(Kind::Breath, frame, calm + (MOST - calm) * (effort / 10) / (MOST / 10)));
        }
    }
}

/// The value of the speaker's emotion at a frame, in thousandths.
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
