//! Merging two changed versions of a Lipz file, element by element and segment by segment.
//!
//! A merge by lines fails where it should not: in canonical layout, one longer text moves the `|` of all elements, so
//! that two translations of the same clip change the same lines.

mod conflict;
mod elements;
mod recording;
mod segments;

use crate::format::{LineEnding, Style, format, rewrite};
use crate::{Document, parse};
use elements::MergedElement;
use std::collections::HashSet;

/// Three versions of a Lipz file, as text.
#[derive(Clone, Copy, Debug)]
pub struct Versions<'s> {
    /// The version that both sides started from; empty if each side created the file.
    pub base: &'s str,
    /// The version of this side, whose order and layout the result keeps, unless the other side was formatted.
    pub ours: &'s str,
    /// The version of the other side.
    pub theirs: &'s str,
}

/// The result of a merge.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct MergedFile {
    /// The text. Each conflict is surrounded by the markers that Git uses.
    pub text: String,
    /// The names of the elements with conflicts.
    pub conflicts: Vec<String>,
}

/// Merges the changes of both sides; `None` if a version is not a Lipz file without errors.
///
/// If only one side has changed, added or deleted an element, the result has that change. If both sides have changed a
/// text or the events, and the clip still has the same number of segments, the segments are merged one by one. All other
/// elements that both sides have changed are conflicts, unless their values are equal. `visemes`, `viseme_type`, `fps`
/// and `phones` are results of the same recording. Therefore, they are a conflict if each side has changed some of them,
/// unless both changed only the visemes of different segments. If the number of segments differs between the sides, each
/// element that the result would have with the old number is a conflict too.
///
/// Spaces that align `|` are not changes. Takes time in proportion to the length of the files.
///
/// ```
/// use lipz_file::merge::{Versions, merge};
/// let base = r#"{ "text_en-us": "Hi|you" }"#;
/// let ours = r#"{ "text_en-us": "Hello|you" }"#;
/// let theirs = r#"{ "text_en-us": "Hi|there", "text_de-de": "Hallo|du" }"#;
/// let merged = merge(Versions { base, ours, theirs }, None).ok_or("three Lipz files")?;
/// assert_eq!(merged.text, r#"{ "text_en-us": "Hello|there", "text_de-de": "Hallo|du" }"#);
/// assert!(merged.conflicts.is_empty());
/// # Ok::<(), &str>(())
/// ```
pub fn merge(versions: Versions<'_>, default_locale: Option<&str>) -> Option<MergedFile> {
    let base = if versions.base.is_empty() { Document::default() } else { document(versions.base)? };
    let (ours, theirs) = (document(versions.ours)?, document(versions.theirs)?);
    let merged = elements::merge(&base, &ours, &theirs);
    let style = Style { default_locale, line_ending: LineEnding::detect(versions.ours) };
    let is_conflict = |element: &&MergedElement<'_>| element.is_conflict();
    let conflicts: Vec<String> = merged.iter().filter(is_conflict).map(|element| element.name.clone()).collect();
    let whole = || elements::document(&merged, MergedElement::ours);
    let text = match conflicts.is_empty() {
        // Formatting is a change too.
        true if is_canonical(versions.theirs, &theirs, style) && !is_canonical(versions.base, &base, style) => {
            format(&whole(), style)
        }
        true => rewrite(versions.ours, &ours, &whole(), style),
        false => conflict::text(&merged, style)?,
    };
    Some(MergedFile { text, conflicts })
}

fn is_canonical(text: &str, document: &Document<'_>, style: Style<'_>) -> bool {
    format(document, Style { line_ending: LineEnding::detect(text), ..style }) == text
}

/// Returns the elements of a file in which every element appears once.
fn document(text: &str) -> Option<Document<'_>> {
    let document = parse(text.as_bytes()).document?;
    let mut names = HashSet::new();
    let is_unique = document.elements.iter().all(|element| names.insert(element.name.text.as_ref()));
    drop(names);
    is_unique.then_some(document)
}

#[cfg(test)]
mod tests {
    use super::*;

    const BASE: &str = r#"{"visemes":"MAEO|EO-","text_en-us":"Good evening|you","events":"bow|nod","fps":24}"#;

    /// A version in canonical layout.
    fn formatted(file: &str) -> String {
        format(&parse(file.as_bytes()).document.unwrap(), Style::default())
    }

    /// Merges the base with two changes of it, each a text and its replacement.
    fn merged(ours: &[(&str, &str)], theirs: &[(&str, &str)]) -> MergedFile {
        let changed = |changes: &[(&str, &str)]| {
            changes.iter().fold(BASE.to_owned(), |file, (old, new)| {
                assert!(file.contains(old), "{old}");
                file.replace(old, new)
            })
        };
        let (ours, theirs) = (changed(ours), changed(theirs));
        let in_lines = merge(Versions { base: BASE, ours: &ours, theirs: &theirs }, None).unwrap();
        let [base, ours, theirs] = [BASE, &ours, &theirs].map(formatted);
        let canonical = merge(Versions { base: &base, ours: &ours, theirs: &theirs }, None).unwrap();
        assert_eq!(canonical.conflicts, in_lines.conflicts);
        if canonical.conflicts.is_empty() {
            assert_eq!(formatted(&in_lines.text), canonical.text);
        } else {
            assert_eq!(in_lines.text, canonical.text);
        }
        in_lines
    }

    fn without_conflict(ours: &[(&str, &str)], theirs: &[(&str, &str)]) -> String {
        let merged = merged(ours, theirs);
        assert_eq!(merged.conflicts, [""; 0], "{}", merged.text);
        merged.text
    }

    #[test]
    fn changes_of_different_elements_are_combined() {
        let german = (r#","events""#, r#","text_de-de":"Guten Abend|Sie","events""#);
        let french = (r#","events""#, r#","text_fr-fr":"Bonsoir|vous","events""#);
        let whole = without_conflict(&[german], &[french, ("24", "12")]);
        assert!(whole.contains(r#""text_de-de":"Guten Abend|Sie","text_fr-fr":"Bonsoir|vous","events""#), "{whole}");
        assert!(whole.contains(r#""fps":12"#), "{whole}");
        let removed = without_conflict(&[(r#""events":"bow|nod","#, "")], &[("Good evening", "Hi")]);
        assert_eq!(removed, r#"{"visemes":"MAEO|EO-","text_en-us":"Hi|you","fps":24}"#);
    }

    #[test]
    fn segments_of_a_text_are_combined() {
        let whole = without_conflict(&[("Good evening", "Hello")], &[("|you", "|there"), ("bow", "wave")]);
        assert_eq!(whole, BASE.replace("Good evening|you", "Hello|there").replace("bow", "wave"));
        let same = without_conflict(&[("Good evening", "Hello")], &[("Good evening", "Hello")]);
        assert_eq!(same, BASE.replace("Good evening", "Hello"));
        let visemes = without_conflict(&[("MAEO", "MAAO")], &[("EO-", "EE-")]);
        assert_eq!(visemes, BASE.replace("MAEO|EO-", "MAAO|EE-"));
    }

    #[test]
    fn changes_of_one_segment_are_a_conflict() {
        let MergedFile { text, conflicts } =
            merged(&[("Good evening", "Hello"), ("nod", "wave")], &[("Good evening", "Hi")]);
        assert_eq!(conflicts, ["text_en-us"]);
        let expected = "{
  \"visemes\" :    \"MAEO |EO-\",
<<<<<<< ours
  \"text_en-us\" : \"Hello|you\",
=======
  \"text_en-us\" : \"Hi   |you\",
>>>>>>> theirs
  \"events\" :     \"bow  |wave\",
  \"fps\" :        24
}
";
        // Each version aligns its own segments.
        let spaces = |text: &str| text.replace(' ', "");
        assert_eq!(spaces(&text), spaces(expected));
        assert_eq!(parse(text.as_bytes()).diagnostics.len(), 1, "{text}");
    }

    #[test]
    fn a_deleted_element_that_was_changed_is_a_conflict() {
        let MergedFile { text, conflicts } = merged(&[(r#""events":"bow|nod","#, "")], &[("bow", "wave")]);
        assert_eq!(conflicts, ["events"]);
        assert!(text.contains("<<<<<<< ours\n=======\n  \"events\""), "{text}");
    }

    /// The visemes, rate and phones of different recordings must not be mixed.
    #[test]
    fn parts_of_two_recordings_are_a_conflict() {
        let again = merged(&[("MAEO", "MMEO")], &[("24", "12")]);
        assert_eq!(again.conflicts, ["visemes", "fps"]);
        let same = merged(&[("MAEO", "MMEO"), ("24", "12")], &[("MAEO", "MMEO"), ("24", "12"), ("you", "there")]);
        assert_eq!(same.conflicts, [""; 0]);
    }

    #[test]
    fn a_text_for_fewer_segments_is_a_conflict() {
        let split = [("MAEO|", "MA|EO|"), ("Good evening", "Good|evening"), ("bow", "bow|")];
        let german = [(r#","events""#, r#","text_de-de":"Guten Abend|Sie","events""#)];
        assert_eq!(merged(&split, &german).conflicts, ["text_de-de"]);
        assert_eq!(merged(&german, &split).conflicts, ["text_de-de"]);
        assert_eq!(merged(&split, &[("24", "12")]).conflicts, ["visemes", "fps"]);
    }

    #[test]
    fn both_sides_may_create_a_file() {
        let (ours, theirs) = (r#"{"text_en-us":"Hi"}"#, r#"{"text_en-us":"Hi","fps":24}"#);
        let merged = merge(Versions { base: "", ours, theirs }, None).unwrap();
        assert_eq!(merged, MergedFile { text: theirs.to_owned(), conflicts: Vec::new() });
    }

    #[test]
    fn formatting_is_kept() {
        let (ours, theirs) = (BASE.replace("Good evening", "Hello"), formatted(BASE));
        let merged = merge(Versions { base: BASE, ours: &ours, theirs: &theirs }, None).unwrap();
        assert_eq!(merged.text, formatted(&ours));
    }

    #[test]
    fn files_with_errors_are_refused() {
        for broken in ["{", r#"{"fps":24,"fps":12}"#, "[]"] {
            assert_eq!(merge(Versions { base: BASE, ours: BASE, theirs: broken }, None), None, "{broken}");
        }
    }
}
