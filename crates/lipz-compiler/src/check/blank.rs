//! Segments in which a translation shows nothing, although the default locale does.

use super::elements::{Roles, TextElement};
use super::texts::{SHOWN, more};
use crate::Options;
use crate::clip::{ClipData, ClipText, Locales};
use lipz_diagnostics::{Code, Diagnostic, Span, bound};
use lipz_file::text;

/// Reports the segments of the texts of a clip that are blank, where the text of the default locale is not. Texts that
/// display nothing at all are reported as such, and those with another number of segments have none to compare.
pub(super) fn report(
    roles: &Roles<'_>,
    clip: &ClipData,
    options: &Options,
    locales: &Locales,
    diagnostics: &mut Vec<Diagnostic>,
) {
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
            let message = format!("segment {} of `{name}` shows nothing, but `{default_name}` does", segment + 1);
            let diagnostic = Diagnostic::at(Code::BlankSegment, span(element, segment, false), message)
                .also(span(spoken, segment, true), "players of the default locale see this")
                .help("translate it, or move a part of the text here from the segment before or behind");
            diagnostics.push(more(diagnostic, index, silent.len()));
        }
    }
}

/// Whether an element has as many segments as the clip.
fn has(text: &TextElement<'_>, count: usize) -> bool {
    text::segment_count(&text.string.text) == count
}

/// The display texts of an element, which are in the order of their tags.
fn run<'c>(clip: &'c ClipData, text: &TextElement<'_>, locales: &Locales) -> Option<&'c ClipText> {
    let tag = locales.tag(text.locale);
    let at = clip.texts.binary_search_by(|run| locales.tag(run.locale).cmp(tag)).ok()?;
    clip.texts.get(at)
}

/// Where a segment is in the file, without the white space around it if it `is_text`.
fn span(text: &TextElement<'_>, segment: usize, is_text: bool) -> Span {
    let string = text.string;
    let Some(range) = text::segments(&string.text).nth(segment) else { return string.span() };
    let whole = &string.text[range.clone()];
    let shown = if is_text { text::trim(whole) } else { whole };
    let start = range.start + (shown.as_ptr() as usize - whole.as_ptr() as usize);
    string.span_of(start..start + shown.len())
}
