//! The comparison of a clip's text with that of its line.

use lipz_diagnostics::{Code, Diagnostic, escape};
use lipz_file::locale::{TextName, text_name};
use lipz_file::text::display;
use lipz_file::{Document, JsonString, Value};
use lipz_interop::ScriptLine;

/// Returns the diagnostic for a text of a clip that differs from that of its line.
pub(super) fn difference(script: &str, line: ScriptLine<'_>, text: &JsonString<'_>) -> Option<Diagnostic> {
    let own: Vec<String> = text.text.split('|').map(|segment| display(segment).text.into_owned()).collect();
    let own = words(&own.join(" "));
    let is_same = own == words(&display(line.text).text) || has_parts(&own, line.parts);
    if is_same || line.text.trim().is_empty() {
        return None;
    }
    let message = format!("the text differs from the line in {script}");
    let note = format!("the line is {}", escape::quoted(line.text.trim()));
    let found = Diagnostic::at(Code::LineDiffers, text.span(), message).note(note);
    Some(found.help("change the text in the Lipz file or in the script"))
}

/// Whether a text consists of these parts, with any text between them.
fn has_parts(text: &str, parts: &[String]) -> bool {
    let parts: Vec<String> = parts.iter().map(|part| words(&display(part).text)).collect();
    let [first, others @ ..] = parts.as_slice() else { return false };
    let Some((last, inner)) = others.split_last() else { return text == first };
    let Some(mut rest) = text.strip_prefix(first.as_str()) else { return false };
    for part in inner {
        let Some((_, after)) = rest.split_once(part.as_str()) else { return false };
        rest = after;
    }
    rest.ends_with(last.as_str())
}

/// The text of a clip that corresponds to its line.
pub(super) enum SourceText<'d> {
    Found(&'d JsonString<'d>),
    /// The clip does not have a text in the source locale.
    Missing,
    /// The clip has several texts, but the source locale is unknown.
    Ambiguous,
}

impl<'d> SourceText<'d> {
    /// Returns the text of a clip in the source locale. If the source locale is unknown, returns the only text.
    pub(super) fn of(document: &'d Document<'d>, source_locale: Option<&str>) -> SourceText<'d> {
        let mut texts = document.elements.iter().filter_map(|element| match &element.value {
            Value::String(string) => Some(string).filter(|_| is_of(&element.name.text, source_locale)),
            _ => None,
        });
        match (texts.next(), texts.next()) {
            (None, _) => SourceText::Missing,
            (Some(_), Some(_)) if source_locale.is_none() => SourceText::Ambiguous,
            (Some(text), _) => SourceText::Found(text),
        }
    }
}

/// Whether an element is a text in this locale. If the locale is unknown, any text is.
fn is_of(element: &str, locale: Option<&str>) -> bool {
    match (text_name(element), locale) {
        (None, _) => false,
        (Some(TextName::NoLocale), _) | (Some(_), None) => true,
        (Some(name), Some(locale)) => name.tag().is_some_and(|tag| tag == locale),
    }
}

/// Returns a text with one space between words; without spaces next to the characters of scripts that do not use them.
fn words(text: &str) -> String {
    let mut joined = String::with_capacity(text.len());
    for word in text.split_whitespace() {
        let sides = [joined.chars().next_back(), word.chars().next()];
        if sides.into_iter().all(|side| side.is_some_and(|side| !is_unspaced(side))) {
            joined.push(' ');
        }
        joined.push_str(word);
    }
    joined
}

/// Whether the character belongs to a script without spaces between words: Thai, Lao, Burmese, Khmer, Chinese or Japanese,
/// with their punctuation.
fn is_unspaced(character: char) -> bool {
    matches!(character, '\u{e00}'..='\u{eff}' | '\u{1000}'..='\u{109f}' | '\u{1780}'..='\u{17ff}'
        | '\u{3000}'..='\u{30ff}' | '\u{31f0}'..='\u{31ff}' | '\u{3400}'..='\u{9fff}' | '\u{f900}'..='\u{faff}'
        | '\u{ff00}'..='\u{ff9f}' | '\u{20000}'..='\u{3ffff}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_match_any_text() {
        let fits = |text: &str, parts: &[&str]| {
            has_parts(&words(text), &parts.iter().map(|part| (*part).to_owned()).collect::<Vec<_>>())
        };
        assert!(fits("Hello, Eileen!", &["Hello, ", "!"]));
        assert!(fits("Hello, !", &["Hello, ", "!"]) && fits("Hello!", &["{b}Hello", "!{/b}"]));
        assert!(fits("Take 3 of 4 lamps.", &["Take ", " of ", " lamps."]) && fits("Anything", &["", ""]));
        assert!(fits("Hello.", &["Hello."]) && !fits("Hello.", &["Hallo."]) && !fits("Hello.", &[]));
        assert!(!fits("Hello, Eileen?", &["Hello, ", "!"]) && !fits("Hello", &["Hello", "o"]));
        assert!(!fits("Take 3 lamps.", &["Take ", " of ", " lamps."]));
    }

    #[test]
    fn white_space_without_meaning_is_ignored() {
        for (one, other) in [
            ("Hello, \r\n Otto.", " Hello, Otto. "),
            ("Bonjour\u{a0}!", "Bonjour !"),
            ("\u{3053}\u{3093}\u{306b}\u{3061}\u{306f}\u{3002} \u{5143}\u{6c17}\u{ff1f}", "こんにちは。元気？"),
            ("元気\u{3000}Otto", "元気Otto"),
        ] {
            assert_eq!(words(one), words(other));
        }
        for (one, other) in [("a way", "away"), ("안녕 하세요", "안녕하세요")] {
            assert_ne!(words(one), words(other));
        }
    }
}
