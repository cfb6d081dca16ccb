//! A job with all inputs except the decoded recording: decides whether and how visemes are made.

use crate::job::grid::Grid;
use crate::job::mouth::{self, HeardMouth};
use crate::job::outcome::{JobOutcome, KeepReason, NewMouth, NewWordTimes};
use crate::job::progress::{Progress, WatchedFile};
use crate::job::reports::{push, push_report};
use crate::job::review_list::ReviewList;
use crate::job::settings_hash::settings_hash;
use crate::job::target::{Target, merged};
use crate::job::{Job, SyncOptions};
use crate::record::hashes::{NO_TEXT, mouth_hash, text_hash};
use crate::record::{MouthHashes, OriginalHashes, RecordLine, RecordedText};
use crate::recordings::clip::ClipMouth;
use crate::recordings::condition::Condition;
use crate::recordings::file_facts::{content_hash, extension, no_sound, unreadable};
use crate::recordings::paths::shown;
use lipz_compiler::WordTimes;
use lipz_diagnostics::{Code, Diagnostic, Report, escape};
use lipz_file::{Document, JsonString};
use lipz_speech::{AlignedPhone, Alignment, Recogniser, Script, Sound};
use lipz_types::{Fps, VisemeType};
use std::fs::File;
use std::io::BufReader;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// The purpose of analysing a recording.
#[derive(Clone, Copy, PartialEq, Eq)]
enum JobPurpose {
    /// Everything, including a comparison of text and recording by a recogniser, which takes longer than the rest.
    Mouth,
    Phones,
    TextGrid,
}

/// All inputs of a job before its recording is decoded.
pub(super) struct LoadedJob<'a> {
    pub(super) job: &'a Job,
    pub(super) options: &'a SyncOptions,
    /// The Lipz file; for a new one, its content without visemes.
    pub(super) name: &'a str,
    pub(super) bytes: &'a [u8],
    pub(super) is_new: bool,
    pub(super) before: &'a Document<'a>,
    pub(super) clip: ClipMouth<'a>,
    /// The type and the frame rate of the visemes.
    pub(super) rate: (VisemeType, Fps),
    /// The Lipz file of a dub's original: its name, its bytes, and its content.
    pub(super) original_file: (&'a str, &'a [u8]),
    pub(super) original: Option<&'a Document<'a>>,
    /// The spoken text and its locale, and whether it is in the file of the original.
    pub(super) locale: Option<&'a str>,
    pub(super) text: Option<&'a JsonString<'a>>,
    pub(super) is_borrowed: bool,
    pub(super) script: Script,
    /// The path of its TextGrid, and the content if it exists and is usable.
    pub(super) grid_place: Option<PathBuf>,
    pub(super) grid: Option<Grid>,
    pub(super) made: MouthHashes,
    pub(super) known: Vec<RecordLine>,
    /// The known texts of the recording.
    pub(super) recorded: Vec<RecordedText>,
    /// The diagnostics of the Lipz file, and of the text.
    pub(super) diagnostics: Vec<Diagnostic>,
    pub(super) of_text: Vec<Diagnostic>,
}

impl LoadedJob<'_> {
    /// Does the job, except for writing.
    pub(super) fn step(mut self, progress: &Progress<'_>, reports: &mut Vec<Report>) -> Result<JobOutcome, Report> {
        let is_unwritten = self.script.words.is_empty() && self.rate.0 != VisemeType::Rms;
        let no_script = is_unwritten.then(|| no_script(self.options.locale_of(self.job)));
        let spoken_text = self.text.map_or("", |text| &*text.text);
        if let Some(line) = self.current().filter(|_| self.lacking_grid().is_none()) {
            let listed = ReviewList::remembered(line, &self.script, spoken_text);
            let differences = line.differences.clone();
            self.of_text.extend(self.mismatches(differences.as_ref()));
            self.diagnostics.extend(no_script);
            self.report(reports);
            return Ok(JobOutcome::Unchanged(listed));
        }
        if let Some(kept) = self.kept() {
            let (made, mut known) = (self.made, self.known.iter());
            let is_current = known.any(|line| (line.made.sound, line.made.text) == (made.sound, made.text));
            let visemes = self.clip.visemes.filter(|_| !is_current);
            self.diagnostics.extend(visemes.map(|visemes| kept_mouth(kept, visemes)));
            self.of_text.clear();
            let words = self.missing_word_times(progress, reports);
            self.report(reports);
            return Ok(JobOutcome::Kept(kept, words));
        }
        self.diagnostics.extend(no_script);
        self.make(progress, reports)
    }

    /// Returns the path of its TextGrid, if one is wanted but missing.
    fn lacking_grid(&self) -> Option<&Path> {
        self.grid_place.as_deref().filter(|place| !place.exists())
    }

    /// Returns the line of the record for the current visemes, if they are up to date.
    fn current(&self) -> Option<&RecordLine> {
        let original_now = || self.original_now();
        let is_current = |line: &&RecordLine| {
            // Older versions did not store the times of words, or stored them without the hashes of the words.
            let knows = |words: &WordTimes| {
                words.is_empty() || self.text.is_some_and(|text| !words.of_text(&text.text).is_empty())
            };
            let is_whole = self.script.words.is_empty() || line.words.as_ref().is_some_and(knows);
            // The original of a dub may have changed since, but with `force`, it must be the current one.
            let is_of_original = line.original.is_some() && !self.options.force || line.original == original_now();
            line.made == self.made && is_whole && is_of_original
        };
        self.known.iter().find(is_current).filter(|_| !self.is_new)
    }

    /// Returns why the current visemes stay, if they were edited by hand.
    fn kept(&self) -> Option<KeepReason> {
        let has_mouth = self.clip.codes.iter().any(|code| *code != b'-');
        let mut known = self.known.iter().filter(|line| line.made.mouth == self.made.mouth);
        let kept = match known.next() {
            None if self.known.is_empty() => KeepReason::ByHand,
            None => KeepReason::Changed,
            Some(line) if line.is_corrected && self.grid_place.is_none() => KeepReason::Corrected,
            Some(_) => return None,
        };
        (has_mouth && !self.options.force).then_some(kept)
    }

    /// Returns the times of all words for the record, if visemes were made from this recording before, but words of the
    /// text have changed since. As long as the visemes are kept, no other step finds these times.
    fn missing_word_times(&mut self, progress: &Progress<'_>, reports: &mut Vec<Report>) -> Option<NewWordTimes> {
        let text = &*self.text?.text;
        let line = self.known.iter().rev().find(|line| line.words.is_some())?;
        if line.made.sound != self.made.sound || line.is_corrected || self.grid.is_some() {
            return None;
        }
        let times = line.words.as_ref()?.of_text(text);
        let has_time = |range: &Range<usize>| {
            let next = times.partition_point(|time| time.range.end <= range.start);
            times.get(next).is_some_and(|time| time.range.start <= range.start)
        };
        let mut said = self.script.words.iter().filter(|word| !word.pronunciations.is_empty());
        if said.all(|word| has_time(&word.range)) {
            return None;
        }
        match self.hear(JobPurpose::Phones, progress, reports) {
            Ok(heard) => {
                let words = mouth::word_times(&heard, &self.script, text);
                (!words.is_empty()).then_some(NewWordTimes { sound: self.made.sound, words })
            }
            Err(report) => {
                reports.push(report);
                None
            }
        }
    }

    /// Returns the TextGrid of the current visemes, if these are up to date with the recording.
    pub(super) fn textgrid(mut self, reports: &mut Vec<Report>) -> Result<Option<String>, Report> {
        if self.current().is_none() || self.rate.0 == VisemeType::Rms {
            return Ok(None);
        }
        let heard = self.hear(JobPurpose::TextGrid, &Progress::new(&|_| ()), reports)?;
        Ok(heard.grid.filter(|_| heard.codes.as_bytes() == self.clip.codes))
    }

    fn original_now(&self) -> Option<OriginalHashes> {
        original_then(self.job, self.original?, self.options)
    }

    /// Returns the mismatches between recording and text.
    fn mismatches(&self, differences: Option<&WordTimes>) -> Vec<Diagnostic> {
        let mut found = self.text.map(|text| mouth::mismatches(differences, text)).unwrap_or_default();
        if self.is_borrowed {
            let note = format!("the dub is {}", escape::quoted(&self.job.key));
            found.iter_mut().for_each(|diagnostic| diagnostic.notes.push(note.clone()));
        }
        found
    }

    /// Reports the diagnostics. Returns whether there is an error in the Lipz file.
    fn report(&mut self, reports: &mut Vec<Report>) -> bool {
        let (mut diagnostics, of_text) = (std::mem::take(&mut self.diagnostics), std::mem::take(&mut self.of_text));
        if self.is_borrowed {
            let (name, bytes) = self.original_file;
            push(reports, self.options, name, bytes, of_text);
        } else {
            diagnostics.extend(of_text);
        }
        push(reports, self.options, self.name, self.bytes, diagnostics)
    }

    /// Returns the file with new visemes.
    fn make(mut self, progress: &Progress<'_>, reports: &mut Vec<Report>) -> Result<JobOutcome, Report> {
        let heard = self.hear(JobPurpose::Mouth, progress, reports)?;
        let spoken_text = self.text.map(|text| &*text.text);
        let differences = spoken_text.and_then(|text| mouth::differences(&heard, &self.script, text));
        self.of_text.extend(self.mismatches(differences.as_ref()));
        let (viseme_type, fps) = self.rate;
        let borrowed = spoken_text.filter(|_| self.is_borrowed).map(|text| (self.options.text_element(self.job), text));
        let LoadedJob { bytes, before, is_new, locale, .. } = self;
        let target = Target { bytes, before, is_new, locale, borrowed, fps, viseme_type };
        let (after, guessed) = merged(&heard, &self.script, self.options, &target);
        self.diagnostics.extend(guessed);
        if self.report(reports) {
            return Ok(JobOutcome::Refused);
        }
        let mut made =
            MouthHashes { mouth: mouth_hash(heard.codes.as_bytes(), Some(fps), Some(viseme_type)), ..self.made };
        let grid = self.lacking_grid().map(Path::to_owned).zip(heard.grid.clone());
        if let Some((_, text)) = &grid {
            // The hash covers the TextGrid as the next run will read it.
            let grid = Grid::parse(text.as_bytes(), &self.script, &mut Vec::new());
            made.settings = settings_hash(self.options, locale, &self.script, self.rate, grid.as_ref());
        }
        let scripted = spoken_text.filter(|_| !self.script.words.is_empty());
        let words = scripted.map(|text| mouth::word_times(&heard, &self.script, text));
        // Results of an earlier run do not count as edited by hand, nor does work that results in the same visemes.
        let is_own = |line: &RecordLine| {
            !line.is_corrected && MouthHashes { settings: 0, ..line.made } == MouthHashes { settings: 0, ..made }
        };
        let is_corrected = self.grid.is_some() && !self.known.iter().any(is_own);
        let line = RecordLine { made, words, original: self.original_now(), is_corrected, differences };
        let (before, has_new_text) = ((!is_new).then(|| bytes.to_vec()), has_new_text(&self.known, &line));
        let now = RecordedText::from(&line);
        // A recording without a text was not made for a different text.
        self.recorded.retain(|recorded| recorded.text != NO_TEXT);
        let is_outdated = !self.recorded.iter().any(|recorded| recorded.is_still(&now));
        let outdated = if is_outdated { std::mem::take(&mut self.recorded) } else { Vec::new() };
        let word = |number: usize| Some(self.script.words.get(number)?.text.clone());
        let doubtful = heard.doubtful.iter().filter_map(|(number, start_us)| Some((*start_us, word(*number)?)));
        let listed = ReviewList::new(&self.script, doubtful.collect());
        Ok(JobOutcome::New(Box::new(NewMouth { before, after, line, outdated, listed, grid, has_new_text })))
    }

    /// Whether visemes were made from the phones of this recording and this text.
    pub(super) fn has_phones(&self) -> bool {
        let (sound, text) = (self.made.sound, self.made.text);
        let is_made = self.known.iter().any(|line| (line.made.sound, line.made.text) == (sound, text));
        is_made && self.rate.0 != VisemeType::Rms
    }

    /// Returns the times of the phones in the recording.
    pub(super) fn phones(&mut self, reports: &mut Vec<Report>) -> Result<Vec<AlignedPhone>, Report> {
        self.hear(JobPurpose::Phones, &Progress::new(&|_| ()), reports).map(|heard| heard.phones)
    }

    /// Returns the visemes of the recording. Reports its problems.
    fn hear(
        &mut self,
        wanted: JobPurpose,
        progress: &Progress<'_>,
        reports: &mut Vec<Report>,
    ) -> Result<HeardMouth, Report> {
        let LoadedJob { job, options, .. } = *self;
        let file = File::open(&job.recording).map_err(|error| unreadable(&job.recording, &error))?;
        let file = WatchedFile::new(file, progress).map_err(|error| unreadable(&job.recording, &error))?;
        let sound = Sound::read(BufReader::new(file), extension(&job.recording))
            .map_err(|error| no_sound(&job.recording, &error))?;
        let condition = Condition::of(&sound);
        let corrected = self.corrected(&sound, reports);
        let script = &self.script;
        let is_unwritten = script.words.is_empty() && self.rate.0 != VisemeType::Rms && corrected.is_none();
        let phones = match is_unwritten && !condition.is_silent() {
            true => Some(recognised(options.recogniser_without_text(), job)?.script()),
            false => None,
        };
        let is_compared = !script.words.is_empty() && !condition.is_silent() && corrected.is_none();
        let is_compared = is_compared && wanted == JobPurpose::Mouth;
        let mismatches = |alignment: &Alignment| {
            let built_in = || alignment.is_uncertain().then(Recogniser::built_in);
            match options.recogniser.as_ref().or_else(built_in).filter(|_| is_compared) {
                Some(recogniser) => Ok(recognised(recogniser, job)?.mismatches(script, alignment)),
                None => Ok(alignment.mismatches.clone()),
            }
        };
        let (script, model) = (phones.as_ref().unwrap_or(script), options.model_of(self.locale));
        let with_grid = match wanted {
            JobPurpose::Mouth => options.textgrids.is_some(),
            JobPurpose::Phones => false,
            JobPurpose::TextGrid => true,
        };
        let mismatches = &mismatches;
        let hearing = mouth::Hearing { sound: &sound, model, is_unwritten, mismatches, corrected, with_grid, progress };
        let heard = mouth::make(hearing, script, self.rate, options)?;
        let mut heard = sound.intact(heard).map_err(|error| no_sound(&job.recording, &error))?;
        if condition.is_silent() || phones.is_some() {
            heard.forget_words(); // silent or corrected recordings have no doubtful words to report
        }
        let condition = if heard.is_said() { condition.with_speech() } else { condition };
        push_report(reports, options, condition.report(&job.recording));
        Ok(heard)
    }

    /// Returns the corrected alignment, if it fits this recording. Otherwise reports and discards it.
    fn corrected(&mut self, sound: &Sound, reports: &mut Vec<Report>) -> Option<Alignment> {
        let (grid, place) = (self.grid.as_ref()?, self.grid_place.as_ref()?);
        let Err(unfit) = grid.fits(sound.duration_us(), self.rate.1) else {
            return Some(grid.alignment(sound.duration_us(), &self.script));
        };
        push_report(reports, self.options, Some(Report::about(shown(place), *unfit)));
        self.grid = None;
        self.made.settings = settings_hash(self.options, self.locale, &self.script, self.rate, None);
        None
    }
}

/// Whether the recording is in the record with a different text.
fn has_new_text(known: &[RecordLine], now: &RecordLine) -> bool {
    let mut with_sound = known.iter().filter(|line| line.made.sound == now.made.sound).peekable();
    with_sound.peek().is_some() && with_sound.all(|line| line.made.text != now.made.text)
}

/// Returns the current hashes of a dub's original.
fn original_then(job: &Job, document: &Document<'_>, options: &SyncOptions) -> Option<OriginalHashes> {
    let original = job.original.as_ref()?;
    let sound = original.recording.as_ref().and_then(|path| File::open(path).and_then(content_hash).ok()).unwrap_or(0);
    Some(OriginalHashes { sound, text: text_hash(spoken_in_original(job, Some(document), options)) })
}

/// Returns the spoken text of a dub's original.
pub(super) fn spoken_in_original<'d>(
    job: &Job,
    document: Option<&'d Document<'d>>,
    options: &SyncOptions,
) -> Option<&'d str> {
    let spoken = options.spoken_in(job.original.as_ref()?.locale.as_deref(), document?);
    spoken.map(|(_, text)| &*text.text)
}

/// Returns the result of a recogniser for a recording.
fn recognised(recogniser: &Recogniser, job: &Job) -> Result<lipz_speech::RecognisedWords, Report> {
    let file = File::open(&job.recording).map_err(|error| unreadable(&job.recording, &error))?;
    let heard = recogniser.hear(BufReader::new(file), extension(&job.recording));
    heard.map_err(|error| no_sound(&job.recording, &error))
}

fn kept_mouth(kept: KeepReason, visemes: &JsonString<'_>) -> Diagnostic {
    let why = match kept {
        KeepReason::Changed => "the visemes were edited by hand, and their recording or text has changed",
        KeepReason::ByHand => "the visemes were made by hand or by another tool",
        KeepReason::Corrected => {
            "the visemes were made from a corrected TextGrid, and their recording or text has changed"
        }
    };
    Diagnostic::at(Code::MouthKept, visemes.span(), format!("{why}, so they are kept"))
        .help("check whether they fit the recording; only a run that discards edits replaces them")
}

fn no_script(locale: Option<&str>) -> Diagnostic {
    let text = locale.map_or_else(|| "text".to_owned(), |locale| format!("text in `{locale}`"));
    Diagnostic::new(Code::NoScript, format!("the clip has no {text}, so the visemes follow only the audio"))
        .help("add the spoken text for much better visemes")
}
