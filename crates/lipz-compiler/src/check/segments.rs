//! Checks that every element has as many segments as `visemes`.

use super::elements::Roles;
use super::segment_table::side_by_side;
use super::visemes::DELIMITER_LOOKALIKES;
use crate::clip::Locales;
use crate::project::Options;
use lipz_diagnostics::{Code, Diagnostic, bound};
use lipz_file::JsonString;
use lipz_file::text;

/// An element with its number of segments.
#[derive(Clone, Copy)]
struct SegmentedElement<'d> {
    name: &'d str,
    string: &'d JsonString<'d>,
    count: usize,
}

impl<'d> SegmentedElement<'d> {
    fn new(name: &'d str, string: &'d JsonString<'d>) -> Self {
        let count = text::segment_count(&string.text);
        SegmentedElement { name, string, count }
    }
}

/// Reports the elements whose number of segments differs from the clip's.
pub(super) fn report_differing(
    roles: &Roles<'_>,
    options: &Options,
    locales: &Locales,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let visemes = roles.visemes.map(|visemes| SegmentedElement::new("visemes", visemes));
    let texts = roles.texts.iter().map(|text| SegmentedElement::new(&text.name.text, text.string));
    let events = roles.events.map(|events| SegmentedElement::new("events", events));
    let all: Vec<SegmentedElement<'_>> = visemes.into_iter().chain(texts).chain(events).collect();
    let Some(string) = roles.reference(options, locales) else { return };
    let (reference, others): (Vec<_>, Vec<_>) = all.into_iter().partition(|one| std::ptr::eq(one.string, string));
    let Some(&reference) = reference.first() else { return };
    report(reference, &others, visemes.is_some(), options.levels.lowers(Code::SegmentCount), diagnostics);
}

/// Returns the sentence about the segments of a differing element, for a project that lowers the diagnostic.
fn joined(what: &str, is_event: bool, count: usize) -> String {
    match (count, is_event) {
        (1, _) => format!("the only segment of the clip gets all of {what}"),
        (_, false) => format!(
            "the first segment gets all of {what} and the others nothing, so players see the whole text until the \
                second segment starts"
        ),
        (_, true) => {
            format!(
                "the first segment gets all of {what} and the others nothing, so all events happen when the clip starts"
            )
        }
    }
}

fn report(
    reference: SegmentedElement<'_>,
    others: &[SegmentedElement<'_>],
    is_visemes: bool,
    is_lowered: bool,
    diagnostics: &mut Vec<Diagnostic>,
) {
    // Delimiters that have been reported as foreign codes already.
    let lookalikes = if is_visemes { reference.string.text.matches(DELIMITER_LOOKALIKES).count() } else { 0 };
    let differing = || others.iter().filter(|other| other.count != reference.count);
    let is_explained = |other: &SegmentedElement<'_>| lookalikes > 0 && other.count == reference.count + lookalikes;
    if let ([first, _, ..], true) = (others, is_visemes)
        && others.iter().all(|other| other.count == first.count && damage(other, reference).is_none())
    {
        // All other elements agree, so there is only one diagnostic, about `visemes`.
        if !is_explained(first) {
            let message =
                format!("`visemes` has {}, but all other elements have {}", plural(reference.count), first.count);
            let mut diagnostic = mismatch(message, reference, *first);
            if is_lowered {
                diagnostic.notes.push(joined("every other element", false, reference.count));
            }
            diagnostics.push(diagnostic);
        }
        return;
    }
    for other in differing().filter(|other| !is_explained(other)) {
        let message =
            format!("`{}` has {}, but `{}` has {}", other.name, plural(other.count), reference.name, reference.count);
        let mut diagnostic = mismatch(message, *other, reference);
        if is_lowered {
            let name = format!("`{}`", other.name);
            diagnostic.notes.push(joined(&name, other.name == "events", reference.count));
        }
        bound::limit_many(diagnostics);
        diagnostics.push(match damage(other, reference) {
            Some(help) => diagnostic.help(help),
            None => diagnostic,
        });
    }
}

/// Returns the diagnostic for two elements that differ, with a table of their segments.
fn mismatch(message: String, blamed: SegmentedElement<'_>, reference: SegmentedElement<'_>) -> Diagnostic {
    let diagnostic = Diagnostic::at(Code::SegmentCount, blamed.string.span(), message)
        .label(plural(blamed.count))
        .also(reference.string.span(), plural(reference.count))
        .help("put a `|` into each element where the segments meet");
    side_by_side((reference.name, reference.string), (blamed.name, blamed.string))
        .into_iter()
        .fold(diagnostic, Diagnostic::note)
}

fn plural(count: usize) -> String {
    if count == 1 { "1 segment".to_owned() } else { format!("{count} segments") }
}

/// Returns the help about the characters that probably replaced `|` in an element with too few segments.
fn damage(element: &SegmentedElement<'_>, reference: SegmentedElement<'_>) -> Option<String> {
    if element.count >= reference.count {
        return None;
    }
    let text = element.string.text.as_ref();
    if let Some(bar) = text.chars().find(|c| !c.is_ascii() && DELIMITER_LOOKALIKES.contains(c)) {
        return Some(format!("write `|` instead of `{bar}`"));
    }
    looks_like_printed(text).then(|| {
        "write `|` instead of `l` or `I`; files copied from the published specification have this damage".into()
    })
}

/// Whether a text contains a misread printed `|`: `l` or `I` before a capital letter, or after white space at the start
/// of something that is not a word (`lIt was you!`, `   lpoints butler`).
fn looks_like_printed(text: &str) -> bool {
    let starts_word = |before: char| before.is_whitespace() || before.is_ascii_punctuation();
    let mut before = None;
    let mut characters = text.chars().peekable();
    while let Some(character) = characters.next() {
        if let ('l' | 'I', Some(after)) = (character, characters.peek()) {
            let is_damage = match before {
                Some(before) => starts_word(before) && after.is_ascii_alphabetic() && !is_word(*after),
                None => after.is_ascii_uppercase(),
            };
            if is_damage {
                return true;
            }
        }
        before = Some(character);
    }
    false
}

/// Whether an English word can go on with this letter after `l` or `I`.
fn is_word(after: char) -> bool {
    matches!(after, 'a' | 'e' | 'i' | 'o' | 'u' | 'y' | 'n' | 't' | 's' | 'f' | 'm' | 'd' | 'l' | 'r')
}
