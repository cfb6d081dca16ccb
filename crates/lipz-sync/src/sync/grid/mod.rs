//! TextGrids beside the mouths: what was heard, to be corrected by hand; and mouths of what was corrected.

use crate::facts::unreadable;
use crate::recordings::shown;
use lipz_diagnostics::{Code, Diagnostic, Report, Span, escape};
use lipz_interop::Time;
use lipz_interop::textgrid::{Interval, TextGrid, Tier, is_silence};
use lipz_speech::{AlignedPhone, AlignedWord, Alignment, Phone, Script, phones_of_label};
use lipz_types::{Fps, VisemeType};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// By how much a TextGrid may be longer or shorter than its recording, in microseconds: tools round.
const TOLERANCE_US: u64 = 20_000;
const MICROSECONDS: u32 = 1_000_000;

/// The TextGrid of a clip in the folder of all.
pub(super) fn place(folder: &Path, key: &str) -> PathBuf {
    folder.join(format!("{key}.TextGrid"))
}

/// What a TextGrid says about a clip: when its phones and words are said.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Grid {
    length_us: u64,
    phones: Vec<AlignedPhone>,
    words: Vec<AlignedWord>,
}

impl Grid {
    /// Reads the TextGrid at `path`, if it is there. Reports why it cannot be used for this script.
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
            let diagnostic = Diagnostic::new(Code::NoShapes, "no tier is called `phones`");
            diagnostics
                .push(diagnostic.help("rename the tier with the phones, or remove the file: it is written anew"));
            return None;
        };
        let (start, end) = (us(grid.start), us(grid.end));
        let phones = read_phones(phones, start, end, diagnostics)?;
        let words = read_words(tier(&grid, "words"), script, start, diagnostics)?;
        Some(Grid { length_us: end.saturating_sub(start), phones, words })
    }

    /// The alignment that it says, for a sound of this length.
    ///
    /// # Errors
    /// If that is another length: it is about another sound.
    pub(super) fn alignment(&self, length_us: u64, script: &Script) -> Result<Alignment, Box<Diagnostic>> {
        if self.length_us.abs_diff(length_us) > TOLERANCE_US {
            let seconds = |us: u64| format!("{:.3} s", us as f64 / 1e6);
            let (own, sound) = (seconds(self.length_us), seconds(length_us));
            let message = format!("the TextGrid lasts {own}, but the recording {sound}: it is not used");
            let help =
                "it is of another take: remove it, and it is written anew; or take the recording it was made for";
            return Err(Box::new(Diagnostic::new(Code::RecordingLength, message).help(help)));
        }
        let mut phones = self.phones.clone();
        phones.iter_mut().for_each(|phone| phone.end_us = phone.end_us.min(length_us));
        phones.retain(|phone| phone.start_us < phone.end_us);
        if let Some(last) = phones.last_mut() {
            last.end_us = length_us;
        }
        let words = self.words.clone();
        let last_us = words.iter().map(|word| word.end_us).max().unwrap_or(length_us);
        let break_us = |&word: &usize| words.get(word).map_or(last_us, |word| word.start_us);
        let breaks_us = script.breaks.iter().map(break_us).collect();
        Ok(Alignment { duration_us: length_us, phones, words, breaks_us, mismatches: Vec::new() })
    }
}

/// The TextGrid of an alignment and its mouth, the codes of whose frames these are.
pub(super) fn written(
    alignment: &Alignment,
    script: &Script,
    codes: &str,
    (viseme_type, fps): (VisemeType, Fps),
) -> String {
    let time = |us: u64| Time::new(us, MICROSECONDS);
    let end = alignment.duration_us;
    let said = alignment.words.iter().zip(&script.words).filter(|(word, _)| word.start_us < word.end_us);
    let words = said.map(|(word, written)| (word.start_us, word.end_us, written.text.clone()));
    let phones = alignment.phones.iter().map(|phone| {
        let label = if phone.phone.is_speech() { phone.phone.to_string() } else { String::new() };
        (phone.start_us, phone.end_us, label)
    });
    let frames: Vec<char> = codes.chars().collect();
    let frame_us = |frame: usize| fps.start_of_frame_us(u32::try_from(frame).unwrap_or(u32::MAX)).min(end);
    let mut at = 0;
    let visemes = frames.chunk_by(|one, next| one == next).map(|run| {
        let start = at;
        at += run.len();
        (frame_us(start), if at == frames.len() { end } else { frame_us(at) }, run.iter().take(1).collect())
    });
    let tier = |name: &str, stretches: Vec<(u64, u64, String)>| {
        let mut intervals = Vec::with_capacity(stretches.len());
        let mut done = 0;
        let mut add = |from: u64, to: u64, label: String| {
            if from < to {
                intervals.push(Interval::new(time(from), time(to), label));
            }
        };
        // Praat wants intervals without gaps.
        for (from, to, label) in stretches {
            add(done, from, String::new());
            add(from.max(done), to, label);
            done = done.max(to);
        }
        add(done, end, String::new());
        Tier::new(name, intervals)
    };
    let shapes = match viseme_type {
        VisemeType::Blair => "visemes".to_owned(),
        other => format!("visemes-{}", other.name()),
    };
    let tiers =
        vec![tier("words", words.collect()), tier("phones", phones.collect()), tier(&shapes, visemes.collect())];
    TextGrid { start: Time::ZERO, end: time(end), tiers }.write()
}

/// The first tier of this name, also that of a speaker: `Mara - phones`.
fn tier<'g>(grid: &'g TextGrid, name: &str) -> Option<&'g Tier> {
    let own = |tier: &&Tier| tier.name.rsplit(" - ").next().is_some_and(|own| own.trim().eq_ignore_ascii_case(name));
    grid.tiers.iter().filter(|tier| !tier.has_points).find(own)
}

fn us(time: Time) -> u64 {
    time.in_units(MICROSECONDS)
}

/// The phones of a tier, from 0 to the end without gaps. Reports a label that is none.
fn read_phones(tier: &Tier, start: u64, end: u64, diagnostics: &mut Vec<Diagnostic>) -> Option<Vec<AlignedPhone>> {
    let mut phones: Vec<AlignedPhone> = Vec::with_capacity(tier.intervals.len());
    let mut done = 0;
    let mut add = |phone: Phone, from: u64, to: u64| {
        if from < to {
            phones.push(AlignedPhone { phone, start_us: from, end_us: to, word: None, fit: 0.0 });
        }
    };
    let labels = tier
        .intervals
        .iter()
        .map(|interval| interval.label.trim())
        .filter(|label| !is_silence(label) && *label != "spn");
    // Only the CMU Pronouncing Dictionary has capitals; some corpora write it in small letters.
    let is_capital = |label: &str| label.starts_with(|c: char| c.is_ascii_uppercase());
    let is_arpabet = labels.clone().any(is_capital) || labels.clone().all(|label| label.parse::<Phone>().is_ok());
    for interval in &tier.intervals {
        let label = interval.label.trim();
        let found = if is_silence(label) { Some(vec![Phone::Sil]) } else { phones_of_label(label, is_arpabet) };
        let Some(found) = found.filter(|found| !found.is_empty()) else {
            let message = format!("{} is no phone: the TextGrid is not used", escape::quoted(label));
            let help = "write phones as the CMU Pronouncing Dictionary does (`AH`, `NG`), or all in IPA";
            let span = interval.span.unwrap_or(Span::new(0, 0));
            diagnostics.push(Diagnostic::at(Code::Pronunciation, span, message).help(help));
            return None;
        };
        let (from, to) = (us(interval.start).saturating_sub(start).max(done), us(interval.end).saturating_sub(start));
        add(Phone::Sil, done, from);
        let parts = found.len() as u64;
        let length = to.saturating_sub(from);
        // In this order, because a TextGrid may be of any length.
        let share = |number: u64| from + length / parts * number + length % parts * number / parts;
        for (number, phone) in (0..).zip(found) {
            add(phone, share(number), share(number + 1));
        }
        done = done.max(to);
    }
    add(Phone::Sil, done, end.saturating_sub(start));
    Some(phones)
}

/// When the words of a script are said, by a tier of words. Reports a word that is not in the script.
fn read_words(
    tier: Option<&Tier>,
    script: &Script,
    start: u64,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Vec<AlignedWord>> {
    let mut words: Vec<AlignedWord> = Vec::with_capacity(script.words.len());
    let mut now = 0;
    let unsaid = |now: u64| AlignedWord { start_us: now, end_us: now, pronunciation: None, confidence: 0.0 };
    let intervals = tier.map_or(&[][..], |tier| &tier.intervals);
    for interval in intervals.iter().filter(|interval| !is_silence(interval.label.trim())) {
        let label = interval.label.trim().to_lowercase();
        let rest = script.words.get(words.len()..).unwrap_or_default();
        let Some(skipped) = rest.iter().position(|word| word.text.trim().to_lowercase() == label) else {
            let message = format!("the word {} is not in the text: the TextGrid is not used", escape::quoted(&label));
            let span = interval.span.unwrap_or(Span::new(0, 0));
            let help = "the text has changed since: remove the file, and it is written anew";
            diagnostics.push(Diagnostic::at(Code::TextMismatch, span, message).help(help));
            return None;
        };
        words.extend(std::iter::repeat_n(unsaid(now), skipped));
        let (start_us, end_us) = (us(interval.start).saturating_sub(start), us(interval.end).saturating_sub(start));
        words.push(AlignedWord { start_us, end_us, pronunciation: Some(0), confidence: 1.0 });
        now = end_us;
    }
    words.resize(script.words.len(), unsaid(now));
    Some(words)
}
