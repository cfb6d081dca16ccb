//! Clips and recordings of different lengths.

use crate::recordings::FileFacts;
use crate::recordings::clip::ClipMouth;
use crate::recordings::paths::shown;
use lipz_diagnostics::{Code, Diagnostic, escape};
use std::path::Path;

/// Reports visemes whose length differs from that of their recording by more than a frame or `tolerance_ms`.
pub(super) fn check(
    clip: &ClipMouth<'_>,
    path: &Path,
    facts: FileFacts,
    tolerance_ms: Option<u32>,
) -> Option<Diagnostic> {
    let (visemes, fps, length_us) = (clip.visemes?, clip.fps?, clip.length_us()?);
    let tolerance_us = tolerance_ms.map_or(fps.start_of_frame_us(1), |ms| u64::from(ms) * 1000);
    if clip.codes.is_empty() || length_us.abs_diff(facts.length_us) <= tolerance_us {
        return None;
    }
    let (mouth, sound) = (seconds(length_us), seconds(facts.length_us));
    let message = format!("the visemes last {mouth}, but the recording lasts {sound}");
    let frames = clip.codes.len();
    let wanted = u64::from(fps.numerator()) * facts.length_us;
    let wanted = wanted.div_ceil(u64::from(fps.denominator()) * 1_000_000);
    Some(
        Diagnostic::at(Code::RecordingLength, visemes.span(), message)
            .note(format!("the recording is `{}`", escape::text(&shown(path))))
            .note(format!(
                "the clip has {frames} frames at {} fps, but the recording needs {wanted}",
                rounded(fps.to_f64())
            ))
            .help("make the visemes again from the recording, or use the recording that they were made for"),
    )
}

fn rounded(number: f64) -> String {
    let text = format!("{number:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Returns seconds, such as `1.500 s`.
pub(super) fn seconds(us: u64) -> String {
    format!("{:.3} s", us as f64 / 1e6)
}
