//! The results of readers: texts, their clips, and their positions in the file.

use crate::exchange::model::VARIANT_MARK;
use crate::exchange::{Mark, State};
use crate::plural::join_category;
use lipz_diagnostics::{Code, Diagnostic, Span, escape};
use lipz_file::locale::{canonical_tag, has_lipz_shape, is_variant_key, language, split_variant, variant_tag};
use lipz_file::text::DELIMITER;
use std::sync::Arc;

/// A text of a file, and its position.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Words {
    /// The text.
    pub text: String,
    /// Its position in [`IncomingFile::text`].
    pub span: Span,
}

/// The translation of a clip, or of one of its segments, into one locale.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct Entry {
    /// The key of the clip, and its position in the file. Adjacent locales and segments share it.
    pub key: Arc<Words>,
    /// The number of the segment, from 1; `None` if the texts are those of the whole clip, with `|` between segments.
    pub segment: Option<usize>,
    /// The number of segments of the clip, if the file states it.
    pub segment_count: Option<usize>,
    /// The source text of the translation, if the file contains it. All locales share it.
    pub source: Option<Arc<Words>>,
    /// The mark of the source text, if the file has only that.
    pub source_mark: Option<Mark>,
    /// The locale of the translation.
    pub locale: Arc<str>,
    /// The translation; empty if it is missing.
    pub text: Words,
    /// The state of the work.
    pub state: State,
    /// Whether the file states it. Otherwise a text counts as translated.
    pub says_state: bool,
    /// The translation at the time of the export.
    pub mark: Option<Mark>,
    /// The comments of translators on the clip, one line each.
    pub comments: Vec<String>,
    /// The mark of these comments at the time of the export, if there were any.
    pub comments_mark: Option<Mark>,
    /// Whether it comes from a table. Programs that save tables change line ends inside cells.
    pub is_of_table: bool,
    /// A number for callers that read several files; [`read()`](crate::read()) sets 0.
    pub file: usize,
}

/// The take of a line that a director chose, from a recording script.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct ChosenTake {
    /// The key of the clip, and its position in the file.
    pub key: Arc<Words>,
    /// The locales of the columns with translations, one of which is spoken; none if the script has only source texts.
    pub locales: Arc<[Arc<str>]>,
    /// The number of the take, or the name of its file.
    pub name: Words,
}

/// The result of reading a file.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct IncomingFile {
    /// The text of the file, to which positions refer. A spreadsheet becomes a line per row.
    pub text: String,
    /// The entries, ordered by position; empty if a diagnostic is an error, or if [only takes are
    /// wanted](ReadOptions::takes). A row of a table has no entry for locales without text, mark and comments, but a row
    /// without any of these has an entry for its first locale.
    pub entries: Vec<Entry>,
    /// The chosen takes of a recording script.
    pub takes: Vec<ChosenTake>,
    /// The diagnostics of the file.
    pub diagnostics: Vec<Diagnostic>,
}

/// The parts of a project's settings that readers need.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct ReadOptions {
    /// The source locale. A column of this locale has the source texts.
    pub source_locale: String,
    /// The wanted locales; empty for all. If there is only one, files that name no locale are in it.
    pub wanted: Vec<String>,
    /// The locales of the project, which files may name without a country.
    pub known: Vec<String>,
    /// Whether locales may be any BCP 47 tag, rather than only `ll-cc`.
    pub has_extended_locales: bool,
    /// Whether only the chosen takes of recording scripts are wanted, and no texts.
    pub wants_takes: bool,
}

/// The reason why a tag is not a locale of a project.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum NoLocale {
    /// It is not a tag, or matches several locales.
    Tag,
    /// It does not have the form `ll-cc`.
    Shape,
}

impl NoLocale {
    pub(crate) const NOTE: &str = "the locales of this project have the form ll-cc, a language and a country";
    pub(crate) const HELP: &str =
        "name the intended locale with `--locale fr-fr`, or accept any BCP 47 tag with `extended-locales = true`";

    /// Returns the diagnostic for a tag at a position.
    pub(crate) fn diagnostic(self, tag: &str, span: Span) -> Diagnostic {
        let message = format!("the language {} is not a locale of the project", escape::quoted(tag));
        let diagnostic = Diagnostic::at(Code::ExchangeSyntax, span, message);
        match self {
            NoLocale::Tag => diagnostic.help("name the locale of the file with `--locale`, as in de-de"),
            NoLocale::Shape => diagnostic.note(NoLocale::NOTE).help(NoLocale::HELP),
        }
    }
}

impl ReadOptions {
    /// Returns the options for a project with this source locale.
    pub fn new(source_locale: impl Into<String>) -> ReadOptions {
        ReadOptions { source_locale: source_locale.into(), ..ReadOptions::default() }
    }

    /// Sets the wanted locales.
    #[must_use]
    pub fn wanted<T: Into<String>>(self, locales: impl IntoIterator<Item = T>) -> ReadOptions {
        ReadOptions { wanted: locales.into_iter().map(Into::into).collect(), ..self }
    }

    /// Sets the locales of the project.
    #[must_use]
    pub fn known<T: Into<String>>(self, locales: impl IntoIterator<Item = T>) -> ReadOptions {
        ReadOptions { known: locales.into_iter().map(Into::into).collect(), ..self }
    }

    /// Sets whether locales may be any BCP 47 tag.
    #[must_use]
    pub fn extended_locales(self, has_extended_locales: bool) -> ReadOptions {
        ReadOptions { has_extended_locales, ..self }
    }

    /// Sets whether only the chosen takes of recording scripts are wanted.
    #[must_use]
    pub fn takes(self, wants_takes: bool) -> ReadOptions {
        ReadOptions { wants_takes, ..self }
    }

    /// Whether the texts of a locale are wanted.
    pub(crate) fn wants(&self, locale: &str) -> bool {
        let (locale, _) = split_variant(locale);
        !self.wants_takes
            && locale != self.source_locale
            && (self.wanted.is_empty() || self.wanted.iter().any(|wanted| wanted == locale))
    }

    /// Returns the locale for a tag in a file: `de_DE`, `de-DE`, or `de` if only one locale is German.
    pub(crate) fn locale(&self, tag: &str) -> Result<String, NoLocale> {
        let locale = self.meant(tag).ok_or(NoLocale::Tag)?;
        let is_allowed = self.has_extended_locales || has_lipz_shape(&locale);
        is_allowed.then_some(locale).ok_or(NoLocale::Shape)
    }

    /// Returns the locale in any form; `None` if the tag is invalid or ambiguous.
    fn meant(&self, tag: &str) -> Option<String> {
        // gettext uses `sr_RS@latin` and `de_DE.UTF-8`.
        let tag = tag.split(['@', '.']).next().unwrap_or(tag).trim();
        let canonical = canonical_tag(tag, true)?;
        let all = || self.wanted.iter().chain(&self.known).chain([&self.source_locale]);
        if canonical.contains('-') || all().any(|known| *known == canonical) {
            return Some(canonical);
        }
        let is_alike = |known: &&String| language(known) == canonical;
        let mut alike: Vec<&String> = self.wanted.iter().filter(is_alike).collect();
        if alike.is_empty() {
            alike = all().filter(is_alike).collect();
        }
        alike.sort_unstable();
        alike.dedup();
        match alike.as_slice() {
            [only] => Some((*only).clone()),
            [] => Some(canonical),
            _ => None,
        }
    }
}

impl Entry {
    /// Moves the key of a variant from the ID of the clip to the locale.
    pub(crate) fn find_variant(&mut self) {
        let Some((key, variant)) = self.key.text.rsplit_once(VARIANT_MARK) else { return };
        if is_variant_key(variant) {
            self.locale = variant_tag(&self.locale, variant).into();
            self.key = Words { text: key.to_owned(), span: self.key.span }.into();
        }
    }

    /// Makes the entry that of the variant with this plural category, or leaves it unchanged for `""`.
    pub(crate) fn add_category(&mut self, category: &str) {
        let (locale, rest) = split_variant(&self.locale);
        let key = join_category(category, rest.unwrap_or(""));
        self.locale = variant_tag(locale, &key).into();
    }
}

/// Splits an ID into the key, and the number of the segment after its `|`.
pub(crate) fn id(id: &str) -> (&str, Option<usize>) {
    let numbered = id.rsplit_once(DELIMITER).and_then(|(key, number)| Some((key, number.parse().ok()?)));
    numbered.filter(|(_, number)| *number > 0).map_or((id, None), |(key, number)| (key, Some(number)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tags_of_all_tools() {
        let options = ReadOptions::new("en-us").known(["de-de", "pt-br", "pt-pt"]);
        let of = |tag: &str| options.locale(tag);
        let is = |tag: &str| Ok(tag.to_owned());
        assert_eq!(of("de_DE.UTF-8"), is("de-de"));
        assert_eq!(of("de-DE"), is("de-de"));
        assert_eq!(of("de"), is("de-de"));
        assert_eq!(of("EN"), is("en-us"));
        assert_eq!(of("pt"), Err(NoLocale::Tag), "which one?");
        assert_eq!(options.clone().wanted(["pt-br"]).locale("pt"), is("pt-br"));
        assert_eq!(of("fr-ca"), is("fr-ca"), "a new one");
        assert_eq!(of("Speaker"), Err(NoLocale::Tag));
        assert_eq!([of("fr"), of("es-419")], [Err(NoLocale::Shape), Err(NoLocale::Shape)], "`lipz check` says LZ0503");
        let extended = options.clone().extended_locales(true);
        assert_eq!([extended.locale("fr"), extended.locale("es-419")], [is("fr"), is("es-419")]);
        assert_eq!(options.clone().wanted(["fr-fr"]).locale("fr"), is("fr-fr"));
    }

    #[test]
    fn ids_have_a_key_and_a_number() {
        assert_eq!(id("act1/mayor"), ("act1/mayor", None));
        assert_eq!(id("act1/mayor|2"), ("act1/mayor", Some(2)));
        assert_eq!(id("act1/mayor|0"), ("act1/mayor|0", None));
        assert_eq!(id("act1/mayor|x"), ("act1/mayor|x", None));
    }
}
