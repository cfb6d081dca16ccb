//! A job of which everything is known but what its recording sounds like: whether a mouth is made, and how.

use super::grid::Grid;
use super::hashes::{NO_TEXT, mouth_hash, settings_hash, text_hash};
use super::listed::Listed;
use super::mouth::{self, Heard};
use super::one::{Kept, New, Step, push, push_report};
use super::progress::{Progress, Watched};
use super::record::{Line, Made, OriginalThen};
use super::spoken::Spoken;
use super::target::{Target, merged};
use super::{Job, SyncOptions};
use crate::clip::Clip;
use crate::condition::Condition;
use crate::facts::{content_hash, extension, no_sound, unreadable};
use crate::recordings::shown;
use lipz_compiler::WordTimes;
use lipz_diagnostics::{Code, Diagnostic, Report, escape};
use lipz_file::{Document, JsonString};
use lipz_speech::{AlignedPhone, Alignment, Recogniser, Script, Sound};
use lipz_types::{Fps, VisemeType};
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

/// What a recording is heard for.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Wanted {
    /// Everything: a recogniser, if there is one, compares text and recording, which takes longer than all else.
    Mouth,
    Phones,
    TextGrid,
}

/// Everything that is known of a job before its recording is decoded.
pub(super) struct Subject<'a> {
    pub(super) job: &'a Job,
    pub(super) options: &'a SyncOptions,
    /// The Lipz file; for one that is not there yet, what it will be without a mouth.
    pub(super) name: &'a str,
    pub(super) bytes: &'a [u8],
    pub(super) is_new: bool,
    pub(super) before: &'a Document<'a>,
    pub(super) clip: Clip<'a>,
    /// What the mouth will be.
    pub(super) rate: (VisemeType, Fps),
    /// The Lipz file of the original of a dub: its name and bytes, and what it says.
    pub(super) original_file: (&'a str, &'a [u8]),
    pub(super) original: Option<&'a Document<'a>>,
    /// What is spoken, its locale, and whether it stands in the file of the original.
    pub(super) locale: Option<&'a str>,
    pub(super) text: Option<&'a JsonString<'a>>,
    pub(super) is_borrowed: bool,
    pub(super) script: Script,
    /// Where its TextGrid is, or will be, and what that says if it can be used.
    pub(super) grid_place: Option<PathBuf>,
    pub(super) grid: Option<Grid>,
    pub(super) made: Made,
    pub(super) known: Vec<Line>,
    /// What is known of what the recording says.
    pub(super) recorded: Vec<Spoken>,
    /// What was found in the Lipz file, and in the text.
    pub(super) diagnostics: Vec<Diagnostic>,
    pub(super) of_text: Vec<Diagnostic>,
}

impl Subject<'_> {
    /// Does the job, all but writing.
    pub(super) fn step(mut self, progress: &Progress<'_>, reports: &mut Vec<Report>) -> Result<Step, Report> {
        let is_unwritten = self.script.words.is_empty() && self.rate.0 != VisemeType::Rms;
        let no_script = is_unwritten.then(|| no_script(self.options.locale_of(self.job)));
        let spoken_text = self.text.map_or("", |text| &*text.text);
        if let Some(line) = self.current().filter(|_| self.lacking_grid().is_none()) {
            let listed = Listed::remembered(line, &self.script, spoken_text);
            let differences = line.differences.clone();
            self.of_text.extend(self.mismatches(differences.as_ref()));
            self.diagnostics.extend(no_script);
            self.report(reports);
            return Ok(Step::Unchanged(listed));
        }
        if let Some(kept) = self.kept() {
            let (made, mut known) = (self.made, self.known.iter());
            let is_current = known.any(|line| (line.made.sound, line.made.text) == (made.sound, made.text));
            let visemes = self.clip.visemes.filter(|_| !is_current);
            self.diagnostics.extend(visemes.map(|visemes| kept_mouth(kept, visemes)));
            self.of_text.clear();
            self.report(reports);
            return Ok(Step::Kept(kept));
        }
        self.diagnostics.extend(no_script);
        self.make(progress, reports)
    }

    /// Where its TextGrid will be, if there should be one, and there is none.
    fn lacking_grid(&self) -> Option<&Path> {
        self.grid_place.as_deref().filter(|place| !place.exists())
    }

    /// The line of the record that says that the mouth is what it would become.
    fn current(&self) -> Option<&Line> {
        let original_now = || self.original_now();
        let is_current = |line: &&Line| {
            // Older versions did not write down when words are said; and what is written between them may have changed.
            let knows = |words: &WordTimes| {
                words.is_empty() || self.text.is_some_and(|text| !words.of_text(&text.text).is_empty())
            };
            let is_whole = self.script.words.is_empty() || line.words.as_ref().is_some_and(knows);
            // A dub is one of its original as that was then; by force, as it is now.
            let is_of_original = line.original.is_some() && !self.options.force || line.original == original_now();
            line.made == self.made && is_whole && is_of_original
        };
        self.known.iter().find(is_current).filter(|_| !self.is_new)
    }

    /// Whether somebody has made the mouth by hand, and it stays.
    fn kept(&self) -> Option<Kept> {
        let has_mouth = self.clip.codes.iter().any(|code| *code != b'-');
        let mut known = self.known.iter().filter(|line| line.made.mouth == self.made.mouth);
        let kept = match known.next() {
            None if self.known.is_empty() => Kept::ByHand,
            None => Kept::Changed,
            Some(line) if line.is_corrected && self.grid_place.is_none() => Kept::Corrected,
            Some(_) => return None,
        };
        (has_mouth && !self.options.force).then_some(kept)
    }

    /// The TextGrid of the mouth that is there, if it is what the recording makes of it.
    pub(super) fn textgrid(mut self, reports: &mut Vec<Report>) -> Result<Option<String>, Report> {
        if self.current().is_none() || self.rate.0 == VisemeType::Rms {
            return Ok(None);
        }
        let heard = self.hear(Wanted::TextGrid, &Progress::new(&|_| ()), reports)?;
        Ok(heard.grid.filter(|_| heard.codes.as_bytes() == self.clip.codes))
    }

    fn original_now(&self) -> Option<OriginalThen> {
        original_then(self.job, self.original?, self.options)
    }

    /// Where recording and text do not say the same.
    fn mismatches(&self, differences: Option<&WordTimes>) -> Vec<Diagnostic> {
        let mut found = self.text.map(|text| mouth::mismatches(differences, text)).unwrap_or_default();
        if self.is_borrowed {
            let note = format!("in its dub {}", escape::quoted(&self.job.key));
            found.iter_mut().for_each(|diagnostic| diagnostic.notes.push(note.clone()));
        }
        found
    }

    /// Reports what was found; whether there is an error in the Lipz file.
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

    /// The file with a new mouth.
    fn make(mut self, progress: &Progress<'_>, reports: &mut Vec<Report>) -> Result<Step, Report> {
        let heard = self.hear(Wanted::Mouth, progress, reports)?;
        let spoken_text = self.text.map(|text| &*text.text);
        let differences = spoken_text.and_then(|text| mouth::differences(&heard, &self.script, text));
        self.of_text.extend(self.mismatches(differences.as_ref()));
        let (viseme_type, fps) = self.rate;
        let borrowed = spoken_text.filter(|_| self.is_borrowed).map(|text| (self.options.text_element(self.job), text));
        let Subject { bytes, before, is_new, locale, .. } = self;
        let target = Target { bytes, before, is_new, locale, borrowed, fps, viseme_type };
        let (after, guessed) = merged(&heard, &self.script, self.options, &target);
        self.diagnostics.extend(guessed);
        if self.report(reports) {
            return Ok(Step::Refused);
        }
        let mut made = Made { mouth: mouth_hash(heard.codes.as_bytes(), Some(fps), Some(viseme_type)), ..self.made };
        let grid = self.lacking_grid().map(Path::to_owned).zip(heard.grid.clone());
        if let Some((_, text)) = &grid {
            // The next run will read it.
            let grid = Grid::parse(text.as_bytes(), &self.script, &mut Vec::new());
            made.settings = settings_hash(self.options, locale, &self.script, self.rate, grid.as_ref());
        }
        let scripted = spoken_text.filter(|_| !self.script.words.is_empty());
        let words = scripted.map(|text| mouth::word_times(&heard, &self.script, text));
        // What lipz heard itself is no work by hand, nor is what makes the same mouth.
        let is_own =
            |line: &Line| !line.is_corrected && Made { settings: 0, ..line.made } == Made { settings: 0, ..made };
        let is_corrected = self.grid.is_some() && !self.known.iter().any(is_own);
        let line = Line { made, words, original: self.original_now(), is_corrected, differences };
        let (before, has_new_text) = ((!is_new).then(|| bytes.to_vec()), has_new_text(&self.known, &line));
        let now = Spoken::from(&line);
        // A recording of which nobody had the words was made for none.
        self.recorded.retain(|recorded| recorded.text != NO_TEXT);
        let is_outdated = !self.recorded.iter().any(|recorded| recorded.is_still(&now));
        let outdated = if is_outdated { std::mem::take(&mut self.recorded) } else { Vec::new() };
        let word = |number: usize| Some(self.script.words.get(number)?.text.clone());
        let doubtful = heard.doubtful.iter().filter_map(|(number, start_us)| Some((*start_us, word(*number)?)));
        let listed = Listed::new(&self.script, doubtful.collect());
        Ok(Step::New(Box::new(New { before, after, line, outdated, listed, grid, has_new_text })))
    }

    /// Whether a mouth was made of the phones of this recording and this text.
    pub(super) fn has_phones(&self) -> bool {
        let (sound, text) = (self.made.sound, self.made.text);
        let is_made = self.known.iter().any(|line| (line.made.sound, line.made.text) == (sound, text));
        is_made && self.rate.0 != VisemeType::Rms
    }

    /// When the phones of the recording are said.
    pub(super) fn phones(&mut self, reports: &mut Vec<Report>) -> Result<Vec<AlignedPhone>, Report> {
        self.hear(Wanted::Phones, &Progress::new(&|_| ()), reports).map(|heard| heard.phones)
    }

    /// The mouth of the recording. Reports what is wrong with it.
    fn hear(&mut self, wanted: Wanted, progress: &Progress<'_>, reports: &mut Vec<Report>) -> Result<Heard, Report> {
        let Subject { job, options, .. } = *self;
        let file = File::open(&job.recording).map_err(|error| unreadable(&job.recording, &error))?;
        let file = Watched::new(file, progress).map_err(|error| unreadable(&job.recording, &error))?;
        let sound = Sound::read(BufReader::new(file), extension(&job.recording))
            .map_err(|error| no_sound(&job.recording, &error))?;
        let condition = Condition::of(&sound);
        let corrected = self.corrected(&sound, reports);
        let script = &self.script;
        let is_unwritten = script.words.is_empty() && self.rate.0 != VisemeType::Rms && corrected.is_none();
        let phones = match options.recogniser.as_ref().filter(|_| is_unwritten) {
            Some(recogniser) => Some(recognised(recogniser, job)?.script()),
            None => None,
        };
        let is_compared = !script.words.is_empty() && !condition.is_silent() && corrected.is_none();
        let is_compared = is_compared && wanted == Wanted::Mouth;
        let opinion = options.recogniser.as_ref().filter(|_| is_compared);
        let opinion = opinion.map(|recogniser| recognised(recogniser, job)).transpose()?;
        let script = phones.as_ref().unwrap_or(script);
        let (model, opinion) = (options.model_of(self.locale), opinion.as_ref());
        let with_grid = match wanted {
            Wanted::Mouth => options.textgrids.is_some(),
            Wanted::Phones => false,
            Wanted::TextGrid => true,
        };
        let hearing = mouth::Hearing { sound: &sound, model, opinion, corrected, with_grid, progress };
        let mut heard = mouth::make(hearing, script, self.rate, options);
        if condition.is_silent() || phones.is_some() {
            heard.forget_words(); // of what cannot be heard, nothing else needs to be said
        }
        push_report(reports, options, condition.report(&job.recording));
        Ok(heard)
    }

    /// What somebody has corrected, if it is for this sound. Otherwise reports that it is not, and forgets it.
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

/// Whether the recording is known, and the text in it was another one.
fn has_new_text(known: &[Line], now: &Line) -> bool {
    let mut with_sound = known.iter().filter(|line| line.made.sound == now.made.sound).peekable();
    with_sound.peek().is_some() && with_sound.all(|line| line.made.text != now.made.text)
}

/// What the original of a dub is while the dub is made.
fn original_then(job: &Job, document: &Document<'_>, options: &SyncOptions) -> Option<OriginalThen> {
    let original = job.original.as_ref()?;
    let sound = original.recording.as_ref().and_then(|path| File::open(path).and_then(content_hash).ok()).unwrap_or(0);
    Some(OriginalThen { sound, text: text_hash(spoken_in_original(job, Some(document), options)) })
}

/// What is spoken in the original of a dub.
pub(super) fn spoken_in_original<'d>(
    job: &Job,
    document: Option<&'d Document<'d>>,
    options: &SyncOptions,
) -> Option<&'d str> {
    let spoken = options.spoken_in(job.original.as_ref()?.locale.as_deref(), document?);
    spoken.map(|(_, text)| &*text.text)
}

/// What a recogniser hears in a recording.
fn recognised(recogniser: &Recogniser, job: &Job) -> Result<lipz_speech::Heard, Report> {
    let file = File::open(&job.recording).map_err(|error| unreadable(&job.recording, &error))?;
    let heard = recogniser.hear(BufReader::new(file), extension(&job.recording));
    heard.map_err(|error| no_sound(&job.recording, &error))
}

fn kept_mouth(kept: Kept, visemes: &JsonString<'_>) -> Diagnostic {
    let why = match kept {
        Kept::Changed => "the mouth was changed by hand, and its recording or text is another one now",
        Kept::ByHand => "the mouth was drawn by hand, or made by another tool",
        Kept::Corrected => "the mouth was made from a corrected TextGrid, and its recording or text is another one now",
    };
    Diagnostic::at(Code::MouthKept, visemes.span(), format!("{why}: it is kept"))
        .help("only a forced run replaces it: look first whether it fits")
}

fn no_script(locale: Option<&str>) -> Diagnostic {
    let text = locale.map_or_else(|| "text".to_owned(), |locale| format!("text in `{locale}`"));
    Diagnostic::new(Code::NoScript, format!("the clip has no {text}: the mouth follows the sound alone"))
        .help("add what is said: the mouth will be much better")
}
