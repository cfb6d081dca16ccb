//! Variants of texts: a text for a number, a gender or a form of address, such as `text_pl-pl-x-few`.

use super::elements::TextElement;
use super::trigger::{Check, CheckedClip, Run, Trigger};
use crate::clip::{ClipData, Locales, split_run};
use lipz_diagnostics::{Code, Diagnostic, bound};
use lipz_file::locale::{is_variant, split_variant};
use lipz_layout::U16;

/// The check for variants of texts that do not exist. `clean` leaves all files with variants to the full parser.
pub(super) const CHECKS: &[Check] = &[Check { trigger: Trigger::Unclean, run: Run::Clip(without_text) }];

/// Gives the blank segments of each variant the text that the locale shows in them, so that a reader finds every segment
/// in the variant alone.
pub(super) fn fill_blanks(locales: &Locales, clip: &mut ClipData) {
    for at in 0..clip.texts.len() {
        let text = clip.texts[at];
        let (locale, key) = split_variant(locales.tag(text.locale));
        let is_blank = |clip: &ClipData| (0..clip.starts.len()).any(|segment| clip.is_blank(&text, segment));
        if key.is_none() || !is_blank(clip) {
            continue;
        }
        let Some(base) = clip.texts.iter().find(|base| locales.tag(base.locale) == locale).copied() else { continue };
        let (own, whole) = (segments(clip, &text), segments(clip, &base));
        let filled = own.into_iter().zip(whole).map(|(own, base)| if own.is_empty() { base } else { own });
        let filled: Vec<Vec<u8>> = filled.collect();
        clip.texts[at] = clip.run(text.locale, filled.iter().map(Vec::as_slice));
    }
}

/// Returns the display texts of all segments of a text.
fn segments(clip: &ClipData, text: &crate::clip::ClipText) -> Vec<Vec<u8>> {
    let (texts, ends) = split_run(clip.whole_run(text), clip.starts.len());
    let mut start = 0;
    let of_end = |end: &U16| {
        // Ends are modulo 2¹⁶, and so is the length of a segment.
        let length = usize::from(end.get().wrapping_sub(start as u16));
        let segment = texts.get(start..start + length).unwrap_or_default();
        start += length;
        segment.to_vec()
    };
    ends.iter().map(of_end).collect()
}

/// Reports variants whose locale has no text in the file.
fn without_text(file: &CheckedClip<'_>, diagnostics: &mut Vec<Diagnostic>) {
    let CheckedClip { roles, locales, .. } = *file;
    let tag = |text: &TextElement<'_>| locales.tag(text.locale);
    for text in roles.texts.iter().filter(|text| is_variant(tag(text))) {
        let (locale, _) = split_variant(tag(text));
        if roles.texts.iter().any(|other| tag(other) == locale) {
            continue;
        }
        bound::limit_many(diagnostics);
        let message = format!("`{}` is a variant of `text_{locale}`, which is missing", text.name.text);
        diagnostics.push(
            Diagnostic::at(Code::VariantWithoutText, text.name.span(), message)
                .note("games that do not request the variant show the text of a fallback locale")
                .help(format!("add \"text_{locale}\", the text for all other cases")),
        );
    }
}
