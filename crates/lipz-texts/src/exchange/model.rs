//! The exchanged data: clips with their segments, and the translations.

use crate::exchange::Mark;
use lipz_diagnostics::escape;
use lipz_file::text::DELIMITER;
use std::fmt;

/// The texts of many clips, in the source language and its translations.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Exchange {
    /// The source locale: `en-us`.
    pub source_locale: String,
    /// The locales of the translations.
    pub locales: Vec<String>,
    /// The clips, sorted by key.
    pub units: Vec<Unit>,
}

/// The texts of a clip, with information for translators.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Unit {
    /// The key of the clip.
    pub key: String,
    /// The key of the variant, if the texts are those of a variant: `few`.
    pub variant: Option<String>,
    /// The path of the Lipz file.
    pub file: Option<String>,
    /// The path of the recording.
    pub recording: Option<String>,
    /// A note to translators.
    pub note: Option<String>,
    /// The segments of the clip.
    pub segments: Vec<Segment>,
    /// The translations, in the order of [`Exchange::locales`].
    pub translations: Vec<Translation>,
}

/// A segment of a clip: a text that is shown for some time.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Segment {
    /// The source text, with `{meta}`, without whitespace at its ends. May be empty.
    pub source: String,
    /// The speaker, if the texts name one: `{speaker: Mara}`.
    pub speaker: Option<String>,
    /// The events.
    pub events: Option<String>,
    /// The start and the end, in milliseconds.
    pub time_ms: Option<(u64, u64)>,
    /// The number of characters that fit on a screen and can be read in the time.
    pub max_characters: Option<usize>,
}

/// The translation of a clip into one locale.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Translation {
    /// The texts of the segments, one per segment of the clip. Untranslated ones are empty.
    pub texts: Vec<String>,
    /// The state of the work.
    pub state: State,
    /// The source texts of the translation, if they are known and have changed since.
    pub made_from: Option<Vec<String>>,
    /// The comments of translators, one line each.
    pub comments: Vec<String>,
    /// Whether the locale neither has nor needs a text of the unit, such as a variant for `few` in English.
    pub is_unneeded: bool,
}

/// The state of a translation; each includes those before it. The names are those of XLIFF 2.1.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub enum State {
    /// Not translated, or to be revised (*fuzzy*).
    #[default]
    Initial,
    /// Translated.
    Translated,
    /// Translated, and read by a second person.
    Reviewed,
    /// Done.
    Final,
}

/// Whether an exchange file has one text per clip, with `|` between its segments, or one per segment.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub enum Division {
    /// One text per clip, so translators see the whole line.
    #[default]
    Clip,
    /// One text per segment, so translators can neither lose nor add a `|`.
    Segment,
}

impl State {
    /// All states, in order.
    pub const ALL: [State; 4] = [State::Initial, State::Translated, State::Reviewed, State::Final];

    /// Returns the name of the state in XLIFF 2.1.
    pub fn name(self) -> &'static str {
        match self {
            State::Initial => "initial",
            State::Translated => "translated",
            State::Reviewed => "reviewed",
            State::Final => "final",
        }
    }

    /// Returns the state with this name.
    ///
    /// ```
    /// use lipz_texts::State;
    /// assert_eq!(State::from_name("reviewed"), Some(State::Reviewed));
    /// ```
    pub fn from_name(name: &str) -> Option<State> {
        State::ALL.into_iter().find(|state| state.name() == name)
    }
}

impl fmt::Display for State {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl Translation {
    /// Whether all segments are empty.
    pub fn is_empty(&self) -> bool {
        self.texts.iter().all(String::is_empty)
    }

    /// Returns the source text of a segment's translation, if it differs from the current one.
    pub(crate) fn made_from_at(&self, at: usize, source: &str) -> Option<&str> {
        self.made_from.as_ref()?.get(at).map(String::as_str).filter(|made_from| *made_from != source)
    }
}

/// Joins the texts of segments for formats with one text per clip: `Mayor? | Mayor!`.
pub(crate) fn joined<T: AsRef<str>>(texts: &[T]) -> String {
    if texts.iter().all(|text| text.as_ref().is_empty()) {
        return String::new();
    }
    let mut joined = String::new();
    for (number, text) in texts.iter().enumerate() {
        if number > 0 {
            joined.push(' ');
            joined.push(DELIMITER);
            joined.push(' ');
        }
        joined.push_str(text.as_ref());
    }
    joined
}

/// A row or entry of an exchange file.
pub(crate) struct Item<'u> {
    pub(crate) unit: &'u Unit,
    /// The number of the segment, from 1; `None` for the whole clip.
    pub(crate) number: Option<usize>,
    /// Its segments, with their numbers from 0.
    pub(crate) segments: Vec<(usize, &'u Segment)>,
}

impl Exchange {
    /// Returns the items of a file with all locales, or with the one at `at`: each clip, or each of its segments that has
    /// a text. Variants that the locale does not need are left out.
    pub(crate) fn items(&self, at: Option<usize>, division: Division) -> impl Iterator<Item = Item<'_>> {
        let is_needed = move |unit: &&Unit| match at {
            Some(at) => unit.translations.get(at).is_none_or(|translation| !translation.is_unneeded),
            None => unit.variant.is_none() || unit.translations.iter().any(|translation| !translation.is_unneeded),
        };
        self.units.iter().filter(is_needed).flat_map(move |unit| {
            let all = || unit.segments.iter().enumerate();
            match division {
                Division::Clip => vec![Item { unit, number: None, segments: all().collect() }],
                // The segment of a clip with one segment needs no number.
                Division::Segment if unit.segments.len() == 1 => {
                    vec![Item { unit, number: None, segments: all().collect() }]
                }
                Division::Segment => {
                    let spoken = all().filter(|(_, segment)| !segment.source.is_empty());
                    spoken.map(|part| Item { unit, number: Some(part.0 + 1), segments: vec![part] }).collect()
                }
            }
        })
    }
}

impl Unit {
    /// Returns the ID: the key, and that of the variant after `|x-`. Keys never contain a `|`.
    pub(crate) fn id(&self) -> String {
        match &self.variant {
            Some(variant) => format!("{}{VARIANT_MARK}{variant}", self.key),
            None => self.key.clone(),
        }
    }
}

/// The characters between the key of a clip and that of a variant.
pub(crate) const VARIANT_MARK: &str = "|x-";

impl Item<'_> {
    /// Returns the ID: that of the unit, and the number of the segment after a `|`.
    pub(crate) fn id(&self) -> String {
        match self.number {
            Some(number) => format!("{}{DELIMITER}{number}", self.unit.id()),
            None => self.unit.id(),
        }
    }

    /// Returns the source text.
    pub(crate) fn source(&self) -> String {
        joined(&self.segments.iter().map(|(_, segment)| segment.source.as_str()).collect::<Vec<_>>())
    }

    /// Returns the source text of a variant, `unit`, with that of this item in the segments that do not vary; empty if
    /// none of them varies.
    pub(crate) fn source_of_variant(&self, unit: &Unit) -> String {
        let source = |(number, _): &(usize, &Segment)| unit.segments.get(*number).map_or("", |other| &other.source);
        self.filled(self.segments.iter().map(source), |segment| &segment.1.source)
    }

    /// Returns the translation of a variant, an item with the same segments, with the text of this item in the segments
    /// that do not vary; empty if it has none.
    pub(crate) fn text_of_variant(&self, variant: &Item<'_>, [own, of_variant]: [&Translation; 2]) -> String {
        let text = |(number, _): &(usize, &Segment)| of_variant.texts.get(*number).map_or("", String::as_str);
        self.filled(variant.segments.iter().map(text), |(number, _)| {
            let varies = variant.segments.iter().any(|(other, segment)| other == number && !segment.source.is_empty());
            own.texts.get(*number).filter(|_| !varies).map_or("", String::as_str)
        })
    }

    fn filled<'t>(
        &'t self,
        texts: impl Iterator<Item = &'t str>,
        own: impl Fn(&'t (usize, &'t Segment)) -> &'t str,
    ) -> String {
        let texts: Vec<&str> = texts.collect();
        if texts.iter().all(|text| text.is_empty()) {
            return String::new();
        }
        let filled =
            texts.into_iter().zip(&self.segments).map(|(text, part)| if text.is_empty() { own(part) } else { text });
        joined(&filled.collect::<Vec<_>>())
    }

    /// Returns the text of a translation.
    pub(crate) fn text(&self, translation: &Translation) -> String {
        self.of(&translation.texts)
    }

    /// Returns the source text of a translation, if it differs from the current one.
    pub(crate) fn made_from(&self, translation: &Translation) -> Option<String> {
        let made_from = self.of(translation.made_from.as_ref()?);
        (made_from != self.source()).then_some(made_from)
    }

    /// Returns the state of a translation. A stale one must be revised.
    pub(crate) fn state(&self, translation: &Translation) -> State {
        if self.made_from(translation).is_some() { State::Initial } else { translation.state }
    }

    /// Returns the mark of a translation.
    pub(crate) fn mark(&self, translation: &Translation) -> Mark {
        Mark::of(&self.text(translation))
    }

    /// Returns information for translators, in lines.
    pub(crate) fn comments(&self) -> Vec<String> {
        let mut comments = Vec::new();
        comments.extend(self.unit.variant.as_ref().map(|variant| format!("variant: {variant}")));
        let mut speaker = None;
        for (number, segment) in &self.segments {
            if let Some(name) = segment.speaker.as_deref().filter(|name| Some(*name) != speaker) {
                speaker = Some(name);
                comments.push(format!("speaker: {}", escape::text(name)));
            }
            let mut facts = Vec::new();
            facts.extend(segment.time_ms.map(|(start, end)| format!("{} to {} s", seconds(start), seconds(end))));
            facts.extend(segment.max_characters.map(|most| format!("at most {most} characters")));
            facts.extend(segment.events.as_ref().map(|events| format!("events: {}", escape::text(events))));
            if !facts.is_empty() {
                let head = if self.segments.len() > 1 { format!("segment {}: ", number + 1) } else { String::new() };
                comments.push(head + &facts.join(", "));
            }
        }
        comments
            .extend(self.unit.note.iter().flat_map(|note| note.lines()).map(|line| escape::text(line).into_owned()));
        comments
    }

    /// Returns the comments of translators, which the first item of a clip has.
    pub(crate) fn translator_comments<'t>(&self, translation: &'t Translation) -> &'t [String] {
        let first = self.unit.segments.iter().position(|segment| !segment.source.is_empty()).unwrap_or(0);
        let is_first = self.number.is_none_or(|number| number == first + 1);
        if is_first { &translation.comments } else { &[] }
    }

    /// Returns the paths of the clip's Lipz file and recording.
    pub(crate) fn paths(&self) -> impl Iterator<Item = &str> {
        [&self.unit.file, &self.unit.recording].into_iter().flatten().map(String::as_str)
    }

    fn of(&self, texts: &[String]) -> String {
        let text = |(number, _): &(usize, &Segment)| texts.get(*number).map_or("", String::as_str);
        joined(&self.segments.iter().map(text).collect::<Vec<_>>())
    }
}

/// Returns milliseconds as seconds: `1.250`.
pub(crate) fn seconds(ms: u64) -> String {
    format!("{}.{:03}", ms / 1000, ms % 1000)
}
