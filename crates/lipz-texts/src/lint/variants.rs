//! Variants that a translation lacks.

use super::LocaleText;
use crate::exchange::variants::variant_keys;
use crate::exchange::{ClipSources, ClipTexts};
use lipz_diagnostics::{Code, Diagnostic};
use lipz_file::locale::{is_variant, variant_tag};

/// Reports the variants that the language of a translation needs, but that the clip lacks, or has only in part.
pub(super) fn check(
    texts: &ClipTexts,
    sources: &ClipSources<'_>,
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
        let sources = sources.of(tag).texts;
        let is_blank = |at: usize| own.get(at).is_none_or(String::is_empty);
        sources.iter().enumerate().any(|(at, source)| !source.is_empty() && is_blank(at))
    };
    let tags = needed.map(|key| variant_tag(&translation.locale, &key.key));
    let missing: Vec<String> = tags.filter(is_missing).map(|tag| format!("`text_{tag}`")).collect();
    if !missing.is_empty() {
        let message = format!("the translation lacks {}, which its language needs", missing.join(", "));
        diagnostics.push(
            Diagnostic::at(Code::VariantMissing, translation.string.span(), message)
                .note("games show the text without a key in place of a missing variant")
                .help("translate the variants; `lipz export texts` lists them"),
        );
    }
}
