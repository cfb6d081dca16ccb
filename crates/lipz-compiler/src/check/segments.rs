//! Segment counts: every element has as many segments as `visemes`.

use super::elements::Roles;
use lipz::JsonString;
use lipz::text::{self, DELIMITER};
use lipz::{Code, Diagnostic};
use unicode_width::UnicodeWidthStr;

/// Segments shown side by side; the rest is counted.
const SHOWN: usize = 12;
/// Columns of a segment that are shown.
const WIDTH: usize = 36;

/// The number of segments that the elements agree on, 1 for a clip without segmented elements;
/// reports elements that differ.
pub(super) fn common_count(roles: &Roles<'_>, diagnostics: &mut Vec<Diagnostic>) -> usize {
    let texts = roles.texts.iter().map(|text| (text.name.text.as_ref(), text.string));
    let mut elements = roles
        .visemes
        .map(|visemes| ("visemes", visemes))
        .into_iter()
        .chain(texts)
        .chain(roles.events.map(|events| ("events", events)));
    let Some((reference_name, reference)) = elements.next() else { return 1 };
    let expected = count(reference);
    for (name, string) in elements {
        if count(string) != expected {
            diagnostics.push(mismatch(name, string, reference_name, reference));
        }
    }
    expected
}

fn count(string: &JsonString<'_>) -> usize {
    1 + string.text.bytes().filter(|&byte| byte == DELIMITER as u8).count()
}

fn mismatch(name: &str, string: &JsonString<'_>, reference_name: &str, reference: &JsonString<'_>) -> Diagnostic {
    let (found, expected) = (count(string), count(reference));
    let plural = |count: usize| if count == 1 { "1 segment".to_owned() } else { format!("{count} segments") };
    let headline = format!("`{name}` has {}, `{reference_name}` {expected}", plural(found));
    let mut finding = Diagnostic::at(Code::SegmentCount, string.span(), headline)
        .label(plural(found))
        .also(reference.span(), plural(expected));
    let left = std::iter::once(reference_name.to_owned()).chain(shown(reference)).collect::<Vec<_>>();
    let right = std::iter::once(name.to_owned()).chain(shown(string)).collect::<Vec<_>>();
    let width = left.iter().map(|cell| cell.width()).max().unwrap_or(0);
    for row in 0..left.len().max(right.len()).min(SHOWN + 1) {
        let number = if row == 0 { String::new() } else { row.to_string() };
        let missing = "(none)".to_owned();
        let (a, b) = (left.get(row).unwrap_or(&missing), right.get(row).unwrap_or(&missing));
        let blanks = " ".repeat(width.saturating_sub(a.width()));
        finding = finding.note(format!("{number:>2}  {a}{blanks}  {b}"));
    }
    let hidden = found.max(expected).saturating_sub(SHOWN);
    if hidden > 0 {
        finding = finding.note(format!("{hidden} more segments are not shown"));
    }
    if found < expected && looks_like_damage(&string.text) {
        finding.help(
            "this looks like `l` or `I` used for `|`: files copied from the published specification have this damage",
        )
    } else {
        finding.help("put a `|` into each element where the segments meet")
    }
}

/// The segments of an element as a column of cells.
fn shown(string: &JsonString<'_>) -> impl Iterator<Item = String> {
    text::segments(&string.text).take(SHOWN).map(|range| {
        let segment = text::trim(&string.text[range]);
        let mut cell = String::new();
        for character in segment.chars() {
            if cell.width() >= WIDTH {
                cell.push('…');
                break;
            }
            cell.push(if character.is_control() { '\u{FFFD}' } else { character });
        }
        format!("`{cell}`")
    })
}

/// Whether a text contains what a printed `|` was read as: `l` or `I` before a capital letter, or
/// after white space as the start of a word that is none (`lIt was you!`, `   lpoints butler`).
fn looks_like_damage(text: &str) -> bool {
    let characters: Vec<char> = text.chars().collect();
    characters.windows(3).any(|window| match window {
        [before, 'l' | 'I', after] => {
            (before.is_whitespace() || before.is_ascii_punctuation()) && after.is_ascii_alphabetic() && !is_word(*after)
        }
        _ => false,
    }) || text.starts_with(['l', 'I']) && text.len() > 2 && text[1..].starts_with(|c: char| c.is_ascii_uppercase())
}

/// Whether an English word can go on with this letter after `l` or `I`.
fn is_word(after: char) -> bool {
    matches!(after, 'a' | 'e' | 'i' | 'o' | 'u' | 'y' | 'n' | 't' | 's' | 'f' | 'm' | 'd' | 'l' | 'r')
}
