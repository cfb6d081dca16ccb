//! From a track to a Lipz document: codes, frames, segments, texts.

use crate::frames::{Run, Why, resample};
use crate::segments::{Division, Segments, Speech, divide};
use crate::{Format, Map, Shape, Text, Time, Track, map};
use lipz::diagnostic::show;
use lipz::rate::Rate;
use lipz::text::{DELIMITER, trim};
use lipz::{Code, Diagnostic, Document, Element, JsonString, Level, Raw, Value, VisemeType};
use std::borrow::Cow;

/// The frame rate of clips if neither the file nor the project tells one: that of Rhubarb, Moho and Pamela.
pub const DEFAULT_RATE: Rate = Rate { numerator: 24, denominator: 1, is_exact: true };
/// Most frames of a clip: more than a day at 24 frames a second can only be a mistake.
const MAX_FRAMES: u64 = 1 << 22;
/// Losses that a finding names; [`Clip::lost`] has all.
const LOSSES_SHOWN: usize = 8;

/// What a project and a person decide about an import.
#[derive(Clone, Debug)]
pub struct ImportOptions<'a> {
    /// The table to use instead of the one of the format.
    pub map: Option<&'a Map>,
    /// The viseme type of the clips, which chooses among the tables of the format; without it, the first one.
    pub viseme_type: Option<VisemeType>,
    /// The frame rate of the clips; without it, that of the file.
    pub rate: Option<Rate>,
    /// The frame rate of clips if neither is told.
    pub default_rate: Rate,
    /// Frames a second of files that count frames and do not say how many are a second.
    pub file_rate: Option<Rate>,
    /// The name of the file without folders and extension, for formats that have it in the file, too.
    pub name: Option<&'a str>,
    /// What a second has of the units in which a Fallout file counts; without it, what the length of the sound
    /// tells, or what the engine plays.
    pub units_per_second: Option<u32>,
    /// How long the recording is.
    pub sound_length: Option<Time>,
    /// The number of the first frame in Moho files, 0 or 1.
    pub dat_base: u64,
    /// Frames for which a shape is shown at least.
    pub min_hold: usize,
    /// What is said; without it, what the file has.
    pub text: Option<&'a str>,
    /// The locale of the text, `en-us`.
    pub locale: Option<&'a str>,
    /// Where clips are divided.
    pub segments: Segments,
    /// The shortest rest of the mouth that is a pause.
    pub min_pause: Time,
}

impl Default for ImportOptions<'_> {
    fn default() -> Self {
        ImportOptions {
            map: None,
            viseme_type: None,
            rate: None,
            default_rate: DEFAULT_RATE,
            file_rate: None,
            name: None,
            units_per_second: None,
            sound_length: None,
            dat_base: 1,
            min_hold: 1,
            text: None,
            locale: None,
            segments: Segments::default(),
            min_pause: Time::new(300, 1000),
        }
    }
}

/// What an import gave.
#[derive(Debug, Default)]
pub struct Imported {
    /// The clips, one for each speaker of the file; none if a finding is an error.
    pub clips: Vec<Clip>,
    /// What is wrong or lost.
    pub diagnostics: Vec<Diagnostic>,
}

/// An imported clip.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Clip {
    /// What the file calls the speaker, if it has several.
    pub name: Option<String>,
    /// The clip as a Lipz file.
    pub document: Document<'static>,
    /// The table that was used: `rhubarb 1`.
    pub map: String,
    /// The frame rate.
    pub rate: Rate,
    /// Frames of the clip.
    pub frames: usize,
    /// The shapes that have no frame.
    pub lost: Vec<Lost>,
    /// How the file was read where there was a choice, a sentence each.
    pub remarks: Vec<String>,
}

/// A shape without a frame.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Lost {
    /// What the file calls it.
    pub symbol: String,
    /// When it starts.
    pub start: Time,
    /// When it ends.
    pub end: Time,
    /// Why it has no frame.
    pub why: Why,
}

impl Lost {
    /// The loss as a sentence.
    pub fn describe(&self) -> String {
        let ms = self.end.in_units(1000).saturating_sub(self.start.in_units(1000));
        format!("{} at {} ({ms} ms): {}", show::name(&self.symbol), self.start, self.why.reason())
    }
}

/// Reads a file of another tool as Lipz documents.
///
/// Nothing in the file makes this panic; what is wrong with it is in the diagnostics. Spans count from the
/// first byte after a byte order mark; in binary files, notes tell the byte.
pub fn import(format: &Format, bytes: &[u8], options: &ImportOptions<'_>) -> Imported {
    let mut imported = Imported::default();
    let Some(read) = format.read else { return imported };
    let tracks = read(bytes, options, &mut imported.diagnostics);
    let several = tracks.len() > 1;
    for mut track in tracks {
        if !several {
            track.name = None;
        }
        let Some(map) = table(format, &track, options) else { continue };
        imported.clips.extend(clip(track, map, options, &mut imported.diagnostics));
    }
    imported.diagnostics.sort_by_key(Diagnostic::start);
    if imported.diagnostics.iter().any(|finding| finding.level == Level::Error) {
        imported.clips.clear();
        // Shapes that could not be read are not missing.
        imported.diagnostics.retain(|finding| finding.code != Code::NoShapes);
    }
    imported
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
fn clip(track: Track, map: &Map, options: &ImportOptions<'_>, findings: &mut Vec<Diagnostic>) -> Option<Clip> {
    let track = in_order(track, findings);
    let rate = options.rate.or(track.rate).unwrap_or(options.default_rate);
    let (symbols, runs) = runs(&track, map, rate, findings)?;
    if track.shapes.is_empty() && track.phrases.is_empty() {
        findings.push(
            Diagnostic::new(Code::NoShapes, "the file has no mouth shapes")
                .help("the clip rests all the time; was the recording silent, or the tool interrupted?"),
        );
    }
    let resampled = resample(&runs, map.viseme_type, rate, options.min_hold);
    let lost: Vec<Lost> = resampled
        .lost
        .iter()
        .filter_map(|&(index, why)| {
            // The rest before the first shape is ours: nobody misses it.
            let run = runs.get(index).filter(|run| run.code != REST || run.start > Time::ZERO)?;
            Some(Lost { symbol: (*symbols.get(index)?).to_owned(), start: run.start, end: run.end, why })
        })
        .collect();
    report(&lost, symbols.len(), rate, findings);
    let texts = texts(&track, options, findings);
    let speech = Speech::of(&runs, options.min_pause);
    let division = divide(&track, &speech, &texts, options.segments, findings);
    let codes = codes(&runs, &resampled.lengths, &division, rate);
    let document = document(&track, codes, texts, &division, map.viseme_type, rate);
    let frames = resampled.lengths.iter().sum();
    Some(Clip { name: track.name, document, map: map.label(), rate, frames, lost, remarks: track.remarks })
}

/// The track with its shapes in the order of their times; reports where they run backwards.
fn in_order(mut track: Track, findings: &mut Vec<Diagnostic>) -> Track {
    let backwards = track.shapes.windows(2).filter_map(|pair| match pair {
        [before, after] if after.start < before.start => Some((before, after)),
        _ => None,
    });
    let count = backwards.clone().count();
    if let Some((before, after)) = backwards.clone().next() {
        let (earlier, later) = (after.start, before.start);
        let headline = format!("times run backwards: {earlier} stands behind {later}");
        let finding = shape_finding(Code::TimesBackwards, after, headline)
            .note("the shapes are used in the order of their times")
            .help("was the file edited by hand, or joined of two? look at the clip there");
        findings.push(if count > 1 { finding.note(format!("so do {} more", count - 1)) } else { finding });
        track.shapes.sort_by_key(|shape| shape.start);
    }
    track
}

fn shape_finding(code: Code, shape: &Shape, headline: String) -> Diagnostic {
    match shape.span {
        Some(span) => Diagnostic::at(code, span, headline),
        None => Diagnostic::new(code, headline).note(format!("at {}", shape.start)),
    }
}

/// The shapes as codes, equal neighbours joined, with the symbol of each; reports symbols that the table
/// does not have.
fn runs<'t>(
    track: &'t Track,
    map: &Map,
    rate: Rate,
    findings: &mut Vec<Diagnostic>,
) -> Option<(Vec<&'t str>, Vec<Run>)> {
    let last = track.shapes.last().map_or(Time::ZERO, |shape| shape.start);
    let a_frame_later = Time::of_frame(last.nearest_frame(rate).saturating_add(1), rate);
    let end = track.end.unwrap_or(if track.shapes.is_empty() { last } else { a_frame_later }).max(last);
    if end.nearest_frame(rate) > MAX_FRAMES {
        let headline = format!("the clip would have more than {MAX_FRAMES} frames: it ends at {end}");
        findings.push(Diagnostic::new(Code::ForeignValue, headline).help("are the times in the unit of the format?"));
        return None;
    }
    let before = findings.len();
    let mut unknown: Vec<(&str, Diagnostic)> = Vec::new();
    let (mut symbols, mut runs): (Vec<&str>, Vec<Run>) = (Vec::new(), Vec::new());
    let first = track.shapes.first().map_or(end, |shape| shape.start);
    if first > Time::ZERO {
        symbols.push("-");
        runs.push(Run { code: REST, start: Time::ZERO, end: first });
    }
    for (index, shape) in track.shapes.iter().enumerate() {
        let Some(code) = map.code(&shape.symbol) else {
            match unknown.iter_mut().find(|(symbol, _)| *symbol == shape.symbol) {
                Some((_, finding)) => finding
                    .secondary
                    .extend(shape.span.map(|span| lipz::diagnostic::Label { span, text: "also here".into() })),
                None => unknown.push((&shape.symbol, unknown_symbol(shape, map))),
            }
            continue;
        };
        let end = track.shapes.get(index + 1).map_or(end, |next| next.start);
        match runs.last_mut() {
            Some(run) if run.code == code => run.end = end,
            _ => {
                symbols.push(&shape.symbol);
                runs.push(Run { code, start: shape.start, end });
            }
        }
    }
    findings.extend(unknown.into_iter().map(|(_, finding)| finding));
    (findings.len() == before).then_some((symbols, runs))
}

/// The resting mouth in every viseme type.
pub(crate) const REST: u8 = b'-';

fn unknown_symbol(shape: &Shape, map: &Map) -> Diagnostic {
    let headline = format!("{} is not in the mapping table `{}`", show::name(&shape.symbol), show::text(&map.name));
    let finding = shape_finding(Code::UnknownSymbol, shape, headline);
    match map.nearest(&shape.symbol) {
        Some(known) => finding.help(format!("did you mean {}?", show::name(known))),
        None => finding.help("give a table that has it with --map; lipz maps shows the tables there are"),
    }
}

/// Reports the shapes that have no frame.
fn report(lost: &[Lost], all: usize, rate: Rate, findings: &mut Vec<Diagnostic>) {
    if lost.is_empty() {
        return;
    }
    let (count, have) = (lost.len(), if lost.len() == 1 { "has" } else { "have" });
    let headline = format!("{count} of {all} mouth shapes {have} no frame at {} frames a second", spell(rate));
    let mut finding = Diagnostic::new(Code::ShapesLost, headline);
    for loss in lost.iter().take(LOSSES_SHOWN) {
        finding = finding.note(loss.describe());
    }
    if count > LOSSES_SHOWN {
        finding = finding.note(format!("and {} more, which --report lists", count - LOSSES_SHOWN));
    }
    findings.push(finding.help("choose a higher rate with --fps if the game can show it"));
}

/// The texts of the clip with their locales; reports those that have none.
fn texts(track: &Track, options: &ImportOptions<'_>, findings: &mut Vec<Diagnostic>) -> Vec<Text> {
    let given = options.text.map(|text| vec![Text { locale: None, text: text.to_owned() }]);
    let mut texts = given.unwrap_or_else(|| track.texts.clone());
    for text in &mut texts {
        if text.locale.is_none() {
            text.locale = options.locale.map(str::to_owned);
        }
    }
    let before = texts.len();
    texts.retain(|text| text.locale.is_some());
    if texts.len() < before {
        findings.push(
            Diagnostic::new(Code::TextLeftOut, "the text is left out: its locale is not known")
                .help("name the locale: --locale en-us, or `default-locale` in lipz.toml"),
        );
    }
    for (index, text) in texts.iter().enumerate() {
        let Some(locale) = &text.locale else { continue };
        if texts.iter().take(index).any(|before| before.locale == text.locale) {
            let headline = format!("two texts are of the locale {}", show::name(locale));
            findings.push(Diagnostic::new(Code::SameLocaleTwice, headline).help("keep one of them"));
        }
    }
    texts
}

/// The codes of all frames, with `|` where segments start.
fn codes(runs: &[Run], lengths: &[usize], division: &Division, rate: Rate) -> String {
    let mut starts = Vec::with_capacity(runs.len() + 1);
    let mut codes = String::new();
    for (run, &length) in runs.iter().zip(lengths) {
        starts.push((run.start, codes.len()));
        codes.extend(std::iter::repeat_n(char::from(run.code), length));
    }
    // A segment that starts with a shape starts with its first frame, wherever that went.
    let frame_of = |time: Time| match starts.binary_search_by(|(start, _)| start.cmp(&time)) {
        Ok(found) => starts.get(found).map_or(codes.len(), |(_, frame)| *frame),
        Err(_) => usize::try_from(time.nearest_frame(rate)).unwrap_or(codes.len()),
    };
    let mut divided = String::with_capacity(codes.len() + division.starts.len());
    let mut done = 0;
    for start in &division.starts {
        let frame = frame_of(*start).clamp(done, codes.len());
        divided.push_str(codes.get(done..frame).unwrap_or_default());
        divided.push(DELIMITER);
        done = frame;
    }
    divided + codes.get(done..).unwrap_or_default()
}

fn document(
    track: &Track,
    codes: String,
    texts: Vec<Text>,
    division: &Division,
    viseme_type: VisemeType,
    rate: Rate,
) -> Document<'static> {
    let mut elements = vec![element("visemes", codes)];
    for (text, parts) in texts.into_iter().zip(&division.texts) {
        let trimmed: Vec<&str> = parts.iter().map(|part| trim(part)).collect();
        let name = format!("text_{}", text.locale.unwrap_or_default());
        elements.push(element(&name, trimmed.join(&DELIMITER.to_string())));
    }
    elements.push(element("viseme_type", viseme_type.name().to_owned()));
    elements.push(fps(rate));
    elements.extend(track.elements.iter().cloned());
    Document { elements }
}

/// An element with a string.
pub(crate) fn element(name: &str, value: String) -> Element<'static> {
    Element { name: string(name.to_owned()), value: Value::String(string(value)) }
}

/// The frame rate as an element.
pub(crate) fn fps(rate: Rate) -> Element<'static> {
    Element { name: string("fps".to_owned()), value: Value::Number(Raw::new(spell(rate))) }
}

fn string(text: String) -> JsonString<'static> {
    Cow::<'static, str>::Owned(text).into()
}

/// A rate in decimal digits.
pub(crate) fn spell(rate: Rate) -> String {
    (f64::from(rate.numerator) / f64::from(rate.denominator.max(1))).to_string()
}
