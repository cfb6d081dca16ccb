//! Insertion of segments into a Lipz file without changing any other character.

use lipz_diagnostics::Span;
use lipz_file::format::{LineEnding, Style, format, rewrite};
use lipz_file::locale::{TextName, is_variant, split_variant, text_name};
use lipz_file::text::{DELIMITER, segments, trim};
use lipz_file::{Document, Element, JsonString, Value, literal, parse};
use std::borrow::Cow;
use std::collections::{BTreeMap, HashMap};

/// The new texts of a clip in a locale.
pub(super) struct NewTexts {
    pub(super) locale: String,
    /// The changed segments, from 0, with their texts.
    pub(super) segments: BTreeMap<usize, String>,
    /// The number of segments of the clip.
    pub(super) count: usize,
}

/// Returns the file with new texts. A file in the canonical layout keeps that layout. In any other file, all unchanged
/// parts keep their spelling, down to escapes in the same text. `strings` are the texts of the clip by locale.
pub(super) fn splice(
    file: &str,
    clip: &Document<'_>,
    texts: &[NewTexts],
    style: Style<'_>,
    strings: &HashMap<String, &JsonString<'_>>,
) -> String {
    let (mark, text) = match file.strip_prefix('\u{feff}') {
        Some(text) => ("\u{feff}", text),
        None => ("", file),
    };
    let style = Style { line_ending: LineEnding::detect(text), ..style };
    let is_canonical = format(clip, style) == text;
    let mut changes = Vec::new();
    let mut added = Vec::new();
    for new in texts {
        match strings.get(&new.locale) {
            Some(string) => changes.extend(changes_of(string, &new.segments)),
            None => added.push(new),
        }
    }
    changes.sort_by_key(|(span, _)| *span);
    let changed = apply(text, &changes);
    if added.is_empty() && !is_canonical {
        return mark.to_owned() + &changed;
    }
    let Some(before) = parse(changed.as_bytes()).document else { return file.to_owned() };
    let mut after = before.clone();
    for new in added {
        add(&mut after, new);
    }
    let whole = if is_canonical { format(&after, style) } else { rewrite(&changed, &before, &after, style) };
    mark.to_owned() + &whole
}

/// Returns the replaced spans, with their replacements.
fn changes_of(string: &JsonString<'_>, new: &BTreeMap<usize, String>) -> Vec<(Span, String)> {
    let mut changes = Vec::new();
    for (at, range) in segments(&string.text).enumerate() {
        let Some(new) = new.get(&at) else { continue };
        let old = string.text.get(range.clone()).unwrap_or_default();
        let shown = trim(old);
        let start = range.start + (old.len() - old.trim_start_matches(lipz_file::text::is_white_space).len());
        let span = match shown.is_empty() {
            true => string.span_of(range.start..range.start),
            false => string.span_of(start..start + shown.len()),
        };
        let spelled = literal(new);
        changes.push((span, spelled.get(1..spelled.len() - 1).unwrap_or_default().to_owned()));
    }
    changes
}

/// Adds a text in a new locale after the last text, or a variant after the last text of its locale.
fn add(document: &mut Document<'_>, new: &NewTexts) {
    let segment = |at: usize| new.segments.get(&at).map_or("", String::as_str);
    let text = (0..new.count).map(segment).collect::<Vec<_>>().join(&DELIMITER.to_string());
    let name = JsonString::from(Cow::Owned(format!("text_{}", new.locale)));
    let element = Element { name, value: Value::String(JsonString::from(Cow::Owned(text))) };
    let tag = |element: &Element<'_>| text_name(&element.name.text);
    let is_alike = |element: &Element<'_>| {
        let tag = tag(element).and_then(TextName::tag);
        is_variant(&new.locale) && tag.is_some_and(|tag| split_variant(&tag).0 == split_variant(&new.locale).0)
    };
    let last_where = |is_meant: &dyn Fn(&Element<'_>) -> bool| document.elements.iter().rposition(is_meant);
    let last = last_where(&is_alike).or_else(|| last_where(&|element| tag(element).is_some()));
    document.elements.insert(last.map_or(document.elements.len(), |at| at + 1), element);
}

/// Returns the text with changes, which ascend and do not overlap.
fn apply(text: &str, changes: &[(Span, String)]) -> String {
    let mut changed = String::with_capacity(text.len());
    let mut done = 0;
    for (span, new) in changes {
        let place = span.range();
        changed.push_str(text.get(done..place.start).unwrap_or_default());
        changed.push_str(new);
        done = place.end;
    }
    changed.push_str(text.get(done..).unwrap_or_default());
    changed
}
