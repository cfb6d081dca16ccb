//! The curves of a recorded face: each weight at the starts of all frames.

use super::document::object;
use crate::{FaceWeights, Time, WeightRow};
use lipz_file::rate::Rate;
use lipz_file::{Element, curve};
use lipz_types::CurveValue;

/// The most values of all curves: those of 300 weights in an hour with 60 frames per second.
pub(super) const MOST_VALUES: usize = 1 << 26;

/// The element with the curves, and the accuracy of their values.
pub(super) struct FaceCurves {
    pub(super) element: Element<'static>,
    pub(super) remark: String,
}

/// Returns the curves of all weights, for a clip with this number of frames. Weights that are always 0 have curves, too,
/// because programs compute weights without a curve.
///
/// If no two rows belong to the same frame, the row of a frame has its values. Otherwise, values between two rows are
/// interpolated.
pub(super) fn curves(weights: FaceWeights, frames: usize, rate: Rate) -> Option<FaceCurves> {
    let FaceWeights { names, mut rows } = weights;
    rows.sort_by_key(|row| row.start);
    rows.dedup_by(|later, row| later.start == row.start);
    let nearest: Vec<Time> = rows.iter().map(|row| Time::of_frame(row.start.nearest_frame(rate), rate)).collect();
    let is_exact = nearest.windows(2).all(|pair| pair.first() != pair.last());
    if is_exact {
        rows.iter_mut().zip(nearest).for_each(|(row, frame)| row.start = frame);
    }
    if rows.is_empty() || names.is_empty() || frames == 0 {
        return None;
    }
    let positions: Vec<Position> = positions(&rows, frames, rate);
    let mut curves = Vec::with_capacity(names.len());
    let mut error = 0_f32;
    for (index, name) in names.iter().enumerate() {
        let of_row = |row: usize| rows.get(row).and_then(|row| row.weights.get(index)).copied().unwrap_or_default();
        let value = |at: &Position| of_row(at.row) + (of_row(at.row + 1) - of_row(at.row)) * at.share;
        let samples: Vec<CurveValue> =
            positions.iter().map(|at| CurveValue::from_thousandths(thousandths(value(at)))).collect();
        if !is_exact {
            error = rows.iter().enumerate().fold(error, |error, (row, WeightRow { start, .. })| {
                error.max((of_row(row) - at_time(&samples, *start, rate)).abs())
            });
        }
        curves.push((name.as_str(), curve::sampled(&samples, 0)));
    }
    let mut remark = match curves.len() {
        1 => "1 weight becomes a curve".to_owned(),
        count => format!("{count} weights become curves"),
    };
    remark += ", rounded to thousandths";
    if !is_exact {
        remark += &format!("; they differ from the file by at most {error:.3}, because it has more frames");
    }
    Some(FaceCurves { element: object(curve::ELEMENT, curve::write(curves)), remark })
}

/// A position between two rows.
struct Position {
    /// The row at or before the position.
    row: usize,
    /// The distance to the next row, from 0 to 1.
    share: f32,
}

/// Returns the positions of the starts of all frames.
fn positions(rows: &[WeightRow], frames: usize, rate: Rate) -> Vec<Position> {
    let mut row = 0;
    let position = |frame| {
        let time = Time::of_frame(frame, rate);
        while rows.get(row + 1).is_some_and(|next| next.start <= time) {
            row += 1;
        }
        let seconds = |row: usize| rows.get(row).map(|row| row.start.as_f64());
        let share = match (seconds(row), seconds(row + 1)) {
            (Some(before), Some(after)) => (time.as_f64() - before) / (after - before),
            _ => 0.0,
        };
        #[expect(clippy::cast_possible_truncation, reason = "from 0 to 1")]
        Position { row, share: share.clamp(0.0, 1.0) as f32 }
    };
    (0..frames as u64).map(position).collect()
}

/// Returns the value of a curve with these samples at a time.
fn at_time(samples: &[CurveValue], time: Time, rate: Rate) -> f32 {
    let frame = time.frame(rate);
    let sample = |frame: u64| {
        let last = samples.len().saturating_sub(1);
        let index = usize::try_from(frame).unwrap_or(last).min(last);
        samples.get(index).map_or(0.0, |value| value.to_f32())
    };
    let passed = time.as_f64() * f64::from(rate.numerator) / f64::from(rate.denominator.max(1));
    #[expect(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "from 0 to 1")]
    let share = (passed - frame as f64).clamp(0.0, 1.0) as f32;
    sample(frame) + (sample(frame + 1) - sample(frame)) * share
}

/// Returns a value in thousandths, the nearest.
#[expect(clippy::cast_possible_truncation, reason = "weights are at most 2,000,000")]
fn thousandths(value: f32) -> i32 {
    (f64::from(value) * 1000.0).round() as i32
}
