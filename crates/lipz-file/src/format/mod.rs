//! Formatting: a document in its canonical layout, which means the same.
//!
//! The layout is that of the specification's examples: `visemes`, texts and `events` come first,
//! one below the other, the opening quotes of all values stand in one column, and blanks at the
//! ends of segments bring the `|` under each other. The type and the rate of the visemes follow,
//! then the curves, one a line, and elements that are not of the format.

mod columns;
mod rewrite;
mod spelling;

pub use rewrite::rewrite;

use crate::locale::{TextName, text_name};
use crate::{Document, Element, Value, curve};
use columns::Row;
use std::borrow::Cow;
use unicode_width::UnicodeWidthStr;

/// How lines end.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum LineEnding {
    /// `\n`
    #[default]
    Lf,
    /// `\r\n`
    CrLf,
}

impl LineEnding {
    /// How the first line of a text ends.
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

/// What a project and a file decide about the layout.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Style<'a> {
    /// The locale whose text comes first. Without one, or in a file without a text in it, the
    /// first text stays the first: it is the one that the clip was written in.
    pub default_locale: Option<&'a str>,
    /// How lines end.
    pub line_ending: LineEnding,
}

/// The document in canonical layout. Reading it gives the same clip: display texts, events, codes,
/// numbers and unknown elements are as before. Formatting it again changes nothing.
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
    let mut elements: Vec<(Role, &Element<'_>)> =
        document.elements.iter().map(|element| (Role::from_name(&element.name.text), element)).collect();
    let first = first_text(&elements, style.default_locale);
    if let Some((role, _)) = first.and_then(|index| elements.get_mut(index)) {
        *role = Role::FirstText;
    }
    elements.sort_by(|(a, _), (b, _)| a.cmp(b)); // stable: unknown elements stay in their order
    let names: Vec<Cow<'_, str>> = elements.iter().map(|(_, element)| element.name.spelling()).collect();
    let known = || std::iter::zip(&elements, &names).filter(|((role, _), _)| *role != Role::Unknown);
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

/// What an element is to the layout, in the order of the lines.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum Role {
    Visemes,
    FirstText,
    /// A text, by its locale.
    Text(String),
    Events,
    VisemeType,
    Fps,
    Curves,
    Unknown,
}

impl Role {
    fn from_name(name: &str) -> Role {
        match name {
            "visemes" => Role::Visemes,
            "events" => Role::Events,
            "viseme_type" => Role::VisemeType,
            "fps" => Role::Fps,
            curve::ELEMENT => Role::Curves,
            _ => match text_name(name) {
                None => Role::Unknown,
                Some(TextName::NoLocale) => Role::Text(String::new()),
                Some(TextName::Canonical(tag) | TextName::Misspelt(tag) | TextName::OtherShape(_, Some(tag))) => {
                    Role::Text(tag)
                }
                Some(TextName::OtherShape(locale, None)) => Role::Text(locale),
            },
        }
    }
}

/// The index of the text that comes first.
fn first_text(elements: &[(Role, &Element<'_>)], default_locale: Option<&str>) -> Option<usize> {
    // A text without locale is read as that of the default locale.
    let is_default = |tag: &str| tag.is_empty() || Some(tag) == default_locale;
    let default = elements.iter().position(|(role, _)| matches!(role, Role::Text(tag) if is_default(tag)));
    default.or_else(|| elements.iter().position(|(role, _)| matches!(role, Role::Text(_))))
}

/// The values as they are written, with aligned segments.
fn values<'d>(elements: &[(Role, &'d Element<'d>)], line_ending: &str) -> Vec<Cow<'d, str>> {
    let mut rows = Vec::new();
    for (role, element) in elements {
        match (role, &element.value) {
            (Role::Visemes, Value::String(string)) => rows.push(Row::fixed(spelling::segments(string, false))),
            (Role::Text(_) | Role::FirstText | Role::Events, Value::String(string)) => {
                rows.push(Row::padded(spelling::segments(string, true)));
            }
            _ => {}
        }
    }
    columns::align(&mut rows);
    let mut rows = rows.into_iter();
    let value = |(role, element): &(Role, &'d Element<'d>)| match (role, &element.value) {
        (Role::Unknown | Role::VisemeType | Role::Fps | Role::Curves, Value::String(string)) => string.spelling(),
        (_, Value::String(_)) => Cow::Owned(rows.next().map_or_else(String::new, Row::literal)),
        (Role::Curves, Value::Other(raw)) => curve::tidy(raw, line_ending).map_or(raw.text.as_ref().into(), Cow::Owned),
        (_, Value::Number(raw) | Value::Other(raw)) => Cow::Borrowed(raw.text.as_ref()),
    };
    elements.iter().map(value).collect()
}
