//! Segments of a translation that show nothing although the text of the default locale does.

use super::elements::TextElement;
use super::texts::{SHOWN, more};
use super::trigger::{Check, CheckedClip, CleanFile, Run, Trigger};
use crate::clip::{ClipData, ClipText, Locales};
use lipz_diagnostics::{Code, Diagnostic, Span, bound};
use lipz_file::text;

/// The check for blank segments of translations.
pub(super) const CHECKS: &[Check] = &[Check { trigger: Trigger::File(may_be_blank), run: Run::Clip(report) }];

/// Whether a text shows nothing in a segment in which the text of the default locale shows something.
fn may_be_blank(file: &CleanFile<'_>) -> bool {
    let CleanFile { clip, locales, options, has_blank, .. } = *file;
    if !has_blank {
        return false;
    }
    let Some(default) = options.default_locale.as_deref().and_then(|tag| locales.get(tag)) else { return false };
    let Some(spoken) = clip.texts.iter().find(|text| text.locale == default) else { return false };
    let is_silent = |text, segment| clip.is_blank(text, segment) && !clip.is_blank(spoken, segment);
    clip.texts.iter().any(|text| (0..clip.starts.len()).any(|segment| is_silent(text, segment)))
}

/// Reports the blank segments of a clip's texts where the text of the default locale is not blank. Texts that are blank
/// as a whole have a report of their own. Texts with a different number of segments cannot be compared.
fn report(file: &CheckedClip<'_>, diagnostics: &mut Vec<Diagnostic>) {
    let CheckedClip { roles, clip, locales, options } = *file;
    let Some(default) = options.default_locale.as_deref().and_then(|tag| locales.get(tag)) else { return };
    let count = clip.starts.len();
    let Some(spoken) = roles.texts.iter().find(|text| text.locale == default && has(text, count)) else { return };
    let Some(spoken_run) = run(clip, spoken, locales) else { return };
    for element in roles.texts.iter().filter(|text| text.locale != default && has(text, count)) {
        let Some(own_run) = run(clip, element, locales).filter(|run| clip.text_bytes(run) > 0) else { continue };
        bound::limit_many(diagnostics);
        let is_silent = |segment: &usize| clip.is_blank(own_run, *segment) && !clip.is_blank(spoken_run, *segment);
        let silent: Vec<usize> = (0..count).filter(is_silent).collect();
        for (index, &segment) in silent.iter().take(SHOWN).enumerate() {
            let (name, default_name) = (&element.name.text, &spoken.name.text);
            let message = format!("segment {} of `{name}` is blank, but not that of `{default_name}`", segment + 1);
            let diagnostic = Diagnostic::at(Code::BlankSegment, span(element, segment, false), message)
                .also(span(spoken, segment, true), "players of the default locale see this")
                .help("translate it, or move a part of the text here from the segment before or after");
            diagnostics.push(more(diagnostic, index, silent.len()));
        }
    }
}

/// Whether an element has as many segments as the clip.
fn has(text: &TextElement<'_>, count: usize) -> bool {
    text::segment_count(&text.string.text) == count
}

/// Returns the display texts of an element. The texts of a clip are sorted by tag.
fn run<'c>(clip: &'c ClipData, text: &TextElement<'_>, locales: &Locales) -> Option<&'c ClipText> {
    let tag = locales.tag(text.locale);
    let at = clip.texts.binary_search_by(|run| locales.tag(run.locale).cmp(tag)).ok()?;
    clip.texts.get(at)
}

/// Returns the position of a segment in the file. If it `is_text`, the surrounding white space is left out.
fn span(text: &TextElement<'_>, segment: usize, is_text: bool) -> Span {
    let string = text.string;
    let Some(range) = text::segments(&string.text).nth(segment) else { return string.span() };
    let whole = &string.text[range.clone()];
    let shown = if is_text { text::trim(whole) } else { whole };
    let start = range.start + (shown.as_ptr() as usize - whole.as_ptr() as usize);
    string.span_of(start..start + shown.len())
}
