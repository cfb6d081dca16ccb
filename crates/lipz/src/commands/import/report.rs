//! `--report`: what was used and lost, clip by clip, for scripts.

use lipz_compiler::Input;
use lipz_diagnostics::render::to_json;
use lipz_interop::{Clip, Format};
use serde::Serialize;

#[derive(Serialize)]
struct Document<'a> {
    format: &'a str,
    clips: Vec<OfClip<'a>>,
}

#[derive(Serialize)]
struct OfClip<'a> {
    key: &'a str,
    file: String,
    map: &'a str,
    fps: f64,
    frames: usize,
    lost: Vec<Loss<'a>>,
    /// How the file was read where there was a choice.
    remarks: &'a [String],
}

#[derive(Serialize)]
struct Loss<'a> {
    symbol: &'a str,
    start_ms: u64,
    end_ms: u64,
    why: &'static str,
}

/// The report as JSON.
pub(super) fn json<'a>(format: &Format, clips: impl Iterator<Item = (&'a Input, &'a Clip)>) -> String {
    let clips = clips.map(|(input, clip)| OfClip {
        key: &input.key,
        file: input.name(),
        map: &clip.map,
        fps: f64::from(clip.rate.numerator) / f64::from(clip.rate.denominator),
        frames: clip.frames,
        lost: clip.lost.iter().map(loss).collect(),
        remarks: &clip.remarks,
    });
    to_json(&Document { format: format.name, clips: clips.collect() })
}

fn loss(lost: &lipz_interop::LostShape) -> Loss<'_> {
    Loss {
        symbol: &lost.symbol,
        start_ms: lost.start.in_units(1000),
        end_ms: lost.end.in_units(1000),
        why: lost.reason.describe(),
    }
}
