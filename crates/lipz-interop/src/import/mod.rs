//! Conversion of a track to a Lipz document: codes, frames, segments, texts.

mod curves;
mod document;
mod options;
mod phones;
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
pub struct ImportResult {
    /// The clips, one for each speaker of the file; empty if a diagnostic is an error.
    pub clips: Vec<ImportedClip>,
    /// The problems and losses.
    pub diagnostics: Vec<Diagnostic>,
}

/// An imported clip: the Lipz file of one speaker, and details of the import.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct ImportedClip {
    /// The speaker's name in the file, if it has several.
    pub name: Option<String>,
    /// The clip as a Lipz file.
    pub document: Document<'static>,
    /// Its lip-sync track, for an existing clip: see [`ImportedClip::merge`].
    pub mouth: Mouth,
    /// The undivided texts, each with its locale.
    pub texts: Vec<Text>,
    /// The mapping table used: `rhubarb 1`.
    pub map: String,
    /// The frame rate.
    pub rate: Rate,
    /// The number of frames.
    pub frames: usize,
    /// The shapes without frames.
    pub lost: Vec<LostShape>,
    /// Notes on how ambiguous parts of the file were read, one sentence each.
    pub remarks: Vec<String>,
}

/// A shape without a frame.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct LostShape {
    /// Its symbol in the file.
    pub symbol: String,
    /// The start of the shape.
    pub start: Time,
    /// The end of the shape.
    pub end: Time,
    /// The reason why it has no frame.
    pub reason: LossReason,
}

impl LostShape {
    /// Returns the loss as a sentence.
    pub fn describe(&self) -> String {
        let ms = self.end.in_units(1000).saturating_sub(self.start.in_units(1000));
        format!("{} at {} ({ms} ms): {}", escape::quoted(&self.symbol), self.start, self.reason.describe())
    }
}

/// Converts a file of another tool to Lipz documents.
///
/// No content of the file causes a panic; problems become diagnostics. Spans count from the first byte after a byte
/// order mark. For binary files, notes state the byte.
pub fn import(format: &Format, bytes: &[u8], options: &ImportOptions<'_>) -> ImportResult {
    let mut imported = ImportResult::default();
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
        // If shapes could not be read, they are not reported as missing.
        imported.diagnostics.retain(|diagnostic| diagnostic.code != Code::NoShapes);
    }
    imported
}

/// Returns the diagnostic for a voice that is skipped, because only other voices of the file have mouth shapes.
fn silent_voice(track: &Track) -> Diagnostic {
    let name = track.name.as_deref().unwrap_or_default();
    let message = format!("the voice {} has no mouth shapes", escape::quoted(name));
    let mut diagnostic = Diagnostic::new(Code::NoShapes, message).note("it does not become a clip");
    diagnostic.severity = Severity::Warning;
    diagnostic
}

/// Returns the mapping table for a track: the requested one, that of the file, or one of the format.
fn table<'m>(format: &Format, track: &Track, options: &ImportOptions<'m>) -> Option<&'m Map> {
    let of_format = || {
        let maps = format.maps.iter().filter_map(|name| map::find(name));
        let wanted = |map: &&Map| options.viseme_type.is_none_or(|wanted| wanted == map.viseme_type);
        let has_all = |map: &&Map| track.shapes.iter().all(|shape| map.code(&shape.symbol).is_some());
        let mut of_type = maps.clone().filter(wanted);
        // Files of one format come from several tools, with different names.
        of_type.clone().find(has_all).or_else(|| of_type.next()).or_else(|| maps.clone().next())
    };
    options.map.or_else(|| map::find(track.map?)).or_else(of_format)
}

/// Returns the clip of a track.
fn clip(
    track: Track,
    map: &Map,
    options: &ImportOptions<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<ImportedClip> {
    let rate = options.rate.or(track.rate).unwrap_or(options.default_rate);
    let phones = phones::phones_of(&track, map);
    let track = match options.codes {
        Some(codes) => with_codes(track, codes, map, rate),
        None => in_order(track, diagnostics),
    };
    let (symbols, runs) = runs(&track, map, rate, diagnostics)?;
    if track.shapes.is_empty() {
        diagnostics.push(
            Diagnostic::new(Code::NoShapes, "the file has no mouth shapes")
                .help("analyse the recording again, with visemes; the tool may have been interrupted"),
        );
    }
    let resampled = resample(&runs, map.viseme_type, rate, options.min_hold);
    let lost: Vec<LostShape> = resampled
        .lost
        .iter()
        .filter_map(|&(index, reason)| {
            // The importer added the rest before the first shape, so its loss is not reported.
            let run = runs.get(index).filter(|run| run.code != REST || run.start > Time::ZERO)?;
            Some(LostShape { symbol: (*symbols.get(index)?).to_owned(), start: run.start, end: run.end, reason })
        })
        .collect();
    report(&lost, symbols.len(), rate, diagnostics);
    if !track.shapes.is_empty() && resampled.lengths.iter().sum::<usize>() == 0 {
        let end = runs.last().map_or(Time::ZERO, |run| run.end);
        diagnostics.push(
            Diagnostic::new(Code::NoShapes, format!("the clip would have no frames because its shapes end at {end}"))
                .help("check whether the times of the file have the unit of its format"),
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
    let frames: usize = resampled.lengths.iter().sum();
    let phones = phones::spelled(phones, Time::of_frame(frames as u64, rate));
    let mouth = mouth.phones(phones.clone());
    let mut document = document(&track, codes, &texts, &division, map.viseme_type, rate);
    let (map, mut remarks) = (map.label(), track.remarks);
    document.elements.extend(phones.map(|phones| element(lipz_file::phones::ELEMENT, phones)));
    if frames.saturating_mul(track.weights.names.len()) > curves::MOST_VALUES {
        let message = format!("{} weights in {frames} frames are too many", track.weights.names.len());
        diagnostics.push(
            Diagnostic::new(Code::ForeignValue, message).help("check whether the times have the unit of the format"),
        );
    } else if let Some(curves) = curves::curves(track.weights, frames, rate) {
        document.elements.push(curves.element);
        remarks.push(curves.remark);
    }
    Some(ImportedClip { name: track.name, document, mouth, texts, map, rate, frames, lost, remarks })
}
