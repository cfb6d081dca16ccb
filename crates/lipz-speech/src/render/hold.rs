//! Keeps closed lips visible for long enough.

use super::shapes::TimedShape;

/// Extends closed shapes to `hold_us`. The time comes from the shape before, and then from the shape after. At first they
/// keep `frame_us`, so that a short vowel is visible, then `least_us`, and then nothing, but `hold_us` if they are
/// closed.
pub(super) fn hold(shapes: &mut Vec<TimedShape>, hold_us: u64, frame_us: u64, least_us: u64) {
    for current in 0..shapes.len() {
        if shapes[current].is_closed() {
            for keep_us in [frame_us, least_us, 0] {
                take(shapes, current, hold_us, keep_us);
            }
        }
    }
    shapes.retain(|shape| shape.length_us() > 0);
}

/// Extends the shapes of other consonants to `hold_us`, as long as the adjacent vowels and pauses keep `frame_us`.
/// Closed shapes are extended afterwards and take the time they need.
pub(super) fn hold_consonants(shapes: &mut [TimedShape], hold_us: u64, frame_us: u64) {
    for current in 0..shapes.len() {
        if shapes[current].is_consonant() {
            take(shapes, current, hold_us, frame_us);
        }
    }
}

/// Takes the missing time of a shape from its neighbours, which keep `keep_us`, or `hold_us` if they are closed.
fn take(shapes: &mut [TimedShape], current: usize, hold_us: u64, keep_us: u64) {
    let is_consonant = shapes[current].is_consonant();
    let lacking = |shapes: &[TimedShape]| hold_us.saturating_sub(shapes[current].length_us());
    let spare_us = |shape: &TimedShape| {
        let is_held = shape.is_closed() || is_consonant && shape.is_consonant();
        let keep_us = if is_held { hold_us } else { keep_us };
        shape.length_us().saturating_sub(keep_us)
    };
    let lacking_us = lacking(shapes);
    if let Some(before) = current.checked_sub(1).and_then(|before| shapes.get_mut(before)) {
        let taken_us = lacking_us.min(spare_us(before));
        before.end_us -= taken_us;
        shapes[current].start_us -= taken_us;
    }
    let lacking_us = lacking(shapes);
    if let Some(after) = shapes.get_mut(current + 1) {
        let taken_us = lacking_us.min(spare_us(after));
        after.start_us += taken_us;
        shapes[current].end_us += taken_us;
    }
}
