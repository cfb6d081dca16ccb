//! From frames to times, pauses and words.

use super::{AlignedPhone, AlignedWord};
use crate::Phone;
use crate::features::mel::{HOP, RATE_HZ, WINDOW};
use std::ops::Range;

/// Microseconds from one frame to the next, and in the samples of a frame.
const HOP_US: u64 = HOP as u64 * 1_000_000 / RATE_HZ as u64;
const WINDOW_US: u64 = WINDOW as u64 * 1_000_000 / RATE_HZ as u64;

/// The time that frames stand for: each is the middle of its samples, give or take half a hop.
pub(super) fn of_frames(frames: Range<usize>, duration_us: u64) -> (u64, u64) {
    let boundary = |frame: usize| match frame {
        0 => 0,
        frame => (frame as u64 * HOP_US + (WINDOW_US - HOP_US) / 2).min(duration_us),
    };
    (boundary(frames.start), boundary(frames.end))
}

/// Makes phones end with the sound. A sound that is shorter than a sample of the features is silent.
pub(super) fn cover(mut phones: Vec<AlignedPhone>, duration_us: u64) -> Vec<AlignedPhone> {
    match phones.last_mut() {
        Some(last) => last.end_us = duration_us,
        None => phones.push(AlignedPhone { phone: Phone::Sil, start_us: 0, end_us: duration_us, word: None, fit: 0.0 }),
    }
    phones
}

/// Joins what is silent, and gives pauses that are shorter than `shortest_us` to the phone before them, unless they begin or
/// end the sound.
pub(super) fn join_pauses(phones: Vec<AlignedPhone>, shortest_us: u64) -> Vec<AlignedPhone> {
    let mut joined: Vec<AlignedPhone> = Vec::with_capacity(phones.len());
    for phone in phones {
        match joined.last_mut() {
            Some(last) if !phone.phone.is_speech() && phone.phone == last.phone => last.end_us = phone.end_us,
            _ => joined.push(phone),
        }
    }
    let count = joined.len();
    let mut kept: Vec<AlignedPhone> = Vec::with_capacity(count);
    for (number, phone) in joined.into_iter().enumerate() {
        let is_short = !phone.phone.is_speech() && phone.end_us - phone.start_us < shortest_us && number + 1 < count;
        match kept.last_mut() {
            Some(last) if is_short && last.phone.is_speech() => last.end_us = phone.end_us,
            _ => kept.push(phone),
        }
    }
    kept
}

/// The times of the words, of which `heard` are the pronunciations.
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
