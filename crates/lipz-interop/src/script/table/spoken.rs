//! The parts of a line that are always the same: without the name of its speaker, and without the text that a game
//! inserts.

use super::columns::TableOrigin;

/// Returns the parts of a text around the gaps that a game fills; empty if the whole text is spoken as it is.
pub(super) fn parts(text: &str, origin: TableOrigin) -> Vec<String> {
    let (spoken, gaps) = match origin {
        TableOrigin::YarnSpinner => (without_speaker(text), YARN_GAPS),
        TableOrigin::RenPy => (text, RENPY_GAPS),
        TableOrigin::Other => return Vec::new(),
    };
    let parts = gaps.split(spoken);
    let is_whole = parts.len() == 1 && parts.first().is_some_and(|part| part == text);
    if is_whole { Vec::new() } else { parts }
}

/// Returns a text of Yarn Spinner without the name of its speaker: `Mara: Hello.` is spoken as `Hello.`
pub(super) fn without_speaker(text: &str) -> &str {
    match text.split_once(':') {
        Some((name, spoken)) if !name.trim().is_empty() && !name.ends_with('\\') => spoken.trim_start(),
        _ => text,
    }
}

/// The spelling of the gaps in texts.
struct Gaps {
    /// The brackets around gaps.
    brackets: &'static [(char, char)],
    /// The brackets around tags, in which brackets of gaps have no meaning.
    tags: Option<(char, char)>,
    /// Whether a doubled bracket is displayed as one; otherwise, a backslash marks it.
    is_doubled: bool,
}

/// Expressions, which are numbered in the tables (`{0}`), and markup (`[wave]`, `[plural {0} one="…"]`), which may
/// stand for a text.
const YARN_GAPS: Gaps = Gaps { brackets: &[('{', '}'), ('[', ']')], tags: None, is_doubled: false };
/// Interpolations (`[name!t]`). Text tags (`{b}`) are not displayed.
const RENPY_GAPS: Gaps = Gaps { brackets: &[('[', ']')], tags: Some(('{', '}')), is_doubled: true };

impl Gaps {
    fn split(&self, text: &str) -> Vec<String> {
        let mut parts = vec![String::new()];
        let mut rest = text;
        while let Some(character) = rest.chars().next() {
            let after = rest.get(character.len_utf8()..).unwrap_or_default();
            let bracket = |(open, _): &&(char, char)| *open == character;
            let is_escape =
                |next: char| next == ':' || self.brackets.iter().any(|(open, close)| [*open, *close].contains(&next));
            let (kept, length) = match (self.brackets.iter().find(bracket), self.tags.filter(|tag| tag.0 == character))
            {
                (Some(_), _) if self.is_doubled && after.starts_with(character) => (&rest[..1], 2),
                (Some(pair), _) => match end(rest, *pair) {
                    Some(end) => {
                        parts.push(String::new());
                        ("", end)
                    }
                    None => (rest, rest.len()),
                },
                (None, Some(_)) if self.is_doubled && after.starts_with(character) => (&rest[..1], 2),
                (None, Some(tag)) => {
                    let end = end(rest, tag).unwrap_or(rest.len());
                    (&rest[..end], end)
                }
                (None, None) if character == '\\' && !self.is_doubled && after.starts_with(is_escape) => {
                    (&after[..1], 2)
                }
                (None, None) => (&rest[..character.len_utf8()], character.len_utf8()),
            };
            if let Some(part) = parts.last_mut() {
                part.push_str(kept);
            }
            rest = rest.get(length..).unwrap_or_default();
        }
        parts
    }
}

/// Returns the end of the brackets that a text begins with, which may contain others of their kind.
fn end(text: &str, (open, close): (char, char)) -> Option<usize> {
    let mut depth = 0;
    text.char_indices().find_map(|(at, character)| {
        depth += i32::from(character == open) - i32::from(character == close);
        (depth == 0).then_some(at + character.len_utf8())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn gaps_are_those_of_each_tool() {
        let renpy = |text| parts(text, TableOrigin::RenPy);
        assert_eq!(renpy("Hello, Otto."), [""; 0]);
        assert_eq!(renpy("Hello, [name!t]."), ["Hello, ", "."]);
        assert_eq!(renpy("[items[0].name] and {size=[big]}[b]{/size}"), ["", " and {size=[big]}", "{/size}"]);
        assert_eq!(renpy("Press [[Esc]."), ["Press [Esc]."]);
        assert_eq!(renpy("An open [name"), [""; 0]);
        assert_eq!(renpy("{{ [name] }}"), ["{ ", " }}"], "a doubled brace is displayed as one");
        assert!(renpy(&"{a".repeat(100_000)).is_empty(), "in linear time");
        let yarn = |text| parts(text, TableOrigin::YarnSpinner);
        assert_eq!(yarn("Hello."), [""; 0]);
        assert_eq!(yarn("Mara: Hello, {0}. [wave]Hi![/wave]"), ["Hello, ", ". ", "Hi!", ""]);
        assert_eq!(yarn("At 10\\:30 I say \\[hi\\]."), ["At 10:30 I say [hi]."]);
        assert_eq!(parts("Mara: [name]", TableOrigin::Other), [""; 0]);
    }

    proptest! {
        #[test]
        fn dividing_any_text_keeps_no_more_than_the_text(text in "[a\\\\\\[\\]{}:é]{0,12}") {
            for origin in [TableOrigin::YarnSpinner, TableOrigin::RenPy] {
                let kept: usize = parts(&text, origin).iter().map(String::len).sum();
                prop_assert!(kept <= text.len());
            }
        }
    }
}
