//! Keys: `frame:value`, separated by whitespace.

use crate::JsonString;
use crate::text::is_white_space;
use lipz_diagnostics::{Code, Diagnostic, Span, escape};
use lipz_types::CurveValue;

/// A key of a curve, with its position.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Key {
    /// The frame. The curve has the value at its start.
    pub frame: u32,
    /// The value.
    pub value: CurveValue,
    /// The position of the key in the file.
    pub span: Span,
}

/// The separator of a key's frame and value.
const COLON: char = ':';

/// The most invalid keys of one curve that are reported. With more, the value is probably something else.
const REPORTED: usize = 5;

/// Returns the keys of a curve. Reports invalid keys, and omits them.
pub(super) fn keys(name: &JsonString<'_>, string: &JsonString<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Key> {
    let mut keys: Vec<Key> = Vec::new();
    let mut wrong = 0;
    for word in words(&string.text) {
        let start = word.as_ptr() as usize - string.text.as_ptr() as usize;
        let place = |part: &str| {
            let start = start + (part.as_ptr() as usize - word.as_ptr() as usize);
            string.span_of(start..start + part.len())
        };
        let found = key(word, &place).and_then(|key| match keys.last() {
            Some(before) if before.frame >= key.frame => Err(order(before, &key).into()),
            _ => Ok(key),
        });
        match found {
            Ok(key) => keys.push(key),
            Err(diagnostic) => {
                wrong += 1;
                if wrong <= REPORTED {
                    diagnostics.push(*diagnostic);
                }
            }
        }
    }
    if wrong > REPORTED
        && let Some(last) = diagnostics.last_mut()
    {
        last.notes.push(format!("{} more invalid keys of this curve are not shown", wrong - REPORTED));
    }
    if keys.is_empty() && wrong == 0 {
        let message = format!("the curve {} has no keys", escape::quoted(&name.text));
        diagnostics.push(
            Diagnostic::at(Code::CurveSyntax, string.span(), message)
                .help("write at least one key as frame:value, such as \"0:1\", or remove the curve"),
        );
    }
    keys
}

/// Returns the words of a curve.
pub(super) fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(is_white_space).filter(|word| !word.is_empty())
}

/// Parses a word as a key.
fn key(word: &str, place: &impl Fn(&str) -> Span) -> Result<Key, Box<Diagnostic>> {
    let Some((frame, value)) = word.split_once(COLON) else {
        let message = format!("{} is not a key", escape::quoted(word));
        let help = match word.trim_end_matches(',') {
            "" => "separate keys by spaces: 0:0 12:0.8",
            _ => "write a key as frame:value, such as 12:0.8, without spaces around the colon",
        };
        return Err(Diagnostic::at(Code::CurveSyntax, place(word), message).help(help).into());
    };
    let frame = match frame.parse() {
        Ok(number) if frame.bytes().all(|byte| byte.is_ascii_digit()) => number,
        _ => {
            let message = format!("{} is not a frame number", escape::quoted(frame));
            let marked = if frame.is_empty() { word } else { frame };
            return Err(Diagnostic::at(Code::CurveSyntax, place(marked), message)
                .help("write a whole number; frames count from 0, without `|`: 12:0.8")
                .into());
        }
    };
    match thousandths(value) {
        Ok(thousandths) => Ok(Key { frame, value: CurveValue::from_thousandths(thousandths), span: place(word) }),
        Err(wrong) => Err(wrong.diagnostic(value, place(if value.is_empty() { word } else { value })).into()),
    }
}

/// The problem of a value.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum ValueFault {
    Syntax,
    TooFine,
    TooLarge,
}

impl ValueFault {
    fn diagnostic(self, value: &str, span: Span) -> Diagnostic {
        let value_shown = escape::quoted(value);
        match self {
            ValueFault::Syntax => Diagnostic::at(Code::CurveSyntax, span, format!("{value_shown} is not a number"))
                .help(match value.trim_end_matches(',') {
                    number if number.len() < value.len() && thousandths(number).is_ok() => {
                        "separate keys by spaces only: 0:0 12:0.8"
                    }
                    _ if value.contains(',') => "write a decimal point: 12:0.8",
                    _ => "write a number, such as 1, 0.8 or -0.25",
                }),
            ValueFault::TooFine => {
                let rounded = value.parse().map_or(0.0, |value: f64| (value * 1000.0).round() / 1000.0);
                Diagnostic::at(Code::CurveValue, span, format!("{value_shown} has more than three decimal places"))
                    .note("a bank stores curve values in whole thousandths")
                    .help(format!("write at most three decimal places: {rounded}"))
            }
            ValueFault::TooLarge => Diagnostic::at(Code::CurveValue, span, format!("{value_shown} is too large"))
                .help("write a value from -2147483.648 to 2147483.647"),
        }
    }
}

/// Returns the value in thousandths: a sign, digits, and after a point all digits that are not zero in a thousandth.
pub(crate) fn thousandths(value: &str) -> Result<i32, ValueFault> {
    let (is_negative, size) = match value.strip_prefix('-') {
        Some(size) => (true, size),
        None => (false, value),
    };
    let (whole, behind) = match size.split_once('.') {
        Some((whole, behind)) if !behind.is_empty() => (whole, behind),
        Some(_) => return Err(ValueFault::Syntax),
        None => (size, ""),
    };
    if whole.is_empty() || !whole.bytes().chain(behind.bytes()).all(|byte| byte.is_ascii_digit()) {
        return Err(ValueFault::Syntax);
    }
    let behind = behind.trim_end_matches('0');
    if behind.len() > 3 {
        return Err(ValueFault::TooFine);
    }
    let digits = format!("{}{whole}{behind:0<3}", if is_negative { "-" } else { "" });
    digits.parse().map_err(|_| ValueFault::TooLarge)
}

fn order(before: &Key, key: &Key) -> Diagnostic {
    let (message, help) = if before.frame == key.frame {
        let message = format!("the curve has a second key at frame {}", key.frame);
        (message, "keep one of the two; for a step, put the keys on consecutive frames")
    } else {
        let message = format!("the key at frame {} comes after the key at frame {}", key.frame, before.frame);
        (message, "sort the keys by frame")
    };
    Diagnostic::at(Code::CurveOrder, key.span, message).also(before.span, "the previous key").help(help)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_exact_thousandths() {
        let good =
            [("0", 0), ("-0.05", -50), ("2.2", 2200), ("007", 7000), ("1.2500", 1250), ("-2147483.648", i32::MIN)];
        for (text, expected) in good {
            assert_eq!(thousandths(text), Ok(expected), "{text}");
        }
        for text in ["", "-", ".5", "5.", "1e3", "+1", "1,5", "--1", "１"] {
            assert_eq!(thousandths(text), Err(ValueFault::Syntax), "{text}");
        }
        assert_eq!(thousandths("0.0005"), Err(ValueFault::TooFine));
        assert_eq!(thousandths("2147483.648"), Err(ValueFault::TooLarge));
        assert_eq!(thousandths(&"9".repeat(400)), Err(ValueFault::TooLarge));
    }
}
