//! Apostrophes and periods that belong to a word, although Unicode excludes them: `'em`, `runnin'`, `a.m.`

use std::ops::Range;

/// Whether the character is an apostrophe, typed or typeset.
pub(super) fn is_apostrophe(c: char) -> bool {
    matches!(c, '\'' | '’')
}

/// Returns the word at `word` of `text`, with the adjacent apostrophes and period that belong to it: those with which
/// it is `known`, and the apostrophe of a dropped g.
pub(super) fn extended(text: &str, word: Range<usize>, known: &dyn Fn(&str) -> bool) -> Range<usize> {
    let before = text.get(..word.start).unwrap_or_default();
    let after = text.get(word.end..).unwrap_or_default();
    let last = before.chars().next_back().filter(|c| is_apostrophe(*c));
    // Excludes an apostrophe that ends another word.
    let last = last.filter(|c| !before[..before.len() - c.len_utf8()].ends_with(char::is_alphanumeric));
    let longer = word.start - last.map_or(0, char::len_utf8);
    let next = after.chars().next();
    let inside = text.get(word.clone()).unwrap_or_default();
    let end = match next {
        Some(c) if is_apostrophe(c) => word.end + c.len_utf8(),
        // A period ends a sentence. In `a.m.` and `A.`, it also ends an abbreviation.
        Some('.') if inside.contains('.') || inside.chars().count() == 1 => word.end + 1,
        _ => word.end,
    };
    let is_known = |range: &Range<usize>| text.get(range.clone()).is_some_and(known);
    let candidates = [longer..end, word.start..end, longer..word.end];
    if let Some(range) = candidates.into_iter().find(|range| *range != word && is_known(range)) {
        return range;
    }
    let dropped =
        end > word.end && next != Some('.') && inside.len() > 4 && inside.to_ascii_lowercase().ends_with("in");
    match dropped {
        true => word.start..end,
        false => word,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_belongs_to_a_word() {
        let known = |word: &str| ["'em", "’em", "a.m.", "y'", "a."].contains(&word);
        let cases = [
            ("get 'em now", "em", "'em"),
            ("get ’em", "em", "’em"),
            ("'hello'", "hello", "hello"),
            ("at 5 a.m. today", "a.m", "a.m."),
            ("Plan a.", "a", "a."),
            ("the end.", "end", "end"),
            ("runnin' away", "runnin", "runnin'"),
            ("the 'thin' man", "thin", "thin"),
        ];
        for (text, word, expected) in cases {
            let start = text.rfind(word).expect("the word");
            assert_eq!(&text[extended(text, start..start + word.len(), &known)], expected, "{text}");
        }
    }
}
