//! Words without quotes or with other quotes, invalid numbers, and other characters in place of the colon.

use super::error_position::{ErrorPosition, WHITE_SPACE};
use super::{Continuation, ExpectedToken, Mistake};
use lipz_diagnostics::{Code, Diagnostic, Span, escape};

/// Quotation marks that are not valid in JSON, and their closing ones.
const QUOTES: [char; 9] = ['\'', '‘', '’', '“', '”', '„', '«', '»', '`'];

pub(super) fn explain(at: &ErrorPosition<'_>, expected: ExpectedToken) -> Option<Mistake> {
    if let Some(mistake) = white_space(at, expected) {
        return Some(mistake);
    }
    match (expected, at.character()?) {
        (ExpectedToken::Value, '−' | '–' | '—') => {
            let shown = at.character().map(escape::numbered).unwrap_or_default();
            let diagnostic = diagnostic(at, format!("{shown} is not a minus sign in JSON"));
            let end = word_end(at, at.character_span().end as usize);
            Some(Continuation::Damaged(end).after(diagnostic.help("delete it, or write `-`")))
        }
        (ExpectedToken::Comma, '/') => fraction(at),
        (ExpectedToken::Name | ExpectedToken::Value, mark) if QUOTES.contains(&mark) => Some(
            quoted(at).after(
                diagnostic(at, "a name or string does not start with a straight double quote")
                    .help("put straight double quotes (\") around the string"),
            ),
        ),
        (ExpectedToken::Colon, '=') => Some(
            Continuation::Taken(at.offset() + 1).after(
                diagnostic(at, "`=` is used instead of a colon")
                    .help("write `:` instead of `=`")
                    .fix(at.character_span(), ":"),
            ),
        ),
        (ExpectedToken::Colon, next) => {
            let (name, _) = at.before()?;
            let end = Span { start: name.end, end: name.end };
            let then = match next {
                '"' | '-' | '0'..='9' | '[' | '{' | 't' | 'f' | 'n' => Continuation::Taken(at.offset()),
                ',' | '}' => Continuation::Damaged(at.offset()),
                _ => Continuation::Lost(at.offset()),
            };
            Some(
                then.after(
                    Diagnostic::at(Code::JsonSyntax, end, "a colon is missing between name and value")
                        .help("write a colon after the name"),
                ),
            )
        }
        (ExpectedToken::Value, '+' | '.') | (ExpectedToken::Number, _) => number(at),
        (ExpectedToken::Name, _) => name(at),
        (ExpectedToken::Comma, next) if !is_word(next) => None,
        (ExpectedToken::Value | ExpectedToken::Word | ExpectedToken::Comma, _) => value(at, expected),
    }
}

fn diagnostic(at: &ErrorPosition<'_>, message: impl Into<String>) -> Diagnostic {
    Diagnostic::at(Code::JsonSyntax, at.character_span(), message)
}

/// Whitespace that is not valid in JSON, and characters without a shape. Both are invisible.
fn white_space(at: &ErrorPosition<'_>, expected: ExpectedToken) -> Option<Mistake> {
    let character = at.character()?;
    let is_odd = |c: char| !WHITE_SPACE.contains(&c) && !c.is_control() && !escape::has_shape(c);
    if !is_odd(character) {
        return None;
    }
    let run = at.rest().trim_start_matches(character);
    let span = at.span_of(at.rest().len() - run.len());
    let message = format!("{} is not whitespace in JSON", escape::code_point(character));
    let diagnostic = Diagnostic::at(Code::JsonSyntax, span, message).help("delete it, or write a space");
    // After a value, it may be part of a text with invalid quotes.
    let is_between = matches!(expected, ExpectedToken::Name | ExpectedToken::Value | ExpectedToken::Colon);
    let blanks = || " ".repeat(at.text_of(span).map_or(1, |run| run.chars().count()));
    Some(match expected {
        ExpectedToken::Word | ExpectedToken::Number => Continuation::Damaged(span.end as usize).after(diagnostic),
        _ => Continuation::Again(span.end as usize).after(if is_between {
            diagnostic.fix(span, blanks())
        } else {
            diagnostic
        }),
    })
}

/// A fraction, `24000/1001`, which is replaced by a decimal number if it is a frame rate.
fn fraction(at: &ErrorPosition<'_>) -> Option<Mistake> {
    let is_digit = |c: char| c.is_ascii_digit();
    let start = at.start().trim_end_matches(WHITE_SPACE);
    let above = start.get(start.trim_end_matches(is_digit).len()..)?;
    let below = at.rest().strip_prefix('/')?.trim_start_matches(WHITE_SPACE);
    let below = below.get(..below.len() - below.trim_start_matches(is_digit).len())?;
    let (numerator, denominator): (u32, u32) = (above.parse().ok()?, below.parse().ok()?);
    let begin = start.len() - above.len();
    let end = below.as_ptr() as usize + below.len() - at.start().as_ptr() as usize;
    let message = format!("`{numerator}/{denominator}` is a fraction, which JSON does not have");
    let diagnostic = Diagnostic::at(Code::JsonSyntax, Span::new(begin, end), message);
    Some(Continuation::Damaged(end).after(match denominator {
        0 => diagnostic.help("write a decimal number: 23.976"),
        _ => {
            diagnostic.help(format!("write it as a decimal number: {}", f64::from(numerator) / f64::from(denominator)))
        }
    }))
}

/// Finds the end of a string between other quotation marks: the first one on the same line after which an element
/// continues or ends.
fn quoted(at: &ErrorPosition<'_>) -> Continuation {
    let lost = Continuation::Lost(at.offset());
    let is_quote = |c: char| c == '"' || QUOTES.contains(&c);
    let begin = at.character_span().end as usize;
    // Lazily, not by the end of the line: with all elements on one line, that end would be searched for from each of
    // them.
    let line = at.rest().char_indices().skip(1).take_while(|(_, c)| !matches!(c, '\n' | '\r'));
    let end = line.filter(|(_, c)| is_quote(*c)).find(|(mark, c)| {
        let behind = at.behind(at.offset() + mark + c.len_utf8()).trim_start_matches([' ', '\t']);
        behind.is_empty() || behind.starts_with([':', '=', ',', '}', ']', '/', '#', '\n', '\r'])
    });
    let Some((end, mark)) = end else { return lost };
    let content = begin..at.offset() + end;
    let behind = content.end + mark.len_utf8();
    // The fix is only certain if nothing needs decoding.
    match at.text_of(Span::new(content.start, content.end)) {
        Some(text) if !text.contains(['\\', '"']) && !text.contains(char::is_control) => {
            Continuation::Bare(content, behind)
        }
        _ => Continuation::Damaged(behind),
    }
}

/// A name without quotes.
fn name(at: &ErrorPosition<'_>) -> Option<Mistake> {
    let (span, name) = at.word(is_word)?;
    let quoted = format!("\"{name}\"");
    let end = word_end(at, at.offset());
    let is_name = at.behind(end).trim_start_matches(WHITE_SPACE).starts_with([':', '=']);
    let then = if is_name { Continuation::Bare(at.offset()..end, end) } else { Continuation::Lost(end) };
    Some(
        then.after(
            Diagnostic::at(Code::JsonSyntax, span, format!("`{name}` has no double quotes"))
                .help(format!("write {quoted}")),
        ),
    )
}

/// A string without quotes, a literal of another language, or a number with its unit.
fn value(at: &ErrorPosition<'_>, expected: ExpectedToken) -> Option<Mistake> {
    let (span, word) = at.word(is_word)?;
    let end = word_end(at, at.offset());
    if expected == ExpectedToken::Comma && span.start == at.character_span().start {
        // It follows a complete value.
        let (_, '0'..='9') = at.before()? else { return None };
        let diagnostic = Diagnostic::at(Code::JsonSyntax, span, "a number is followed by a word");
        return Some(Continuation::Damaged(end).after(diagnostic.help(format!("delete `{word}`"))));
    }
    if word.starts_with(|c: char| c.is_ascii_digit()) {
        return number(at);
    }
    if word.chars().all(char::is_numeric) {
        let diagnostic =
            Diagnostic::at(Code::JsonSyntax, span, format!("`{word}` is not written with the digits 0 to 9"));
        return Some(Continuation::Damaged(end).after(diagnostic.help(match digits(word) {
            Some(digits) => format!("write {digits}"),
            None => "use the digits 0 to 9".to_owned(),
        })));
    }
    if matches!(word, "None" | "nil" | "NULL" | "Null" | "undefined" | "NaN" | "Infinity" | "True" | "False") {
        return Some(
            Continuation::Damaged(end).after(
                Diagnostic::at(Code::JsonSyntax, span, format!("`{word}` is not a JSON value"))
                    .help("write true, false or null, or leave out the element if it has no value"),
            ),
        );
    }
    let after = at.rest().trim_start_matches(is_word).trim_start_matches([' ', '\t']);
    let is_one_word = after.starts_with([',', '}', ']', '\r', '\n']);
    let help = if is_one_word { format!("write \"{word}\"") } else { "put the whole string into double quotes".into() };
    let then = if is_one_word { Continuation::Damaged(end) } else { Continuation::Lost(at.offset()) };
    let message = format!("`{word}` has no double quotes");
    Some(then.after(Diagnostic::at(Code::JsonSyntax, span, message).help(help)))
}

/// A number with a unit, a leading zero or a plus sign, or without digits on one side of its point.
fn number(at: &ErrorPosition<'_>) -> Option<Mistake> {
    let is_part = |c: char| is_word(c) || matches!(c, '+' | '.');
    let (span, word) = at.word(is_part)?;
    let end = at.offset() + at.rest().len() - at.rest().trim_start_matches(is_part).len();
    Some(
        Continuation::Damaged(end).after(
            Diagnostic::at(Code::JsonSyntax, span, format!("`{word}` is not a JSON number"))
                .help("write digits without leading zeros, plus sign or unit: 24, 0.5, 23.976"),
        ),
    )
}

/// Returns the end of the word at a byte, however long it is, or the byte itself.
fn word_end(at: &ErrorPosition<'_>, from: usize) -> usize {
    let rest = at.behind(from);
    from + rest.len() - rest.trim_start_matches(|c: char| is_word(c) || c == '.').len()
}

/// Returns the number in the digits 0 to 9, if it is written in a script that people type on a keyboard.
fn digits(word: &str) -> Option<String> {
    // The digit 0 in ASCII, Arabic, Persian, Devanagari, Bengali, Thai and full width.
    const ZEROS: [char; 7] = ['0', '٠', '۰', '०', '০', '๐', '０'];
    let digit = |c: char| {
        let values = ZEROS.iter().filter_map(|&zero| u32::from(c).checked_sub(u32::from(zero)));
        values.min().and_then(|value| char::from_digit(value, 10))
    };
    word.chars().map(digit).collect()
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || matches!(c, '_' | '-')
}
