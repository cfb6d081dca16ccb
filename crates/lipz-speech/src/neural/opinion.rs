//! A second check whether a script matches the recording: compares the phones found by the network with those of the
//! script.

use super::hear::RecognisedWords;
use crate::pronounce::ipa_phones;
use crate::{Alignment, Mismatch, MismatchKind, Phone, Script};
use std::ops::Range;

/// Limits of the difference between a script and a recording, in nats or wrong phones.
struct Limits {
    /// The difference per phone, and the difference of any script on top of it, above which a script does not match.
    other_script: (f32, f32),
    /// The difference per phone up to which words match, whatever the aligner reports.
    same_words: f32,
}

/// The limits of [`PhoneCosts::of_script`](super::phone_costs::PhoneCosts::of_script), in nats, chosen with 600 human
/// announcements in five languages. Of 1,550 others, lipz reports 1,463 with a different script (1,309 without the
/// network), and 41 with their own (40).
const OF_COSTS: Limits = Limits { other_script: (4.0, 20.0), same_words: 3.0 };
/// The limits of shares of wrong phones. With their own scripts, 1 of 123 recordings in nine languages is above 0.72;
/// with those of other recordings, all but 3 of 680 are.
const OF_ERRORS: Limits = Limits { other_script: (0.72, 0.0), same_words: 0.62 };
/// The most pairs of phones in the script and in the recording that are compared: those of six minutes, in 16
/// megabytes.
const MOST_PAIRS: usize = 16 << 20;

impl RecognisedWords {
    /// Returns the places where audio and script differ, according to the network. It drops mismatches of the aligner
    /// for words that the network found, and reports the whole script if that does not match. Recordings of more than
    /// about a minute (the built-in network) or six minutes (other networks) keep the aligner's result.
    pub fn mismatches(&self, script: &Script, alignment: &Alignment) -> Vec<Mismatch> {
        let heard: Vec<Phone> = self.words().filter_map(|word| ipa_phones(word).ok()).flatten().collect();
        let (said, words) = phones_of(script, alignment);
        let Some((differences, limits)) = self.differences(&said, &heard) else {
            return alignment.mismatches.clone();
        };
        let all: f32 = differences.iter().sum();
        let (per_phone, more) = limits.other_script;
        if all > per_phone * said.len().max(heard.len()) as f32 + more {
            let (start_us, end_us) = spoken(alignment);
            return vec![Mismatch { kind: MismatchKind::OtherWords, words: 0..script.words.len(), start_us, end_us }];
        }
        let is_heard = |found: &Mismatch| {
            let phones = words.get(found.words.clone()).and_then(|words| Some(words.first()?.start..words.last()?.end));
            let phones = phones.filter(|phones| !phones.is_empty()).unwrap_or_default();
            let difference: f32 = differences.get(phones.clone()).unwrap_or_default().iter().sum();
            !phones.is_empty() && difference <= limits.same_words * phones.len() as f32
        };
        alignment.mismatches.iter().filter(|found| !is_heard(found)).cloned().collect()
    }

    /// Returns the difference of each phone in the script from the recording, and its limits.
    fn differences(&self, said: &[Phone], heard: &[Phone]) -> Option<(Vec<f32>, Limits)> {
        if said.is_empty() {
            return None;
        }
        if !self.costs.is_empty() {
            // A network that finds no phones cannot tell which they are.
            return Some((self.costs.of_script(said)?, OF_COSTS)).filter(|_| !heard.is_empty());
        }
        let is_short = (said.len() + 1).saturating_mul(heard.len() + 1) <= MOST_PAIRS;
        is_short.then(|| (errors(said, heard).into_iter().map(|errors| errors as f32).collect(), OF_ERRORS))
    }
}

/// Returns the phones of a script as pronounced in the recording, or as they could be for missing words, and the range
/// of phones of each word.
fn phones_of(script: &Script, alignment: &Alignment) -> (Vec<Phone>, Vec<Range<usize>>) {
    let mut phones = Vec::new();
    let mut words = Vec::with_capacity(script.words.len());
    for (number, word) in script.words.iter().enumerate() {
        let start = phones.len();
        let chosen = alignment.words.get(number).and_then(|word| word.pronunciation).unwrap_or(0);
        if let Some(pronunciation) = word.pronunciations.get(chosen) {
            phones.extend(pronunciation.phones.iter().copied().filter(|phone| phone.is_speech()));
        }
        words.push(start..phones.len());
    }
    (phones, words)
}

/// Returns the start of the first and the end of the last speech, in microseconds.
fn spoken(alignment: &Alignment) -> (u64, u64) {
    let is_sound = |phone: &&crate::AlignedPhone| phone.phone != Phone::Sil;
    let first = alignment.phones.iter().find(is_sound).map_or(0, |phone| phone.start_us);
    let last = alignment.phones.iter().rev().find(is_sound).map_or(alignment.duration_us, |phone| phone.end_us);
    (first, last)
}

/// Returns, by phone of `said`, the number of edits from `said` to `heard`: substitutions, deletions, and insertions
/// before the next phone (Levenshtein distance, V. Levenshtein, 1965). Insertions before the first phone count for it.
fn errors(said: &[Phone], heard: &[Phone]) -> Vec<u32> {
    const OTHER: u8 = 0;
    const NONE: u8 = 1;
    const MORE: u8 = 2;
    let width = heard.len() + 1;
    let mut ways = vec![MORE; (said.len() + 1) * width];
    let mut costs: Vec<u32> = (0..).take(width).collect();
    for (row, phone) in said.iter().enumerate() {
        let mut diagonal = costs[0];
        costs[0] += 1;
        ways[(row + 1) * width] = NONE;
        for (column, other) in heard.iter().enumerate() {
            let choices = [
                (diagonal + u32::from(phone != other), OTHER),
                (costs[column + 1] + 1, NONE),
                (costs[column] + 1, MORE),
            ];
            let (cost, way) = choices.into_iter().min().unwrap_or_default();
            diagonal = std::mem::replace(&mut costs[column + 1], cost);
            ways[(row + 1) * width + column + 1] = way;
        }
    }
    let mut errors = vec![0; said.len()];
    let (mut row, mut column) = (said.len(), heard.len());
    while row > 0 || column > 0 {
        let last = row.saturating_sub(1);
        match ways[row * width + column] {
            OTHER => {
                errors[last] += u32::from(said[row - 1] != heard[column - 1]);
                (row, column) = (row - 1, column - 1);
            }
            NONE => {
                errors[last] += 1;
                row -= 1;
            }
            _ => {
                errors.get_mut(last).into_iter().for_each(|errors| *errors += 1);
                column -= 1;
            }
        }
    }
    errors
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::align::tests::script;
    use crate::{AlignedPhone, AlignedWord, Recogniser};

    fn phones(names: &str) -> Vec<Phone> {
        names.split_whitespace().map(|name| name.parse().unwrap()).collect()
    }

    #[test]
    fn changes_are_counted_where_they_are() {
        let errors = |said: &str, heard: &str| errors(&phones(said), &phones(heard));
        assert_eq!(errors("K AE T", "K AE T"), [0, 0, 0]);
        assert_eq!(errors("K AE T", "K EH T"), [0, 1, 0]);
        assert_eq!(errors("K AE T", "K T"), [0, 1, 0]);
        assert_eq!(errors("K AE T", "K AE S T"), [0, 1, 0]);
        assert_eq!(errors("K AE T", "S K AE T"), [1, 0, 0]);
        assert_eq!(errors("K AE T", ""), [1, 1, 1]);
        assert_eq!(errors("K", "M AA M AA"), [4]);
    }

    /// Returns a script of two words, and an alignment in which these are reported as missing.
    fn aligned(mismatches: Vec<Mismatch>) -> (Script, Alignment) {
        let script = script(&[&["M AA M AA"], &["F UW SH"]]);
        let phone = |phone, start_us, end_us| AlignedPhone { phone, start_us, end_us, word: None, fit: 0.0 };
        let word = AlignedWord { start_us: 0, end_us: 0, pronunciation: Some(0), confidence: 0.1 };
        let alignment = Alignment {
            duration_us: 900,
            phones: vec![phone(Phone::Sil, 0, 100), phone(Phone::Aa, 100, 700), phone(Phone::Sil, 700, 900)],
            words: vec![word; 2],
            breaks_us: Vec::new(),
            mismatches,
        };
        (script, alignment)
    }

    fn of(kind: MismatchKind, words: Range<usize>) -> Mismatch {
        Mismatch { kind, words, start_us: 100, end_us: 700 }
    }

    #[test]
    fn what_is_heard_is_no_mismatch_and_another_script_is_one_altogether() {
        let doubts = vec![
            of(MismatchKind::NotSaid, 0..1),
            of(MismatchKind::OtherWords, 1..2),
            of(MismatchKind::NotInScript, 2..2),
        ];
        let (script, alignment) = aligned(doubts.clone());
        let found = |words: &[&str]| RecognisedWords::of_words(words).mismatches(&script, &alignment);
        assert_eq!(found(&["mama", "fuʃ"]), doubts[2..], "what is not in the script has no phones to be heard");
        assert_eq!(found(&["mama", "kitik"]), doubts[1..]);
        assert_eq!(found(&["sistikiteksi"]), [of(MismatchKind::OtherWords, 0..2)]);
        assert_eq!(found(&[]), [of(MismatchKind::OtherWords, 0..2)]);
        let long: Vec<&str> = vec!["mama"; MOST_PAIRS / 8 / 4 + 1];
        assert_eq!(found(&long), doubts, "nobody compares hours");
    }

    #[test]
    fn a_network_that_finds_nothing_compares_nothing() {
        let doubts = vec![of(MismatchKind::NotSaid, 0..1)];
        let silence = Recogniser::built_in().hear_samples(&[0.0; 16_000]);
        let (script, alignment) = aligned(doubts.clone());
        assert_eq!(silence.mismatches(&script, &alignment), doubts);
    }
}
