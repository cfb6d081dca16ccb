//! Numbers that are missing from a translation, or replaced with different ones.
//!
//! Digits of all scripts are compared, and `1,000`, `1.000` and `1 000` are equal. Numbers in words are not compared.
//! Therefore missing small numbers, which may be written out, and additional numbers are not reported.

use super::numerals::{Number, has_roman, numbers, runs};
use lipz_file::text::display;

/// The greatest integer that is often written out.
const OFTEN_IN_WORDS: u8 = 12;

/// Whether the numbers of all segments together differ. Some move to a different segment with the words around them.
pub(super) fn differ(sources: &[String], texts: &[String]) -> bool {
    if sources.iter().zip(texts).all(|(source, text)| are_same(source, text)) {
        return false;
    }
    !are_same(&sources.join("\n"), &texts.join("\n"))
}

/// Returns the difference between the numbers of a translation and its source; `None` if they are equal or cannot be
/// compared.
pub(super) fn difference(source: &str, text: &str) -> Option<String> {
    if are_same(source, text) {
        return None;
    }
    let (source, text) = (display(source).text, display(text).text);
    let (in_source, in_text) = (numbers(&source), numbers(&text));
    let lost = without(&in_source, &in_text);
    let lost: Vec<&Number> = lost.into_iter().filter(|number| !has_roman(&text, number)).collect();
    let added = without(&in_text, &in_source);
    let list = |numbers: &[&Number]| {
        let spelled: Vec<&str> = numbers.iter().map(|number| number.spelled.as_str()).collect();
        format!("{} {}", if spelled.len() == 1 { "number" } else { "numbers" }, spelled.join(", "))
    };
    match (lost.is_empty(), added.is_empty()) {
        (true, _) => None,
        (false, false) => {
            let lost: Vec<&str> = lost.iter().map(|number| number.spelled.as_str()).collect();
            Some(format!("the translation has the {} instead of {}", list(&added), lost.join(", ")))
        }
        (false, true) => {
            let large: Vec<&Number> = lost.into_iter().filter(|number| !is_small(number)).collect();
            (!large.is_empty()).then(|| format!("the translation lacks the {}", list(&large)))
        }
    }
}

fn is_small(number: &Number) -> bool {
    number.value.parse::<u8>().is_ok_and(|value| value <= OFTEN_IN_WORDS)
}

/// Whether two texts have the same numbers, or at least the same digits in any grouping.
fn are_same(source: &str, text: &str) -> bool {
    let digits = |text: &str| text.bytes().any(|byte| byte.is_ascii_digit() || !byte.is_ascii());
    if !digits(source) && !digits(text) {
        return true;
    }
    let (source, text) = (display(source).text, display(text).text);
    let values = |text: &str| {
        let mut values: Vec<String> = numbers(text).into_iter().map(|number| number.value).collect();
        values.sort_unstable();
        values
    };
    values(&source) == values(&text) || runs(&source) == runs(&text)
}

/// Returns the numbers of `all` that occur less often in `others`.
fn without<'n>(all: &'n [Number], others: &[Number]) -> Vec<&'n Number> {
    let mut counts: std::collections::HashMap<&str, usize> = std::collections::HashMap::new();
    others.iter().for_each(|number| *counts.entry(&number.value).or_default() += 1);
    let is_left = |number: &&Number| match counts.get_mut(number.value.as_str()) {
        Some(count) if *count > 0 => {
            *count -= 1;
            false
        }
        _ => true,
    };
    all.iter().filter(is_left).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_number_in_other_clothes() {
        for (source, text) in [
            ("1,000 men", "1.000 Mann"),
            ("1,000 men", "1 000 hommes"),
            ("1,000 men", "1\u{202f}000 hommes"),
            ("1,00,000", "100.000"),
            ("2.5 miles", "2,50 Meilen"),
            ("25%", "٢٥٪"),
            ("at 12:30", "um 12.30 Uhr"),
            ("in 2019 300 ships", "2019 300 Schiffe"),
            ("the 3rd of May 363", "III. Mai CCCLXIII"),
            ("2 wolves", "zwei Wölfe"),
            ("fifty pieces", "50 Stück"),
            ("{COMMA1} ships", "Schiffe"),
        ] {
            assert_eq!(difference(source, text), None, "{source} / {text}");
        }
    }

    #[test]
    fn other_numbers() {
        let found = |source, text| difference(source, text).unwrap_or_default();
        assert_eq!(found("in 365", "363"), "the translation has the number 363 instead of 365");
        assert_eq!(found("6 or 7", "3 oder 5"), "the translation has the numbers 3, 5 instead of 6, 7");
        assert_eq!(found("25% more", "mehr"), "the translation lacks the number 25");
        assert_eq!(found("2.5", "25"), "the translation has the number 25 instead of 2.5");
        assert_eq!(found("10,000", "1.000"), "the translation has the number 1.000 instead of 10,000");
        assert_eq!(found("15", "٥١"), "the translation has the number ٥١ instead of 15");
    }

    #[test]
    fn numbers_may_move_to_another_segment() {
        let texts = |texts: &[&str]| texts.iter().map(|text| (*text).to_owned()).collect::<Vec<_>>();
        assert!(!differ(&texts(&["by 25%", "then"]), &texts(&["dann", "um 25 %"])));
        assert!(differ(&texts(&["by 25%", "then"]), &texts(&["dann", "um 35 %"])));
    }
}
