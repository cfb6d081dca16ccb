//! Completion: names of elements and curves, viseme types, rates, the words of events, emotions in texts,
//! and phones.

mod curves;
mod emotions;
mod events;
mod names;
mod phones;

use crate::context::{Context, context};
use crate::document::Document;
use crate::place;
use crate::project::KnownProject;
use lipz_file::locale::text_name;
use lipz_types::VisemeType;
use lsp_types::{
    CompletionItem, CompletionItemKind, CompletionTextEdit, Documentation, InsertTextFormat, MarkupContent, MarkupKind,
    TextEdit,
};
use std::ops::Range;

/// The common frame rates of recordings and films.
const RATES: [&str; 6] = ["24", "25", "30", "60", "23.976", "29.97"];

/// A completion.
struct Offer {
    /// The displayed name.
    label: String,
    /// A short description.
    detail: String,
    /// The documentation, in Markdown.
    about: String,
    kind: CompletionItemKind,
    /// The inserted text, with `$0` at the position of the cursor.
    text: String,
}

impl Offer {
    fn new(label: impl Into<String>, detail: impl Into<String>, kind: CompletionItemKind) -> Offer {
        let label = label.into();
        Offer { text: label.clone(), label, detail: detail.into(), about: String::new(), kind }
    }
}

/// Returns the completions at byte `at`, in the order in which they are offered.
pub(crate) fn complete(
    document: &Document,
    known: &KnownProject,
    at: usize,
    has_snippets: bool,
) -> Vec<CompletionItem> {
    let text = document.text.as_str();
    let (offers, replaced) = match context(text, at) {
        Context::Between => (names::offers(document, known, names::NameContext::Nothing), at..at),
        Context::Name(start) => {
            let (around, end) = names::around(text, at);
            (names::offers(document, known, around), start..end)
        }
        Context::BetweenCurves => (curves::offers(document, known, names::NameContext::Nothing), at..at),
        Context::CurveName(start) => {
            let (around, end) = names::around(text, at);
            (curves::offers(document, known, around), start..end)
        }
        Context::Value("viseme_type") => (quoted(types()), at..at),
        Context::Value("fps") => (rates(), at..at),
        Context::Text("viseme_type", start) => (types(), start..end_of_text(text, at)),
        Context::Text("events", start) => {
            let before = text.get(start..at).unwrap_or_default();
            let word = events::word_around(text, start, at);
            (events::offers(before, known), word)
        }
        Context::Text("phones", start) => {
            let name = phones::name_around(text, start, at);
            (phones::offers(text.get(word_start(text, start, at)..at).unwrap_or_default()), name)
        }
        Context::Text(name, start) if text_name(name).is_some() => {
            let before = text.get(start..at).unwrap_or_default();
            (emotions::in_braces(before, known), emotions::word_around(text, start, at))
        }
        _ => return Vec::new(),
    };
    let item = |(number, offer): (usize, Offer)| item(document, offer, replaced.clone(), number, has_snippets);
    offers.into_iter().enumerate().map(item).collect()
}

fn item(
    document: &Document,
    offer: Offer,
    replaced: Range<usize>,
    number: usize,
    has_snippets: bool,
) -> CompletionItem {
    let range = lsp_types::Range::new(
        place::position(&document.rope, replaced.start),
        place::position(&document.rope, replaced.end),
    );
    let is_snippet = has_snippets && offer.text.contains("$0");
    let new_text = if is_snippet { offer.text } else { offer.text.replace("$0", "") };
    let about = MarkupContent { kind: MarkupKind::Markdown, value: offer.about };
    CompletionItem {
        label: offer.label,
        kind: Some(offer.kind),
        detail: Some(offer.detail),
        documentation: (!about.value.is_empty()).then_some(Documentation::MarkupContent(about)),
        // Editors sort by this text, or else by the label.
        sort_text: Some(format!("{number:05}")),
        // Editors compare this text with all typed characters, including the quote.
        filter_text: document.text.get(replaced).filter(|typed| typed.starts_with('"')).map(str::to_owned),
        insert_text_format: is_snippet.then_some(InsertTextFormat::SNIPPET),
        text_edit: Some(CompletionTextEdit::Edit(TextEdit { range, new_text })),
        ..CompletionItem::default()
    }
}

fn types() -> Vec<Offer> {
    let offer = |kind: VisemeType| {
        let codes = kind.codes().chars().map(String::from).collect::<Vec<_>>().join(" ");
        Offer::new(kind.name(), codes, CompletionItemKind::ENUM_MEMBER)
    };
    VisemeType::ALL.into_iter().map(offer).collect()
}

fn quoted(offers: Vec<Offer>) -> Vec<Offer> {
    offers.into_iter().map(|offer| Offer { text: format!("\"{}\"", offer.text), ..offer }).collect()
}

fn rates() -> Vec<Offer> {
    RATES.into_iter().map(|rate| Offer::new(rate, "frames per second", CompletionItemKind::VALUE)).collect()
}

/// Returns the start of the word that ends at byte `at` of a string that starts at `start`.
fn word_start(text: &str, start: usize, at: usize) -> usize {
    text.get(start..at).and_then(|before| before.rfind(' ')).map_or(start, |space| start + space + 1)
}

/// Returns the end of the string that contains byte `at`: at its quote, or at the end of the line.
fn end_of_text(text: &str, at: usize) -> usize {
    let rest = text.get(at..).unwrap_or_default();
    at + rest.find(['"', '\n', '\r']).unwrap_or(rest.len())
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use lsp_types::Uri;
    use std::str::FromStr;

    /// Returns the labels at `§`, and the file with the first of them.
    pub(super) fn at(text: &str, known: &KnownProject) -> (Vec<String>, String) {
        let at = text.find('§').unwrap();
        let text = text.replace('§', "");
        let document = Document::new(Uri::from_str("untitled:a").unwrap(), 1, text.clone());
        let items = complete(&document, known, at, true);
        let first = items.first().map(|item| match item.text_edit.as_ref().unwrap() {
            CompletionTextEdit::Edit(edit) => {
                let range = place::bytes(&document.rope, edit.range);
                format!("{}{}{}", &text[..range.start], edit.new_text, &text[range.end..])
            }
            CompletionTextEdit::InsertAndReplace(_) => String::new(),
        });
        (items.into_iter().map(|item| item.label).collect(), first.unwrap_or_default())
    }

    #[test]
    fn types_and_rates_are_offered_where_they_stand() {
        let known = KnownProject::default();
        let types = ["blair", "toonboom", "rms"].map(str::to_owned).to_vec();
        assert_eq!(at("{\"viseme_type\": §", &known), (types.clone(), "{\"viseme_type\": \"blair\"".into()));
        assert_eq!(at("{\"viseme_type\": \"to§on\",", &known), (types.clone(), "{\"viseme_type\": \"blair\",".into()));
        assert_eq!(at("{\"viseme_type\": \"§\n}", &known), (types, "{\"viseme_type\": \"blair\n}".into()));
        assert_eq!(at("{\"fps\": §}", &known).1, "{\"fps\": 24}");
        assert_eq!(at("{\"fps\": 2§}", &known).0.len(), 0);
        assert_eq!(at("{\"x\": \"§\"}", &known).0.len(), 0);
    }
}
