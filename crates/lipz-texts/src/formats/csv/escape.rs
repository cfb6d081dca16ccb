//! Backslashes in the tables of engines. Godot and Unreal replace escapes in every text.

use std::borrow::Cow;

/// The escapes of both engines, and the characters that they stand for.
const ESCAPES: [(char, char); 10] = [
    ('a', '\u{7}'),
    ('b', '\u{8}'),
    ('f', '\u{c}'),
    ('n', '\n'),
    ('r', '\r'),
    ('t', '\t'),
    ('v', '\u{b}'),
    ('\'', '\''),
    ('"', '"'),
    ('\\', '\\'),
];

/// Returns a text with two backslashes for each.
pub(super) fn escaped(text: &str) -> Cow<'_, str> {
    if text.contains('\\') { Cow::Owned(text.replace('\\', "\\\\")) } else { Cow::Borrowed(text) }
}

/// Returns the text of a cell. Unknown escapes stay as they are.
pub(super) fn unescaped(cell: &str) -> Cow<'_, str> {
    if !cell.contains('\\') {
        return Cow::Borrowed(cell);
    }
    let (mut text, mut rest) = (String::with_capacity(cell.len()), cell.chars());
    while let Some(character) = rest.next() {
        let known = |next: char| ESCAPES.iter().find(|(escape, _)| *escape == next).map(|(_, character)| *character);
        match (character, rest.clone().next().and_then(known)) {
            ('\\', Some(escape)) => {
                text.push(escape);
                rest.next();
            }
            _ => text.push(character),
        }
    }
    Cow::Owned(text)
}

/// Returns the escape that both engines see in a text with an escaped backslash, because they replace one escape after the
/// other: the `\n` in `C:\\new`.
pub(super) fn misread(text: &str) -> Option<String> {
    let others = ESCAPES.iter().filter(|(escape, _)| *escape != '\\');
    others.map(|(escape, _)| format!("\\{escape}")).find(|escape| text.contains(escape))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn escapes_are_those_of_the_engines() {
        assert_eq!(unescaped("a\\nb\\\\c\\q\\"), "a\nb\\c\\q\\");
        assert_eq!((misread("C:\\new"), misread("C:\\x")), (Some("\\n".to_owned()), None));
    }

    proptest! {
        #[test]
        fn every_text_comes_back(text in "[\\\\a-z\n\"']{0,12}") {
            let written = escaped(&text).into_owned();
            prop_assert_eq!(unescaped(&written), text.as_str());
        }
    }
}
