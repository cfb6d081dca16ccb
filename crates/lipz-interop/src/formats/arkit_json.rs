//! Frames of a face in JSON, as tools that track faces with ARKit's shapes store them: a list of frames, bare or below
//! `frames`, possibly in several chunks. Azure's speech service also sends its blend shapes in this form.
//!
//! A frame is a list of weights, or an object with named weights. It may state its time. All weights become curves, as
//! in Live Link recordings.

use super::Format;
use super::face_frames::{self, TABLE};
use crate::json::{self, Node};
use crate::{ImportOptions, Time, Track, source};
use lipz_diagnostics::{Code, Diagnostic, escape};
use lipz_file::curve::ARKIT;
use lipz_file::rate::Rate;
use std::collections::{BTreeSet, HashMap};

/// The frame rate of files that do not state one, as in Azure's speech service.
const RATE: Rate = Rate { numerator: 60, denominator: 1, is_exact: true };
/// The usual rates of cameras.
const RATES: [u32; 6] = [24, 25, 30, 48, 50, 60];
const MILLISECONDS_PER_SECOND: f64 = 1000.0;
/// The weights of Azure after those of ARKit.
const AZURE: [&str; 3] = ["headRoll", "leftEyeRoll", "rightEyeRoll"];

/// The members with the list of frames, with the names of listed weights, and with the weights of a frame.
const FRAMES: &[&str] = &["frames", "BlendShapes", "data"];
const NAMES: &[&str] = &["names", "blendShapeNames", "facsNames"];
const WEIGHTS: &[&str] = &["blendShapes", "weights", "values", "faceBlendshapes", "categories"];
/// The members with the time of a frame, in seconds or in milliseconds.
const SECONDS: &[&str] = &["time", "seconds", "timestamp"];
const MILLISECONDS: &[&str] = &["time_ms", "timeMs", "timestamp_ms", "timestampMs", "ms"];
/// The members with the number of a frame.
const NUMBERS: &[&str] = &["frame", "index", "FrameIndex"];

pub(super) const FORMAT: Format = Format {
    name: "arkit-json",
    about: "ARKit weights per frame, JSON, also of Azure and MediaPipe",
    extension: "json",
    maps: &[TABLE, "rms"],
    is_binary: false,
    is_legacy: false,
    keeps_texts: false,
    read: Some(read),
    write: None,
};

fn read(bytes: &[u8], options: &ImportOptions<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Track> {
    let Some(text) = source::text(bytes, diagnostics) else { return Vec::new() };
    let chunks = json::joined(text, diagnostics);
    let Some((symbols, table)) = face_frames::symbols(options) else { return Vec::new() };
    let first = chunks.first().filter(|chunk| chunk.is_object());
    let stated = first.and_then(|root| face_frames::stated_rate(*root, &["fps", "frameRate"], diagnostics));
    let listed = match first.and_then(|root| root.get(NAMES)).and_then(Node::items) {
        Some(list) => face_frames::names(&list, diagnostics).unwrap_or_default(),
        None => Vec::new(),
    };
    let mut reader = FrameReader { names: NameIndex::default(), listed, left_out: BTreeSet::new(), diagnostics };
    let mut frames: Vec<ArkitFrame<'_>> = Vec::new();
    for chunk in chunks {
        let list = if chunk.is_object() { chunk.get(FRAMES) } else { Some(chunk) };
        let Some(list) = list.and_then(Node::items) else {
            reader.diagnostics.push(
                chunk
                    .lacks("a list of frames, \"frames\",")
                    .help("write each frame as an object: { \"time\": 0.5, \"jawOpen\": 0.3 }"),
            );
            continue;
        };
        for node in list {
            frames.extend(reader.frame(node));
            if reader.names.names.len() > face_frames::MOST_SHAPES {
                let message = format!("the frames up to here name more than {} shapes", face_frames::MOST_SHAPES);
                let diagnostic = Diagnostic::at(Code::ForeignValue, node.span(), message);
                reader.diagnostics.push(diagnostic.help("check whether the names are those of shapes"));
                return Vec::new();
            }
        }
    }
    let FrameReader { names, left_out, .. } = reader;
    let per_second = if are_milliseconds(&frames) { MILLISECONDS_PER_SECOND } else { 1.0 };
    let rate = options.file_rate.or(stated).or_else(|| rate_of(&frames, per_second)).unwrap_or(RATE);
    let mut track = Track { rate: Some(rate), map: Some(table), ..Track::default() };
    track.weights.names = names.names;
    let left_out = left_out.iter().map(|name| format!("the member {} is left out", escape::quoted(name)));
    track.remarks.extend(left_out);
    let exponent = if per_second > 1.0 { "e-3" } else { "" };
    for (index, frame) in (0..).zip(frames) {
        let stated = frame.time.as_ref().and_then(|time| Time::parse(&format!("{}{exponent}", time.digits)));
        let mut weights = frame.weights;
        weights.resize(track.weights.names.len(), 0.0);
        let start = stated.unwrap_or(Time::of_frame(index, rate));
        face_frames::add(&mut track, symbols, Some(frame.node.span()), start, weights);
    }
    face_frames::finish(&mut track, rate);
    vec![track]
}

/// Returns the categories of MediaPipe: below an object, or below the first face of a list.
fn categories(node: Node<'_>) -> Option<Node<'_>> {
    let face = if node.is_object() { Some(node) } else { node.items()?.into_iter().next() };
    face.filter(|face| face.is_object())?.get(&["categories"])
}

/// Returns the name and the score of one of MediaPipe's categories.
fn category(item: Node<'_>) -> Option<(String, Node<'_>)> {
    let name = item.get(&["categoryName", "category_name", "name"])?.string()?;
    Some((name, item.get(&["score", "value", "weight"])?))
}

/// A frame of the file.
struct ArkitFrame<'s> {
    node: Node<'s>,
    time: Option<StatedTime>,
    /// A weight for each name that was known when the frame was read.
    weights: Vec<f32>,
}

/// The time of a frame, before its unit is determined.
struct StatedTime {
    digits: String,
    /// Whether its name indicates milliseconds.
    is_ms: bool,
}

/// Returns the usual frame rate that is nearest to the distance of the times; `None` without times.
fn rate_of(frames: &[ArkitFrame<'_>], per_second: f64) -> Option<Rate> {
    let times = || frames.iter().filter_map(|frame| frame.time.as_ref()?.digits.parse::<f64>().ok());
    let seconds = (times().next_back()? - times().next()?) / per_second;
    #[expect(clippy::cast_precision_loss, reason = "a number of frames")]
    let measured = times().count().saturating_sub(1) as f64 / seconds;
    let distance = |rate: &u32| (f64::from(*rate) - measured).abs();
    let numerator = RATES.into_iter().min_by(|one, other| distance(one).total_cmp(&distance(other)))?;
    Some(Rate { numerator, denominator: 1, is_exact: true })
}

/// Whether times are milliseconds: a name indicates it, or as seconds they would be more than a second apart.
fn are_milliseconds(frames: &[ArkitFrame<'_>]) -> bool {
    let times = || frames.iter().filter_map(|frame| frame.time.as_ref());
    let seconds = || times().filter_map(|time| time.digits.parse::<f64>().ok());
    let (first, last) = (seconds().next().unwrap_or(0.0), seconds().next_back().unwrap_or(0.0));
    #[expect(clippy::cast_precision_loss, reason = "a number of frames")]
    let is_sparse = last - first > times().count() as f64;
    times().any(|time| time.is_ms) || is_sparse
}

/// The names of all weights, in the order in which they occur.
#[derive(Default)]
struct NameIndex {
    names: Vec<String>,
    index_of: HashMap<String, usize>,
}

impl NameIndex {
    fn index(&mut self, name: &str) -> usize {
        if let Some(index) = self.index_of.get(name) {
            return *index;
        }
        let own = face_frames::curve_name(name);
        let next = self.names.len();
        let index = *self.index_of.entry(own.clone()).or_insert(next);
        if index == next {
            self.names.push(own);
        }
        self.index_of.insert(name.to_owned(), index);
        index
    }
}

/// Reads frames.
struct FrameReader<'d> {
    names: NameIndex,
    /// The names of listed weights.
    listed: Vec<String>,
    /// The members of frames that are not weights.
    left_out: BTreeSet<String>,
    diagnostics: &'d mut Vec<Diagnostic>,
}

impl FrameReader<'_> {
    fn frame<'s>(&mut self, node: Node<'s>) -> Option<ArkitFrame<'s>> {
        let (time, weights) = match node.is_object() {
            true => (self.time(node)?, node.get(WEIGHTS).unwrap_or(node)),
            false => (None, node),
        };
        let weights = self.weights(weights)?;
        Some(ArkitFrame { node, time, weights })
    }

    /// Returns the time that a frame states; `None` for a frame with an invalid time, which is reported.
    fn time(&mut self, frame: Node<'_>) -> Option<Option<StatedTime>> {
        let in_ms = frame.get(MILLISECONDS);
        let Some(node) = in_ms.or_else(|| frame.get(SECONDS)) else { return Some(None) };
        let digits = node.number().filter(|digits| Time::parse(digits).is_some_and(|_| !digits.contains(['e', 'E'])));
        if digits.is_none() {
            self.diagnostics.push(node.not("a time, a number of seconds"));
        }
        Some(Some(StatedTime { digits: digits?, is_ms: in_ms.is_some() }))
    }

    /// Returns the weights of a list or an object.
    fn weights(&mut self, node: Node<'_>) -> Option<Vec<f32>> {
        let node = categories(node).unwrap_or(node);
        if node.is_object() {
            return self.named(node.members());
        }
        let items = node.items().unwrap_or_default();
        if items.first().is_some_and(|first| first.is_object()) {
            let pairs = items.iter().map(|item| {
                let pair = category(*item);
                if pair.is_none() {
                    self.diagnostics.push(item.lacks("a name or a score"));
                }
                pair
            });
            let pairs: Option<Vec<_>> = pairs.collect();
            return self.named(pairs?);
        }
        if self.listed.is_empty() {
            let with_head = items.len() == ARKIT.len() + AZURE.len();
            let known = ARKIT.into_iter().chain(AZURE.into_iter().filter(|_| with_head));
            self.listed = known.map(str::to_owned).collect();
        }
        let weights = face_frames::row(node, self.listed.len(), self.diagnostics)?;
        let listed = std::mem::take(&mut self.listed);
        let row = self.row(listed.iter().map(String::as_str).zip(weights));
        self.listed = listed;
        Some(row)
    }

    /// Returns the weights of named members. Members about time and other members that are not numbers are skipped.
    fn named(&mut self, members: Vec<(String, Node<'_>)>) -> Option<Vec<f32>> {
        let is_one_of = |name: &str, known: &[&str]| known.iter().any(|known| known.eq_ignore_ascii_case(name));
        let mut weights = Vec::with_capacity(members.len());
        for (name, node) in members {
            if [SECONDS, MILLISECONDS, NUMBERS].into_iter().any(|known| is_one_of(&name, known)) {
                continue;
            }
            match node.number() {
                Some(_) => weights.push((name, face_frames::weight(node.line, self.diagnostics)?)),
                None => _ = self.left_out.insert(name),
            }
        }
        Some(self.row(weights.iter().map(|(name, weight)| (name.as_str(), *weight))))
    }

    fn row<'n>(&mut self, weights: impl Iterator<Item = (&'n str, f32)>) -> Vec<f32> {
        let mut row = vec![0.0; self.names.names.len()];
        for (name, weight) in weights {
            let index = self.names.index(name);
            row.resize(row.len().max(index + 1), 0.0);
            if let Some(place) = row.get_mut(index) {
                *place = weight;
            }
        }
        row
    }
}
