//! What is exchanged: clips with their segments, and the translations of these.

use crate::Mark;
use lipz_diagnostics::escape;
use lipz_file::text::DELIMITER;
use std::fmt;

/// Texts of many clips, in one language and in those that they are translated into.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Exchange {
    /// The locale that is translated: `en-us`.
    pub source_locale: String,
    /// The locales of the translations.
    pub locales: Vec<String>,
    /// The clips, in the order of their keys.
    pub units: Vec<Unit>,
}

/// The texts of a clip, and what helps to translate them.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Unit {
    /// The key of the clip.
    pub key: String,
    /// The path of the Lipz file.
    pub file: Option<String>,
    /// The path of the recording.
    pub recording: Option<String>,
    /// What somebody wants translators to know.
    pub note: Option<String>,
    /// The segments of the clip.
    pub segments: Vec<Segment>,
    /// The translations, in the order of [`Exchange::locales`].
    pub translations: Vec<Translation>,
}

/// A segment of a clip: a text that shows from one time to another.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Segment {
    /// The text to be translated, with `{meta}`, without white space at its ends. Empty if there is none.
    pub source: String,
    /// Who speaks, if the texts say so: `{speaker: Mara}`.
    pub speaker: Option<String>,
    /// The events.
    pub events: Option<String>,
    /// When it shows, and until when, in milliseconds.
    pub time_ms: Option<(u64, u64)>,
    /// How many characters a screen holds and a player can read in the time.
    pub max_characters: Option<usize>,
}

/// The translation of a clip into one locale.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Translation {
    /// The texts of the segments, as many as the clip has: empty ones are not translated yet.
    pub texts: Vec<String>,
    /// How far the work is.
    pub state: State,
    /// The source texts that it was made from, if they are known and others than those of today.
    pub made_from: Option<Vec<String>>,
}

/// How far the work on a translation is; each state includes those before it. The names are those of XLIFF 2.1.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub enum State {
    /// Not translated, or to be looked at again (*fuzzy*).
    #[default]
    Initial,
    /// Translated.
    Translated,
    /// Translated, and somebody else has read it.
    Reviewed,
    /// Done.
    Final,
}

/// Whether a file of exchange has one text for a clip, with `|` between its segments, or one for each segment.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub enum Division {
    /// One text for each clip: translators see the whole of what is said.
    #[default]
    Clip,
    /// One text for each segment: a `|` can be neither lost nor added.
    Segment,
}

impl State {
    /// All states, in their order.
    pub const ALL: [State; 4] = [State::Initial, State::Translated, State::Reviewed, State::Final];

    /// The name of the state in XLIFF 2.1.
    pub fn name(self) -> &'static str {
        match self {
            State::Initial => "initial",
            State::Translated => "translated",
            State::Reviewed => "reviewed",
            State::Final => "final",
        }
    }

    /// The state with this name.
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
    /// Whether no segment has a text.
    pub fn is_empty(&self) -> bool {
        self.texts.iter().all(String::is_empty)
    }

    /// The source text that the translation of a segment was made from, if it is another one than that of today.
    pub(crate) fn made_from_at(&self, at: usize, source: &str) -> Option<&str> {
        self.made_from.as_ref()?.get(at).map(String::as_str).filter(|made_from| *made_from != source)
    }
}

/// Texts of segments as one, as files with one text for each clip have it: `Mayor? | Mayor!`.
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

/// One row or entry of a file of exchange.
pub(crate) struct Item<'u> {
    pub(crate) unit: &'u Unit,
    /// The number of the segment, from 1; `None` if it is about the whole clip.
    pub(crate) number: Option<usize>,
    /// The segments that it is about, with their numbers from 0.
    pub(crate) segments: Vec<(usize, &'u Segment)>,
}

impl Exchange {
    /// What a file has an entry for: each clip, or each of its segments that has a text.
    pub(crate) fn items(&self, division: Division) -> impl Iterator<Item = Item<'_>> {
        self.units.iter().flat_map(move |unit| {
            let all = || unit.segments.iter().enumerate();
            match division {
                Division::Clip => vec![Item { unit, number: None, segments: all().collect() }],
                // A clip of one segment needs no number.
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

impl Item<'_> {
    /// What names it: the key, and the number of the segment behind a `|`, which no key has.
    pub(crate) fn id(&self) -> String {
        match self.number {
            Some(number) => format!("{}{DELIMITER}{number}", self.unit.key),
            None => self.unit.key.clone(),
        }
    }

    /// The text to be translated.
    pub(crate) fn source(&self) -> String {
        joined(&self.segments.iter().map(|(_, segment)| segment.source.as_str()).collect::<Vec<_>>())
    }

    /// The text of a translation.
    pub(crate) fn text(&self, translation: &Translation) -> String {
        self.of(&translation.texts)
    }

    /// The text that a translation was made from, if it is another one than that of today.
    pub(crate) fn made_from(&self, translation: &Translation) -> Option<String> {
        let made_from = self.of(translation.made_from.as_ref()?);
        (made_from != self.source()).then_some(made_from)
    }

    /// How far a translation is: one that was made from another source is to be looked at again.
    pub(crate) fn state(&self, translation: &Translation) -> State {
        if self.made_from(translation).is_some() { State::Initial } else { translation.state }
    }

    /// The mark of a translation.
    pub(crate) fn mark(&self, translation: &Translation) -> Mark {
        Mark::of(&self.text(translation))
    }

    /// What translators should know, in lines.
    pub(crate) fn comments(&self) -> Vec<String> {
        let mut comments = Vec::new();
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

    /// Where the clip is: its Lipz file, its recording.
    pub(crate) fn paths(&self) -> impl Iterator<Item = &str> {
        [&self.unit.file, &self.unit.recording].into_iter().flatten().map(String::as_str)
    }

    fn of(&self, texts: &[String]) -> String {
        let text = |(number, _): &(usize, &Segment)| texts.get(*number).map_or("", String::as_str);
        joined(&self.segments.iter().map(text).collect::<Vec<_>>())
    }
}

/// Milliseconds as seconds: `1.250`.
pub(crate) fn seconds(ms: u64) -> String {
    format!("{}.{:03}", ms / 1000, ms % 1000)
}
