//! The frame rate, an exact ratio between 1 and 1000.

use lipz_bank::Fps;
use lipz_diagnostics::{Code, Diagnostic};
use lipz_file::RawJson;
use lipz_file::rate;

/// Returns the frame rate in the element `fps`.
pub(super) fn rate(number: &RawJson<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<Fps> {
    let rate = rate::parse(&number.text);
    let fps = rate.and_then(|rate| Fps::new(rate.numerator, rate.denominator));
    let (Some(rate), Some(fps)) = (rate, fps) else {
        let message = format!("{} frames per second is outside 1 to 1000", shortened(&number.text));
        diagnostics.push(
            Diagnostic::at(Code::FpsOutOfRange, number.span, message)
                .help("write the frame rate of the mouth shapes, usually 24, 25 or 30"),
        );
        return None;
    };
    if !rate.is_exact {
        let (numerator, denominator) = (rate.numerator, rate.denominator);
        let message = format!("fps is stored as {numerator}/{denominator}, the nearest exact ratio");
        diagnostics.push(
            Diagnostic::at(Code::FpsInexact, number.span, message)
                .note("a bank stores frame rates as ratios of 32-bit numbers")
                .help(match denominator {
                    1 => format!("write {numerator} if you meant that rate"),
                    1001 => {
                        format!("write {} if you meant {numerator}/1001", f64::from(numerator) / f64::from(denominator))
                    }
                    _ => "write at most nine digits".to_owned(),
                }),
        );
    }
    Some(fps)
}

/// Returns the number, or its start if it is too long to read.
fn shortened(number: &str) -> String {
    match number.get(..24) {
        Some(start) if number.len() > 27 => format!("{start}…"),
        _ => number.to_owned(),
    }
}
