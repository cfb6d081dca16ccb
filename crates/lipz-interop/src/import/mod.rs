//! From a track to a Lipz document: codes, frames, segments, texts.

mod document;
mod options;
mod runs;

pub use options::{DEFAULT_RATE, ImportOptions};

pub(crate) use document::{element, fps, spell};
pub(crate) use runs::REST;

use crate::frames::{LossReason, resample};
use crate::segments::{Speech, divide};
use crate::{Format, Map, Mouth, Text, Time, Track, map};
use document::{OnFrames, document, texts};
use lipz_diagnostics::{Code, Diagnostic, Severity, escape};
use lipz_file::Document;
use lipz_file::rate::Rate;
use runs::{in_order, report, runs, with_codes};

/// The result of an import.
#[derive(Debug, Default)]
#[non_exhaustive]
pub struct Imported {
    /// The clips, one for each speaker of the file; none if a diagnostic is an error.
    pub clips: Vec<Clip>,
    /// What is wrong or lost.
    pub diagnostics: Vec<Diagnostic>,
}

/// An imported clip: the Lipz file of one speaker, and how it came about.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct Clip {
    /// What the file calls the speaker, if it has several.
    pub name: Option<String>,
    /// The clip as a Lipz file.
    pub document: Document<'static>,
    /// Its mouth, for a clip that exists: see [`Clip::merge`].
    pub mouth: Mouth,
    /// What is said, undivided, each with its locale.
    pub texts: Vec<Text>,
    /// The table that was used: `rhubarb 1`.
    pub map: String,
    /// The frame rate.
    pub rate: Rate,
    /// Frames of the clip.
    pub frames: usize,
    /// The shapes that have no frame.
    pub lost: Vec<LostShape>,
    /// How the file was read where there was a choice, a sentence each.
    pub remarks: Vec<String>,
}

/// A shape without a frame.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct LostShape {
    /// What the file calls it.
    pub symbol: String,
    /// When it starts.
    pub start: Time,
    /// When it ends.
    pub end: Time,
    /// Why it has no frame.
    pub reason: LossReason,
}

impl LostShape {
    /// The loss as a sentence.
    pub fn describe(&self) -> String {
        let ms = self.end.in_units(1000).saturating_sub(self.start.in_units(1000));
        format!("{} at {} ({ms} ms): {}", escape::quoted(&self.symbol), self.start, self.reason.describe())
    }
}

/// Reads a file of another tool as Lipz documents.
///
/// Nothing in the file makes this panic; what is wrong with it is in the diagnostics. Spans count from the
/// first byte after a byte order mark; in binary files, notes name the byte.
pub fn import(format: &Format, bytes: &[u8], options: &ImportOptions<'_>) -> Imported {
    let mut imported = Imported::default();
    let Some(read) = format.read else { return imported };
    let tracks = read(bytes, options, &mut imported.diagnostics);
    let several = tracks.len() > 1;
    let somebody_speaks = tracks.iter().any(|track| !track.shapes.is_empty());
    for mut track in tracks {
        if somebody_speaks && track.shapes.is_empty() {
            imported.diagnostics.push(silent_voice(&track));
            continue;
        }
        if !several {
            track.name = None;
        }
        let Some(map) = table(format, &track, options) else { continue };
        imported.clips.extend(clip(track, map, options, &mut imported.diagnostics));
    }
    imported.diagnostics.sort_by_key(Diagnostic::start);
    let is_error = |diagnostic: &Diagnostic| diagnostic.severity == Severity::Error;
    if imported.diagnostics.iter().any(is_error) {
        imported.clips.clear();
    }
    if imported.diagnostics.iter().any(|diagnostic| is_error(diagnostic) && diagnostic.code != Code::NoShapes) {
        // Shapes that could not be read are not missing.
        imported.diagnostics.retain(|diagnostic| diagnostic.code != Code::NoShapes);
    }
    imported
}

/// The voice of a file is left out: it has no mouth shapes, but another has.
fn silent_voice(track: &Track) -> Diagnostic {
    let name = track.name.as_deref().unwrap_or_default();
    let message = format!("the voice {} has no mouth shapes", escape::quoted(name));
    let mut diagnostic = Diagnostic::new(Code::NoShapes, message).note("no clip is made of it");
    diagnostic.severity = Severity::Warning;
    diagnostic
}

/// The table for a track: the one that is asked for, that of the file, or one of the format.
fn table<'m>(format: &Format, track: &Track, options: &ImportOptions<'m>) -> Option<&'m Map> {
    let of_format = || {
        let maps = format.maps.iter().filter_map(|name| map::find(name));
        let wanted = |map: &&Map| options.viseme_type.is_none_or(|wanted| wanted == map.viseme_type);
        let has_all = |map: &&Map| track.shapes.iter().all(|shape| map.code(&shape.symbol).is_some());
        let mut of_type = maps.clone().filter(wanted);
        // Files of one format come from several tools, each with its own names.
        of_type.clone().find(has_all).or_else(|| of_type.next()).or_else(|| maps.clone().next())
    };
    options.map.or_else(|| map::find(track.map?)).or_else(of_format)
}

/// The clip of a track.
fn clip(track: Track, map: &Map, options: &ImportOptions<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<Clip> {
    let rate = options.rate.or(track.rate).unwrap_or(options.default_rate);
    let track = match options.codes {
        Some(codes) => with_codes(track, codes, map, rate),
        None => in_order(track, diagnostics),
    };
    let (symbols, runs) = runs(&track, map, rate, diagnostics)?;
    if track.shapes.is_empty() {
        diagnostics.push(
            Diagnostic::new(Code::NoShapes, "the file has no mouth shapes")
                .help("was the tool interrupted, or not asked for visemes? let it analyse the recording again"),
        );
    }
    let resampled = resample(&runs, map.viseme_type, rate, options.min_hold);
    let lost: Vec<LostShape> = resampled
        .lost
        .iter()
        .filter_map(|&(index, reason)| {
            // The rest before the first shape is ours: nobody misses it.
            let run = runs.get(index).filter(|run| run.code != REST || run.start > Time::ZERO)?;
            Some(LostShape { symbol: (*symbols.get(index)?).to_owned(), start: run.start, end: run.end, reason })
        })
        .collect();
    report(&lost, symbols.len(), rate, diagnostics);
    if !track.shapes.is_empty() && resampled.lengths.iter().sum::<usize>() == 0 {
        let end = runs.last().map_or(Time::ZERO, |run| run.end);
        diagnostics.push(
            Diagnostic::new(Code::NoShapes, format!("the clip would have no frames: its shapes end at {end}"))
                .help("are the times of the file in the unit of its format?"),
        );
    }
    let texts = texts(&track, options, diagnostics);
    let speech = Speech::from_runs(&runs, options.min_pause);
    let division = divide(&track, &speech, &texts, options.segments, diagnostics);
    let frames = OnFrames::new(&runs, &resampled.lengths, rate);
    let mouth = Mouth::new(frames.codes.as_str(), rate, map.viseme_type)
        .words(frames.timed(&track.words))
        .phrases(frames.timed(&track.phrases));
    let codes = frames.divided(&division);
    let document = document(&track, codes, &texts, &division, map.viseme_type, rate);
    let frames = resampled.lengths.iter().sum();
    let (map, remarks) = (map.label(), track.remarks);
    Some(Clip { name: track.name, document, mouth, texts, map, rate, frames, lost, remarks })
}
