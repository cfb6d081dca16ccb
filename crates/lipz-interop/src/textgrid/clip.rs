//! TextGrids as clips: words, phones and texts of aligners, mouth shapes and texts of lipz.
//!
//! The name of a tier determines its content. Aligners write a pair of tiers for each speaker, `Mara - words` and `Mara
//! - phones`.

use super::phones::is_silence;
use super::roles::{TierRole, roles};
use super::symbols::{ARPABET, IPA, Sound, Symbols, XSAMPA};
use super::{Interval, TextGrid, Tier};
use crate::import::element;
use crate::{DEFAULT_RATE, Format, ImportOptions, Shape, StartedPhone, Text, Time, TimedText, Track, find_map};
use lipz_diagnostics::{Code, Diagnostic, Span, escape};
use lipz_file::locale::{TextName, text_name};
use lipz_file::text::{DELIMITER, trim};
use lipz_file::{Element, Value};
use lipz_types::VisemeType;
use std::collections::{BTreeSet, HashMap};
use std::fmt::Write;

pub(crate) const FORMAT: Format = Format {
    name: "textgrid",
    about: "Praat TextGrid, also of the Montreal Forced Aligner",
    extension: "TextGrid",
    maps: &["blair", "toonboom", "rms", ARPABET, IPA, XSAMPA],
    is_binary: false,
    is_legacy: true,
    keeps_texts: true,
    read: Some(read),
    write: Some(write),
};

/// The tiers of a speaker.
type Tiers<'t> = Vec<(TierRole, &'t Tier)>;

fn read(bytes: &[u8], options: &ImportOptions<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Track> {
    TextGrid::read(bytes, diagnostics).and_then(|grid| tracks(&grid, options, diagnostics)).unwrap_or_default()
}

/// Returns a track for each speaker; `None` if the file has no mouth shapes.
fn tracks(grid: &TextGrid, options: &ImportOptions<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<Vec<Track>> {
    let mut speakers: Vec<(Option<&str>, Tiers<'_>)> = Vec::new();
    let mut place_of: HashMap<Option<&str>, usize> = HashMap::new();
    let roles = roles(&grid.tiers, options.tiers, diagnostics)?;
    for (tier, (speaker, role)) in grid.tiers.iter().zip(roles) {
        // A tier with an unknown name does not belong to a speaker, even if it contains a hyphen.
        let speaker = speaker.filter(|_| role != TierRole::Unknown);
        let place = *place_of.entry(speaker).or_insert(speakers.len());
        if place == speakers.len() {
            speakers.push((speaker, Vec::new()));
        }
        speakers.get_mut(place).into_iter().for_each(|(_, tiers)| tiers.push((role.clone(), tier)));
    }
    let is_spoken = |tiers: &[(TierRole, &Tier)]| {
        tiers.iter().any(|(role, _)| matches!(role, TierRole::Visemes(_) | TierRole::Phones))
    };
    if !speakers.iter().any(|(_, tiers)| is_spoken(tiers)) {
        let diagnostic = Diagnostic::new(Code::NoShapes, "the file has no tier called `phones` or `visemes`");
        diagnostics.push(
            diagnostic.note(super::roles::listed(&grid.tiers)).help("name the tier with the phones: --tier NAME"),
        );
        return None;
    }
    let origin = TimeOrigin(grid.start);
    let (spoken, silent): (Vec<_>, Vec<_>) = speakers.into_iter().partition(|(_, tiers)| is_spoken(tiers));
    let spoken = spoken.into_iter();
    let mut tracks: Vec<Track> =
        spoken.map(|(name, tiers)| track(name, &tiers, grid, origin, options, diagnostics)).collect();
    let left_out = silent.iter().flat_map(|(_, tiers)| tiers).map(|(_, tier)| left_out(tier));
    tracks.iter_mut().take(1).for_each(|first| first.remarks.extend(left_out.clone()));
    Some(tracks)
}

/// Returns the remark about a tier that is skipped.
fn left_out(tier: &Tier) -> String {
    format!("the tier {} is left out", escape::quoted(&tier.name))
}

/// The start of the file, which may be a part of a longer recording.
#[derive(Clone, Copy)]
struct TimeOrigin(Time);

impl TimeOrigin {
    fn time(self, time: Time) -> Time {
        const NANOSECONDS: u32 = 1_000_000_000;
        match self.0 == Time::ZERO {
            true => time,
            false => Time::new(time.in_units(NANOSECONDS).saturating_sub(self.0.in_units(NANOSECONDS)), NANOSECONDS),
        }
    }
}

/// Returns the track of one speaker.
fn track(
    name: Option<&str>,
    tiers: &[(TierRole, &Tier)],
    grid: &TextGrid,
    origin: TimeOrigin,
    options: &ImportOptions<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Track {
    let mut track = Track { name: name.map(str::to_owned), end: Some(origin.time(grid.end)), ..Track::default() };
    let first = |is: &dyn Fn(&TierRole) -> bool| tiers.iter().find(|(role, _)| is(role)).copied_role();
    let timed = |interval: &Interval| TimedText { start: origin.time(interval.start), text: interval.label.clone() };
    if let Some((_, words)) = first(&|role| *role == TierRole::Words) {
        track.words = words.intervals.iter().filter(|word| !is_silence(trim(&word.label))).map(timed).collect();
    }
    let mouth =
        first(&|role| matches!(role, TierRole::Visemes(_))).or_else(|| first(&|role| *role == TierRole::Phones));
    let symbols = match mouth {
        Some((TierRole::Visemes(viseme_type), _)) => Symbols::Codes(viseme_type),
        Some((_, phones)) => Symbols::of_phones(phones, options.map),
        None => return track,
    };
    track.map = Some(symbols.table());
    let intervals = mouth.map_or(&[][..], |(_, tier)| &tier.intervals);
    track.shapes = shapes(intervals, symbols, origin, grid.end);
    track.phones =
        first(&|role| *role == TierRole::Phones).map(|(_, tier)| phones(tier, origin, grid.end)).unwrap_or_default();
    for (kind, shown) in [(Sound::Spoken, "one shape"), (Sound::Noise, "rest")] {
        let labels =
            quoted_labels(intervals.iter().map(|interval| &interval.label), |label| symbols.sound(label) == kind);
        if !labels.is_empty() {
            track.remarks.push(format!("labels without phones ({labels}) are shown as {shown}"));
        }
    }
    let elements: Vec<&Tier> =
        tiers.iter().filter(|(role, _)| *role == TierRole::Element).map(|(_, tier)| *tier).collect();
    let phrases = first(&|role| *role == TierRole::Phrases).map(|(_, tier)| tier);
    if let Some(divided) = phrases.or_else(|| elements.first().copied()) {
        track.phrases = divided.intervals.iter().map(timed).collect();
        for tier in &elements {
            let own = tier.name.rsplit(" - ").next().unwrap_or(&tier.name).trim();
            let text = parts(tier, divided, diagnostics).join(&DELIMITER.to_string());
            match text_name(own) {
                Some(TextName::Canonical(locale)) => track.texts.push(Text { locale: Some(locale), text }),
                _ => track.elements.push(element(own, text)),
            }
        }
        // Numbers of segments do not count as text.
        let is_text = |phrase: &Interval| phrase.label.chars().any(char::is_alphabetic) && !is_silence(&phrase.label);
        if elements.is_empty() && divided.intervals.iter().any(is_text) {
            let said = |phrase: &Interval| if is_text(phrase) { part(&phrase.label) } else { String::new() };
            let text = divided.intervals.iter().map(said).collect::<Vec<_>>().join("|");
            track.texts.push(Text { locale: None, text });
        }
    }
    let unknown = tiers.iter().filter(|(role, _)| *role == TierRole::Unknown);
    track.remarks.extend(unknown.map(|(_, tier)| left_out(tier)));
    track
}

/// Returns the different labels that are selected, in quotes.
fn quoted_labels<'l>(labels: impl Iterator<Item = &'l String>, is_selected: impl Fn(&str) -> bool) -> String {
    let different: BTreeSet<&str> = labels.map(|label| trim(label)).filter(|label| is_selected(label)).collect();
    let mut quoted = String::new();
    for label in different {
        let comma = if quoted.is_empty() { "" } else { ", " };
        // Writing to a string cannot fail.
        let _ = write!(quoted, "{comma}{}", escape::quoted(label));
    }
    quoted
}

/// A pair of references, copied.
trait CopiedRole<'t> {
    fn copied_role(self) -> Option<(TierRole, &'t Tier)>;
}

impl<'t> CopiedRole<'t> for Option<&(TierRole, &'t Tier)> {
    fn copied_role(self) -> Option<(TierRole, &'t Tier)> {
        self.map(|(role, tier)| (role.clone(), *tier))
    }
}

/// Returns a label as a part of a text, without `|`, which would divide it.
fn part(label: &str) -> String {
    trim(label).replace(DELIMITER, "\u{a6}")
}

/// Returns the labels of a tier for each interval of the tier that divides the clip. A label belongs to the interval
/// that contains its middle.
fn parts(tier: &Tier, divided: &Tier, diagnostics: &mut Vec<Diagnostic>) -> Vec<String> {
    let mut parts = vec![String::new(); divided.intervals.len()];
    let starts: Vec<Time> = divided.intervals.iter().map(|interval| interval.start).collect();
    for interval in &tier.intervals {
        let middle = interval.start.midpoint(interval.end);
        let index = starts.partition_point(|start| *start <= middle).saturating_sub(1);
        let label = part(&interval.label);
        let Some(part) = parts.get_mut(index).filter(|_| !label.is_empty()) else { continue };
        if !part.is_empty() {
            part.push(' ');
        }
        *part += &label;
    }
    if tier.intervals.len() != divided.intervals.len() {
        let (name, own, other) = (escape::quoted(&tier.name), tier.intervals.len(), divided.intervals.len());
        let message = format!("the tier {name} has {own} intervals, but {} has {other}", escape::quoted(&divided.name));
        let span = tier.intervals.first().and_then(|interval| interval.span).unwrap_or_else(|| Span::new(0, 0));
        diagnostics.push(
            Diagnostic::at(Code::ForeignOddity, span, message)
                .note("each label belongs to the segment that contains its middle")
                .help("give both tiers the same boundaries"),
        );
    }
    parts
}

/// Returns the shapes of a tier. The mouth rests in its gaps.
fn shapes(intervals: &[Interval], symbols: Symbols<'_>, origin: TimeOrigin, end: Time) -> Vec<Shape> {
    let shape = |start: Time, label: &str, span: Option<Span>| Shape {
        start: origin.time(start),
        symbol: symbols.symbol(label),
        span,
    };
    let mut shapes = Vec::with_capacity(intervals.len());
    let mut done: Option<Time> = None;
    for interval in intervals {
        if let Some(gap) = done.filter(|done| *done < interval.start) {
            shapes.push(shape(gap, "", interval.span));
        }
        shapes.push(shape(interval.start, &interval.label, interval.span));
        done = Some(interval.end);
    }
    if let Some(gap) = done.filter(|done| *done < end) {
        shapes.push(shape(gap, "", intervals.last().and_then(|last| last.span)));
    }
    shapes
}

/// Returns the phones of a tier, by the alphabet of its labels.
fn phones(tier: &Tier, origin: TimeOrigin, end: Time) -> Vec<StartedPhone> {
    let symbols = Symbols::of_phones(tier, None);
    let Some(map) = find_map(symbols.table()) else { return Vec::new() };
    let phone = |shape: Shape| Some(StartedPhone { start: shape.start, phone: map.phone(&shape.symbol)? });
    shapes(&tier.intervals, symbols, origin, end).into_iter().filter_map(phone).collect()
}

/// Returns a tier cut at the end of the file, because a recording ends within the last frame of its lip-sync track.
fn until(tier: &Tier, end: Time) -> Tier {
    let cut = |interval: &Interval| Interval { end: interval.end.min(end), ..interval.clone() };
    let mut intervals: Vec<Interval> =
        tier.intervals.iter().map(cut).filter(|interval| interval.start < interval.end).collect();
    let done = intervals.last().map_or(Time::ZERO, |last| last.end);
    if done < end {
        intervals.push(Interval::new(done, end, ""));
    }
    Tier { intervals, ..tier.clone() }
}

/// Writes the times of words and phones, the codes as `visemes`, the segments, and a tier for each text and the events.
fn write(track: &Track, diagnostics: &mut Vec<Diagnostic>) -> Vec<u8> {
    let end = track.end.unwrap_or(Time::ZERO);
    // Praat rejects audio and files of zero length.
    let end = if end == Time::ZERO { Time::of_frame(1, track.rate.unwrap_or(DEFAULT_RATE)) } else { end };
    let tier_of = |starts: &[(Time, String)]| {
        let ends = starts.iter().skip(1).map(|(start, _)| *start).chain([end]);
        let intervals = starts.iter().zip(ends).map(|((start, label), end)| Interval::new(*start, end, label));
        intervals.filter(|interval| interval.start < interval.end).collect::<Vec<_>>()
    };
    let mut grid = TextGrid { start: Time::ZERO, end, tiers: Vec::new() };
    let add = |grid: &mut TextGrid, name: &str, starts: &[(Time, String)]| {
        grid.tiers.push(Tier::new(name, tier_of(starts)));
    };
    grid.tiers.extend(track.tiers.iter().map(|tier| until(tier, end)));
    let mut shapes: Vec<_> = track.shapes.iter().map(|shape| (shape.start, shape.symbol.clone())).collect();
    if shapes.is_empty() {
        shapes.push((Time::ZERO, String::new()));
    }
    let name = match track.map.and_then(find_map).map(|map| map.viseme_type) {
        None | Some(VisemeType::Blair) => "visemes".to_owned(),
        Some(other) => format!("visemes-{}", other.name()),
    };
    add(&mut grid, &name, &shapes);
    let starts: Vec<Time> = track.phrases.iter().map(|phrase| phrase.start).collect();
    let in_segments = |text: &str| {
        let parts = text.split(DELIMITER).map(|part| trim(part).to_owned()).chain(std::iter::repeat(String::new()));
        starts.iter().copied().zip(parts).collect::<Vec<_>>()
    };
    let numbers: Vec<_> = starts.iter().copied().zip((1..).map(|number: usize| number.to_string())).collect();
    let lost = starts.len() - tier_of(&numbers).len();
    if lost > 0 {
        let segments = if lost == 1 { "segment has" } else { "segments have" };
        let message = format!("{lost} {segments} no frames and cannot be stored in a TextGrid");
        diagnostics.push(Diagnostic::new(Code::ExportLoss, message).note("its texts and its event are also left out"));
    }
    add(&mut grid, "segments", &numbers);
    for text in &track.texts {
        let name = format!("text_{}", text.locale.as_deref().unwrap_or_default());
        add(&mut grid, &name, &in_segments(&text.text));
    }
    for Element { name, value } in &track.elements {
        if let Value::String(string) = value {
            add(&mut grid, &name.text, &in_segments(&string.text));
        }
    }
    grid.write().into_bytes()
}
