//! Conversion of frames to times, pauses and words.

use super::{AlignedPhone, AlignedWord};
use crate::Phone;
use crate::features::mel::{HOP, RATE_HZ, WINDOW};

/// The microseconds from one frame to the next, and in the samples of a frame.
const HOP_US: u64 = HOP as u64 * 1_000_000 / RATE_HZ as u64;
const WINDOW_US: u64 = WINDOW as u64 * 1_000_000 / RATE_HZ as u64;

/// Returns the times of steps that start in these frames. The last step ends before frame `end`. The time of a frame is
/// the middle of its samples, give or take half a hop.
pub(super) fn of_starts(starts: &[f64], end: usize, duration_us: u64) -> Vec<(u64, u64)> {
    let boundary = |frame: f64| match frame > 0.0 {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most a day, and positive")]
        true => ((frame * HOP_US as f64) as u64 + (WINDOW_US - HOP_US) / 2).min(duration_us),
        false => 0,
    };
    let ends = starts.iter().copied().skip(1).chain([end as f64]);
    starts.iter().zip(ends).map(|(&start, end)| (boundary(start), boundary(end))).collect()
}

/// Extends the phones to the end of the audio. Audio shorter than one frame is silent.
pub(super) fn cover(mut phones: Vec<AlignedPhone>, duration_us: u64) -> Vec<AlignedPhone> {
    match phones.last_mut() {
        Some(last) => last.end_us = duration_us,
        None => phones.push(AlignedPhone { phone: Phone::Sil, start_us: 0, end_us: duration_us, word: None, fit: 0.0 }),
    }
    phones
}

/// Joins silent phones, and adds pauses shorter than `shortest_us` to the phone before them, except at the start and
/// the end of the audio.
pub(super) fn join_pauses(mut phones: Vec<AlignedPhone>, shortest_us: u64) -> Vec<AlignedPhone> {
    phones.dedup_by(|phone, last| {
        let is_same = !phone.phone.is_speech() && phone.phone == last.phone;
        if is_same {
            last.end_us = phone.end_us;
        }
        is_same
    });
    // In place, because an hour has 40,000 phones.
    let (mut kept, mut from) = (0_usize, 0_usize);
    while let Some(&first) = phones.get(from) {
        // Adjacent silence and noise are one pause.
        let is_same = |phone: &&AlignedPhone| phone.phone.is_speech() == first.phone.is_speech();
        let end = from + phones[from..].iter().take_while(is_same).count();
        let end_us = phones[end - 1].end_us;
        let is_short = !first.phone.is_speech() && end_us - first.start_us < shortest_us && end < phones.len();
        match kept.checked_sub(1) {
            Some(last) if is_short => phones[last].end_us = end_us,
            _ => {
                phones.copy_within(from..end, kept);
                kept += end - from;
            }
        }
        from = end;
    }
    phones.truncate(kept);
    phones
}

/// Returns the times of the words; `heard` has their spoken pronunciations.
pub(super) fn words(phones: &[AlignedPhone], heard: &[Option<usize>], confidences: &[f32]) -> Vec<AlignedWord> {
    let mut words = Vec::with_capacity(heard.len());
    let mut phones = phones.iter().peekable();
    let mut now_us = 0;
    for (number, (&pronunciation, &confidence)) in heard.iter().zip(confidences).enumerate() {
        let mut word = AlignedWord { start_us: now_us, end_us: now_us, pronunciation, confidence };
        if pronunciation.is_some() {
            while phones.next_if(|phone| phone.word != Some(number)).is_some() {}
            if let Some(first) = phones.peek() {
                word.start_us = first.start_us;
            }
            while let Some(phone) = phones.next_if(|phone| phone.word == Some(number)) {
                word.end_us = phone.end_us;
            }
        }
        now_us = word.end_us;
        words.push(word);
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns phones with these lengths in milliseconds.
    fn phones(parts: &[(Phone, u64)]) -> Vec<AlignedPhone> {
        let mut now_us = 0;
        let phone = |&(phone, length_ms): &(Phone, u64)| {
            let start_us = now_us;
            now_us += length_ms * 1_000;
            AlignedPhone { phone, start_us, end_us: now_us, word: None, fit: 0.0 }
        };
        parts.iter().map(phone).collect()
    }

    #[test]
    fn short_pauses_belong_to_the_phone_before() {
        let joined = |parts: &[(Phone, u64)]| {
            let joined = join_pauses(phones(parts), 150_000).into_iter();
            joined.map(|phone| (phone.phone, (phone.end_us - phone.start_us) / 1_000)).collect::<Vec<_>>()
        };
        use Phone::{Aa, Iy, Noise, Sil};
        assert_eq!(joined(&[(Aa, 100), (Sil, 140), (Iy, 90)]), [(Aa, 240), (Iy, 90)]);
        assert_eq!(joined(&[(Sil, 20), (Aa, 100), (Sil, 20)]), [(Sil, 20), (Aa, 100), (Sil, 20)]);
        // Neither pause is long enough alone, but together they are.
        let long = [(Aa, 100), (Sil, 90), (Noise, 70), (Iy, 90)];
        assert_eq!(joined(&long), long);
        let end = [(Aa, 100), (Sil, 60), (Noise, 40)];
        assert_eq!(joined(&end), end);
        assert_eq!(joined(&[(Aa, 100), (Sil, 60), (Noise, 40), (Iy, 10)]), [(Aa, 200), (Iy, 10)]);
    }
}
