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

/// Takes what a shape lacks from its neighbours, which keep `keep_us`, or `hold_us` if they are closed.
fn take(shapes: &mut [Shape], current: usize, hold_us: u64, keep_us: u64) {
    let lacking = |shapes: &[Shape]| hold_us.saturating_sub(shapes[current].length_us());
    let spare_us = |shape: &Shape| {
        let keep_us = if shape.is_closed() { hold_us } else { keep_us };
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
