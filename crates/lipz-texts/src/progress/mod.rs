//! The remaining translation work: segments and words, by progress.

mod html;
mod list;
mod matches;
mod page;

pub use html::{html, html_page};
pub use list::{cost_of, csv_table};
pub use matches::SourceMatch;
pub use page::page;

use crate::exchange::model::{State, Unit, VARIANT_MARK};
use crate::exchange::variants::variant_keys;
use crate::exchange::{ClipSources, ClipTexts, words};
use crate::record::{Standing, TextRecord};
use lipz_file::locale::{is_variant, variant_tag};
use std::collections::BTreeSet;
use std::sync::Arc;

/// The progress of a segment's translation.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Progress {
    /// There is no text.
    Missing,
    /// The source has changed since, or the number of segments differs.
    Stale,
    /// Translated.
    Translated,
    /// Read by a second person.
    Reviewed,
    /// Done.
    Final,
}

/// Segments, and the words of their source texts.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Amount {
    /// The number of segments.
    pub segments: usize,
    /// The number of words in their source texts ([`words`](words())).
    pub words: usize,
}

/// A segment to be translated.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct OpenSegment {
    /// The key of the clip, and that of a variant after `|x-`.
    pub key: String,
    /// The number of the segment, from 1; `None` if it is the only one of its clip.
    pub number: Option<usize>,
    /// The source text.
    pub source: String,
    /// The source text of the translation, if it is known and differs from the current one.
    pub made_from: Option<String>,
    /// The translation; empty if it is missing.
    pub text: String,
}

/// The work in one locale.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct LocaleWork {
    /// The locale.
    pub locale: String,
    amounts: [Amount; 5],
    /// The translated amount whose source texts are unknown, so that it may be stale.
    pub unknown: Amount,
    /// The missing and stale segments, in the order of the clips.
    pub open: Vec<OpenSegment>,
    /// The source texts of the other segments.
    translated: Vec<Arc<str>>,
}

/// The work of a project: translations from one locale into others.
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
    /// The source locale.
    pub source_locale: String,
    /// The locales of the translations.
    pub locales: Vec<LocaleWork>,
}

impl Progress {
    /// All values, the least first.
    pub const ALL: [Progress; 5] =
        [Progress::Missing, Progress::Stale, Progress::Translated, Progress::Reviewed, Progress::Final];

    /// Returns the name: `missing`.
    pub fn name(self) -> &'static str {
        match self {
            Progress::Missing => "missing",
            Progress::Stale => "stale",
            Progress::Translated => "translated",
            Progress::Reviewed => "reviewed",
            Progress::Final => "final",
        }
    }

    /// Whether work remains.
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
    /// Whether a segment has this progress in the translation at index `locale` of
    /// [`Exchange::locales`](crate::Exchange::locales).
    pub fn has(&self, locale: usize, progress: Progress) -> bool {
        let translation = self.translations.get(locale);
        if translation.is_some_and(|translation| translation.is_unneeded) {
            return false;
        }
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
    /// Returns the work of a project without clips.
    pub fn new<T: Into<String>>(source_locale: impl Into<String>, locales: impl IntoIterator<Item = T>) -> Work {
        let of = |locale: T| LocaleWork { locale: locale.into(), ..LocaleWork::default() };
        Work { source_locale: source_locale.into(), locales: locales.into_iter().map(of).collect() }
    }

    /// Adds a clip with its texts and their variants. `file` is the path of its Lipz file in the record.
    pub fn add(&mut self, key: &str, file: &str, texts: &ClipTexts, record: Option<&TextRecord>) {
        let is_needed = vec![true; self.locales.len()];
        let source_locale = self.source_locale.clone();
        let Some(sources) = ClipSources::new(texts, &source_locale) else { return };
        self.add_texts(key, ("", &is_needed), file, (texts, &sources), record);
        if !texts.keys().any(|tag| is_variant(tag)) {
            return;
        }
        let needed: Vec<BTreeSet<String>> =
            self.locales.iter().map(|work| work.needed(&self.source_locale, texts).collect()).collect();
        let all: BTreeSet<&String> = needed.iter().flatten().collect();
        for variant in all {
            let is_needed: Vec<bool> = needed.iter().map(|needed| needed.contains(variant)).collect();
            self.add_texts(
                &format!("{key}{VARIANT_MARK}{variant}"),
                (variant, &is_needed),
                file,
                (texts, &sources),
                record,
            );
        }
    }

    /// Adds the texts of a clip, or those of one of its variants, in the locales that need them.
    fn add_texts(
        &mut self,
        id: &str,
        (variant, is_needed): (&str, &[bool]),
        file: &str,
        (texts, sources): (&ClipTexts, &ClipSources<'_>),
        record: Option<&TextRecord>,
    ) {
        let tag = variant_tag(&self.source_locale, variant);
        let sources = sources.of(&tag);
        let sources = &*sources.texts;
        let counts: Vec<usize> = sources.iter().map(|source| words(source)).collect();
        let shared: Vec<Arc<str>> = sources.iter().map(|source| source.as_str().into()).collect();
        let in_need = self.locales.iter_mut().zip(is_needed).filter(|(_, is_needed)| **is_needed);
        for (work, _) in in_need {
            let locale = variant_tag(&work.locale, variant);
            let own = texts.get(&locale).map_or(&[][..], Vec::as_slice);
            let standings = record.map(|record| record.standings(file, &tag, &locale, sources, own));
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
                    let (key, source, text) = (id.to_owned(), source.clone(), text.to_owned());
                    work.open.push(OpenSegment { key, number, source, made_from, text });
                } else {
                    work.translated.extend(shared.get(at).cloned());
                }
            }
        }
    }

    /// Returns the number of translated segments in all locales, and of those with unknown source texts.
    pub fn unknown(&self) -> (usize, usize) {
        let of = |locale: &LocaleWork| (locale.all().segments - locale.to_do().segments, locale.unknown.segments);
        self.locales.iter().map(of).fold((0, 0), |sum, one| (sum.0 + one.0, sum.1 + one.1))
    }

    /// Adds the clips of `other`, which has the same locales.
    pub fn join(&mut self, other: Work) {
        for (ours, theirs) in self.locales.iter_mut().zip(other.locales) {
            ours.amounts.iter_mut().zip(theirs.amounts).for_each(|(our, their)| our.add(their));
            ours.unknown.add(theirs.unknown);
            ours.open.extend(theirs.open);
            ours.translated.extend(theirs.translated);
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
    /// Returns the variants of a clip that the locale needs.
    fn needed(&self, source_locale: &str, texts: &ClipTexts) -> impl Iterator<Item = String> {
        let keys = variant_keys(texts, source_locale, &self.locale).into_iter();
        keys.filter(|key| key.is_needed).map(|key| key.key)
    }

    /// Returns the amount with this progress.
    pub fn amount(&self, progress: Progress) -> Amount {
        self.amounts[progress as usize]
    }

    /// Returns the total amount.
    pub fn all(&self) -> Amount {
        self.sum(|_| true)
    }

    /// Returns the amount of remaining work.
    pub fn to_do(&self) -> Amount {
        self.sum(Progress::is_open)
    }

    /// Returns the percentage of translated words, truncated to tenths; 100 if there are no words.
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
    /// Returns whether the segment is missing or stale.
    pub fn progress(&self) -> Progress {
        if self.text.is_empty() { Progress::Missing } else { Progress::Stale }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests;
