//! The confidence of an alignment, and the places where audio and script differ.

use super::{AlignedPhone, Alignment, Mismatch, MismatchKind};
use crate::Phone;
use std::ops::Range;

/// The fit, in nats per frame, at which a word is equally likely right and wrong, and the change of fit that multiplies
/// the odds by e. Measured on 1,200 words of correct scripts, of which 2 in 100 fit worse than -3.3 (English) and -5.5
/// (other languages), and as many words of wrong scripts, whose median is -4.0.
const EVEN_FIT: f32 = -3.0;
const ODDS_FIT: f32 = 0.6;

/// A worse fit than this is evidence for a mismatch, a better fit is evidence against it: the difference, in nats per
/// frame.
const BORDER_FIT: f32 = -2.8;
/// The least fit of the phones of a [drawn-out](crate::Word::is_drawn_out) word, in nats per frame: better than both of
/// these, because a hum or a cry is unlike the short sounds that the model knows, and lasts for many frames.
pub(super) const DRAWN_OUT_FIT: f32 = -2.7;
/// The evidence of a word that is missing from the audio, in nats.
const MISSING_NATS: f32 = 22.0;
/// The evidence of each frame of speech that is not in the script, in nats.
const UNWRITTEN_NATS: f32 = 1.1;
/// The total evidence for a mismatch, in nats: a second of different words, or four missing words.
const MISMATCH_NATS: f32 = 90.0;
/// The evidence against a mismatch that ends it, in nats.
const END_NATS: f32 = 45.0;
/// The evidence for a mismatch per phone, in nats, above which a second comparison is worth its time: 4 of 299 English
/// recordings with the right text have more, and 285 with a wrong one.
const UNCERTAIN_NATS: f32 = -4.0;
/// The length of a frame in microseconds, as a divisor.
const FRAME_US: f32 = 10_000.0;
/// A correctly transcribed word takes longer than this, in microseconds: 100 milliseconds.
const WORD_US: u64 = 100_000;

impl Alignment {
    /// Whether the audio fits the script so badly that it may be a different one, although the aligner found enough of it.
    /// [`RecognisedWords::mismatches`](crate::RecognisedWords::mismatches) then decides.
    pub fn is_uncertain(&self) -> bool {
        let nats: f32 = evidence(&self.phones, self.words.len()).iter().map(|part| part.nats).sum();
        let spoken = self.phones.iter().filter(|phone| phone.word.is_some()).count();
        !self.words.is_empty() && nats > UNCERTAIN_NATS * spoken as f32
    }
}

/// Returns the confidence of each of `words` words, from 0 to 1.
pub(super) fn confidences(phones: &[AlignedPhone], words: usize) -> Vec<f32> {
    let mut sums = vec![(0.0, 0.0); words];
    for phone in phones {
        if let Some((nats, frames)) = phone.word.and_then(|word| sums.get_mut(word)) {
            *nats += phone.fit * frames_of(phone);
            *frames += frames_of(phone);
        }
    }
    let confidence = |(nats, frames): (f32, f32)| match frames > 0.0 {
        true => 1.0 / (1.0 + libm::expf((EVEN_FIT - nats / frames) / ODDS_FIT)),
        false => 0.0,
    };
    sums.into_iter().map(confidence).collect()
}

/// A part of the alignment, with its evidence for a mismatch.
struct Evidence {
    nats: f32,
    words: Range<usize>,
    start_us: u64,
    end_us: u64,
    /// The length of the speech that is not in the script.
    unwritten_us: u64,
}

/// Returns the places where the audio differs from a script of `words` words.
pub(super) fn mismatches(phones: &[AlignedPhone], words: usize) -> Vec<Mismatch> {
    let mut found = Vec::new();
    let mut open: Option<(Evidence, f32)> = None;
    for part in evidence(phones, words) {
        let (sum, now) = match open.take() {
            None if part.nats <= 0.0 => continue,
            None => {
                let nats = part.nats;
                (part, nats)
            }
            Some((sum, now)) => {
                let now = now + part.nats;
                // The sum grows up to the part with the most evidence. Later parts may still add to it.
                let sum = if now > sum.nats { sum.until(&part, now) } else { sum };
                (sum, now)
            }
        };
        if now < sum.nats - END_NATS || now <= 0.0 {
            found.extend(sum.mismatch());
        } else {
            open = Some((sum, now));
        }
    }
    found.extend(open.and_then(|(sum, _)| sum.mismatch()));
    found
}

impl Evidence {
    fn until(self, part: &Evidence, nats: f32) -> Evidence {
        Evidence {
            nats,
            words: self.words.start..part.words.end.max(self.words.end),
            start_us: self.start_us,
            end_us: part.end_us,
            unwritten_us: self.unwritten_us + part.unwritten_us,
        }
    }

    fn mismatch(self) -> Option<Mismatch> {
        let heard_us = self.end_us - self.start_us;
        let kind = match self.words.len() as u64 {
            _ if self.nats < MISMATCH_NATS => return None,
            0 => MismatchKind::NotInScript,
            words if heard_us < words * WORD_US => MismatchKind::NotSaid,
            words if self.unwritten_us * 2 > heard_us && words * WORD_US * 2 < heard_us => MismatchKind::NotInScript,
            _ => MismatchKind::OtherWords,
        };
        Some(Mismatch { kind, words: self.words, start_us: self.start_us, end_us: self.end_us })
    }
}

/// Returns the words, spoken or not, and the unscripted speech between them, in order.
fn evidence(phones: &[AlignedPhone], words: usize) -> Vec<Evidence> {
    let mut parts: Vec<Evidence> = Vec::new();
    let (mut next, mut now_us) = (0, 0);
    let missing = |from: usize, to: usize, now_us| {
        (from..to).map(move |word| Evidence {
            nats: MISSING_NATS,
            words: word..word + 1,
            start_us: now_us,
            end_us: now_us,
            unwritten_us: 0,
        })
    };
    for phone in phones {
        let AlignedPhone { start_us, end_us, .. } = *phone;
        match phone.word {
            Some(word) => {
                let nats = (BORDER_FIT - phone.fit) * frames_of(phone);
                match parts.last_mut() {
                    Some(last) if word + 1 == next && last.words == (word..next) => {
                        last.nats += nats;
                        last.end_us = end_us;
                    }
                    _ => {
                        parts.extend(missing(next, word, now_us));
                        parts.push(Evidence { nats, words: word..word + 1, start_us, end_us, unwritten_us: 0 });
                        next = word + 1;
                    }
                }
                now_us = end_us;
            }
            // Speech that is not in the script is one phone at first, and gets its phones later.
            None if phone.phone == Phone::Spoken || phone.phone.is_speech() => {
                let nats = UNWRITTEN_NATS * frames_of(phone);
                parts.push(Evidence { nats, words: next..next, start_us, end_us, unwritten_us: end_us - start_us });
                // Words missing from here on are missing after this speech.
                now_us = end_us;
            }
            None => {}
        }
    }
    parts.extend(missing(next, words, now_us));
    parts
}

fn frames_of(phone: &AlignedPhone) -> f32 {
    (phone.end_us - phone.start_us) as f32 / FRAME_US
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns one-phone words from pairs of length in milliseconds (0: not spoken) and fit; `None` is other speech.
    fn phones(parts: &[Option<(u64, f32)>]) -> (Vec<AlignedPhone>, usize) {
        let (mut phones, mut words, mut start_us) = (Vec::new(), 0, 0);
        for part in parts {
            let (length_ms, fit) = part.unwrap_or((600, -4.0));
            let end_us = start_us + length_ms * 1_000;
            let (phone, word) = if part.is_some() { (Phone::Aa, Some(words)) } else { (Phone::Spoken, None) };
            if length_ms > 0 {
                phones.push(AlignedPhone { phone, start_us, end_us, word, fit });
            }
            words += usize::from(part.is_some());
            start_us = end_us;
        }
        (phones, words)
    }

    const GOOD: Option<(u64, f32)> = Some((300, -1.0));
    const BAD: Option<(u64, f32)> = Some((300, -4.5));
    const MISSING: Option<(u64, f32)> = Some((0, 0.0));

    fn found(parts: &[Option<(u64, f32)>]) -> Vec<(MismatchKind, Range<usize>, u64, u64)> {
        let (phones, words) = phones(parts);
        let mismatches = mismatches(&phones, words).into_iter();
        mismatches.map(|found| (found.kind, found.words, found.start_us / 1_000, found.end_us / 1_000)).collect()
    }

    #[test]
    fn what_fits_is_no_mismatch() {
        assert_eq!(found(&[GOOD; 9]), []);
        assert_eq!(found(&[GOOD, BAD, GOOD, MISSING, GOOD, BAD, GOOD]), []);
        assert_eq!(found(&[]), []);
    }

    #[test]
    fn each_kind_of_mismatch_has_its_time_and_words() {
        assert_eq!(found(&[GOOD, GOOD, BAD, BAD, BAD, GOOD]), [(MismatchKind::OtherWords, 2..5, 600, 1500)]);
        let missing = [GOOD, MISSING, MISSING, MISSING, MISSING, MISSING, GOOD];
        assert_eq!(found(&missing), [(MismatchKind::NotSaid, 1..6, 300, 300)]);
        assert_eq!(found(&[GOOD, None, None, GOOD]), [(MismatchKind::NotInScript, 1..1, 300, 1500)]);
        assert_eq!(found(&[MISSING; 5]), [(MismatchKind::NotSaid, 0..5, 0, 0)]);
        let other = [None, None, MISSING, MISSING, MISSING, MISSING];
        assert_eq!(found(&other), [(MismatchKind::NotInScript, 0..4, 0, 1200)]);
    }

    #[test]
    fn two_mismatches_are_two() {
        let kinds: Vec<_> = found(&[BAD, BAD, BAD, GOOD, GOOD, None, None, GOOD]);
        assert_eq!(kinds.len(), 2, "{kinds:?}");
    }

    #[test]
    fn confidence_falls_with_the_fit_and_is_none_for_what_is_not_heard() {
        let (phones, words) = phones(&[GOOD, Some((200, EVEN_FIT)), BAD, MISSING]);
        let confidences = confidences(&phones, words);
        assert!(confidences[0] > 0.95 && confidences[2] < 0.1, "{confidences:?}");
        assert_eq!((confidences[1], confidences[3]), (0.5, 0.0));
    }
}
