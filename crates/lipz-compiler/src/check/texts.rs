//! The display forms of texts, and the checks of texts.

use super::trigger::{Check, CheckedText, CleanFile, Run, Trigger};
use crate::project::Options;
use crate::util::strings::Strings;
use lipz_diagnostics::{Code, Diagnostic};
use lipz_file::JsonString;
use lipz_file::text;
use std::borrow::Cow;

/// The maximum number of diagnostics of one kind per text that are shown in full; the rest are counted.
pub(super) const SHOWN: usize = 3;

/// Fills `displays` with the display texts of all segments.
pub(super) fn display_texts(
    string: &JsonString<'_>,
    options: &Options,
    displays: &mut Strings,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let mut unbalanced = Vec::new();
    let mut nested = Vec::new();
    displays.clear();
    let has_meta = !options.literal_braces && memchr::memchr2(b'{', b'}', string.text.as_bytes()).is_some();
    for range in text::segments(&string.text) {
        if !has_meta {
            displays.push(text::trim(&string.text[range]));
            continue;
        }
        let display = text::display(&string.text[range.clone()]);
        unbalanced.extend(display.unbalanced.iter().map(|at| range.start + at));
        nested.extend(display.nested.iter().map(|at| range.start + at));
        displays.push(&display.text);
    }
    for (index, &at) in unbalanced.iter().take(SHOWN).enumerate() {
        let (brace, partner) = if string.text.as_bytes().get(at) == Some(&b'{') { ('{', '}') } else { ('}', '{') };
        let diagnostic = Diagnostic::at(
            Code::UnbalancedBrace,
            string.span_of(at..at + 1),
            format!("this `{brace}` has no `{partner}` in its segment and is displayed"),
        )
        .help("add the other brace in the same segment; braces enclose meta, which is not displayed");
        diagnostics.push(more(diagnostic, index, unbalanced.len()));
    }
    for (index, &at) in nested.iter().take(SHOWN).enumerate() {
        let diagnostic =
            Diagnostic::at(Code::NestedBraces, string.span_of(at..at + 1), "the meta that starts here contains braces")
                .help("remove the inner braces; everything up to the matching `}` is hidden");
        diagnostics.push(more(diagnostic, index, nested.len()));
    }
}

/// The checks of a text, in the order of their reports.
pub(super) const CHECKS: &[Check] = &[
    // U+0000 can only come from an escape.
    Check { trigger: Trigger::Unclean, run: Run::Text(nul_in_text) },
    Check { trigger: Trigger::File(|file| file.has_blank && shows_nothing(file)), run: Run::Text(nothing_displayed) },
];

fn nul_in_text(text: &CheckedText<'_>, diagnostics: &mut Vec<Diagnostic>) {
    nul(text.string, Code::NulInText, "the text contains", diagnostics);
}

/// Whether nothing is displayed of a text in a file.
fn shows_nothing(file: &CleanFile<'_>) -> bool {
    file.clip.texts.iter().any(|text| file.clip.text_of(text).is_empty())
}

fn nothing_displayed(text: &CheckedText<'_>, diagnostics: &mut Vec<Diagnostic>) {
    let CheckedText { string, options, .. } = *text;
    if text.displays.text().is_empty() {
        let diagnostic = Diagnostic::at(Code::EmptyDisplayText, string.span(), "this text displays nothing");
        diagnostics.push(if options.literal_braces || !string.text.contains('{') {
            diagnostic.help("remove the element so that players see the text of the fallback locale")
        } else {
            diagnostic.note("the whole text is {meta}, which is not displayed")
        });
    }
}

/// Adds the number of hidden diagnostics of the same kind to the last one that is shown.
pub(super) fn more(diagnostic: Diagnostic, index: usize, count: usize) -> Diagnostic {
    match count.saturating_sub(SHOWN) {
        rest if rest > 0 && index + 1 == SHOWN => diagnostic.note(format!("{rest} more in this text are not shown")),
        _ => diagnostic,
    }
}

/// Reports U+0000, at which C programs would stop reading.
pub(super) fn nul(string: &JsonString<'_>, code: Code, what: &str, diagnostics: &mut Vec<Diagnostic>) {
    // JSON does not allow a literal U+0000, so it can only come from an escape.
    if matches!(string.text, Cow::Borrowed(_)) {
        return;
    }
    if let Some(at) = string.text.find('\0') {
        diagnostics.push(
            Diagnostic::at(code, string.span_of(at..at + 1), format!("{what} U+0000"))
                .note("it is kept; programs in C must use the length that comes with every string")
                .help("remove it unless you need it"),
        );
    }
}
