//! An excerpt of a recording: everything audible, with a little of the silence around it.
//!
//! The aligner subtracts means over the whole recording, and compares frames with its loud and quiet frames. Seconds of
//! silence before, after or between sentences would change all of these, so they are cut.

use super::{AlignedPhone, Alignment};
use crate::sound::audible;
use crate::{Phone, Sound};
use std::ops::Range;

/// The microseconds of a frame.
const FRAME_US: u64 = 10_000;

/// An excerpt, and its place in the recording.
pub(super) struct Excerpt {
    pub(super) sound: Sound,
    /// The parts of the excerpt, which follow each other.
    parts: Vec<Part>,
    duration_us: u64,
}

/// A part of an excerpt: its time in microseconds, and what to add for the time in the recording.
struct Part {
    time_us: Range<u64>,
    later_us: i64,
}

impl Excerpt {
    /// Returns the excerpt of a recording, or `None` if nothing in it is audible.
    pub(super) fn new(sound: &Sound) -> Option<Excerpt> {
        let (spectrum, duration_us) = (sound.spectrum(), sound.duration_us());
        let kept = audible::parts(spectrum);
        if kept.is_empty() {
            return None;
        }
        let mut frames = 0;
        let part = |kept: &Range<usize>| {
            let start_us = frames as u64 * FRAME_US;
            frames += kept.len();
            let later_us = (kept.start as u64 * FRAME_US).cast_signed() - start_us.cast_signed();
            Part { time_us: start_us..frames as u64 * FRAME_US, later_us }
        };
        let parts = kept.iter().map(part).collect();
        let sound = sound.with_spectrum(spectrum.cut(&kept));
        Some(Excerpt { sound, parts, duration_us })
    }

    /// Returns the time of a start in the recording, in microseconds.
    fn start_us(&self, time_us: u64) -> u64 {
        let part = self.parts.get(self.parts.partition_point(|part| part.time_us.end <= time_us));
        part.map_or(self.duration_us, |part| self.shifted_us(time_us, part))
    }

    /// Returns the time of an end in the recording, in microseconds.
    fn end_us(&self, time_us: u64) -> u64 {
        let part = self.parts.get(self.parts.partition_point(|part| part.time_us.end < time_us));
        part.map_or(self.duration_us, |part| self.shifted_us(time_us, part))
    }

    fn shifted_us(&self, time_us: u64, part: &Part) -> u64 {
        time_us.saturating_add_signed(part.later_us).min(self.duration_us)
    }

    /// Converts the times of an alignment of the excerpt to those of the recording.
    pub(super) fn alignment(&self, mut alignment: Alignment) -> Alignment {
        alignment.duration_us = self.duration_us;
        alignment.phones = self.phones(&alignment.phones);
        for word in &mut alignment.words {
            word.start_us = self.start_us(word.start_us);
            word.end_us = self.end_us(word.end_us).max(word.start_us);
        }
        for time_us in &mut alignment.breaks_us {
            *time_us = self.start_us(*time_us);
        }
        for found in &mut alignment.mismatches {
            found.start_us = self.start_us(found.start_us);
            found.end_us = self.end_us(found.end_us).max(found.start_us);
        }
        alignment
    }

    /// Converts the times of phones, which cover the recording as they cover the excerpt. What was cut is silence.
    fn phones(&self, phones: &[AlignedPhone]) -> Vec<AlignedPhone> {
        let mut converted: Vec<AlignedPhone> = Vec::with_capacity(phones.len());
        let mut now_us = 0;
        for phone in phones {
            let first = self.parts.partition_point(|part| part.time_us.end <= phone.start_us);
            let parts = self.parts.iter().skip(first);
            for part in parts.take_while(|part| part.time_us.start < phone.end_us) {
                let start_us = self.shifted_us(phone.start_us.max(part.time_us.start), part);
                let end_us = self.shifted_us(phone.end_us.min(part.time_us.end), part);
                if start_us > now_us {
                    add_silence(&mut converted, now_us, start_us);
                    now_us = start_us;
                }
                if end_us > now_us {
                    match phone.phone {
                        Phone::Sil => add_silence(&mut converted, now_us, end_us),
                        _ => converted.push(AlignedPhone { start_us: now_us, end_us, ..*phone }),
                    }
                    now_us = end_us;
                }
            }
        }
        match converted.last_mut() {
            // The last samples fill no frame.
            Some(last) if self.duration_us < now_us + 3 * FRAME_US => last.end_us = self.duration_us,
            _ => add_silence(&mut converted, now_us, self.duration_us),
        }
        converted
    }
}

fn add_silence(phones: &mut Vec<AlignedPhone>, start_us: u64, end_us: u64) {
    match phones.last_mut() {
        Some(last) if last.phone == Phone::Sil => last.end_us = end_us,
        _ => phones.push(AlignedPhone { phone: Phone::Sil, start_us, end_us, word: None, fit: 0.0 }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_those_of_the_recording() {
        let part = |time_us, later_us| Part { time_us, later_us };
        let sound = Sound::from_samples(&[0.0; 1_600], 16_000).unwrap();
        let parts = vec![part(0..500_000, 1_000_000), part(500_000..900_000, 3_000_000)];
        let excerpt = Excerpt { sound, parts, duration_us: 5_000_000 };
        assert_eq!((excerpt.start_us(500_000), excerpt.end_us(500_000)), (3_500_000, 1_500_000));
        let phone = |phone, start_us, end_us| AlignedPhone { phone, start_us, end_us, word: None, fit: 0.0 };
        let phones =
            [phone(Phone::Sil, 0, 100_000), phone(Phone::Aa, 100_000, 600_000), phone(Phone::S, 600_000, 900_000)];
        let converted: Vec<_> = excerpt
            .phones(&phones)
            .iter()
            .map(|phone| (phone.phone, phone.start_us / 1_000, phone.end_us / 1_000))
            .collect();
        let expected = [
            (Phone::Sil, 0, 1_100),
            (Phone::Aa, 1_100, 1_500),
            (Phone::Sil, 1_500, 3_500),
            (Phone::Aa, 3_500, 3_600),
            (Phone::S, 3_600, 3_900),
            (Phone::Sil, 3_900, 5_000),
        ];
        assert_eq!(converted, expected);
    }
}
