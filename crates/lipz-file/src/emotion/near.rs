//! Texts that are almost a blend of emotions: `anger 2,2`, `anger 3 and joy 2`, `anger=3`.

use super::Blend;
use crate::text::is_white_space;
use std::fmt::Write;

/// The probable meaning of a text that is not a blend.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct NearBlend<'t> {
    /// The blend in the correct spelling.
    pub meant: String,
    /// The text after a `,` that is not an emotion: a note.
    pub note: Option<&'t str>,
}

/// Words that people write between emotions.
const AND: [&str; 3] = ["and", "plus", "with"];
/// Words that people write before the time of a change.
const OVER: [&str; 3] = ["over", "in", "within"];
/// Units of that time for seconds.
const SECONDS: [&str; 5] = ["s", "sec", "secs", "second", "seconds"];
const MILLISECONDS: &str = "ms";
/// Signs that people write between emotions and values.
const SIGNS: [char; 7] = ['+', ',', ';', '&', '=', ':', '/'];
/// The maximal number of digits after the decimal point of a value.
const MOST_DIGITS: usize = 3;

impl<'t> NearBlend<'t> {
    /// Returns the probable meaning of a text that is not a [`Blend`] of known emotions. The text must start with the
    /// name of an emotion, followed by a number or a second name.
    ///
    /// ```
    /// use lipz_file::emotion::NearBlend;
    /// let is_known = |name: &str| ["anger", "joy"].contains(&name);
    /// let meant = |text| NearBlend::of(text, is_known).map(|near| near.meant);
    /// assert_eq!(meant("anger 2,2 and joy"), Some("anger 2.2 + joy".to_owned()));
    /// assert_eq!(meant("take 3"), None);
    /// ```
    pub fn of(text: &'t str, is_known: impl Fn(&str) -> bool) -> Option<NearBlend<'t>> {
        let mut rest = Tokens { rest: text }.peekable();
        let mut meant = String::new();
        let (mut names, mut has_number, mut may_have_value, mut is_behind_comma) = (0, false, false, false);
        while let Some(token) = rest.next() {
            // Writing to a string cannot fail.
            let _ = match token {
                Token::Word(word)
                    if OVER.contains(&word) && matches!(rest.peek(), Some(Token::Number(_))) && names > 0 =>
                {
                    let Some(Token::Number(number)) = rest.next() else { return None };
                    let is_unit = |token: &Token<'_>| matches!(token, Token::Word(unit) if is_unit(unit));
                    let is_milli = rest.next_if(is_unit).is_some_and(|unit| unit == Token::Word(MILLISECONDS));
                    (has_number, may_have_value) = (true, false);
                    write!(meant, " over {}{}", decimal(number), if is_milli { MILLISECONDS } else { "s" })
                }
                Token::Word(word) if is_known(word) => {
                    (names, may_have_value) = (names + 1, true);
                    write!(meant, "{}{word}", if names > 1 { " + " } else { "" })
                }
                Token::Word(word) if AND.contains(&word) && names > 0 => Ok(()),
                Token::Word(word) if is_behind_comma && has_number => {
                    let note = text[word.as_ptr() as usize - text.as_ptr() as usize..].trim_matches(is_white_space);
                    return is_blend(&meant).then_some(NearBlend { meant, note: Some(note) });
                }
                Token::Number(number) if may_have_value => {
                    (has_number, may_have_value) = (true, false);
                    write!(meant, " {}", decimal(number))
                }
                Token::Sign(sign) if SIGNS.contains(&sign) && names > 0 => Ok(()),
                _ => return None,
            };
            is_behind_comma = matches!(token, Token::Sign(',' | ';'));
        }
        ((has_number || names > 1) && is_blend(&meant)).then_some(NearBlend { meant, note: None })
    }
}

fn is_unit(word: &str) -> bool {
    SECONDS.contains(&word) || word == MILLISECONDS
}

fn is_blend(text: &str) -> bool {
    Blend::parse(text, 0).is_some()
}

/// Returns a number in lipz's spelling: with a decimal point, a digit before it and at most three after it.
fn decimal(number: &str) -> String {
    let (sign, number) = match number.strip_prefix('-') {
        Some(number) => ("-", number),
        None => ("", number.trim_start_matches('+')),
    };
    match number.split_once(['.', ',']) {
        None => format!("{sign}{number}"),
        Some((whole, digits)) => {
            let whole = if whole.is_empty() { "0" } else { whole };
            format!("{sign}{whole}.{}", &digits[..digits.len().min(MOST_DIGITS)])
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Token<'t> {
    Word(&'t str),
    /// Digits with a sign, a decimal point or a decimal comma.
    Number(&'t str),
    Sign(char),
}

/// The words, numbers and signs of a text.
struct Tokens<'t> {
    rest: &'t str,
}

impl<'t> Iterator for Tokens<'t> {
    type Item = Token<'t>;

    fn next(&mut self) -> Option<Token<'t>> {
        let text = self.rest.trim_start_matches(is_white_space);
        let first = text.chars().next()?;
        let (length, token): (_, fn(&'t str) -> Token<'t>) = match number_length(text) {
            0 if first.is_alphabetic() => {
                let is_end = |c: char| !(c.is_alphabetic() || matches!(c, '-' | '_' | '\'' | '’'));
                (text.find(is_end).unwrap_or(text.len()), Token::Word)
            }
            0 => {
                self.rest = &text[first.len_utf8()..];
                return Some(Token::Sign(first));
            }
            length => (length, Token::Number),
        };
        let (taken, rest) = text.split_at(length);
        self.rest = rest;
        Some(token(taken))
    }
}

/// Returns the length in bytes of the number at the start of a text, or 0.
fn number_length(text: &str) -> usize {
    let digits = |from: usize| text.as_bytes().iter().skip(from).take_while(|byte| byte.is_ascii_digit()).count();
    let sign = usize::from(text.starts_with(['-', '+']));
    let whole = sign + digits(sign);
    let behind = match text.as_bytes().get(whole) {
        Some(b'.' | b',') => digits(whole + 1),
        _ => 0,
    };
    match (whole > sign, behind) {
        (false, 0) => 0,
        (true, 0) => whole,
        (_, behind) => whole + 1 + behind,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(text: &str) -> Option<(String, Option<&str>)> {
        let near = NearBlend::of(text, |name| ["anger", "joy", "calm"].contains(&name))?;
        Some((near.meant, near.note))
    }

    #[test]
    fn slips_of_the_pen() {
        let cases = [
            ("anger 2,2", "anger 2.2"),
            ("anger 2.2345", "anger 2.234"),
            ("anger=3", "anger 3"),
            ("anger: 3", "anger 3"),
            ("anger3", "anger 3"),
            ("anger 3 joy 2", "anger 3 + joy 2"),
            ("anger 3 and joy 2", "anger 3 + joy 2"),
            ("anger 3; joy 2", "anger 3 + joy 2"),
            ("anger and joy", "anger + joy"),
            ("anger 3 over 2", "anger 3 over 2s"),
            ("anger 3, over 1s", "anger 3 over 1s"),
            ("anger 3 over .4s", "anger 3 over 0.4s"),
            ("anger 3 over 0,4s", "anger 3 over 0.4s"),
            ("anger 3 over 0.2 s", "anger 3 over 0.2s"),
            ("anger 3 in 400 ms", "anger 3 over 400ms"),
            ("calm over 2 seconds", "calm over 2s"),
            ("anger +2", "anger 2"),
            ("anger 3 +", "anger 3"),
        ];
        for (text, meant) in cases {
            assert_eq!(near(text), Some((meant.to_owned(), None)), "{text}");
            assert!(is_blend(meant), "{meant}");
        }
        assert_eq!(near("anger 3, a bit louder"), Some(("anger 3".to_owned(), Some("a bit louder"))));
    }

    #[test]
    fn notes_are_left_alone() {
        for text in [
            "",
            "take 3",
            "louder",
            "anger",
            "anger at him",
            "calm 3 times",
            "joy 1 2",
            "to: amy",
            "anger (3)",
            "3 joy",
            "joy 99999999999",
        ] {
            assert_eq!(near(text), None, "{text}");
        }
    }
}
