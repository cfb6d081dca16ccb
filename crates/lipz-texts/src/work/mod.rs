//! What is left to translate: segments and words, by how far they are.

mod html;
mod list;
mod page;

pub use html::{html, html_page};
pub use list::{cost_of, csv_table};
pub use page::page;

use crate::{Standing, State, TextRecord, Texts, Unit, words};

/// How far the translation of a segment is.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Progress {
    /// It has no text.
    Missing,
    /// It is older than its source, or has another number of segments.
    Stale,
    /// It is translated.
    Translated,
    /// Somebody else has read it.
    Reviewed,
    /// It is done.
    Final,
}

/// Segments, and the words of their source texts.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Amount {
    /// How many segments.
    pub segments: usize,
    /// How many words their source texts have ([`words`]).
    pub words: usize,
}

/// A segment that is to be translated.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct OpenSegment {
    /// The key of the clip.
    pub key: String,
    /// The number of the segment, from 1; `None` if it is the only one of its clip.
    pub number: Option<usize>,
    /// The source text.
    pub source: String,
    /// The source text that the translation was made from, if that is known and another one.
    pub made_from: Option<String>,
    /// The translation; empty if there is none.
    pub text: String,
}

/// The work in one locale.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct LocaleWork {
    /// The locale.
    pub locale: String,
    amounts: [Amount; 5],
    /// Of what is translated, that of which nobody knows what it was made from: it may be stale.
    pub unknown: Amount,
    /// What is missing or stale, in the order of the clips.
    pub open: Vec<OpenSegment>,
}

/// The work of a project: what is translated from one locale into others.
///
/// ```
/// use lipz_texts::{Progress, Work, texts_of};
/// let clip = br#"{ "text_en-us": "Who goes there?|Halt!", "text_de-de": "Wer da?|" }"#;
/// let clip = lipz_file::parse(clip).document.ok_or("a valid file")?;
/// let mut work = Work::new("en-us", ["de-de", "fr-fr"]);
/// work.add("guard", "guard.lipz", &texts_of(&clip, None), None);
/// let [german, french] = work.locales.as_slice() else { return Err("two locales") };
/// assert_eq!(german.amount(Progress::Translated).words, 3);
/// assert_eq!((german.to_do().words, french.to_do().words), (1, 4));
/// # Ok::<(), &str>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Work {
    /// The locale that is translated.
    pub source_locale: String,
    /// The locales of the translations.
    pub locales: Vec<LocaleWork>,
}

impl Progress {
    /// All of them, the least first.
    pub const ALL: [Progress; 5] =
        [Progress::Missing, Progress::Stale, Progress::Translated, Progress::Reviewed, Progress::Final];

    /// Its name: `missing`.
    pub fn name(self) -> &'static str {
        match self {
            Progress::Missing => "missing",
            Progress::Stale => "stale",
            Progress::Translated => "translated",
            Progress::Reviewed => "reviewed",
            Progress::Final => "final",
        }
    }

    /// Whether it is to be translated.
    pub fn is_open(self) -> bool {
        self <= Progress::Stale
    }
}

impl From<State> for Progress {
    fn from(state: State) -> Progress {
        match state {
            State::Initial => Progress::Stale,
            State::Translated => Progress::Translated,
            State::Reviewed => Progress::Reviewed,
            State::Final => Progress::Final,
        }
    }
}

impl Unit {
    /// Whether a segment of the translation at `locale` of [`Exchange::locales`](crate::Exchange::locales) is so far.
    pub fn has(&self, locale: usize, progress: Progress) -> bool {
        let translation = self.translations.get(locale);
        let mut spoken = self.segments.iter().enumerate().filter(|(_, segment)| !segment.source.is_empty());
        spoken.any(|(at, segment)| {
            let own = match translation {
                Some(translation) if translation.texts.get(at).is_some_and(|text| !text.is_empty()) => {
                    let is_stale = translation.made_from_at(at, &segment.source).is_some();
                    if is_stale { Progress::Stale } else { translation.state.into() }
                }
                _ => Progress::Missing,
            };
            own == progress
        })
    }
}

impl Work {
    /// No clips yet.
    pub fn new<T: Into<String>>(source_locale: impl Into<String>, locales: impl IntoIterator<Item = T>) -> Work {
        let of = |locale: T| LocaleWork { locale: locale.into(), ..LocaleWork::default() };
        Work { source_locale: source_locale.into(), locales: locales.into_iter().map(of).collect() }
    }

    /// Adds a clip with its texts; `file` is what the record calls its Lipz file.
    pub fn add(&mut self, key: &str, file: &str, texts: &Texts, record: Option<&TextRecord>) {
        let Some(sources) = texts.get(&self.source_locale) else { return };
        let counts: Vec<usize> = sources.iter().map(|source| words(source)).collect();
        for work in &mut self.locales {
            let own = texts.get(&work.locale).map_or(&[][..], Vec::as_slice);
            let standings =
                record.map(|record| record.standings(file, &self.source_locale, &work.locale, sources, own));
            for (at, (source, words)) in
                sources.iter().zip(&counts).enumerate().filter(|(_, (text, _))| !text.is_empty())
            {
                let text = own.get(at).map_or("", String::as_str);
                let standing = standings.as_ref().and_then(|standings| standings.get(at));
                let (progress, made_from) = match standing {
                    _ if text.is_empty() => (Progress::Missing, None),
                    _ if own.len() != sources.len() => (Progress::Stale, None),
                    Some(Standing::Stale { made_from, .. }) => (Progress::Stale, Some(made_from.clone())),
                    Some(Standing::Current(state)) => (Progress::from(*state), None),
                    Some(Standing::Unknown) | None => (Progress::Translated, None),
                };
                work.amounts[progress as usize].add(Amount { segments: 1, words: *words });
                if progress == Progress::Translated && matches!(standing, None | Some(Standing::Unknown)) {
                    work.unknown.add(Amount { segments: 1, words: *words });
                }
                if progress.is_open() {
                    let number = (sources.len() > 1).then_some(at + 1);
                    let (key, source, text) = (key.to_owned(), source.clone(), text.to_owned());
                    work.open.push(OpenSegment { key, number, source, made_from, text });
                }
            }
        }
    }

    /// Translated segments of all locales, and those of which nobody knows what they were made from.
    pub fn unknown(&self) -> (usize, usize) {
        let of = |locale: &LocaleWork| (locale.all().segments - locale.to_do().segments, locale.unknown.segments);
        self.locales.iter().map(of).fold((0, 0), |sum, one| (sum.0 + one.0, sum.1 + one.1))
    }

    /// Adds the clips of another one, which is about the same locales.
    pub fn join(&mut self, other: Work) {
        for (ours, theirs) in self.locales.iter_mut().zip(other.locales) {
            ours.amounts.iter_mut().zip(theirs.amounts).for_each(|(our, their)| our.add(their));
            ours.unknown.add(theirs.unknown);
            ours.open.extend(theirs.open);
        }
    }
}

impl Amount {
    fn add(&mut self, other: Amount) {
        self.segments += other.segments;
        self.words += other.words;
    }
}

impl LocaleWork {
    /// What is so far.
    pub fn amount(&self, progress: Progress) -> Amount {
        self.amounts[progress as usize]
    }

    /// All of it.
    pub fn all(&self) -> Amount {
        self.sum(|_| true)
    }

    /// What is to be translated.
    pub fn to_do(&self) -> Amount {
        self.sum(Progress::is_open)
    }

    /// Words that are translated, in percent, cut off behind the tenths; 100 if there are none.
    pub fn percent_in_tenths(&self) -> f64 {
        let (all, to_do) = (self.all().words, self.to_do().words);
        if all == 0 { 100.0 } else { ((all - to_do) as f64 * 1000.0 / all as f64).floor() / 10.0 }
    }

    fn sum(&self, is_meant: impl Fn(Progress) -> bool) -> Amount {
        let meant =
            Progress::ALL.into_iter().filter(|progress| is_meant(*progress)).map(|progress| self.amount(progress));
        meant.fold(Amount::default(), |mut sum, amount| {
            sum.add(amount);
            sum
        })
    }
}

impl OpenSegment {
    /// Whether it has a translation, or none.
    pub fn progress(&self) -> Progress {
        if self.text.is_empty() { Progress::Missing } else { Progress::Stale }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests;
