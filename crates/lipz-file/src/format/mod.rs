//! Formatting: a document in its canonical layout, with the same meaning.
//!
//! The layout is that of the specification's examples. `visemes`, texts and `events` come first, one per line. The
//! opening quotes of all values are aligned, and spaces at the ends of segments align the `|`. Type and rate of the
//! visemes follow, then the curves, one per line, and elements that are not part of the format.

mod columns;
mod rewrite;
mod spelling;

pub use rewrite::rewrite;

use crate::locale::{TextName, text_name};
use crate::{Document, Element, Value, curve, phones};
use columns::SegmentRow;
use std::borrow::Cow;
use unicode_width::UnicodeWidthStr;

/// The kind of line endings.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum LineEnding {
    /// `\n`
    #[default]
    Lf,
    /// `\r\n`
    CrLf,
}

impl LineEnding {
    /// Returns the line ending of a text's first line.
    pub fn detect(text: &str) -> LineEnding {
        match text.split_once('\n') {
            Some((line, _)) if line.ends_with('\r') => LineEnding::CrLf,
            _ => LineEnding::Lf,
        }
    }

    fn as_str(self) -> &'static str {
        match self {
            LineEnding::Lf => "\n",
            LineEnding::CrLf => "\r\n",
        }
    }
}

/// Layout options of a project and a file.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Style<'a> {
    /// The locale whose text comes first. Without one, or in a file without a text in it, the first text stays first,
    /// because the clip was written in its locale.
    pub default_locale: Option<&'a str>,
    /// The kind of line endings.
    pub line_ending: LineEnding,
}

/// Returns the document in canonical layout. Parsing it leads to the same clip: display texts, events, codes, numbers
/// and unknown elements are preserved. Formatting it again changes nothing.
///
/// ```
/// use lipz_file::format::{Style, format};
/// let file = br#"{"fps":24,"text_en-us":"Let me think...|It was you!","visemes":"125643356734563-----|972---"}"#;
/// let document = lipz_file::parse(file).document.ok_or("a valid file")?;
/// assert_eq!(format(&document, Style::default()), r#"{
///   "visemes" :    "125643356734563-----|972---",
///   "text_en-us" : "Let me think...     |It was you!",
///   "fps" :        24
/// }
/// "#);
/// # Ok::<(), &str>(())
/// ```
pub fn format(document: &Document<'_>, style: Style<'_>) -> String {
    let line_ending = style.line_ending.as_str();
    if document.elements.is_empty() {
        return format!("{{}}{line_ending}");
    }
    let mut elements: Vec<(ElementRole, &Element<'_>)> =
        document.elements.iter().map(|element| (ElementRole::from_name(&element.name.text), element)).collect();
    let first = first_text(&elements, style.default_locale);
    if let Some((role, _)) = first.and_then(|index| elements.get_mut(index)) {
        *role = ElementRole::FirstText;
    }
    elements.sort_by(|(a, _), (b, _)| a.cmp(b)); // stable: unknown elements keep their order
    let names: Vec<Cow<'_, str>> = elements.iter().map(|(_, element)| element.name.spelling()).collect();
    let known = || std::iter::zip(&elements, &names).filter(|((role, _), _)| *role != ElementRole::Unknown);
    let value_column = known().map(|(_, name)| name.width()).max().unwrap_or(0);
    let values = values(&elements, line_ending);
    let mut out = String::from("{");
    for (index, (name, value)) in std::iter::zip(names, values).enumerate() {
        out.push_str(if index == 0 { "" } else { "," });
        out.push_str(line_ending);
        let blanks = value_column.saturating_sub(name.width());
        out.push_str(&format!("  {name} : {:blanks$}{value}", ""));
    }
    out + line_ending + "}" + line_ending
}

/// The role of an element in the layout, in the order of the lines.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum ElementRole {
    Visemes,
    FirstText,
    /// A text, with its locale.
    Text(String),
    Events,
    VisemeType,
    Fps,
    Curves,
    Phones,
    Unknown,
}

impl ElementRole {
    fn from_name(name: &str) -> ElementRole {
        match name {
            "visemes" => ElementRole::Visemes,
            "events" => ElementRole::Events,
            "viseme_type" => ElementRole::VisemeType,
            "fps" => ElementRole::Fps,
            curve::ELEMENT => ElementRole::Curves,
            phones::ELEMENT => ElementRole::Phones,
            _ => match text_name(name) {
                None => ElementRole::Unknown,
                Some(TextName::NoLocale) => ElementRole::Text(String::new()),
                Some(TextName::Canonical(tag) | TextName::Misspelt(tag) | TextName::OtherShape(_, Some(tag))) => {
                    ElementRole::Text(tag)
                }
                Some(TextName::OtherShape(locale, None)) => ElementRole::Text(locale),
            },
        }
    }
}

/// Returns the index of the text that comes first.
fn first_text(elements: &[(ElementRole, &Element<'_>)], default_locale: Option<&str>) -> Option<usize> {
    // A text without a locale belongs to the default locale.
    let is_default = |tag: &str| tag.is_empty() || Some(tag) == default_locale;
    let default = elements.iter().position(|(role, _)| matches!(role, ElementRole::Text(tag) if is_default(tag)));
    default.or_else(|| elements.iter().position(|(role, _)| matches!(role, ElementRole::Text(_))))
}

/// Returns the values as written, with aligned segments.
fn values<'d>(elements: &[(ElementRole, &'d Element<'d>)], line_ending: &str) -> Vec<Cow<'d, str>> {
    let mut rows = Vec::new();
    for (role, element) in elements {
        match (role, &element.value) {
            (ElementRole::Visemes, Value::String(string)) => {
                rows.push(SegmentRow::fixed(spelling::segments(string, false)));
            }
            (ElementRole::Text(_) | ElementRole::FirstText | ElementRole::Events, Value::String(string)) => {
                rows.push(SegmentRow::padded(spelling::segments(string, true)));
            }
            _ => {}
        }
    }
    columns::align(&mut rows);
    let mut rows = rows.into_iter();
    let value = |(role, element): &(ElementRole, &'d Element<'d>)| match (role, &element.value) {
        (
            ElementRole::Unknown
            | ElementRole::VisemeType
            | ElementRole::Fps
            | ElementRole::Curves
            | ElementRole::Phones,
            Value::String(string),
        ) => string.spelling(),
        (_, Value::String(_)) => Cow::Owned(rows.next().map_or_else(String::new, SegmentRow::literal)),
        (ElementRole::Curves, Value::Other(raw)) => {
            curve::tidy(raw, line_ending).map_or(raw.text.as_ref().into(), Cow::Owned)
        }
        (_, Value::Number(raw) | Value::Other(raw)) => Cow::Borrowed(raw.text.as_ref()),
    };
    elements.iter().map(value).collect()
}
