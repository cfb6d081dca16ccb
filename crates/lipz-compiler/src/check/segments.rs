//! Segment counts: every element has as many segments as `visemes`.

use super::elements::Roles;
use super::segment_table::side_by_side;
use super::visemes::DELIMITER_LOOKALIKES;
use crate::Options;
use crate::clip::Locales;
use lipz_diagnostics::{Code, Diagnostic, bound};
use lipz_file::JsonString;
use lipz_file::text;

/// An element with its number of segments.
#[derive(Clone, Copy)]
struct Segmented<'d> {
    name: &'d str,
    string: &'d JsonString<'d>,
    count: usize,
}

impl<'d> Segmented<'d> {
    fn new(name: &'d str, string: &'d JsonString<'d>) -> Self {
        let count = text::segment_count(&string.text);
        Segmented { name, string, count }
    }
}

/// Reports the elements that have another number of segments than the clip.
pub(super) fn report_differing(
    roles: &Roles<'_>,
    options: &Options,
    locales: &Locales,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let visemes = roles.visemes.map(|visemes| Segmented::new("visemes", visemes));
    let texts = roles.texts.iter().map(|text| Segmented::new(&text.name.text, text.string));
    let events = roles.events.map(|events| Segmented::new("events", events));
    let all: Vec<Segmented<'_>> = visemes.into_iter().chain(texts).chain(events).collect();
    let Some(string) = roles.reference(options, locales) else { return };
    let (reference, others): (Vec<_>, Vec<_>) = all.into_iter().partition(|one| std::ptr::eq(one.string, string));
    let Some(&reference) = reference.first() else { return };
    report(reference, &others, visemes.is_some(), options.levels.lowers(Code::SegmentCount), diagnostics);
}

/// What becomes of an element that differs, in a project that lowers the diagnostic.
fn joined(what: &str, is_event: bool, count: usize) -> String {
    match (count, is_event) {
        (1, _) => format!("the only segment of the clip gets all of {what}"),
        (_, false) => format!(
            "the first segment gets all of {what}, the others nothing: players see the whole text until the second \
             segment starts, and then none"
        ),
        (_, true) => {
            format!("the first segment gets all of {what}, the others nothing: all of it happens when the clip starts")
        }
    }
}

fn report(
    reference: Segmented<'_>,
    others: &[Segmented<'_>],
    is_visemes: bool,
    is_lowered: bool,
    diagnostics: &mut Vec<Diagnostic>,
) {
    // Delimiters that are reported as foreign codes already.
    let lookalikes = if is_visemes { reference.string.text.matches(DELIMITER_LOOKALIKES).count() } else { 0 };
    let differing = || others.iter().filter(|other| other.count != reference.count);
    let is_explained = |other: &Segmented<'_>| lookalikes > 0 && other.count == reference.count + lookalikes;
    if let ([first, _, ..], true) = (others, is_visemes)
        && others.iter().all(|other| other.count == first.count && damage(other, reference).is_none())
    {
        // All the others agree: one diagnostic, about `visemes`.
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

/// Two elements that differ, with their segments side by side.
fn mismatch(message: String, blamed: Segmented<'_>, reference: Segmented<'_>) -> Diagnostic {
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

/// What an element with too few segments probably has for `|`.
fn damage(element: &Segmented<'_>, reference: Segmented<'_>) -> Option<String> {
    if element.count >= reference.count {
        return None;
    }
    let text = element.string.text.as_ref();
    if let Some(bar) = text.chars().find(|c| !c.is_ascii() && DELIMITER_LOOKALIKES.contains(c)) {
        return Some(format!("this looks like `{bar}` used for `|`"));
    }
    looks_like_printed(text).then(|| {
        "this looks like `l` or `I` used for `|`: files copied from the published specification have this damage".into()
    })
}

/// Whether a text contains what a printed `|` was read as: `l` or `I` before a capital letter, or
/// after white space as the start of a word that is none (`lIt was you!`, `   lpoints butler`).
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
