//! Live Link Face recordings, CSV: the 52 shapes of ARKit and 9 angles of head and eyes, one line per frame.

use super::{FaceAnimation, WeightFormat};
use lipz_diagnostics::{Code, Diagnostic, escape};
use lipz_file::curve::{ARKIT, LIVE_LINK_ANGLES};
use std::fmt::Write;

const SECONDS_PER_HOUR: u64 = 3600;

pub(super) const FORMAT: WeightFormat = WeightFormat {
    name: "live-link",
    about: "Live Link Face (ARKit) recordings, CSV",
    extension: "csv",
    rig: "arkit",
    fixed_rate: None,
    write,
};

fn write(animation: &FaceAnimation, diagnostics: &mut Vec<Diagnostic>) -> Vec<u8> {
    let columns: Vec<&str> = ARKIT.into_iter().chain(LIVE_LINK_ANGLES).collect();
    left_out(animation, &columns, diagnostics);
    let per_second = u64::from(animation.rate.numerator.div_ceil(animation.rate.denominator.max(1)));
    if animation.rate.denominator > 1 {
        let message = format!("timecodes count {per_second} frames per second, because they need a whole number");
        let help = format!("import the file with `--file-rate {}`", animation.frames_per_second());
        diagnostics.push(Diagnostic::new(Code::ExportLoss, message).help(help));
    }
    let mut csv = format!(
        "Timecode,BlendShapeCount,{}\n",
        columns.iter().map(|name| capital(name)).collect::<Vec<_>>().join(",")
    );
    let indices: Vec<Option<usize>> = columns.iter().map(|name| animation.index_of(name)).collect();
    for frame in 0..animation.frame_count {
        let (seconds, in_second) = (frame as u64 / per_second, frame as u64 % per_second);
        let (hours, minutes) = (seconds / SECONDS_PER_HOUR, seconds / 60 % 60);
        // Writing to a string cannot fail.
        let _ = write!(csv, "{hours:02}:{minutes:02}:{:02}:{in_second:02}.000,{}", seconds % 60, columns.len());
        for index in &indices {
            let value = index.and_then(|index| animation.weights.get(index)?.values.get(frame)).copied();
            let _ = write!(csv, ",{:.3}", f64::from(value.unwrap_or_default().thousandths()) / 1000.0);
        }
        csv.push('\n');
    }
    csv.into_bytes()
}

/// Reports shapes without a column that move.
pub(super) fn left_out(animation: &FaceAnimation, columns: &[&str], diagnostics: &mut Vec<Diagnostic>) {
    let is_column = |name: &str| columns.iter().any(|column| column.eq_ignore_ascii_case(name));
    let moves = |values: &[lipz_types::CurveValue]| values.iter().any(|value| value.thousandths() != 0);
    let lost: Vec<String> = animation
        .weights
        .iter()
        .filter(|weight| !is_column(&weight.name) && moves(&weight.values))
        .map(|weight| escape::quoted(&weight.name))
        .collect();
    if !lost.is_empty() {
        let message = format!("the format has no column for {}", lost.join(", "));
        diagnostics.push(
            Diagnostic::new(Code::ExportLoss, message).help("export to gltf, which stores shapes with any names"),
        );
    }
}

/// Returns the name of a shape as Live Link spells it.
fn capital(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map_or_else(String::new, |first| first.to_ascii_uppercase().to_string() + letters.as_str())
}
