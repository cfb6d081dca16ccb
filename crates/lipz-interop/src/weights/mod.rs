//! Animations of faces for other tools: the weights of a rig's shapes, one value per frame.
//!
//! Each format is one file with its [`WeightFormat`]. The caller computes the weights of a clip; the writers only
//! arrange them.

mod audio2face;
mod blender;
mod glb;
mod gltf;
mod godot;
mod keys;
mod live2d;
mod live_link;
mod spine;
mod unity;
mod vmd;
mod vrma;

use crate::Time;
use lipz_diagnostics::Diagnostic;
use lipz_file::rate::Rate;
use lipz_types::CurveValue;

/// The largest distance of a value between two keys from the weight, in thousandths, in formats with keys.
pub const KEY_TOLERANCE: i32 = 2;

/// A format for the weights of a face.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct WeightFormat {
    /// The name in commands, `live-link`.
    pub name: &'static str,
    /// A short description of the tool and its file.
    pub about: &'static str,
    /// The end of the names of its files, without the dot.
    pub extension: &'static str,
    /// The built-in rig whose shapes the format's tools usually have.
    pub rig: &'static str,
    /// Whether the frame rate of its files is fixed.
    pub fixed_rate: Option<Rate>,
    /// The writer. Diagnostics report losses.
    pub write: fn(&FaceAnimation, &mut Vec<Diagnostic>) -> Vec<u8>,
}

/// The weights of a face while a clip plays.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct FaceAnimation {
    /// The name of the clip, without folders.
    pub name: String,
    /// The frame rate of the values.
    pub rate: Rate,
    /// The number of frames, at least 1.
    pub frame_count: usize,
    /// The shapes, each with its values.
    pub weights: Vec<SampledWeight>,
}

/// A shape of a face, and its weight at the start of each frame.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct SampledWeight {
    /// The name of the shape.
    pub name: String,
    /// One value per frame.
    pub values: Vec<CurveValue>,
}

impl FaceAnimation {
    /// Returns an animation of shapes that all have this number of values, which is at least 1.
    pub fn new(name: impl Into<String>, rate: Rate, frame_count: usize, weights: Vec<SampledWeight>) -> FaceAnimation {
        FaceAnimation { name: name.into(), rate, frame_count, weights }
    }

    /// Returns the start of a frame in seconds.
    fn seconds(&self, frame: u32) -> f64 {
        Time::of_frame(frame.into(), self.rate).as_f64()
    }

    /// Returns the end of the last frame in seconds.
    fn duration_seconds(&self) -> f64 {
        Time::of_frame(self.frame_count as u64, self.rate).as_f64()
    }

    /// Returns the frame rate as a number.
    fn frames_per_second(&self) -> f64 {
        f64::from(self.rate.numerator) / f64::from(self.rate.denominator.max(1))
    }

    /// Returns the index of the shape with this name, in either case.
    fn index_of(&self, name: &str) -> Option<usize> {
        self.weights.iter().position(|weight| weight.name.eq_ignore_ascii_case(name))
    }
}

/// All formats, in the order of lists.
pub const ALL: &[WeightFormat] = &[
    live_link::FORMAT,
    audio2face::FORMAT,
    gltf::FORMAT,
    vrma::FORMAT,
    vmd::FORMAT,
    live2d::FORMAT,
    spine::FORMAT,
    godot::FORMAT,
    unity::FORMAT,
    blender::FORMAT,
];

/// Returns the format with this name.
pub fn find(name: &str) -> Option<&'static WeightFormat> {
    ALL.iter().find(|format| format.name == name)
}
