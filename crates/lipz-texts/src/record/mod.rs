//! The source text of each translation, in a text file that accompanies the Lipz files and merges in version control.

mod comments;
mod line;
mod merge;
mod moved;
mod sources;
mod standing;
mod unit;
mod untranslated;
mod version;

pub use standing::Standing;

use crate::exchange::Mark;
use crate::exchange::model::{State, joined};
use comments::{CommentLine, Comments};
use line::Line;
use lipz_diagnostics::{Code, Diagnostic, Span};
use merge::merge;
use sources::Sources;
use standing::Fact;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use version::{ApprovedMark, Version};

/// The start of the file, for people.
const HEAD: &str = "\
# lipz texts: the source text that each translation was made from, with the marks of the translations, and comments.
# Keep this file with the Lipz files, and let git merge it by lines: `lipz-texts.txt merge=union` in .gitattributes.
";

/// The source texts of translations. Several lines may refer to the same translation: all of them are true, so merging
/// the lines of two branches yields everything that both have approved. Records with the same content produce the same
/// file.
///
/// ```
/// use lipz_texts::{Standing, State, TextRecord};
/// let mut record = TextRecord::default();
/// record.approve("mara.lipz", "en-us", "de-de", &["Hi."], &["Hallo."], &[Some(State::Translated)]);
/// let standing = |source| record.standings("mara.lipz", "en-us", "de-de", &[source], &["Hallo."]).remove(0);
/// assert_eq!(standing("Hi."), Standing::Current(State::Translated));
/// assert_eq!(standing("Go away!"), Standing::Stale { made_from: "Hi.".into(), is_changed: false });
/// let (again, odd_lines) = TextRecord::parse(&record.to_string()).ok_or("a record")?;
/// assert_eq!((again, odd_lines), (record, Vec::new()));
/// # Ok::<(), &str>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct TextRecord {
    /// By the paths of Lipz files in the record.
    files: BTreeMap<String, Vec<Version>>,
    /// By the same paths, the comments of translators.
    comments: BTreeMap<String, Comments>,
    /// By the same paths, the source texts of clips that have comments, but no translation.
    untranslated: BTreeMap<String, Sources>,
}

impl TextRecord {
    /// Parses a record, and reports invalid lines; `None` if it is a different kind of file.
    pub fn parse(text: &str) -> Option<(TextRecord, Vec<Diagnostic>)> {
        let body = text.strip_prefix('\u{feff}').unwrap_or(text);
        if !body.is_empty() && !body.starts_with("# lipz texts") && !body.starts_with("<<<<<<<") {
            return None;
        }
        let (mut record, mut diagnostics) = (TextRecord::default(), Vec::new());
        let mut start = 0;
        for whole in text.split_inclusive('\n') {
            let content = whole.trim_end_matches(['\n', '\r']).trim_start_matches('\u{feff}');
            match (Line::parse(content), CommentLine::parse(content)) {
                (Some(line), _) => record.add(line),
                (_, Some(line)) => {
                    let of_file = record.comments.entry(line.file.clone()).or_default();
                    line.add_to(of_file);
                }
                _ if content.is_empty() || content.starts_with('#') => {}
                _ => {
                    let diagnostic = Diagnostic::at(
                        Code::TextRecordLine,
                        Span::new(start, start + content.len()),
                        "the line is not a record of a translation",
                    );
                    diagnostics
                        .push(diagnostic.help("remove it; the next import or `lipz approve` writes the file again"));
                }
            }
            start += whole.len();
        }
        lipz_diagnostics::bound::limit(&mut diagnostics);
        record.files.retain(|_, versions| {
            merge(versions);
            !versions.is_empty()
        });
        record.drop_sources();
        Some((record, diagnostics))
    }

    /// Whether the record is empty.
    pub fn is_empty(&self) -> bool {
        self.files.is_empty() && self.comments.is_empty()
    }

    /// Returns the files in the record.
    pub fn files(&self) -> impl Iterator<Item = &str> {
        let only_comments = self.comments.keys().filter(|file| !self.files.contains_key(*file));
        self.files.keys().chain(only_comments).map(String::as_str)
    }

    /// Whether the record contains a file.
    pub fn has(&self, file: &str) -> bool {
        self.files.contains_key(file) || self.comments.contains_key(file)
    }

    /// Returns the source locales of translations.
    pub fn source_locales(&self) -> Vec<&str> {
        let all = self.files.values().flatten().map(Version::locale);
        let mut all: Vec<&str> = all.collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// Returns the source locales of this file's translations.
    pub(crate) fn source_locales_of(&self, file: &str) -> Vec<&str> {
        let versions = self.files.get(file).map_or(&[][..], Vec::as_slice);
        let mut all: Vec<&str> = versions.iter().map(Version::locale).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// Removes a file.
    pub fn forget(&mut self, file: &str) {
        self.files.remove(file);
        self.comments.remove(file);
        self.untranslated.remove(file);
    }

    /// Records that translations were made from the current source texts, for the segments that have a state here.
    /// Information about other segments stays, as far as it concerns the current texts.
    ///
    /// `file` is the path of the Lipz file; `sources` and `texts` are the texts of its segments in both locales.
    pub fn approve<S: AsRef<str>, T: AsRef<str>>(
        &mut self,
        file: &str,
        source_locale: &str,
        locale: &str,
        sources: &[S],
        texts: &[T],
        approved: &[Option<State>],
    ) {
        self.record(file, source_locale, locale, (sources, texts), approved, false);
    }

    /// Like [`approve`](TextRecord::approve), for texts that an import put there if `is_imported`.
    fn record<S: AsRef<str>, T: AsRef<str>>(
        &mut self,
        file: &str,
        source_locale: &str,
        locale: &str,
        (sources, texts): (&[S], &[T]),
        approved: &[Option<State>],
        is_imported: bool,
    ) {
        let facts = self.facts(file, source_locale, locale, sources, texts);
        let mut current = vec![None; sources.len()];
        let mut older: BTreeMap<usize, Vec<(usize, ApprovedMark)>> = BTreeMap::new();
        for (at, (fact, text)) in facts.into_iter().zip(texts).enumerate() {
            let mark = Mark::of(text.as_ref());
            let state = approved.get(at).copied().flatten().filter(|_| !text.as_ref().is_empty());
            let mut keep = |state, is_imported| {
                if let Some(slot) = current.get_mut(at) {
                    *slot = Some(ApprovedMark { mark, state, is_imported });
                }
            };
            match (state, fact) {
                (Some(state), Fact::Current { is_imported: was_imported, .. }) => {
                    keep(state, is_imported || was_imported);
                }
                (Some(state), _) => keep(state, is_imported),
                (None, Fact::Current { state, is_imported, .. }) => keep(state, is_imported),
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
        } else {
            self.untranslated.remove(file);
        }
    }

    fn add(&mut self, line: Line) {
        if line.version.is_untranslated() {
            let source = (line.version.source_locale, line.version.sources);
            self.untranslated.entry(line.file).or_default().insert(source);
            return;
        }
        self.files.entry(line.file).or_default().push(line.version);
    }
}

/// Prints the file: lines for the source texts of each clip and for the comments on it, sorted by path.
impl fmt::Display for TextRecord {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(HEAD)?;
        let files: BTreeSet<&String> = self.files.keys().chain(self.comments.keys()).collect();
        for file in files {
            for version in self.files.get(file).into_iter().flatten() {
                line::write(f, file, version, &joined(&version.sources))?;
            }
            let Some(comments) = self.comments.get(file) else { continue };
            let untranslated = self.untranslated.get(file).into_iter().flatten();
            for (source, locale) in untranslated.filter_map(|source| Some((source, comments.keys().next()?))) {
                sources::write(f, file, source, locale)?;
            }
            comments::write(f, file, comments)?;
        }
        Ok(())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests;
