//! Speech and pauses, as the shapes of the mouth show them.

use crate::Time;
use crate::frames::Run;
use std::ops::Range;

/// When a mouth speaks and when it rests, from first to last.
pub(crate) struct Speech {
    /// The stretches between pauses, in seconds; the first starts with the first sound.
    spoken: Vec<Range<f64>>,
    /// The pauses between them: one fewer.
    pauses: Vec<Range<Time>>,
}

impl Speech {
    /// The speech in `runs`, in which `is_rest` says which codes rest. Rests shorter than `min_pause` are part of speaking.
    pub(crate) fn from_runs(runs: &[Run], min_pause: Time) -> Speech {
        let mut speech = Speech { spoken: Vec::new(), pauses: Vec::new() };
        for run in runs.iter().filter(|run| run.code != b'-' && run.start < run.end) {
            let (start, end) = (run.start.as_f64(), run.end.as_f64());
            let Some(last) = speech.spoken.last_mut() else {
                speech.spoken.push(start..end);
                speech.pauses.push(run.end..run.end);
                continue;
            };
            if let Some(pause) = speech.pauses.last_mut() {
                if nanoseconds(run.start) - nanoseconds(pause.start) >= nanoseconds(min_pause) {
                    pause.end = run.start;
                    speech.spoken.push(start..end);
                    speech.pauses.push(run.end..run.end);
                } else {
                    last.end = end;
                    *pause = run.end..run.end;
                }
            }
        }
        speech.pauses.pop(); // the rest behind the last sound
        speech
    }

    /// The pauses between sounds.
    pub(crate) fn pauses(&self) -> impl Iterator<Item = &Range<Time>> {
        self.pauses.iter()
    }

    /// How much of the speaking is done at a time, from 0 to 1.
    pub(crate) fn share(&self, time: Time) -> f64 {
        let time = time.as_f64();
        let before = |spoken: &Range<f64>| time.clamp(spoken.start, spoken.end) - spoken.start;
        let done: f64 = self.spoken.iter().map(before).sum();
        if self.seconds() > 0.0 { done / self.seconds() } else { 0.0 }
    }

    /// Seconds of speaking, without pauses.
    fn seconds(&self) -> f64 {
        self.spoken.iter().map(|spoken| spoken.end - spoken.start).sum()
    }

    /// When this share of the speaking is done.
    fn time(&self, share: f64) -> Time {
        let mut left = share * self.seconds();
        for spoken in &self.spoken {
            let length = spoken.end - spoken.start;
            if left <= length {
                return time(spoken.start + left);
            }
            left -= length;
        }
        time(self.spoken.last().map_or(0.0, |spoken| spoken.end))
    }

    /// When parts of these lengths start, but for the first, and how many of the starts are in no pause.
    #[allow(clippy::cast_precision_loss, reason = "lengths of texts")]
    pub(crate) fn starts(&self, lengths: &[usize]) -> (Vec<Time>, usize) {
        let all = lengths.iter().sum::<usize>().max(1) as f64;
        let mut shares = vec![0.0];
        for length in lengths {
            shares.push(shares.last().copied().unwrap_or(0.0) + *length as f64 / all);
        }
        let pauses: Vec<(f64, Time)> = self.pauses().map(|pause| (self.share(pause.end), pause.end)).collect();
        let mut guessed = 0;
        let start = |around: &[f64]| {
            let [before, wanted, after] = *around else { return Time::ZERO };
            // A pause nearer than half of either part cannot be nearer to another boundary, so they stay in order.
            let reach = (wanted - before).min(after - wanted) / 2.0;
            let distance = |pause: &&(f64, Time)| (pause.0 - wanted).abs();
            let nearest = pauses.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
            match nearest.filter(|pause| distance(pause) < reach) {
                Some((_, time)) => *time,
                None => {
                    guessed += 1;
                    self.time(wanted)
                }
            }
        };
        let starts = shares.windows(3).map(start).collect();
        (starts, guessed)
    }
}

/// Nanoseconds of a second.
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
            Run { code, start: Time::new(start, 1000), end: Time::new(end, 1000) }
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
    fn parts_start_at_the_nearest_pause_or_where_they_should() {
        let speech = speech(&[(b'A', 1000), (b'-', 400), (b'E', 900), (b'-', 400), (b'O', 1100)]);
        let starts = |lengths: &[usize]| {
            let (starts, guessed) = speech.starts(lengths);
            (starts.iter().map(|start| start.in_units(1000)).collect::<Vec<_>>(), guessed)
        };
        assert_eq!(starts(&[10, 10, 10]), (vec![1400, 2700], 0));
        assert_eq!(starts(&[20, 10]), (vec![2700], 0));
        assert_eq!(starts(&[1, 9]), (vec![300], 1), "no pause is near");
        assert_eq!(starts(&[0]), (vec![], 0));
        assert_eq!(starts(&[0, 0]).0.len(), 1);
    }
}
