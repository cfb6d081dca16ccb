//! Writing of an alignment as a TextGrid.

use super::MICROSECONDS;
use lipz_interop::Time;
use lipz_interop::textgrid::{Interval, TextGrid, Tier};
use lipz_speech::{Alignment, Script};
use lipz_types::{Fps, VisemeType};

/// Returns the TextGrid of an alignment and its visemes, whose codes are given.
pub(crate) fn written(
    alignment: &Alignment,
    script: &Script,
    codes: &str,
    (viseme_type, fps): (VisemeType, Fps),
) -> String {
    let end = alignment.duration_us;
    let said = alignment.words.iter().zip(&script.words).filter(|(word, _)| word.start_us < word.end_us);
    let words = said.map(|(word, written)| (word.start_us, word.end_us, written.text.clone()));
    let phones = alignment.phones.iter().map(|phone| {
        let label = if phone.phone.is_speech() { phone.phone.to_string() } else { String::new() };
        (phone.start_us, phone.end_us, label)
    });
    let frames: Vec<char> = codes.chars().collect();
    let frame_us = |frame: usize| fps.start_of_frame_us(u32::try_from(frame).unwrap_or(u32::MAX)).min(end);
    let mut at = 0;
    let visemes = frames.chunk_by(|one, next| one == next).map(|run| {
        let start = at;
        at += run.len();
        (frame_us(start), if at == frames.len() { end } else { frame_us(at) }, run.iter().take(1).collect())
    });
    let shapes = match viseme_type {
        VisemeType::Blair => "visemes".to_owned(),
        other => format!("visemes-{}", other.name()),
    };
    let tiers = vec![
        tier("words", end, words.collect()),
        tier("phones", end, phones.collect()),
        tier(&shapes, end, visemes.collect()),
    ];
    TextGrid { start: Time::ZERO, end: time(end), tiers }.write()
}

/// Returns a tier of stretches, each with its start, its end and its label.
pub(crate) fn tier(name: &str, end: u64, stretches: Vec<(u64, u64, String)>) -> Tier {
    let mut intervals = Vec::with_capacity(stretches.len());
    let mut done = 0;
    let mut add = |from: u64, to: u64, label: String| {
        if from < to {
            intervals.push(Interval::new(time(from), time(to), label));
        }
    };
    // Praat requires intervals without gaps.
    for (from, to, label) in stretches {
        add(done, from, String::new());
        add(from.max(done), to, label);
        done = done.max(to);
    }
    add(done, end, String::new());
    Tier::new(name, intervals)
}

fn time(us: u64) -> Time {
    Time::new(us, MICROSECONDS)
}
