//! Animations of faces in binary glTF files: weights of morph targets by name, and expressions of VRM animations
//! (`.vrma`). All of them become curves, as in Live Link recordings.

use super::Format;
use super::face_frames::{self, Symbols};
use super::glb::{Glb, index};
use crate::{ImportOptions, Time, Track, find_map};
use lipz_diagnostics::{Code, Diagnostic};
use lipz_file::rate::Rate;
use serde_json::Value;
use std::collections::HashSet;

const TABLES: [&str; 3] = ["arkit", "vrm", "ovr"];
/// Weaker shapes are ignored for the visemes.
const FLOOR: f32 = 0.15;
/// The most weights: those of 300 shapes in an hour with 60 frames per second.
const MOST_VALUES: usize = 1 << 26;
/// The usual frame rates. A file has the first one whose frames include all of its keys.
const RATES: [u32; 6] = [24, 25, 30, 48, 50, 60];
/// The largest distance of a key from its frame, in frames. Times are rounded to 32 bits.
const NEAR: f64 = 0.02;
/// The largest time of a key in seconds: longer than any clip.
const LATEST_SECONDS: f32 = 100_000.0;

pub(super) const FORMAT: Format = Format {
    name: "gltf",
    about: "glTF animations of morph targets or VRM expressions, .glb or .vrma",
    extension: "glb",
    maps: &TABLES,
    is_binary: true,
    is_legacy: false,
    keeps_texts: false,
    read: Some(read),
    write: None,
};

/// The keys of one weight.
struct WeightTrack {
    name: String,
    seconds: Vec<f32>,
    weights: Vec<f32>,
    /// Whether a weight stays until the next key.
    is_stepped: bool,
}

fn read(bytes: &[u8], options: &ImportOptions<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Track> {
    let Some(glb) = Glb::read(bytes, diagnostics) else { return Vec::new() };
    let mut tracks = Vec::new();
    let animations = glb.json.get("animations").and_then(Value::as_array).map(Vec::as_slice).unwrap_or_default();
    for channel in animations.iter().take(1).flat_map(channels).take(face_frames::MOST_SHAPES + 1) {
        match tracks_of(&glb, &channel) {
            Some(found) => tracks.extend(found),
            None => {
                let message = "a channel of the animation has no valid keys";
                diagnostics.push(Diagnostic::new(Code::ForeignSyntax, message).help("export the animation again"));
                return Vec::new();
            }
        }
    }
    if tracks.len() > face_frames::MOST_SHAPES {
        let message = format!("the animation moves more than {} shapes", face_frames::MOST_SHAPES);
        diagnostics.push(Diagnostic::new(Code::ForeignValue, message).help("export only the face"));
        return Vec::new();
    }
    if tracks.is_empty() {
        let message = "the file has no animation of morph targets or of VRM expressions";
        diagnostics.push(Diagnostic::new(Code::NoShapes, message).help("export the shapes with the animation"));
        return Vec::new();
    }
    let times = times(&tracks);
    if times.len().saturating_mul(tracks.len()) > MOST_VALUES {
        let message = format!("the {} shapes have keys at {} times, which are too many", tracks.len(), times.len());
        diagnostics
            .push(Diagnostic::new(Code::ForeignValue, message).help("export only the face, with keys at frames"));
        return Vec::new();
    }
    let mut track = track(tracks, &times, options);
    if animations.len() > 1 {
        track.remarks.push(format!("{} more animations of the file are left out", animations.len() - 1));
    }
    vec![track]
}

/// A channel with its sampler: the node and its property, and the accessors of times and values.
struct Channel<'j> {
    node: usize,
    path: &'j str,
    input: &'j Value,
    output: &'j Value,
    interpolation: &'j str,
}

fn channels(animation: &Value) -> Vec<Channel<'_>> {
    let channel = |channel: &'_ Value| -> Option<(usize, usize)> {
        Some((index(channel.get("sampler")?)?, index(channel.get("target")?.get("node")?)?))
    };
    let list = animation.get("channels").and_then(Value::as_array).map(Vec::as_slice).unwrap_or_default();
    let of = |json| {
        let (sampler, node) = channel(json)?;
        let sampler = animation.get("samplers")?.get(sampler)?;
        let path = json.get("target")?.get("path")?.as_str()?;
        let interpolation = sampler.get("interpolation").and_then(Value::as_str).unwrap_or("LINEAR");
        Some(Channel { node, path, input: sampler.get("input")?, output: sampler.get("output")?, interpolation })
    };
    list.iter().filter_map(of).collect()
}

/// Returns the weights of a channel: all morph targets of a node, or the expression of a node. `None` if its numbers
/// are invalid; nothing for other channels.
fn tracks_of(glb: &Glb<'_>, channel: &Channel<'_>) -> Option<Vec<WeightTrack>> {
    let names = match channel.path {
        "weights" => target_names(glb, channel.node),
        "translation" => expression(glb, channel.node).into_iter().collect(),
        _ => Vec::new(),
    };
    if names.is_empty() {
        return Some(Vec::new());
    }
    let seconds = glb.floats(channel.input, "SCALAR", 1)?;
    let is_time = |pair: &[f32]| pair.first() < pair.last();
    if seconds.is_empty()
        || !seconds.windows(2).all(is_time)
        || !seconds.iter().all(|time| (0.0..LATEST_SECONDS).contains(time))
    {
        return None;
    }
    // A spline stores tangents before and after each value.
    let values_per_key = if channel.interpolation == "CUBICSPLINE" { 3 } else { 1 };
    let (values, width) = match channel.path {
        "weights" => (glb.floats(channel.output, "SCALAR", 1)?, names.len()),
        _ => (glb.floats(channel.output, "VEC3", 3)?, 3),
    };
    if values.len() != seconds.len().checked_mul(width)?.checked_mul(values_per_key)? {
        return None;
    }
    let middle = values_per_key / 2;
    let value = |key: usize, component: usize| values.get((key * values_per_key + middle) * width + component).copied();
    let is_stepped = channel.interpolation == "STEP";
    let of_name = |(component, name): (usize, String)| {
        let weights: Option<Vec<f32>> = (0..seconds.len())
            .map(|key| value(key, component).filter(|weight| weight.abs() <= face_frames::LARGEST))
            .collect();
        Some(WeightTrack { name, seconds: seconds.clone(), weights: weights?, is_stepped })
    };
    names.into_iter().enumerate().map(of_name).collect()
}

/// Returns the names of the morph targets of a node's mesh.
fn target_names(glb: &Glb<'_>, node: usize) -> Vec<String> {
    let mesh = || glb.json.get("meshes")?.get(index(glb.json.get("nodes")?.get(node)?.get("mesh")?)?);
    let names = || mesh()?.get("extras")?.get("targetNames")?.as_array();
    names().into_iter().flatten().filter_map(|name| Some(face_frames::curve_name(name.as_str()?))).collect()
}

/// Returns the name of the VRM expression that a node moves.
fn expression(glb: &Glb<'_>, node: usize) -> Option<String> {
    let expressions = glb.json.get("extensions")?.get("VRMC_vrm_animation")?.get("expressions")?;
    let groups = ["preset", "custom"].into_iter().filter_map(|group| expressions.get(group)?.as_object());
    let is_of_node = |(_, expression): &(&String, &Value)| expression.get("node").and_then(index) == Some(node);
    groups.flatten().find(is_of_node).map(|(name, _)| name.clone())
}

/// Returns the times of all keys, in order.
fn times(tracks: &[WeightTrack]) -> Vec<f32> {
    let mut times: Vec<f32> = tracks.iter().flat_map(|track| track.seconds.iter().copied()).collect();
    times.sort_by(f32::total_cmp);
    times.dedup();
    times
}

/// Returns the track of some weights, with a row for each time at which one of them has a key.
fn track(mut tracks: Vec<WeightTrack>, times: &[f32], options: &ImportOptions<'_>) -> Track {
    let (mut known, all) = (HashSet::new(), tracks.len());
    tracks.retain(|track| known.insert(track.name.clone()));
    let is_on_frame = |rate: f64, time: f32| (f64::from(time) * rate - (f64::from(time) * rate).round()).abs() <= NEAR;
    let fits = |rate: &u32| times.iter().all(|time| is_on_frame(f64::from(*rate), *time));
    let numerator = RATES.into_iter().find(fits).or(RATES.last().copied()).unwrap_or(60);
    let rate = options.file_rate.unwrap_or(Rate { numerator, denominator: 1, is_exact: true });
    let has = |table: &&&str| {
        let of_table = find_map(table);
        tracks.iter().filter(|track| of_table.is_some_and(|map| map.code(&track.name).is_some())).count()
    };
    let table =
        TABLES.iter().max_by_key(|table| has(table)).copied().filter(|table| has(&table) > 0).unwrap_or("arkit");
    let mut made = Track { rate: Some(rate), map: Some(table), ..Track::default() };
    if tracks.len() < all {
        made.remarks.push(format!("{} weights of further meshes with the same names are left out", all - tracks.len()));
    }
    made.weights.names = tracks.iter().map(|track| track.name.clone()).collect();
    let Some(map) = options.map.or_else(|| find_map(table)) else { return made };
    let rest = if table == "ovr" { "sil" } else { "rest" };
    let symbols = Symbols::Strongest { map, floor: FLOOR, rest };
    for &time in times {
        let Some(start) = Time::from_f32(time) else { continue };
        let weights = tracks.iter().map(|track| track.at(time)).collect();
        face_frames::add(&mut made, symbols, None, start, weights);
    }
    face_frames::finish(&mut made, rate);
    made
}

impl WeightTrack {
    /// Returns the weight at a time.
    fn at(&self, time: f32) -> f32 {
        let next = self.seconds.partition_point(|key| *key <= time);
        let value = |key: usize| self.weights.get(key).copied().unwrap_or_default();
        let (Some(before), Some(&after)) = (next.checked_sub(1), self.seconds.get(next)) else {
            return value(next.saturating_sub(1).min(self.weights.len().saturating_sub(1)));
        };
        let start = self.seconds.get(before).copied().unwrap_or_default();
        match self.is_stepped {
            true => value(before),
            false => value(before) + (value(next) - value(before)) * ((time - start) / (after - start)),
        }
    }
}
