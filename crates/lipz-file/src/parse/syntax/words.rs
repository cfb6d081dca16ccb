//! Words without quotes, with other quotes, numbers that are none, other signs for the colon.

use super::place::{Place, WHITE_SPACE};
use super::{Expected, Mistake, Then};
use lipz_diagnostics::{Code, Diagnostic, Span, escape};

/// Quotation marks that are not those of JSON, and those that end what they begin.
const QUOTES: [char; 9] = ['\'', '‘', '’', '“', '”', '„', '«', '»', '`'];

pub(super) fn explain(at: &Place<'_>, expected: Expected) -> Option<Mistake> {
    if let Some(mistake) = white_space(at, expected) {
        return Some(mistake);
    }
    match (expected, at.character()?) {
        (Expected::Value, '−' | '–' | '—') => {
            let shown = at.character().map(escape::numbered).unwrap_or_default();
            let diagnostic = diagnostic(at, format!("{shown} is not the minus of JSON"));
            let end = word_end(at, at.character_span().end as usize);
            Some(Then::Damaged(end).after(diagnostic.help("delete it, or write `-`")))
        }
        (Expected::Comma, '/') => fraction(at),
        (Expected::Name | Expected::Value, mark) if QUOTES.contains(&mark) => Some(
            quoted(at).after(
                diagnostic(at, "names and strings need straight double quotes")
                    .help("write \" before and after the string"),
            ),
        ),
        (Expected::Colon, '=') => Some(Then::Taken(at.offset() + 1).after(
            diagnostic(at, "a colon separates name and value").help("write `:` for `=`").fix(at.character_span(), ":"),
        )),
        (Expected::Colon, next) => {
            let (name, _) = at.before()?;
            let end = Span { start: name.end, end: name.end };
            let then = match next {
                '"' | '-' | '0'..='9' | '[' | '{' | 't' | 'f' | 'n' => Then::Taken(at.offset()),
                ',' | '}' => Then::Damaged(at.offset()),
                _ => Then::Lost(at.offset()),
            };
            Some(
                then.after(
                    Diagnostic::at(Code::JsonSyntax, end, "a colon is missing between name and value")
                        .help("write a colon after the name"),
                ),
            )
        }
        (Expected::Value, '+' | '.') | (Expected::Number, _) => number(at),
        (Expected::Name, _) => name(at),
        (Expected::Comma, next) if !is_word(next) => None,
        (Expected::Value | Expected::Word | Expected::Comma, _) => value(at, expected),
    }
}

fn diagnostic(at: &Place<'_>, message: impl Into<String>) -> Diagnostic {
    Diagnostic::at(Code::JsonSyntax, at.character_span(), message)
}

/// White space that JSON does not have, and characters without any shape: they look like nothing at all.
fn white_space(at: &Place<'_>, expected: Expected) -> Option<Mistake> {
    let character = at.character()?;
    let is_odd = |c: char| !WHITE_SPACE.contains(&c) && !c.is_control() && !escape::has_shape(c);
    if !is_odd(character) {
        return None;
    }
    let run = at.rest().trim_start_matches(character);
    let span = at.span_of(at.rest().len() - run.len());
    let message = format!("{} is not white space as JSON has it", escape::code_point(character));
    let diagnostic = Diagnostic::at(Code::JsonSyntax, span, message).help("delete it, or write a space");
    // Behind a value it may be a part of a text, whose quotes are wrong.
    let is_between = matches!(expected, Expected::Name | Expected::Value | Expected::Colon);
    let blanks = || " ".repeat(at.text_of(span).map_or(1, |run| run.chars().count()));
    Some(match expected {
        Expected::Word | Expected::Number => Then::Damaged(span.end as usize).after(diagnostic),
        _ => Then::Again(span.end as usize).after(if is_between { diagnostic.fix(span, blanks()) } else { diagnostic }),
    })
}

/// A fraction, `24000/1001`: as a decimal number, if it is that of a frame rate.
fn fraction(at: &Place<'_>) -> Option<Mistake> {
    let is_digit = |c: char| c.is_ascii_digit();
    let start = at.start().trim_end_matches(WHITE_SPACE);
    let above = start.get(start.trim_end_matches(is_digit).len()..)?;
    let below = at.rest().strip_prefix('/')?.trim_start_matches(WHITE_SPACE);
    let below = below.get(..below.len() - below.trim_start_matches(is_digit).len())?;
    let (numerator, denominator): (u32, u32) = (above.parse().ok()?, below.parse().ok()?);
    let begin = start.len() - above.len();
    let end = below.as_ptr() as usize + below.len() - at.start().as_ptr() as usize;
    let message = format!("JSON has no fractions: `{numerator}/{denominator}`");
    let diagnostic = Diagnostic::at(Code::JsonSyntax, Span::new(begin, end), message);
    Some(Then::Damaged(end).after(match denominator {
        0 => diagnostic.help("write a decimal number: 23.976"),
        _ => {
            diagnostic.help(format!("write it as a decimal number: {}", f64::from(numerator) / f64::from(denominator)))
        }
    }))
}

/// Where a string between other quotation marks ends: at one behind which an element goes on or ends, in the same line.
fn quoted(at: &Place<'_>) -> Then {
    let lost = Then::Lost(at.offset());
    let is_quote = |c: char| c == '"' || QUOTES.contains(&c);
    let begin = at.character_span().end as usize;
    // Not the line as such: with all elements in one line, its end would be looked for behind each of them.
    let line = at.rest().char_indices().skip(1).take_while(|(_, c)| !matches!(c, '\n' | '\r'));
    let end = line.filter(|(_, c)| is_quote(*c)).find(|(mark, c)| {
        let behind = at.behind(at.offset() + mark + c.len_utf8()).trim_start_matches([' ', '\t']);
        behind.is_empty() || behind.starts_with([':', '=', ',', '}', ']', '/', '#', '\n', '\r'])
    });
    let Some((end, mark)) = end else { return lost };
    let content = begin..at.offset() + end;
    let behind = content.end + mark.len_utf8();
    // Only what needs no decoding is certain.
    match at.text_of(Span::new(content.start, content.end)) {
        Some(text) if !text.contains(['\\', '"']) && !text.contains(char::is_control) => Then::Bare(content, behind),
        _ => Then::Damaged(behind),
    }
}

/// A name without quotes.
fn name(at: &Place<'_>) -> Option<Mistake> {
    let (span, name) = at.word(is_word)?;
    let quoted = format!("\"{name}\"");
    let end = word_end(at, at.offset());
    let is_name = at.behind(end).trim_start_matches(WHITE_SPACE).starts_with([':', '=']);
    let then = if is_name { Then::Bare(at.offset()..end, end) } else { Then::Lost(end) };
    Some(then.after(
        Diagnostic::at(Code::JsonSyntax, span, format!("`{name}` needs double quotes")).help(format!("write {quoted}")),
    ))
}

/// A string without quotes, a literal of another language, a number with its unit.
fn value(at: &Place<'_>, expected: Expected) -> Option<Mistake> {
    let (span, word) = at.word(is_word)?;
    let end = word_end(at, at.offset());
    if expected == Expected::Comma && span.start == at.character_span().start {
        // It follows a whole value.
        let (_, '0'..='9') = at.before()? else { return None };
        let diagnostic = Diagnostic::at(Code::JsonSyntax, span, "a number has no unit");
        return Some(Then::Damaged(end).after(diagnostic.help(format!("delete `{word}`"))));
    }
    if word.starts_with(|c: char| c.is_ascii_digit()) {
        return number(at);
    }
    if word.chars().all(char::is_numeric) {
        let diagnostic = Diagnostic::at(Code::JsonSyntax, span, format!("`{word}` are not the digits of JSON"));
        return Some(Then::Damaged(end).after(diagnostic.help(match digits(word) {
            Some(digits) => format!("write {digits}"),
            None => "write the digits 0 to 9".to_owned(),
        })));
    }
    if matches!(word, "None" | "nil" | "NULL" | "Null" | "undefined" | "NaN" | "Infinity" | "True" | "False") {
        return Some(
            Then::Damaged(end).after(
                Diagnostic::at(Code::JsonSyntax, span, format!("JSON does not know `{word}`"))
                    .help("its words are true, false and null; leave the element out if it has no value"),
            ),
        );
    }
    let after = at.rest().trim_start_matches(is_word).trim_start_matches([' ', '\t']);
    let is_one_word = after.starts_with([',', '}', ']', '\r', '\n']);
    let help = if is_one_word { format!("write \"{word}\"") } else { "put the whole string into double quotes".into() };
    let then = if is_one_word { Then::Damaged(end) } else { Then::Lost(at.offset()) };
    let message = format!("`{word}` needs double quotes");
    Some(then.after(Diagnostic::at(Code::JsonSyntax, span, message).help(help)))
}

/// A number with a unit, a leading zero, a plus, without digits on one side of its point.
fn number(at: &Place<'_>) -> Option<Mistake> {
    let is_part = |c: char| is_word(c) || matches!(c, '+' | '.');
    let (span, word) = at.word(is_part)?;
    let end = at.offset() + at.rest().len() - at.rest().trim_start_matches(is_part).len();
    Some(
        Then::Damaged(end).after(
            Diagnostic::at(Code::JsonSyntax, span, format!("`{word}` is not a number as JSON has it"))
                .help("write digits without leading zeros, plus or unit: 24, 0.5, 23.976"),
        ),
    )
}

/// Where the word ends that starts at a byte, however long it is; there if none does.
fn word_end(at: &Place<'_>, from: usize) -> usize {
    let rest = at.behind(from);
    from + rest.len() - rest.trim_start_matches(|c: char| is_word(c) || c == '.').len()
}

/// The number in the digits 0 to 9, if it is written in those of a script that people type on a keyboard.
fn digits(word: &str) -> Option<String> {
    // Where the digit 0 is: ASCII, Arabic, Persian, Devanagari, Bengali, Thai, full width.
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
