//! Writes a changed document over its file, and keeps unchanged parts as spelled.

use super::{Style, format};
use crate::text::is_white_space;
use crate::{Document, Element, Value, literal};
use lipz_diagnostics::Span;
use std::collections::HashSet;

/// Returns the file `source` with the elements of `after`. `before` is the result of parsing the file.
///
/// A file in canonical layout keeps that layout. In other files, unchanged elements keep every character, a new value
/// replaces the old one, and a new element is formatted like the one above it. A file that cannot keep its layout
/// (because its elements have a different order, or it has no elements) gets the canonical one.
///
/// ```
/// use lipz_file::format::{Style, rewrite};
/// let file = "{\"visemes\":\"MA\",\n \"note\": 1}";
/// let before = lipz_file::parse(file.as_bytes()).document.ok_or("a valid file")?;
/// let after = lipz_file::parse(br#"{ "visemes": "M--", "fps": 24, "note": 1 }"#).document.ok_or("a valid file")?;
/// assert_eq!(rewrite(file, &before, &after, Style::default()), "{\"visemes\":\"M--\",\"fps\":24,\n \"note\": 1}");
/// # Ok::<(), &str>(())
/// ```
pub fn rewrite(source: &str, before: &Document<'_>, after: &Document<'_>, style: Style<'_>) -> String {
    if before == after {
        return source.to_owned();
    }
    let (mark, text) = match source.strip_prefix('\u{feff}') {
        Some(text) => ("\u{feff}", text),
        None => ("", source),
    };
    if format(before, style) == text {
        return mark.to_owned() + &format(after, style);
    }
    let changed = changes(text, before, after).and_then(|changes| apply(text, &changes));
    mark.to_owned() + &changed.unwrap_or_else(|| format(after, style))
}

/// A range of the text, and its replacement.
type Change = (Span, String);

/// Returns the changes that turn a file of `before` into one of `after`; `None` if its layout cannot be kept.
fn changes(text: &str, before: &Document<'_>, after: &Document<'_>) -> Option<Vec<Change>> {
    let mut changes = Vec::new();
    let names: HashSet<&str> = before.elements.iter().map(|old| old.name.text.as_ref()).collect();
    let mut old = before.elements.iter().peekable();
    let mut above: Option<&Element<'_>> = None;
    let mut added = String::new();
    for element in &after.elements {
        if let Some(same) = old.next_if(|old| old.name == element.name) {
            flush(above, &mut added, &mut changes);
            if same.value != element.value {
                changes.push((same.value.span(), spelled(&element.value)));
            }
            above = Some(same);
            continue;
        }
        // An element that moved up would appear twice.
        if names.contains(element.name.text.as_ref()) {
            return None;
        }
        let like = above.or(before.elements.first())?;
        added += &alike(text, like, element, above.is_none())?;
        if above.is_none() {
            let first = like.name.span().range().start;
            changes.push((Span::new(first, first), std::mem::take(&mut added)));
        }
    }
    flush(above, &mut added, &mut changes);
    old.next().is_none().then_some(changes)
}

/// Adds the pending insertion after an element.
fn flush(above: Option<&Element<'_>>, added: &mut String, changes: &mut Vec<Change>) {
    if let Some(above) = above.filter(|_| !added.is_empty()) {
        let end = above.value.span().range().end;
        changes.push((Span::new(end, end), std::mem::take(added)));
    }
}

/// Formats an element in the layout of `like`, for insertion after `like` or, with `is_above`, before it.
fn alike(text: &str, like: &Element<'_>, element: &Element<'_>, is_above: bool) -> Option<String> {
    let (name, value) = (like.name.span().range(), like.value.span().range());
    let text_before = text.get(..name.start)?;
    let blanks_before = text_before.get(text_before.trim_end_matches(is_white_space).len()..)?;
    let colon = text.get(name.end..value.start)?;
    let (name, value) = (literal(&element.name.text), spelled(&element.value));
    Some(match is_above {
        true => format!("{name}{colon}{value},{blanks_before}"),
        false => format!(",{blanks_before}{name}{colon}{value}"),
    })
}

fn spelled(value: &Value<'_>) -> String {
    match value {
        Value::String(string) => literal(&string.text),
        Value::Number(raw) | Value::Other(raw) => raw.text.to_string(),
    }
}

/// Applies changes to the text. They must ascend and not overlap.
fn apply(text: &str, changes: &[Change]) -> Option<String> {
    let mut changed = String::with_capacity(text.len());
    let mut done = 0;
    for (span, new) in changes {
        let place = span.range();
        changed += text.get(done..place.start)?;
        changed += new;
        done = place.end;
    }
    Some(changed + text.get(done..)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::borrow::Cow;

    fn element<'s>(name: &'s str, value: &'s str) -> Element<'s> {
        Element { name: Cow::Borrowed(name).into(), value: Value::String(Cow::Borrowed(value).into()) }
    }

    /// Returns the file after a change of its elements.
    fn changed<'s>(file: &'s str, change: impl Fn(&mut Vec<Element<'s>>)) -> String {
        let before = crate::parse(file.as_bytes()).document.unwrap();
        let mut after = before.clone();
        change(&mut after.elements);
        let result = rewrite(file, &before, &after, Style::default());
        assert_eq!(crate::parse(result.as_bytes()).document.unwrap().elements.len(), after.elements.len(), "{result}");
        result
    }

    #[test]
    fn only_what_changed_is_spelled_anew() {
        let file = "\u{feff}{ \"note\":\t[1,\t2],\r\n\"visemes\" :\"M\\u0041\" , \"text_fr-fr\":\"\\u00e9t\u{e9}\"\r\n}\r\n\r\n";
        let same = changed(file, |_| {});
        assert_eq!(same, file);
        let other = changed(file, |elements| elements[1] = element("visemes", "--"));
        assert_eq!(other, file.replace("M\\u0041", "--"));
        let more = changed(file, |elements| elements.push(element("text_de-de", "Ja.\n")));
        assert_eq!(more, file.replace("\r\n}", ", \"text_de-de\":\"Ja.\\n\"\r\n}"));
        let first = changed(file, |elements| elements.insert(0, element("fps", "1")));
        assert_eq!(first, file.replace("{ \"note\"", "{ \"fps\":\t\"1\", \"note\""));
        let two = changed(file, |elements| {
            elements.insert(1, element("a", "1"));
            elements.insert(2, element("b", "2"));
        });
        assert_eq!(two, file.replace("2],", "2], \"a\":\t\"1\", \"b\":\t\"2\","));
    }

    #[test]
    fn the_canonical_layout_stays_canonical() {
        let file =
            format(&crate::parse(br#"{"visemes":"MA|E","text_en-us":"a|b"}"#).document.unwrap(), Style::default());
        let other = changed(&file, |elements| elements[0] = element("visemes", "MAAAAA|E"));
        let again = crate::parse(other.as_bytes()).document.unwrap();
        assert_eq!(format(&again, Style::default()), other);
        assert!(other.contains("\"a     |b\""), "{other}");
    }

    #[test]
    fn elements_that_move_or_vanish_give_the_canonical_layout() {
        let file = r#"{"a":"1","b":"2"}"#;
        let canonical = "{\n  \"b\" : \"2\",\n  \"a\" : \"1\"\n}\n";
        assert_eq!(changed(file, |elements| elements.reverse()), canonical);
        assert_eq!(changed(file, |elements| drop(elements.remove(0))), "{\n  \"b\" : \"2\"\n}\n");
        assert_eq!(changed("{}", |elements| elements.push(element("a", "1"))), "{\n  \"a\" : \"1\"\n}\n");
    }
}
