//! The names of elements that a file lacks.

use super::Offer;
use crate::context;
use crate::document::Document;
use crate::hover::element;
use crate::project::KnownProject;
use lsp_types::CompletionItemKind;
use std::collections::{BTreeSet, HashSet};

/// The characters around the name to be completed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum NameContext {
    /// There is no quote.
    Nothing,
    /// There is a quote before it.
    Quote,
    /// There are quotes on both sides, and a colon after them, so there is a value.
    Colon,
}

/// Returns the characters around the name at byte `at`, and the end of the name or of its quote.
pub(super) fn around(text: &str, at: usize) -> (NameContext, usize) {
    let rest = text.get(at..).unwrap_or_default();
    let length = rest.find(|c: char| !(c.is_alphanumeric() || matches!(c, '_' | '-'))).unwrap_or(rest.len());
    let end = at + length;
    match rest.get(length..).and_then(|behind| behind.strip_prefix('"')) {
        Some(behind) if behind.trim_start().starts_with(':') => (NameContext::Colon, end),
        Some(_) => (NameContext::Quote, end + 1),
        None => (NameContext::Quote, end),
    }
}

/// Returns the names of the format, and of texts in the locales of the project.
pub(super) fn offers(document: &Document, known: &KnownProject, around: NameContext) -> Vec<Offer> {
    let present: HashSet<&str> = context::names(&document.text).into_iter().collect();
    let options = &known.project.settings.options;
    let mut locales: BTreeSet<&str> = known.words.locales.iter().map(String::as_str).collect();
    locales.extend(options.get_locales().into_iter().flatten().map(String::as_str));
    // The project's default locale comes first; `en-us` if no locale is known.
    let first = options.get_default_locale().or((locales.is_empty()).then_some("en-us"));
    let texts = first.into_iter().chain(locales.iter().copied().filter(|tag| Some(*tag) != first));
    let texts = texts.map(|tag| format!("text_{tag}"));
    let names = ["visemes", "viseme_type", "fps", "events", "curves", "phones"].map(str::to_owned);
    let names = names.into_iter().chain(texts).filter(|name| !present.contains(name.as_str()));
    names.map(|name| offer(name, around)).collect()
}

fn offer(name: String, around: NameContext) -> Offer {
    let value = match name.as_str() {
        "fps" => "$0",
        "curves" => "{ $0 }",
        _ => "\"$0\"",
    };
    let text = match around {
        NameContext::Nothing => format!("\"{name}\": {value}"),
        NameContext::Quote => format!("{name}\": {value}"),
        NameContext::Colon => name.clone(),
    };
    let (title, about) = element::about(&name).unwrap_or_default();
    Offer { text, about: about.to_owned(), ..Offer::new(name, title, CompletionItemKind::PROPERTY) }
}

#[cfg(test)]
mod tests {
    use super::super::tests::at;
    use crate::project::KnownProject;
    use lipz_compiler::Options;

    #[test]
    fn elements_that_are_missing_are_offered() {
        let mut known = KnownProject::default();
        let (labels, first) = at("{ §", &known);
        assert_eq!(labels, ["visemes", "viseme_type", "fps", "events", "curves", "phones", "text_en-us"]);
        assert_eq!(first, "{ \"visemes\": \"$0\"");
        known.words.locales = ["de-de", "fr-fr"].map(str::to_owned).into();
        known.project.settings.options = Options::new().default_locale("fr-fr").expect("a locale");
        let (labels, first) = at("{ \"visemes\": \"\", \"fps\": 24,\n\"v§\" \n\"text_de-de\": \"\" }", &known);
        assert_eq!(labels, ["viseme_type", "events", "curves", "phones", "text_fr-fr"]);
        assert_eq!(first, "{ \"visemes\": \"\", \"fps\": 24,\n\"viseme_type\": \"$0\" \n\"text_de-de\": \"\" }");
    }

    #[test]
    fn a_value_that_is_there_stays() {
        let (_, first) = at("{ \"vis§eme\" : \"MA\" }", &KnownProject::default());
        assert_eq!(first, "{ \"visemes\" : \"MA\" }");
    }
}
