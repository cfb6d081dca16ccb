//! TextGrids of lip sync: the alignments, to be corrected by hand, and the visemes of corrected ones.

mod imported;
mod tiers;
mod write;

pub use imported::{CodesOfPhones, codes_of_phones};
pub(super) use write::{tier as tier_of, written};

use crate::recordings::file_facts::{length_us, unreadable};
use crate::recordings::paths::shown;
use lipz_diagnostics::{Code, Diagnostic, Report};
use lipz_interop::textgrid::TextGrid;
use lipz_speech::{AlignedPhone, AlignedWord, Alignment, Script};
use lipz_types::Fps;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use tiers::{read_phones, read_words, tier, us};

/// The allowed difference between the lengths of a TextGrid and its recording, in microseconds, because tools round. An
/// exported TextGrid ends with a frame of the clip, so a frame is always allowed.
const TOLERANCE_US: u64 = 20_000;
const MICROSECONDS: u32 = 1_000_000;

/// Returns the path of a clip's TextGrid in the folder of TextGrids.
pub(crate) fn place(folder: &Path, key: &str) -> PathBuf {
    folder.join(format!("{key}.TextGrid"))
}

/// The content of a clip's TextGrid: the times of its phones and words.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Grid {
    length_us: u64,
    phones: Vec<AlignedPhone>,
    words: Vec<AlignedWord>,
}

impl Grid {
    /// Reads the TextGrid at `path`, if it exists. Reports why it cannot be used for this script.
    ///
    /// # Errors
    /// If it cannot be read at all.
    pub(super) fn read(path: &Path, script: &Script) -> Result<(Option<Grid>, Option<Report>), Report> {
        let bytes = match fs::read(path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok((None, None)),
            Err(error) => return Err(unreadable(path, &error)),
        };
        let mut diagnostics = Vec::new();
        let grid = Grid::parse(&bytes, script, &mut diagnostics);
        let report = (!diagnostics.is_empty()).then(|| Report::from_bytes(shown(path), &bytes, diagnostics));
        Ok((grid, report))
    }

    pub(super) fn parse(bytes: &[u8], script: &Script, diagnostics: &mut Vec<Diagnostic>) -> Option<Grid> {
        let grid = TextGrid::read(bytes, diagnostics)?;
        let Some(phones) = tier(&grid, "phones") else {
            let diagnostic = Diagnostic::new(Code::NoShapes, "the file has no tier called `phones`");
            diagnostics.push(
                diagnostic.help("rename the tier with the phones, or remove the file so that lipz writes it again"),
            );
            return None;
        };
        let (start, end) = (us(grid.start), us(grid.end));
        let phones = read_phones(phones, start, end, diagnostics)?;
        let words = read_words(tier(&grid, "words"), script, start, diagnostics)?;
        Some(Grid { length_us: end.saturating_sub(start), phones, words })
    }

    /// Checks that the TextGrid fits a recording of this length.
    ///
    /// # Errors
    /// If the lengths differ, so that it belongs to a different recording.
    pub(super) fn fits(&self, length_us: u64, fps: Fps) -> Result<(), Box<Diagnostic>> {
        fits(self.length_us, length_us, fps)
    }

    /// Returns its alignment, for a recording of this length.
    pub(super) fn alignment(&self, length_us: u64, script: &Script) -> Alignment {
        let phones = up_to(length_us, self.phones.clone());
        let words = self.words.clone();
        let last_us = words.iter().map(|word| word.end_us).max().unwrap_or(length_us);
        let break_us = |&word: &usize| words.get(word).map_or(last_us, |word| word.start_us);
        let breaks_us = script.breaks.iter().map(break_us).collect();
        Alignment { duration_us: length_us, phones, words, breaks_us, mismatches: Vec::new() }
    }
}

/// Cuts the phones at the end of the recording.
fn up_to(length_us: u64, mut phones: Vec<AlignedPhone>) -> Vec<AlignedPhone> {
    phones.iter_mut().for_each(|phone| phone.end_us = phone.end_us.min(length_us));
    phones.retain(|phone| phone.start_us < phone.end_us);
    if let Some(last) = phones.last_mut() {
        last.end_us = length_us;
    }
    phones
}

/// Checks that the length of a TextGrid fits that of a recording, whose visemes have this frame rate.
fn fits(own_us: u64, sound_us: u64, fps: Fps) -> Result<(), Box<Diagnostic>> {
    if own_us.abs_diff(sound_us) <= TOLERANCE_US.max(fps.start_of_frame_us(1)) {
        return Ok(());
    }
    let seconds = |us: u64| format!("{:.3} s", us as f64 / 1e6);
    let (own, sound) = (seconds(own_us), seconds(sound_us));
    let message = format!("the TextGrid lasts {own}, but the recording {sound}, so the TextGrid is not used");
    let help = "remove the TextGrid so that lipz writes it again, or use the recording that it was made for";
    Err(Box::new(Diagnostic::new(Code::RecordingLength, message).help(help)))
}

/// Reports a TextGrid at `place` that is invalid, or whose length differs from that of `recording`.
pub(crate) fn check(place: &Path, recording: &Path, fps: Fps) -> Option<Report> {
    let bytes = fs::read(place).ok()?;
    let sound_us = length_us(recording).ok()?; // problems of the recording are reported elsewhere
    let mut diagnostics = Vec::new();
    let grid = TextGrid::read(&bytes, &mut diagnostics);
    let length_us = grid.map(|grid| us(grid.end).saturating_sub(us(grid.start)));
    let unfit = length_us.and_then(|length_us| fits(length_us, sound_us, fps).err());
    diagnostics.extend(unfit.map(|unfit| *unfit));
    (!diagnostics.is_empty()).then(|| Report::from_bytes(shown(place), &bytes, diagnostics))
}
