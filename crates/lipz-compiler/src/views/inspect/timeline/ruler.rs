//! The time ruler above the frames of a band.

use lipz_bank::Fps;
use std::fmt::Write;
use std::ops::Range;

/// Steps between ticks, in tenths of a second. The first one with enough room for the labels is used.
const STEPS_TENTHS: [u64; 16] = [1, 2, 5, 10, 20, 50, 100, 200, 600, 1200, 3000, 6000, 12_000, 36_000, 72_000, 360_000];
/// The number of frames between ticks without a frame rate.
const STEP_FRAMES: usize = 10;
/// The width of a label in columns, including the blank after it: `'12.5s `.
const LABEL_COLUMNS: usize = 7;

/// Returns the row of ticks: `'` is above the first frame at or after the time that follows it. A band that does not
/// start with a tick starts with the time of its first frame. No label exceeds `columns`.
pub(super) fn ruler(fps: Option<Fps>, frames: &Range<usize>, columns: usize) -> String {
    let mut row = LabelRow { text: String::new(), columns };
    match fps {
        Some(fps) => times(&mut row, fps, frames),
        None => {
            let first = frames.start.next_multiple_of(STEP_FRAMES);
            for frame in (first..frames.end).step_by(STEP_FRAMES) {
                row.tick(frame - frames.start, &format!("'{frame}"));
            }
        }
    }
    row.text
}

fn times(row: &mut LabelRow, fps: Fps, frames: &Range<usize>) {
    let (numerator, denominator) = (u64::from(fps.numerator()), u64::from(fps.denominator()));
    let frames_in = |tenths: u64| tenths * numerator / (10 * denominator);
    let enough = STEPS_TENTHS.into_iter().find(|&step| frames_in(step) >= LABEL_COLUMNS as u64);
    let step = enough.unwrap_or(STEPS_TENTHS[STEPS_TENTHS.len() - 1]);
    let frame_of = |tenths: u64| (tenths * numerator).div_ceil(10 * denominator);
    let (start, end) = (frames.start as u64, frames.end as u64);
    // The first tick at or after the start of the band.
    let mut tenths = (start * 10 * denominator / numerator) / step * step;
    while frame_of(tenths) < start {
        tenths += step;
    }
    if frame_of(tenths) > start {
        row.tick(0, &format!("'{:.2}s", fps.start_of_frame_us(u32::try_from(start).unwrap_or(u32::MAX)) as f64 / 1e6));
    }
    while frame_of(tenths) < end {
        let label = if step < 10 { format!("'{}.{}s", tenths / 10, tenths % 10) } else { format!("'{}s", tenths / 10) };
        row.tick(usize::try_from(frame_of(tenths) - start).unwrap_or(usize::MAX), &label);
        tenths += step;
    }
}

/// A row of labels that do not touch each other or exceed its end.
struct LabelRow {
    text: String,
    columns: usize,
}

impl LabelRow {
    fn tick(&mut self, column: usize, label: &str) {
        let is_free = self.text.is_empty() || self.text.len() < column;
        if is_free && column + label.len() <= self.columns {
            let _ = write!(self.text, "{:1$}{label}", "", column - self.text.len());
        }
    }
}
