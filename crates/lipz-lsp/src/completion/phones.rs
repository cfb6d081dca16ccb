//! The names of phones, with IPA symbols.

use super::Offer;
use lipz_file::text::is_white_space;
use lipz_types::Phone;
use lsp_types::CompletionItemKind;
use std::ops::Range;

/// Returns all phones, if the cursor is in a name. `word` is the text before the cursor in its word.
pub(super) fn offers(word: &str) -> Vec<Offer> {
    // A time follows the name.
    if word.contains('@') {
        return Vec::new();
    }
    let offer = |phone: Phone| {
        let about = if phone == Phone::SILENCE { "silence" } else { phone.ipa() };
        Offer::new(phone.name(), about, CompletionItemKind::ENUM_MEMBER)
    };
    Phone::all().map(offer).collect()
}

/// Returns the name of a phone around byte `at` of a string that starts at `start`.
pub(super) fn name_around(text: &str, start: usize, at: usize) -> Range<usize> {
    let is_outside = |c: char| is_white_space(c) || matches!(c, '@' | '"');
    let before = text.get(start..at).unwrap_or_default();
    let first = before.rfind(is_outside).map_or(start, |found| {
        start + found + before.get(found..).and_then(|rest| rest.chars().next()).map_or(1, char::len_utf8)
    });
    let rest = text.get(at..).unwrap_or_default();
    first..at + rest.find(is_outside).unwrap_or(rest.len())
}

#[cfg(test)]
mod tests {
    use super::super::tests::at;
    use crate::project::KnownProject;

    #[test]
    fn names_are_offered_before_the_time() {
        let offered = |phones: &str| at(&format!("{{\"phones\": \"{phones}\"}}"), &KnownProject::default());
        let (labels, text) = offered("sil@0 D§H@191");
        assert!(labels.contains(&"DH".to_owned()) && labels.contains(&"ø".to_owned()), "{labels:?}");
        assert_eq!(text, "{\"phones\": \"sil@0 sil@191\"}");
        assert_eq!(offered("§").0.len(), offered("sil@0 §").0.len());
        assert!(offered("sil@1§").0.is_empty());
    }
}
