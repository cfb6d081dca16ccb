//! Speech and pauses, derived from mouth shapes.

use crate::Time;
use crate::frames::ShapeRun;
use std::ops::Range;

/// The times at which a mouth speaks and rests, from its first to its last sound.
pub(crate) struct Speech {
    /// The stretches between pauses, in seconds. The first starts with the first sound.
    spoken: Vec<Range<f64>>,
    /// The seconds of speech before each of them, and in total.
    spoken_before: Vec<f64>,
    /// The pauses between them.
    pauses: Vec<Range<Time>>,
}

impl Speech {
    /// Returns the speech in `runs`. Rests shorter than `min_pause` count as speech.
    pub(crate) fn from_runs(runs: &[ShapeRun], min_pause: Time) -> Speech {
        let mut speech = Speech { spoken: Vec::new(), spoken_before: vec![0.0], pauses: Vec::new() };
        for run in runs.iter().filter(|run| run.code != b'-' && run.start < run.end) {
            let (start, end) = (run.start.as_f64(), run.end.as_f64());
            let Some(last) = speech.spoken.last_mut() else {
                speech.spoken.push(start..end);
                speech.pauses.push(run.end..run.end);
                continue;
            };
            if let Some(pause) = speech.pauses.last_mut() {
                let rest = nanoseconds(run.start) - nanoseconds(pause.start);
                if rest > 0 && rest >= nanoseconds(min_pause) {
                    pause.end = run.start;
                    speech.spoken.push(start..end);
                    speech.pauses.push(run.end..run.end);
                } else {
                    last.end = end;
                    *pause = run.end..run.end;
                }
            }
        }
        speech.pauses.pop(); // the rest after the last sound
        let mut done = 0.0;
        for spoken in &speech.spoken {
            done += spoken.end - spoken.start;
            speech.spoken_before.push(done);
        }
        speech
    }

    /// Returns the pauses between sounds.
    pub(crate) fn pauses(&self) -> impl Iterator<Item = &Range<Time>> {
        self.pauses.iter()
    }

    /// Returns the pauses of at least `min_pause`.
    pub(crate) fn long_pauses(&self, min_pause: Time) -> impl Iterator<Item = &Range<Time>> {
        self.pauses().filter(move |pause| is_long(pause, min_pause))
    }

    /// Returns the share of the speech before a time, from 0 to 1.
    pub(crate) fn share(&self, time: Time) -> f64 {
        let time = time.as_f64();
        let begun = self.spoken.partition_point(|spoken| spoken.start < time);
        let Some(last) = begun.checked_sub(1) else { return 0.0 };
        let within = self.spoken.get(last).map_or(0.0, |spoken| time.min(spoken.end) - spoken.start);
        (self.spoken_before.get(last).copied().unwrap_or(0.0) + within) / self.seconds()
    }

    /// Returns the seconds of speech, without pauses.
    fn seconds(&self) -> f64 {
        self.spoken_before.last().copied().unwrap_or(0.0)
    }

    /// Returns the time at which this share of the speech has passed.
    fn time(&self, share: f64) -> Time {
        let wanted = share * self.seconds();
        // The first stretch that ends at or after the share.
        let ends = self.spoken_before.get(1..).unwrap_or_default();
        let index = ends.partition_point(|end| *end < wanted);
        match self.spoken.get(index) {
            Some(spoken) => time(spoken.start + wanted - self.spoken_before.get(index).copied().unwrap_or(0.0)),
            None => time(self.spoken.last().map_or(0.0, |spoken| spoken.end)),
        }
    }

    /// Whether there is no speech.
    pub(crate) fn is_silent(&self) -> bool {
        self.spoken.is_empty()
    }

    /// Returns the starts of parts with these lengths, except the first.
    #[allow(clippy::cast_precision_loss, reason = "lengths of texts")]
    pub(crate) fn starts(&self, lengths: &[usize], min_pause: Time) -> Vec<PartStart> {
        let all = lengths.iter().sum::<usize>().max(1) as f64;
        let mut before = 0;
        let share = |length: &usize| {
            before += length;
            before as f64 / all
        };
        let shares: Vec<f64> = lengths.iter().map(share).collect();
        self.at_shares(shares.split_last().map_or(&[], |(_, starts)| starts), min_pause)
    }

    /// Returns the starts of parts at these shares of the speech, which ascend. Parts start in the nearest pauses,
    /// preferably of at least `min_pause`. Parts without speech start at the same share, and consist of the pause
    /// there.
    pub(crate) fn at_shares(&self, shares: &[f64], min_pause: Time) -> Vec<PartStart> {
        let pauses: Vec<(f64, &Range<Time>)> = self.pauses().map(|pause| (self.share(pause.end), pause)).collect();
        let mut places = Vec::with_capacity(shares.len());
        let mut before = 0.0;
        for same in shares.chunk_by(|a, b| (a - b).abs() < SAME_SHARE) {
            let wanted = same.first().copied().unwrap_or_default();
            let after = shares.get(places.len() + same.len()).copied().unwrap_or(1.0);
            // Limiting the distance to half of either part keeps the boundaries in order.
            let reach = (wanted - before).min(after - wanted) / 2.0;
            before = wanted;
            let distance = |pause: &(f64, &Range<Time>)| (pause.0 - wanted).abs();
            // Pauses ascend, and each is within reach of one boundary at most, so all of this takes linear time.
            let first = pauses.partition_point(|pause| pause.0 <= wanted - reach);
            let near = pauses.iter().skip(first).take_while(|pause| pause.0 < wanted + reach);
            let nearest = near.min_by(|a, b| {
                is_long(b.1, min_pause).cmp(&is_long(a.1, min_pause)).then_with(|| distance(a).total_cmp(&distance(b)))
            });
            let (pause, is_guess) = match nearest {
                // Rest before and after all speech does not count as a pause, but is not a guess either.
                _ if wanted < SAME_SHARE => (Time::ZERO..self.time(0.0), false),
                _ if wanted > 1.0 - SAME_SHARE => (self.time(1.0)..self.time(1.0), false),
                Some((_, pause)) => (pause.start..pause.end, false),
                None => (self.time(wanted)..self.time(wanted), true),
            };
            // A part starts when speech continues. Parts without speech before it divide the pause.
            let (start, length) = (pause.start.as_f64(), pause.end.as_f64() - pause.start.as_f64());
            let gaps = same.len().saturating_sub(1);
            for index in 0..same.len() {
                let first = if wanted < SAME_SHARE { 1 } else { 0 }; // a separate part precedes the speech
                let time = match index {
                    _ if index == gaps => pause.end,
                    _ if index + first == 0 => pause.start,
                    _ => time(start + length * fraction(index + first, gaps + first)),
                };
                places.push(PartStart { time, is_guess: is_guess || (index + first > 0 && index < gaps) });
            }
        }
        places
    }
}

/// The start of a part.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct PartStart {
    pub(crate) time: Time,
    /// Whether it is based only on the lengths of the parts.
    pub(crate) is_guess: bool,
}

fn is_long(pause: &Range<Time>, min_pause: Time) -> bool {
    nanoseconds(pause.end) - nanoseconds(pause.start) >= nanoseconds(min_pause)
}

/// Shares that differ by less are equal.
const SAME_SHARE: f64 = 1e-9;

#[allow(clippy::cast_precision_loss, reason = "numbers of segments")]
fn fraction(index: usize, of: usize) -> f64 {
    index as f64 / of.max(1) as f64
}

/// Nanoseconds per second.
const NANOSECONDS: u32 = 1_000_000_000;

fn nanoseconds(time: Time) -> u64 {
    time.in_units(NANOSECONDS)
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "times of runs, none below 0")]
fn time(seconds: f64) -> Time {
    Time::new((seconds * f64::from(NANOSECONDS)).round() as u64, NANOSECONDS)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn speech(shapes: &[(u8, u64)]) -> Speech {
        let mut end = 0;
        let run = |&(code, ms): &(u8, u64)| {
            let start = end;
            end += ms;
            ShapeRun { code, start: Time::new(start, 1000), end: Time::new(end, 1000) }
        };
        Speech::from_runs(&shapes.iter().map(run).collect::<Vec<_>>(), Time::new(300, 1000))
    }

    #[test]
    fn pauses_lie_between_sounds() {
        let speech =
            speech(&[(b'-', 500), (b'A', 200), (b'-', 200), (b'E', 200), (b'-', 300), (b'O', 100), (b'-', 900)]);
        let pauses: Vec<(u64, u64)> =
            speech.pauses().map(|pause| (pause.start.in_units(1000), pause.end.in_units(1000))).collect();
        assert_eq!(pauses, [(1100, 1400)], "the short rest is none, nor are those outside");
        assert!((speech.share(Time::new(1200, 1000)) - 6.0 / 7.0).abs() < 1e-9);
    }

    #[test]
    fn parts_without_speech_are_the_rests() {
        let speech = speech(&[(b'-', 200), (b'A', 1000), (b'-', 400), (b'E', 1000), (b'-', 300)]);
        let starts = |lengths: &[usize]| {
            let places = speech.starts(lengths, Time::ZERO);
            places.iter().map(|place| (place.time.in_units(1000), place.is_guess)).collect::<Vec<_>>()
        };
        assert_eq!(starts(&[0, 5, 5]), [(200, false), (1600, false)]);
        assert_eq!(starts(&[0, 0, 5]), [(100, true), (200, false)]);
        assert_eq!(starts(&[5, 0, 5]), [(1200, false), (1600, false)]);
        assert_eq!(starts(&[5, 0, 0, 5]), [(1200, false), (1400, true), (1600, false)]);
        assert_eq!(starts(&[5, 5, 0]), [(1600, false), (2600, false)]);
    }

    #[test]
    fn parts_start_at_the_nearest_pause_or_where_they_should() {
        let speech = speech(&[(b'A', 1000), (b'-', 400), (b'E', 900), (b'-', 400), (b'O', 1100)]);
        let starts = |lengths: &[usize]| {
            let places = speech.starts(lengths, Time::ZERO);
            let guessed = places.iter().filter(|place| place.is_guess).count();
            (places.iter().map(|place| place.time.in_units(1000)).collect::<Vec<_>>(), guessed)
        };
        assert_eq!(starts(&[10, 10, 10]), (vec![1400, 2700], 0));
        assert_eq!(starts(&[20, 10]), (vec![2700], 0));
        assert_eq!(starts(&[1, 9]), (vec![300], 1), "no pause is near");
        assert_eq!(starts(&[0]), (vec![], 0));
        assert_eq!(starts(&[0, 0]).0.len(), 1);
        assert_eq!(starts(&[]).0.len(), 0);
    }

    #[test]
    fn many_pauses_are_looked_through_once() {
        let shapes: Vec<(u8, u64)> =
            (0..200_000).map(|index| (if index % 2 == 0 { b'A' } else { b'-' }, 300)).collect();
        let speech = speech(&shapes);
        // Comparing all of them for each part would take minutes.
        let places = speech.starts(&vec![1; 60_000], Time::ZERO);
        assert_eq!(places.len(), 59_999);
        assert!(places.windows(2).all(|pair| matches!(pair, [one, next] if one.time <= next.time)));
    }
}
