//! Training of a model of a project's voices, with its recordings and their texts.

use crate::job::run::text_file;
use crate::job::{Job, SyncOptions};
use crate::recordings::file_facts::{content_hash, extension};
use crate::threads;
use lipz_diagnostics::{Code, Diagnostic, Report};
use lipz_speech::{Language, Model, Observations, Script, Sound, TrainedModel, Training};
use std::fs::File;
use std::hash::Hasher;
use std::io::BufReader;
use twox_hash::XxHash3_64;

/// The version of training. It must change when the same recordings and texts produce a different model.
const VERSION: u32 = 1;
/// The most audio for training a model, in microseconds: an hour. More takes longer without improving the model.
const MOST_US: u64 = 3_600_000_000;
/// The least speech for training a model, in microseconds: half a minute.
const LEAST_SPEECH_US: u64 = 30_000_000;
/// The number of parts in which recordings are counted. It does not depend on the number of threads, and parts are
/// added in order, so that the sums are the same on every machine.
const PARTS: usize = 8;
/// The number of passes over the recordings.
pub const TRAINING_ROUNDS: usize = Training::ROUNDS;
/// The number of recordings that are decoded at a time.
const BLOCK: usize = 64;

/// The result of a training.
#[derive(Debug)]
#[non_exhaustive]
pub struct TrainingResult {
    /// The model.
    pub model: TrainedModel,
    /// The number of recordings skipped because they do not match their texts.
    pub left_out: usize,
}

/// A recording with its text.
struct Lesson<'j> {
    job: &'j Job,
    script: Script,
    hash: u64,
}

/// Trains a model on the recordings and texts of these jobs, for the language of [`SyncOptions::locale`]. The same
/// recordings and texts produce the same model, on every machine and with any number of threads.
///
/// `known` is the existing model: if it was trained on the same data, no new one is made. `progress` is called for each
/// recording, [`TRAINING_ROUNDS`] times. Unreadable recordings and texts are skipped; a [`SyncRun`](crate::SyncRun)
/// reports them.
///
/// # Errors
/// If no locale is set, or there is too little speech.
pub fn train(
    jobs: &[Job],
    options: &SyncOptions,
    known: Option<&TrainedModel>,
    progress: &(dyn Fn() + Sync),
) -> Result<Option<TrainingResult>, Report> {
    let language = options.locale.as_deref().and_then(Language::from_locale).ok_or_else(|| {
        Report::failure(
            "",
            Code::TooLittleSpeech,
            "the locale of the recordings is not set",
            "name the spoken language with its locale",
        )
    })?;
    let threads = options.options.get_threads();
    let found = threads::map(jobs, threads, |job| lesson(job, language, options));
    let mut lessons: Vec<Lesson<'_>> = found.into_iter().flatten().collect();
    // Sorted independently of their names.
    lessons.sort_by_key(|lesson| (lesson.hash, lesson.job.key.clone()));
    let origin = origin(&lessons, language);
    if known.is_some_and(|known| known.origin == origin && known.language == language) {
        return Ok(None);
    }
    let sounds = decoded(&lessons, threads);
    let mut training = Training::new(Model::english());
    let mut last = Observations::default();
    for _ in 0..TRAINING_ROUNDS {
        let parts: Vec<&[(Sound, &Script)]> = sounds.chunks(sounds.len().div_ceil(PARTS).max(1)).collect();
        let observed = threads::map(&parts, threads, |part| {
            let mut observations = Observations::default();
            for (sound, script) in *part {
                training.observe(sound, script, &mut observations);
                progress();
            }
            observations
        });
        last = Observations::default();
        observed.iter().for_each(|part| last.extend(part));
        if last.speech_us() < LEAST_SPEECH_US {
            return Err(too_little(&last, lessons.len()));
        }
        training.learn(&last);
    }
    #[expect(clippy::cast_possible_truncation, reason = "an hour of sound")]
    let (speech_s, recordings) = ((last.speech_us() / 1_000_000) as u32, last.used() as u32);
    let model = TrainedModel::new(training.model().clone(), language, origin, speech_s, recordings);
    Ok(Some(TrainingResult { model, left_out: last.left_out() }))
}

/// Returns the recording and the transcript of a job, if both can be read and this is the language.
fn lesson<'j>(job: &'j Job, language: Language, options: &SyncOptions) -> Option<Lesson<'j>> {
    let (_, bytes) = text_file(job, options, std::fs::read(&job.lipz_file)).ok()?;
    let document = lipz_file::parse(&bytes).document?;
    let (locale, text) = options.spoken(job, &document)?;
    if locale.as_deref().and_then(Language::from_locale) != Some(language) {
        return None;
    }
    let script = options.pronouncer(locale.as_deref()).script(&text.text);
    let hash = File::open(&job.recording).and_then(content_hash).ok()?;
    (!script.words.is_empty()).then_some(Lesson { job, script, hash })
}

/// Returns the decoded recordings of lessons, in order, up to an hour.
fn decoded<'l>(lessons: &'l [Lesson<'_>], threads: Option<usize>) -> Vec<(Sound, &'l Script)> {
    let (mut sounds, mut length_us) = (Vec::new(), 0);
    for block in lessons.chunks(BLOCK) {
        let decoded = threads::map(block, threads, |lesson| {
            let recording = &lesson.job.recording;
            Sound::read(BufReader::new(File::open(recording).ok()?), extension(recording)).ok()
        });
        for (sound, lesson) in decoded.into_iter().zip(block) {
            let Some(sound) = sound.filter(|sound| !sound.is_silent()) else { continue };
            length_us += sound.duration_us();
            if length_us > MOST_US && !sounds.is_empty() {
                return sounds;
            }
            sounds.push((sound, &lesson.script));
        }
    }
    sounds
}

/// Returns a hash of everything that affects a model.
fn origin(lessons: &[Lesson<'_>], language: Language) -> u64 {
    let mut hasher = XxHash3_64::with_seed(0);
    hasher.write(format!("{VERSION} {}", language.code()).as_bytes());
    for lesson in lessons {
        hasher.write_u64(lesson.hash);
        let said = lesson.script.words.iter().map(|word| &word.pronunciations).collect::<Vec<_>>();
        hasher.write(format!("{said:?}").as_bytes());
    }
    hasher.finish()
}

fn too_little(observations: &Observations, lessons: usize) -> Report {
    let (speech_s, least_s) = (observations.speech_us() / 1_000_000, LEAST_SPEECH_US / 1_000_000);
    let message = format!("a model needs at least {least_s} seconds of speech, but the recordings have {speech_s}");
    let of = match observations.left_out() {
        0 => format!("recordings with a text: {lessons}"),
        count => format!("recordings with a text: {lessons}; left out because they do not match their text: {count}"),
    };
    let diagnostic = Diagnostic::new(Code::TooLittleSpeech, message).note(of);
    Report::about("", diagnostic.help("add recordings and their texts, or use the built-in model until then"))
}
