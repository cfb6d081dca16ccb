//! What each translation was made from: a text file that belongs to the Lipz files, and that version control merges.

mod line;
mod merge;
mod moved;
mod standing;
mod unit;

pub use moved::Texts;
pub use standing::Standing;

use crate::State;
use crate::{Mark, model::joined};
use line::Line;
use lipz_diagnostics::{Code, Diagnostic, Span};
use merge::merge;
use standing::Fact;
use std::collections::BTreeMap;
use std::fmt;

/// What the file begins with, for people.
const HEAD: &str = "\
# lipz texts: the source text that each translation was made from, with the marks of the translations.
# Keep this file with the Lipz files, and let git merge it by lines: `lipz-texts.txt merge=union` in .gitattributes.
";

/// The source texts that translations were made from. Several lines may say something about the same translation: each of
/// them is true, so the lines of two branches together are what both have accepted. Records that say the same are the same
/// file.
///
/// ```
/// use lipz_texts::{Standing, State, TextRecord};
/// let mut record = TextRecord::default();
/// record.accept("mara.lipz", "en-us", "de-de", &["Hi."], &["Hallo."], &[Some(State::Translated)]);
/// let standing = |source| record.standings("mara.lipz", "en-us", "de-de", &[source], &["Hallo."]).remove(0);
/// assert_eq!(standing("Hi."), Standing::Current(State::Translated));
/// assert_eq!(standing("Go away!"), Standing::Stale { made_from: "Hi.".into(), is_changed: false });
/// let (again, odd_lines) = TextRecord::parse(&record.to_string()).ok_or("a record")?;
/// assert_eq!((again, odd_lines), (record, Vec::new()));
/// # Ok::<(), &str>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct TextRecord {
    /// By the paths of Lipz files, as the record names them.
    files: BTreeMap<String, Vec<Version>>,
}

/// The source texts of a clip at some time, and the translations that were made from them then.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
struct Version {
    source_locale: String,
    /// The texts of its segments.
    sources: Vec<String>,
    /// By locale, what is known of the translation of each segment.
    made: BTreeMap<String, Vec<Option<Made>>>,
}

/// A translation of a segment that somebody has accepted.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Made {
    /// Of its text.
    mark: Mark,
    state: State,
}

impl TextRecord {
    /// Reads a record, and reports lines that say nothing; `None` if it is another file.
    pub fn parse(text: &str) -> Option<(TextRecord, Vec<Diagnostic>)> {
        let body = text.strip_prefix('\u{feff}').unwrap_or(text);
        if !body.is_empty() && !body.starts_with("# lipz texts") && !body.starts_with("<<<<<<<") {
            return None;
        }
        let (mut record, mut diagnostics) = (TextRecord::default(), Vec::new());
        let mut start = 0;
        for whole in text.split_inclusive('\n') {
            let content = whole.trim_end_matches(['\n', '\r']).trim_start_matches('\u{feff}');
            match Line::parse(content) {
                Some(line) => record.add(line),
                None if content.is_empty() || content.starts_with('#') => {}
                None => {
                    let diagnostic = Diagnostic::at(
                        Code::TextRecordLine,
                        Span::new(start, start + content.len()),
                        "the line says nothing about a translation",
                    );
                    diagnostics
                        .push(diagnostic.help("remove it: the next import or `lipz accept` writes the file anew"));
                }
            }
            start += whole.len();
        }
        lipz_diagnostics::bound::limit(&mut diagnostics);
        record.files.retain(|_, versions| {
            merge(versions);
            !versions.is_empty()
        });
        Some((record, diagnostics))
    }

    /// Whether it says nothing.
    pub fn is_empty(&self) -> bool {
        self.files.is_empty()
    }

    /// The files of which it knows something.
    pub fn files(&self) -> impl Iterator<Item = &str> {
        self.files.keys().map(String::as_str)
    }

    /// Whether it knows something of a file.
    pub fn has(&self, file: &str) -> bool {
        self.files.contains_key(file)
    }

    /// The locales of which translations were made.
    pub fn source_locales(&self) -> Vec<&str> {
        let all = self.files.values().flatten().map(|version| version.source_locale.as_str());
        let mut all: Vec<&str> = all.collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// The locales of which translations of this file were made.
    pub(crate) fn source_locales_of(&self, file: &str) -> Vec<&str> {
        let versions = self.files.get(file).map_or(&[][..], Vec::as_slice);
        let mut all: Vec<&str> = versions.iter().map(|version| version.source_locale.as_str()).collect();
        all.dedup(); // versions are sorted by them
        all
    }

    /// Forgets a file.
    pub fn forget(&mut self, file: &str) {
        self.files.remove(file);
    }

    /// Notes that translations were made from the source texts of today: those of the segments that have a state here. What
    /// is known of other segments stays, as far as it is about the texts of today.
    ///
    /// `file` is the path of the Lipz file, `sources` and `texts` are the texts of its segments in both locales.
    pub fn accept<S: AsRef<str>, T: AsRef<str>>(
        &mut self,
        file: &str,
        source_locale: &str,
        locale: &str,
        sources: &[S],
        texts: &[T],
        accepted: &[Option<State>],
    ) {
        let facts = self.facts(file, source_locale, locale, sources, texts);
        let mut current = vec![None; sources.len()];
        let mut older: BTreeMap<usize, Vec<(usize, Made)>> = BTreeMap::new();
        for (at, (fact, text)) in facts.into_iter().zip(texts).enumerate() {
            let mark = Mark::of(text.as_ref());
            let state = accepted.get(at).copied().flatten().filter(|_| !text.as_ref().is_empty());
            match (state, fact) {
                (Some(state), _) | (None, Fact::Current(state)) => {
                    if let Some(slot) = current.get_mut(at) {
                        *slot = Some(Made { mark, state });
                    }
                }
                (None, Fact::Stale { version, segment, made, .. }) => {
                    older.entry(version).or_default().push((segment, made));
                }
                (None, Fact::Unknown) => {}
            }
        }
        let versions = self.files.entry(file.to_owned()).or_default();
        for (at, version) in
            versions.iter_mut().enumerate().filter(|(_, version)| version.source_locale == source_locale)
        {
            version.made.remove(locale);
            for (segment, made) in older.remove(&at).unwrap_or_default() {
                let count = version.sources.len();
                let slots = version.made.entry(locale.to_owned()).or_insert_with(|| vec![None; count]);
                if let Some(slot) = slots.get_mut(segment) {
                    *slot = Some(made);
                }
            }
        }
        if current.iter().any(Option::is_some) {
            versions.push(Version {
                source_locale: source_locale.to_owned(),
                sources: sources.iter().map(|source| source.as_ref().to_owned()).collect(),
                made: [(locale.to_owned(), current)].into(),
            });
        }
        merge(versions);
        if versions.is_empty() {
            self.files.remove(file);
        }
    }

    fn add(&mut self, line: Line) {
        self.files.entry(line.file).or_default().push(line.version);
    }
}

/// The file: a line for the source texts of each clip, in the order of the paths.
impl fmt::Display for TextRecord {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(HEAD)?;
        for (file, versions) in &self.files {
            for version in versions {
                line::write(f, file, version, &joined(&version.sources))?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests;
