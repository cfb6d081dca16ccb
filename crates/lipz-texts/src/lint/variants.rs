//! Variants that a translation lacks.

use super::LocaleText;
use crate::exchange::variants::variant_keys;
use crate::exchange::{ClipTexts, SourceTexts};
use lipz_diagnostics::{Code, Diagnostic};
use lipz_file::locale::{is_variant, variant_tag};

/// Reports the variants that the language of a translation needs, but that the clip lacks, or has only in part.
pub(super) fn check(
    texts: &ClipTexts,
    source_locale: &str,
    translation: &LocaleText<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    if is_variant(&translation.locale) {
        return;
    }
    let needed = variant_keys(texts, source_locale, &translation.locale).into_iter().filter(|key| key.is_needed);
    let is_missing = |tag: &String| {
        let own = texts.get(tag).map_or(&[][..], Vec::as_slice);
        let source = SourceTexts::of(texts, source_locale, tag);
        let sources = source.as_ref().map_or(&[][..], |source| &source.texts);
        let is_blank = |at: usize| own.get(at).is_none_or(String::is_empty);
        sources.iter().enumerate().any(|(at, source)| !source.is_empty() && is_blank(at))
    };
    let tags = needed.map(|key| variant_tag(&translation.locale, &key.key));
    let missing: Vec<String> = tags.filter(is_missing).map(|tag| format!("`text_{tag}`")).collect();
    if !missing.is_empty() {
        let message = format!("the translation lacks {}, which its language needs", missing.join(" and "));
        diagnostics.push(
            Diagnostic::at(Code::VariantMissing, translation.string.span(), message)
                .note("the text has variants, and games show this text in place of a missing one")
                .help("translate the variants; `lipz export texts` lists them"),
        );
    }
}
