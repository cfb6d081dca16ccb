//! One job: from a recording and what is said in it to a Lipz file with a mouth.

use super::mouth::{self, Heard};
use super::record::{Line, Made, OriginalThen};
use super::{Job, SyncOptions, SyncRecord};
use crate::clip::{Clip, string};
use crate::condition::Condition;
use crate::facts::{content_hash, extension, no_sound, unreadable};
use crate::recordings::shown;
use lipz_diagnostics::{Code, Diagnostic, Report, escape};
use lipz_file::format::{LineEnding, Style, format, rewrite};
use lipz_file::rate::Rate;
use lipz_file::text::{DELIMITER, trim};
use lipz_file::{Document, Element, JsonString, Value};
use lipz_interop::{MergeOptions, Mouth, Time, merge};
use lipz_speech::{Recogniser, Script, Sound};
use lipz_types::{Fps, VisemeType};
use std::borrow::Cow;
use std::fs::{self, File};
use std::io::{self, BufReader};
use twox_hash::XxHash3_64;

/// Changes whenever the same recording, text and settings give other mouths than before.
const VERSION: u32 = 3;

/// What becomes of a job.
pub(super) enum Step {
    /// The mouth is what it would become.
    Unchanged,
    /// The mouth was made or changed by hand, and stays.
    Kept(Kept),
    /// The file gets a mouth.
    New(Box<New>),
    /// There are errors.
    Refused,
}

/// Why a mouth stays.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Kept {
    /// It was changed by hand after it had been made of a recording.
    Changed,
    /// The record does not know it: somebody drew it, or another tool.
    ByHand,
}

/// A file to be written.
pub(super) struct New {
    /// What the file was; `None` if there is none.
    pub(super) before: Option<Vec<u8>>,
    pub(super) after: String,
    pub(super) line: Line,
    pub(super) heard: Heard,
    pub(super) script: Script,
    /// Whether the mouth was made from this recording before, when the text was another one.
    pub(super) has_new_text: bool,
}

/// Does a job, all but writing. What is wrong goes to `reports`.
pub(super) fn one(job: &Job, options: &SyncOptions, record: &SyncRecord, reports: &mut Vec<Report>) -> Step {
    match tried(job, options, record, reports) {
        Ok(step) => step,
        Err(report) => {
            reports.push(report);
            Step::Refused
        }
    }
}

fn tried(job: &Job, options: &SyncOptions, record: &SyncRecord, reports: &mut Vec<Report>) -> Result<Step, Report> {
    let name = shown(&job.lipz_file);
    let (is_new, bytes) = text_file(job, options)?;
    let parsed = lipz_file::parse(&bytes);
    let is_whole = !parsed.diagnostics.iter().any(Diagnostic::is_error);
    let before = parsed.document.filter(|_| is_whole);
    let before = before.ok_or_else(|| Report::from_bytes(name.as_str(), &bytes, parsed.diagnostics))?;
    let mut diagnostics = Vec::new();
    let clip = Clip::from_document(&before, &options.options);
    let own_fps = before.get("fps").and(clip.fps);
    let (fps, viseme_type) = (options.fps_of(own_fps), options.viseme_type_of(own_type(&before)));
    // A dub without a text has that of its original.
    let (of_original, original_bytes) = original_file(job);
    let original = lipz_file::parse(&original_bytes).document;
    let own = options.spoken(job, &before);
    let (is_borrowed, mut of_text) = (own.is_none(), Vec::new());
    let spoken = own.or_else(|| options.spoken(job, original.as_ref()?));
    if !is_new {
        diagnostics.extend(other_text(job, spoken.as_ref().filter(|_| !is_borrowed).map(|(_, text)| *text)));
    }
    let to_read = spoken.as_ref().filter(|_| viseme_type != VisemeType::Rms);
    let script = to_read.map(|spoken| script(spoken, options, &mut of_text)).unwrap_or_default();
    let locale = spoken.as_ref().and_then(|(locale, _)| locale.as_deref());
    let sound =
        File::open(&job.recording).and_then(content_hash).map_err(|error| unreadable(&job.recording, &error))?;
    let own_type = own_type(&before).or(options.options.default_viseme_type);
    let made = Made {
        sound,
        text: text_hash(spoken.as_ref().map(|(_, text)| &*text.text)),
        settings: settings_hash(options, locale, &script, (viseme_type, fps)),
        mouth: mouth_hash(&clip.codes, own_fps.or(options.options.default_fps), own_type),
    };
    let known = record.lines_for(&job.lipz_file);
    let has_mouth = clip.codes.iter().any(|code| *code != b'-');
    let original_now = || original.as_ref().and_then(|document| original_then(job, document, options));
    let is_current = |line: &Line| {
        // Older versions did not write down when words are said.
        let is_whole = line.words.is_some() || script.words.is_empty();
        // A dub is one of its original as that was then; by force, as it is now.
        line.made == made && is_whole && (line.original.is_some() && !options.force || line.original == original_now())
    };
    if !is_new && known.iter().any(is_current) {
        push(reports, options, &name, &bytes, diagnostics);
        return Ok(Step::Unchanged);
    }
    if has_mouth && !options.force && !known.iter().any(|line| line.made.mouth == made.mouth) {
        let kept = if known.is_empty() { Kept::ByHand } else { Kept::Changed };
        let is_current = known.iter().any(|line| (line.made.sound, line.made.text) == (made.sound, made.text));
        diagnostics.extend(clip.visemes.filter(|_| !is_current).map(|visemes| kept_mouth(kept, visemes)));
        push(reports, options, &name, &bytes, diagnostics);
        return Ok(Step::Kept(kept));
    }
    let is_unwritten = script.words.is_empty() && viseme_type != VisemeType::Rms;
    diagnostics.extend(is_unwritten.then(|| no_script(options.locale_of(job))));
    let heard = hear(job, options, (locale, &script), (viseme_type, fps), reports)?;
    of_text.extend(spoken.iter().flat_map(|(_, text)| mouth::mismatches(&heard, &script, text)));
    let borrowed = spoken.as_ref().filter(|_| is_borrowed).map(|(_, text)| (options.text_element(job), &*text.text));
    let target = Target { bytes: &bytes, before: &before, is_new, locale, borrowed, fps, viseme_type };
    let (after, guessed) = merged(&heard, &script, options, &target);
    diagnostics.extend(guessed);
    let made = Made { mouth: mouth_hash(heard.codes.as_bytes(), Some(fps), Some(viseme_type)), ..made };
    if is_borrowed {
        push(reports, options, &of_original, &original_bytes, of_text);
    } else {
        diagnostics.extend(of_text);
    }
    if push(reports, options, &name, &bytes, diagnostics) {
        return Ok(Step::Refused);
    }
    let scripted = spoken.as_ref().filter(|_| !script.words.is_empty());
    let words = scripted.map(|(_, text)| mouth::word_times(&heard, &script, &text.text));
    let line = Line { made, words, original: original_now() };
    let (before, has_new_text) = ((!is_new).then(|| bytes.clone()), has_new_text(known, &line));
    Ok(Step::New(Box::new(New { before, after, line, heard, script, has_new_text })))
}

/// Whether the recording is known, and the text in it was another one.
fn has_new_text(known: &[Line], now: &Line) -> bool {
    let mut with_sound = known.iter().filter(|line| line.made.sound == now.made.sound).peekable();
    with_sound.peek().is_some() && with_sound.all(|line| line.made.text != now.made.text)
}

/// The Lipz file of the original of a dub: its name, and its bytes; empty if there is none.
fn original_file(job: &Job) -> (String, Vec<u8>) {
    let Some(original) = &job.original else { return Default::default() };
    (shown(&original.lipz_file), fs::read(&original.lipz_file).unwrap_or_default())
}

/// What the original of a dub is while the dub is made.
fn original_then(job: &Job, document: &Document<'_>, options: &SyncOptions) -> Option<OriginalThen> {
    let original = job.original.as_ref()?;
    let sound = original.recording.as_ref().and_then(|path| File::open(path).and_then(content_hash).ok()).unwrap_or(0);
    let spoken = options.spoken_in(original.locale.as_deref(), document);
    Some(OriginalThen { sound, text: text_hash(spoken.as_ref().map(|(_, text)| &*text.text)) })
}

/// Whether the Lipz file of a job is not there yet, and its bytes; for a new one, what it will be without a mouth.
pub(super) fn text_file(job: &Job, options: &SyncOptions) -> Result<(bool, Vec<u8>), Report> {
    match fs::read(&job.lipz_file) {
        Ok(bytes) => Ok((false, bytes)),
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            let style = Style { default_locale: options.options.default_locale.as_deref(), ..Style::default() };
            Ok((true, format(&new_document(job, options), style).into_bytes()))
        }
        Err(error) => Err(unreadable(&job.lipz_file, &error)),
    }
}

/// The mouth of a recording. Reports what is wrong with it.
fn hear(
    job: &Job,
    options: &SyncOptions,
    (locale, script): (Option<&str>, &Script),
    (viseme_type, fps): (VisemeType, Fps),
    reports: &mut Vec<Report>,
) -> Result<Heard, Report> {
    let file = File::open(&job.recording).map_err(|error| unreadable(&job.recording, &error))?;
    let sound = Sound::read(BufReader::new(file), extension(&job.recording))
        .map_err(|error| no_sound(&job.recording, &error))?;
    let condition = Condition::of(&sound);
    let is_unwritten = script.words.is_empty() && viseme_type != VisemeType::Rms;
    let phones = match options.recogniser.as_ref().filter(|_| is_unwritten) {
        Some(recogniser) => Some(recognised(recogniser, job)?.script()),
        None => None,
    };
    let opinion = options.recogniser.as_ref().filter(|_| !script.words.is_empty() && !condition.is_silent());
    let opinion = opinion.map(|recogniser| recognised(recogniser, job)).transpose()?;
    let script = phones.as_ref().unwrap_or(script);
    let hearing = mouth::Hearing { sound: &sound, model: options.model_of(locale), opinion: opinion.as_ref() };
    let mut heard = mouth::make(&hearing, script, (viseme_type, fps), options);
    if condition.is_silent() || phones.is_some() {
        heard.forget_words(); // of what cannot be heard, nothing else needs to be said
    }
    reports.extend(condition.report(&job.recording).map(|mut report| {
        options.options.apply_levels(&mut report);
        report
    }));
    Ok(heard)
}

/// What a recogniser hears in a recording.
fn recognised(recogniser: &Recogniser, job: &Job) -> Result<lipz_speech::Heard, Report> {
    let file = File::open(&job.recording).map_err(|error| unreadable(&job.recording, &error))?;
    let heard = recogniser.hear(BufReader::new(file), extension(&job.recording));
    heard.map_err(|error| no_sound(&job.recording, &error))
}

/// A Lipz file that gets a mouth.
struct Target<'a> {
    bytes: &'a [u8],
    before: &'a Document<'a>,
    is_new: bool,
    /// The locale that is spoken.
    locale: Option<&'a str>,
    /// Its text with the name of its element, if that is not in the file, but in that of the original.
    borrowed: Option<(String, &'a str)>,
    fps: Fps,
    viseme_type: VisemeType,
}

/// The file with its new mouth, and what was guessed.
fn merged(heard: &Heard, script: &Script, options: &SyncOptions, target: &Target<'_>) -> (String, Vec<Diagnostic>) {
    let rate = |fps: Fps| Rate { numerator: fps.numerator(), denominator: fps.denominator(), is_exact: true };
    let time = |&frame: &usize| Time::of_frame(frame as u64, rate(target.fps));
    let starts = || heard.segment_starts.iter().skip(1).map(time).collect::<Vec<_>>();
    let mouth = Mouth::new(heard.codes.as_str(), rate(target.fps), target.viseme_type)
        .segment_starts((!script.words.is_empty()).then(starts));
    let merge_options = MergeOptions::new()
        .locale(target.locale)
        .default_rate(options.options.default_fps.map(rate))
        .default_viseme_type(options.options.default_viseme_type);
    let mut merged = merge(&divided(target), &mouth, &merge_options);
    if let Some((name, _)) = &target.borrowed {
        merged.document.elements.retain(|element| element.name.text != *name);
    }
    let text = String::from_utf8_lossy(target.bytes);
    let default_locale = options.options.default_locale.as_deref();
    let style = Style { default_locale, line_ending: LineEnding::detect(&text) };
    let after = match target.is_new {
        true => format(&merged.document, style),
        false => rewrite(&text, target.before, &merged.document, style),
    };
    (after, merged.diagnostics)
}

/// The file, with the text that is not in it: that says where its segments are.
fn divided<'a>(target: &Target<'a>) -> Document<'a> {
    let mut document = target.before.clone();
    document.elements.extend(target.borrowed.as_ref().map(|(name, text)| Element {
        name: JsonString::from(Cow::Owned(name.clone())),
        value: Value::String(JsonString::from(Cow::Borrowed(*text))),
    }));
    document
}

/// The words of the text that is spoken in a locale. Reports what is odd about it.
fn script(
    (locale, text): &(Option<String>, &JsonString<'_>),
    options: &SyncOptions,
    diagnostics: &mut Vec<Diagnostic>,
) -> Script {
    let reading = options.pronouncer(locale.as_deref()).read(&text.text);
    diagnostics.extend(reading.problems.iter().map(|problem| {
        let span = text.span_of(problem.range.clone());
        Diagnostic::at(Code::Pronunciation, span, problem.kind.to_string()).help(problem.kind.help())
    }));
    reading.script
}

/// Reports what was found in a Lipz file, at the project's levels; whether it is an error.
fn push(
    reports: &mut Vec<Report>,
    options: &SyncOptions,
    name: &str,
    bytes: &[u8],
    mut diagnostics: Vec<Diagnostic>,
) -> bool {
    options.options.levels_for(name).apply(&mut diagnostics);
    let has_errors = diagnostics.iter().any(Diagnostic::is_error);
    diagnostics.sort_by_key(Diagnostic::start);
    if !diagnostics.is_empty() {
        reports.push(Report::from_bytes(name, bytes, diagnostics));
    }
    has_errors
}

/// A file that is not there yet: what is said.
fn new_document(job: &Job, options: &SyncOptions) -> Document<'static> {
    let string = |text: String| JsonString::from(Cow::Owned(text));
    let element =
        |text: &String| Element { name: string(options.text_element(job)), value: Value::String(string(text.clone())) };
    Document { elements: job.text.iter().map(element).collect() }
}

fn own_type(document: &Document<'_>) -> Option<VisemeType> {
    string(document, "viseme_type").and_then(|name| name.text.parse().ok())
}

fn hash(bytes: &[u8]) -> u64 {
    XxHash3_64::oneshot(bytes)
}

/// What a record has of a text: its segments without the blanks around them, which formatting moves.
pub(crate) fn text_hash(spoken: Option<&str>) -> u64 {
    let segments = |text: &str| text.split(DELIMITER).map(trim).collect::<Vec<_>>().join("|");
    spoken.map_or(0, |text| hash(segments(text).as_bytes()))
}

/// Everything besides recording and text that decides about a mouth.
fn settings_hash(
    options: &SyncOptions,
    locale: Option<&str>,
    script: &Script,
    (viseme_type, fps): (VisemeType, Fps),
) -> u64 {
    // Not the places of words in the text, which formatting moves.
    let said = || script.words.iter().map(|word| &word.pronunciations).collect::<Vec<_>>();
    let rules = match viseme_type {
        VisemeType::Rms => format!("{:?}", options.rms),
        _ => {
            let model = options.trained_for(locale).map_or(String::new(), |trained| format!(" {:x}", trained.hash));
            let recogniser = options.recogniser.as_ref().filter(|_| script.words.is_empty());
            let recogniser = recogniser.map_or(String::new(), |recogniser| format!(" heard {:x}", recogniser.hash()));
            format!("{:?} {:?} {:?} {:?}{model}{recogniser}", options.align, options.rules, said(), script.breaks)
        }
    };
    hash(format!("{VERSION} {}/{} {viseme_type:?} {rules}", fps.numerator(), fps.denominator()).as_bytes())
}

/// The mouth of a file. `|` is not a part of it: writers move them.
pub(crate) fn mouth_hash(codes: &[u8], fps: Option<Fps>, viseme_type: Option<VisemeType>) -> u64 {
    let head = format!("{:?} {viseme_type:?} ", fps.map(|fps| (fps.numerator(), fps.denominator())));
    hash(&[head.as_bytes(), codes].concat())
}

/// Reports a text of the script that is not the one of the file, which stays.
fn other_text(job: &Job, spoken: Option<&JsonString<'_>>) -> Option<Diagnostic> {
    let text = job.text.as_ref()?;
    let Some(spoken) = spoken else {
        return Some(
            Diagnostic::new(Code::OtherText, "the file has no text, but the script has one").help("add it to the file"),
        );
    };
    let is_same = words(text).eq(words(&spoken.text));
    let message = format!("the script has another text: {}", escape::quoted(text));
    (!is_same).then(|| {
        Diagnostic::at(Code::OtherText, spoken.span(), message)
            .note("the text of the Lipz file counts: writers and translators work there")
            .help("bring the two together")
    })
}

/// The words of a text, without what only divides and comments it.
fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| c == DELIMITER || c.is_whitespace()).filter(|word| !word.is_empty())
}

fn kept_mouth(kept: Kept, visemes: &JsonString<'_>) -> Diagnostic {
    let why = match kept {
        Kept::Changed => "the mouth was changed by hand, and its recording or text is another one now",
        Kept::ByHand => "the mouth was drawn by hand, or made by another tool",
    };
    Diagnostic::at(Code::MouthKept, visemes.span(), format!("{why}: it is kept"))
        .help("only a forced run replaces it: look first whether it fits")
}

fn no_script(locale: Option<&str>) -> Diagnostic {
    let text = locale.map_or_else(|| "text".to_owned(), |locale| format!("text in `{locale}`"));
    Diagnostic::new(Code::NoScript, format!("the clip has no {text}: the mouth follows the sound alone"))
        .help("add what is said: the mouth will be much better")
}
