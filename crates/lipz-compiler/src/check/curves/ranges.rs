//! Values of known curves that a face cannot show.

use super::who_and_what;
use lipz_bank::curve::CurveValue;
use lipz_bank::face::{Emotion, FaceCurve};
use lipz_diagnostics::{Code, Diagnostic};
use lipz_file::curve::{self, Curve};
use std::ops::RangeInclusive;

/// Returns the range of a known curve in thousandths, or `None` for a curve that the project defines.
fn range_of(name: &str) -> Option<RangeInclusive<i32>> {
    let what = who_and_what(name).1;
    if Emotion::from_name(what).is_some() {
        return Some(0..=10_000);
    }
    let shape = curve::is_arkit(name).then_some(0..=1000);
    FaceCurve::from_name(what).map(range_of_face).or(shape)
}

fn range_of_face(curve: FaceCurve) -> RangeInclusive<i32> {
    use FaceCurve::*;
    match curve {
        Blink | Lids | Brows | Shrug | Pose => 0..=1000,
        Nod | Shake | Breath => 0..=10_000,
        HeadPitch | HeadYaw | HeadRoll | EyePitch | EyeYaw | LookPitch | LookYaw => -180_000..=180_000,
    }
}

/// Returns the diagnostic for the first value of a curve that is outside its range.
pub(super) fn outside(curve: &Curve<'_>) -> Option<Diagnostic> {
    let range = range_of(&curve.name.text)?;
    let is_outside = |key: &&curve::Key| !range.contains(&key.value.thousandths());
    let key = curve.keys.iter().find(is_outside)?;
    let more = curve.keys.iter().filter(is_outside).count() - 1;
    let [least, most] = [*range.start(), *range.end()].map(CurveValue::from_thousandths);
    let message = format!("{} {} is outside {least} to {most}", curve.name.text, key.value);
    let diagnostic = Diagnostic::at(Code::CurveOutOfRange, key.span, message);
    let diagnostic = match more {
        0 => diagnostic,
        1 => diagnostic.note("1 more value of this curve is outside"),
        _ => diagnostic.note(format!("{more} more values of this curve are outside")),
    };
    Some(
        diagnostic
            .help(format!("write a value from {least} to {most}, or rename the curve if it belongs to your own rig")),
    )
}
