//! The result of an import as JSON: the tables used and the shapes lost, clip by clip.

use lipz_compiler::Input;
use lipz_interop::{Format, ImportedClip};
use serde::Serialize;

#[derive(Serialize)]
pub(super) struct ImportDocument<'a> {
    format: &'a str,
    clips: Vec<ClipRow<'a>>,
}

#[derive(Serialize)]
struct ClipRow<'a> {
    key: &'a str,
    file: String,
    map: &'a str,
    fps: f64,
    frames: usize,
    lost: Vec<Loss<'a>>,
    /// How the file was interpreted where it is ambiguous.
    remarks: &'a [String],
}

#[derive(Serialize)]
struct Loss<'a> {
    symbol: &'a str,
    start_ms: u64,
    end_ms: u64,
    why: &'static str,
}

impl<'a> ImportDocument<'a> {
    /// The report about the clips that were made of files in this format.
    pub(super) fn new(
        format: &'a Format,
        clips: impl Iterator<Item = (&'a Input, &'a ImportedClip)>,
    ) -> ImportDocument<'a> {
        let clips = clips.map(|(input, clip)| ClipRow {
            key: &input.key,
            file: input.name(),
            map: &clip.map,
            fps: f64::from(clip.rate.numerator) / f64::from(clip.rate.denominator),
            frames: clip.frames,
            lost: clip.lost.iter().map(loss).collect(),
            remarks: &clip.remarks,
        });
        ImportDocument { format: format.name, clips: clips.collect() }
    }
}

fn loss(lost: &lipz_interop::LostShape) -> Loss<'_> {
    Loss {
        symbol: &lost.symbol,
        start_ms: lost.start.in_units(1000),
        end_ms: lost.end.in_units(1000),
        why: lost.reason.describe(),
    }
}
