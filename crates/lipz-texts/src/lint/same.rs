//! Untranslated texts.

use lipz_file::text::display;

/// The least number of letters, in a script without lower case, that are longer than any name.
const LETTERS: usize = 6;

/// Whether a text that is equal in another language is probably untranslated: it has at least three words, two of which
/// begin in lower case, or six letters in a script without lower case. This excludes names, exclamations, numbers and
/// `OK`.
pub(super) fn is_suspicious(text: &str) -> bool {
    let shown = display(text).text;
    let mut words = shown.split(|character: char| !character.is_alphabetic() && character != '\'' && character != '’');
    let (mut count, mut small) = (0, 0);
    words.by_ref().filter(|word| !word.is_empty()).for_each(|word| {
        count += 1;
        small += usize::from(word.starts_with(char::is_lowercase));
    });
    let has_case = shown.chars().any(|character| character.is_lowercase() || character.is_uppercase());
    match has_case {
        true => count >= 3 && small >= 2,
        false => shown.chars().filter(|character| character.is_alphabetic()).count() >= LETTERS,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sentences_are_and_names_are_not() {
        for text in ["Select filtering criteria", "the end of it", "港に船が着いた", "{name} is not here, is he?"]
        {
            assert!(is_suspicious(text), "{text}");
        }
        for text in ["OK", "Drogan, no!", "Bakewell Cotswald LB-3", "1,000", "...", "{one} {two and three}", "東京都"]
        {
            assert!(!is_suspicious(text), "{text}");
        }
    }
}
