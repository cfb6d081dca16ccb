//! Texts: display forms, and what is odd about them.

use crate::Options;
use crate::strings::Strings;
use lipz_diagnostics::{Code, Diagnostic};
use lipz_file::JsonString;
use lipz_file::text;
use std::borrow::Cow;

/// Diagnostics of one kind that one text shows in full; the rest is counted.
pub(super) const SHOWN: usize = 3;

/// Makes `displays` the display texts of all segments.
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
        .help("braces enclose meta information that is not displayed, and end in the segment where they begin");
        diagnostics.push(more(diagnostic, index, unbalanced.len()));
    }
    for (index, &at) in nested.iter().take(SHOWN).enumerate() {
        let diagnostic = Diagnostic::at(
            Code::NestedBraces,
            string.span_of(at..at + 1),
            "the meta information that starts here contains braces",
        )
        .help("everything up to its own `}` is left out of the display");
        diagnostics.push(more(diagnostic, index, nested.len()));
    }
    nul(string, Code::NulInText, "the text contains", diagnostics);
    if displays.text().is_empty() {
        let diagnostic = Diagnostic::at(Code::EmptyDisplayText, string.span(), "nothing of this text is displayed");
        diagnostics.push(if options.literal_braces || !string.text.contains('{') {
            diagnostic.help("leave the element out, so that players see the text of the fallback locale")
        } else {
            diagnostic.note("all of it is {meta}, which the format does not display")
        });
    }
}

/// Says behind the last diagnostic that is shown how many of the kind are not.
pub(super) fn more(diagnostic: Diagnostic, index: usize, count: usize) -> Diagnostic {
    match count.saturating_sub(SHOWN) {
        rest if rest > 0 && index + 1 == SHOWN => diagnostic.note(format!("{rest} more in this text are not shown")),
        _ => diagnostic,
    }
}

/// Reports U+0000, at which programs in C would stop reading.
pub(super) fn nul(string: &JsonString<'_>, code: Code, what: &str, diagnostics: &mut Vec<Diagnostic>) {
    // As it stands, JSON allows no U+0000: only an escape makes one.
    if matches!(string.text, Cow::Borrowed(_)) {
        return;
    }
    if let Some(at) = string.text.find('\0') {
        diagnostics.push(
            Diagnostic::at(code, string.span_of(at..at + 1), format!("{what} U+0000"))
                .note("it is kept; programs in C must use the length that comes with every string")
                .help("remove it unless it is there on purpose"),
        );
    }
}
