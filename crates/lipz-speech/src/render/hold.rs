//! Closed lips stay long enough to be seen.

use super::shapes::Shape;

/// Makes closed shapes last `hold_us`. The time comes from the shape before, as far as that keeps `least_us` (or, if it is
/// closed itself, `hold_us`); what is missing, from the shape after; and what is still missing, from all that is left of
/// either.
pub(super) fn hold(shapes: &mut Vec<Shape>, hold_us: u64, least_us: u64) {
    for current in 0..shapes.len() {
        if shapes[current].is_closed() {
            for keep_us in [least_us, 0] {
                take(shapes, current, hold_us, keep_us);
            }
        }
    }
    shapes.retain(|shape| shape.length_us() > 0);
}

/// Makes the shapes of other consonants last `hold_us` as far as the vowels beside them, and pauses, keep `frame_us`. Closed shapes come
/// afterwards and take what they need.
pub(super) fn hold_consonants(shapes: &mut [Shape], hold_us: u64, frame_us: u64) {
    for current in 0..shapes.len() {
        if shapes[current].is_consonant() {
            take(shapes, current, hold_us, frame_us);
        }
    }
}

/// Takes what a shape lacks from its neighbours, which keep `keep_us`, or `hold_us` if they are closed.
fn take(shapes: &mut [Shape], current: usize, hold_us: u64, keep_us: u64) {
    let is_consonant = shapes[current].is_consonant();
    let lacking = |shapes: &[Shape]| hold_us.saturating_sub(shapes[current].length_us());
    let spare_us = |shape: &Shape| {
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
