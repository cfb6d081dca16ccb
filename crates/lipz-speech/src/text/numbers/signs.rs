//! Words for signs: `%`, `€`, `&`. They come from `data/numbers/signs.txt`.

use std::collections::HashMap;
use std::sync::LazyLock;

type Signs = HashMap<&'static str, String>;

static SIGNS: LazyLock<HashMap<&str, Signs>> = LazyLock::new(|| {
    let lines = include_str!("../../../data/numbers/signs.txt").lines().filter(|line| !line.starts_with('#'));
    let line = |line: &'static str| {
        let (code, signs) = line.split_once(' ')?;
        // The sign itself may be a `=`.
        let sign = |entry: &'static str| {
            let at = entry.char_indices().skip(1).find(|(_, c)| *c == '=')?.0;
            Some((entry.get(..at)?, entry.get(at + 1..)?.replace('_', " ")))
        };
        Some((code, signs.split_whitespace().filter_map(sign).collect()))
    };
    lines.filter_map(line).collect()
});

/// Returns the word for a sign alone or next to a number, or `None` if the language does not have one.
pub(super) fn word(code: &str, sign: char, beside_one: bool) -> Option<&'static str> {
    let signs = SIGNS.get(code)?;
    let one = || signs.get(format!("{sign}1").as_str()).filter(|_| beside_one);
    one().or_else(|| signs.get(sign.encode_utf8(&mut [0; 4]) as &str)).map(String::as_str)
}

/// Whether a point begins decimals and a comma groups digits, rather than vice versa.
pub(super) fn has_decimal_point(code: &str) -> bool {
    match SIGNS.get(code) {
        Some(signs) => signs.get(".").is_some_and(|mark| mark == "."),
        // Many languages of Asia and Africa. In Europe and South America, a comma begins decimals.
        None => matches!(
            code,
            "und"
                | "he"
                | "hi"
                | "th"
                | "ms"
                | "fil"
                | "bn"
                | "ta"
                | "ur"
                | "fa"
                | "sw"
                | "am"
                | "my"
                | "km"
                | "cy"
                | "ga"
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_have_words() {
        assert_eq!(word("en", '$', true), Some("dollar"));
        assert_eq!(word("en", '$', false), Some("dollars"));
        assert_eq!(word("es", '%', true), Some("por ciento"));
        assert_eq!(word("de", '=', false), Some("gleich"));
        assert_eq!(word("xx", '%', false), None);
        assert!(has_decimal_point("en") && !has_decimal_point("de"));
    }
}
