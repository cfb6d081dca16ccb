//! Conversion of shapes with exact times to one code per frame, so that visible details survive.
//!
//! A frame shows one shape, so shapes shorter than a frame may be lost. Viewers notice most when closed lips (M, B, P)
//! and the lip under the teeth (F, V) are missing ("Talking Heads": consonants hold, and steal from the sound before
//! them). Therefore these get a frame within their time, unless another such shape needs it.

use crate::Time;
use lipz_file::rate::Rate;
use lipz_types::VisemeType;

/// A shape to be converted, with its code and times.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct ShapeRun {
    pub(crate) code: u8,
    pub(crate) start: Time,
    pub(crate) end: Time,
}

/// The reason why a shape has no frame.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum LossReason {
    /// It is shorter than a frame, and its neighbours cover more of the frames that it touches.
    TooShort,
    /// Its only frame was given to closed lips, or to F or V.
    GaveWay,
    /// It would have less than the minimum number of frames.
    BelowMinimum,
}

impl LossReason {
    /// Returns a short description of the reason.
    pub const fn describe(self) -> &'static str {
        match self {
            LossReason::TooShort => "shorter than a frame",
            LossReason::GaveWay => "its frame shows closed lips or F and V",
            LossReason::BelowMinimum => "shorter than the minimum hold",
        }
    }
}

/// Frames with the shapes that they show.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub(crate) struct Frames {
    /// The number of frames of each run, in the order of the runs.
    pub(crate) lengths: Vec<usize>,
    /// The runs without frames, and the reasons.
    pub(crate) lost: Vec<(usize, LossReason)>,
}

/// Whether a code is one of the shapes that must be visible: closed lips, F and V.
pub(crate) fn must_show(viseme_type: VisemeType, code: u8) -> bool {
    match viseme_type {
        VisemeType::Blair => matches!(code, b'M' | b'F'),
        VisemeType::ToonBoom => matches!(code, b'A' | b'G'),
        VisemeType::Rms => false,
    }
}

/// Assigns frames to `runs`, which follow each other without gaps. Each visible run gets at least `min_hold` frames, if
/// possible.
pub(crate) fn resample(runs: &[ShapeRun], viseme_type: VisemeType, rate: Rate, min_hold: usize) -> Frames {
    let mut owners = nearest_boundaries(runs, rate);
    let mut why = vec![LossReason::TooShort; runs.len()];
    let had_frames = counts(&owners, runs.len());
    for (run, frame) in reserved(runs, viseme_type, rate, owners.len()) {
        if let Some(owner) = owners.get_mut(frame) {
            *owner = run;
        }
    }
    let mut lengths = counts(&owners, runs.len());
    for ((why, had), has) in why.iter_mut().zip(had_frames).zip(&lengths) {
        if had > 0 && *has == 0 {
            *why = LossReason::GaveWay;
        }
    }
    let show = |run: usize| runs.get(run).is_some_and(|run| must_show(viseme_type, run.code));
    hold(&mut lengths, &mut why, min_hold, show);
    let lost = |(run, (&frames, why)): (usize, (&usize, LossReason))| (frames == 0).then_some((run, why));
    let lost = lengths.iter().zip(why).enumerate().filter_map(lost).collect();
    Frames { lengths, lost }
}

/// Returns the run of each frame if every run starts at the nearest frame boundary.
fn nearest_boundaries(runs: &[ShapeRun], rate: Rate) -> Vec<usize> {
    let mut owners = Vec::new();
    for (index, run) in runs.iter().enumerate() {
        let end = usize::try_from(run.end.nearest_frame(rate)).unwrap_or(usize::MAX);
        owners.resize(end.max(owners.len()), index);
    }
    owners
}

fn counts(owners: &[usize], runs: usize) -> Vec<usize> {
    let mut counts = vec![0; runs];
    for &owner in owners {
        if let Some(count) = counts.get_mut(owner) {
            *count += 1;
        }
    }
    counts
}

/// Returns a frame for each run that must be visible, if there is one within its time that no earlier such run needs.
fn reserved(runs: &[ShapeRun], viseme_type: VisemeType, rate: Rate, frames: usize) -> Vec<(usize, usize)> {
    let frame = |count: u64| usize::try_from(count).unwrap_or(usize::MAX);
    // The first and the last possible frame of each. Both ascend from run to run.
    let mut kept: Vec<(usize, usize, usize)> = Vec::new();
    let mut next_free = 0;
    for (index, run) in runs.iter().enumerate().filter(|(_, run)| must_show(viseme_type, run.code)) {
        let last = frame(run.end.frames_begun(rate)).min(frames);
        let first = frame(run.start.frame(rate)).max(next_free);
        if first < last {
            kept.push((index, first, last - 1));
            next_free = first + 1;
        }
    }
    // From the end, the latest frame of each that does not obstruct those after it.
    let mut before = usize::MAX;
    for (_, _, last) in kept.iter_mut().rev() {
        *last = (*last).min(before.saturating_sub(1));
        before = *last;
    }
    let mut next_free = 0;
    kept.into_iter()
        .map(|(index, first, last)| {
            let wanted = runs.get(index).map_or(first, |run| frame(run.start.nearest_frame(rate)));
            let chosen = wanted.clamp(first.max(next_free).min(last), last);
            next_free = chosen + 1;
            (index, chosen)
        })
        .collect()
}

/// Extends every visible run to `minimum` frames. The missing frames come first from the previous run, then from the
/// next, as far as these have more than the minimum. A run that still has too few frames is removed, unless it must be
/// visible: then its neighbours are.
fn hold(lengths: &mut [usize], why: &mut [LossReason], minimum: usize, must_show: impl Fn(usize) -> bool) {
    if minimum < 2 {
        return;
    }
    let mut done: Vec<usize> = Vec::new();
    let shown: Vec<usize> =
        (0..lengths.len()).filter(|&run| lengths.get(run).is_some_and(|&length| length > 0)).collect();
    let length = |lengths: &[usize], run: Option<&usize>| run.and_then(|&run| lengths.get(run).copied()).unwrap_or(0);
    for (at, &run) in shown.iter().enumerate() {
        let rest = shown.get(at + 1..).unwrap_or_default();
        let spare_before = length(lengths, done.last()).saturating_sub(minimum);
        move_frames(lengths, done.last().copied(), run, spare_before, minimum);
        let spare_after = length(lengths, rest.first()).saturating_sub(minimum);
        move_frames(lengths, rest.first().copied(), run, spare_after, minimum);
        let has = length(lengths, Some(&run));
        if has == 0 || has >= minimum {
            // A run without frames lost them to an earlier run that must be visible.
            done.extend((has > 0).then_some(run));
            continue;
        }
        if must_show(run) {
            for &other in rest.iter().take_while(|&&other| !must_show(other)) {
                take_from(lengths, why, other, run, minimum);
            }
            while let Some(&other) = done.last().filter(|&&other| !must_show(other)) {
                if length(lengths, Some(&run)) >= minimum {
                    break;
                }
                // Take all frames, because the rest would be less than the minimum.
                take_from(lengths, why, other, run, usize::MAX);
                done.pop();
            }
            done.push(run);
        } else if let Some(heir) = done.last().or(rest.first()) {
            move_frames(lengths, Some(run), *heir, has, usize::MAX);
            mark(why, run, LossReason::BelowMinimum);
        } else {
            done.push(run); // the only one
        }
    }
}

/// Moves at most `spare` frames from a run to a neighbour with fewer than `wanted`.
fn move_frames(lengths: &mut [usize], from: Option<usize>, to: usize, spare: usize, wanted: usize) {
    let Some(from) = from else { return };
    let lacks = wanted.saturating_sub(lengths.get(to).copied().unwrap_or(wanted));
    let moved = lacks.min(spare);
    if let Some(length) = lengths.get_mut(from) {
        *length -= moved.min(*length);
    }
    if let Some(length) = lengths.get_mut(to) {
        *length += moved;
    }
}

/// Moves the frames that `to` lacks from a run that may disappear.
fn take_from(lengths: &mut [usize], why: &mut [LossReason], from: usize, to: usize, minimum: usize) {
    let all = lengths.get(from).copied().unwrap_or(0);
    move_frames(lengths, Some(from), to, all, minimum);
    if lengths.get(from) == Some(&0) {
        mark(why, from, LossReason::GaveWay);
    }
}

fn mark(why: &mut [LossReason], run: usize, reason: LossReason) {
    if let Some(why) = why.get_mut(run) {
        *why = reason;
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::indexing_slicing, reason = "tests")]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const FILM: Rate = Rate { numerator: 24, denominator: 1, is_exact: true };

    /// Returns runs of codes with these lengths in milliseconds.
    fn runs(shapes: &[(u8, u64)]) -> Vec<ShapeRun> {
        let mut end = 0;
        let run = |&(code, ms): &(u8, u64)| {
            let start = end;
            end += ms;
            ShapeRun { code, start: Time::new(start, 1000), end: Time::new(end, 1000) }
        };
        shapes.iter().map(run).collect()
    }

    fn codes(shapes: &[(u8, u64)], min_hold: usize) -> String {
        let runs = runs(shapes);
        let frames = resample(&runs, VisemeType::Blair, FILM, min_hold);
        let of_run = |(run, length): (&ShapeRun, &usize)| char::from(run.code).to_string().repeat(*length);
        runs.iter().zip(&frames.lengths).map(of_run).collect()
    }

    #[test]
    fn shapes_start_at_the_nearest_frame() {
        assert_eq!(codes(&[(b'-', 100), (b'A', 150), (b'E', 250)], 1), "--AAAAEEEEEE");
        assert_eq!(codes(&[(b'A', 90), (b'S', 10), (b'E', 110)], 1), "AAEEE", "S is lost: no frame is mostly its own");
    }

    #[test]
    fn closed_lips_take_a_frame_of_their_time() {
        assert_eq!(codes(&[(b'A', 100), (b'M', 10), (b'E', 100)], 1), "AAMEE");
        assert_eq!(
            codes(&[(b'A', 100), (b'M', 5), (b'F', 5), (b'M', 5), (b'E', 93)], 1),
            "AAMEE",
            "one frame for three"
        );
        assert_eq!(codes(&[(b'M', 5), (b'F', 5)], 1), "", "there is no frame");
    }

    #[test]
    fn what_gives_way_is_told() {
        let frames = resample(&runs(&[(b'A', 42), (b'M', 20), (b'F', 28), (b'E', 40)]), VisemeType::Blair, FILM, 1);
        assert_eq!(frames.lengths, [1, 1, 1, 0]);
        assert_eq!(frames.lost, [(3, LossReason::GaveWay)]);
    }

    #[test]
    fn short_shapes_are_held_or_give_way() {
        assert_eq!(codes(&[(b'A', 250), (b'S', 42), (b'E', 250)], 2), "AAAAASSEEEEEE", "from the one before");
        assert_eq!(codes(&[(b'A', 84), (b'S', 42), (b'E', 250)], 2), "AASSEEEEE", "or from the one after");
        assert_eq!(codes(&[(b'A', 84), (b'S', 42), (b'E', 84)], 2), "AAAEE", "or it gives way");
        assert_eq!(codes(&[(b'A', 84), (b'M', 42), (b'E', 84)], 2), "AAMMM", "closed lips do not");
    }

    /// Returns the largest number of runs that can each have a frame of their own within their time, among those that
    /// must be visible.
    fn most_shown(runs: &[ShapeRun], frames: usize) -> usize {
        let mut free: Vec<usize> = (0..frames).collect();
        let mut shown = 0;
        for run in runs.iter().filter(|run| must_show(VisemeType::Blair, run.code)) {
            let touched = |frame: &usize| {
                let (start, end) = (Time::of_frame(*frame as u64, FILM), Time::of_frame(*frame as u64 + 1, FILM));
                start < run.end && run.start < end
            };
            if let Some(at) = free.iter().position(touched) {
                free.drain(..=at);
                shown += 1;
            }
        }
        shown
    }

    proptest! {
        #[test]
        fn closed_lips_never_vanish_when_a_frame_exists(
            shapes in prop::collection::vec((prop::sample::select(b"-AMFSEM".to_vec()), 1_u64..120), 0..40),
        ) {
            let runs = runs(&shapes);
            let frames = resample(&runs, VisemeType::Blair, FILM, 1);
            let total: usize = frames.lengths.iter().sum();
            prop_assert_eq!(total as u64, runs.last().map_or(0, |run| run.end.nearest_frame(FILM)));
            let shown = runs.iter().zip(&frames.lengths).filter(|(run, length)| must_show(VisemeType::Blair, run.code) && **length > 0);
            prop_assert_eq!(shown.count(), most_shown(&runs, total));
        }

        #[test]
        fn no_shape_is_held_for_less_than_the_minimum(
            shapes in prop::collection::vec((prop::sample::select(b"-ASE".to_vec()), 1_u64..400), 1..40),
            min_hold in 1_usize..5,
        ) {
            let runs = runs(&shapes);
            let without = resample(&runs, VisemeType::Blair, FILM, 1);
            let frames = resample(&runs, VisemeType::Blair, FILM, min_hold);
            let total: usize = frames.lengths.iter().sum();
            prop_assert_eq!(total, without.lengths.iter().sum::<usize>());
            let shown: Vec<usize> = frames.lengths.iter().copied().filter(|&length| length > 0).collect();
            prop_assert!(shown.len() == 1 || shown.iter().all(|&length| length >= min_hold), "{:?}", frames.lengths);
            prop_assert_eq!(shown.len() + frames.lost.len(), runs.len());
        }

        #[test]
        fn closed_lips_are_held_at_the_cost_of_others(
            shapes in prop::collection::vec((prop::sample::select(b"-AMSE".to_vec()), 1_u64..400), 1..40),
            min_hold in 1_usize..5,
        ) {
            let runs = runs(&shapes);
            let without = resample(&runs, VisemeType::Blair, FILM, 1);
            let frames = resample(&runs, VisemeType::Blair, FILM, min_hold);
            for (index, run) in runs.iter().enumerate().filter(|(_, run)| run.code == b'M') {
                prop_assert!(without.lengths[index] == 0 || frames.lengths[index] > 0, "{run:?}");
            }
        }
    }
}
