//! Formatting: a document in its canonical layout, with the same meaning.
//!
//! The layout is that of the specification's examples. `visemes`, texts and `events` come first, one per line. The
//! opening quotes of all values are aligned, and spaces at the ends of segments align the `|`. Type and rate of the
//! visemes follow, then the curves, one per line, and elements that are not part of the format.

mod columns;
mod rewrite;
mod spelling;

pub use rewrite::rewrite;

use crate::locale::{TextName, split_variant, text_name};
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
    if let Some(first) = first_locale(&elements, style.default_locale) {
        for (role, _) in &mut elements {
            if let ElementRole::Text { is_behind, locale, .. } = role {
                *is_behind = *locale != first && !locale.is_empty();
            }
        }
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
    /// A text. The variants of a locale follow its text.
    Text {
        /// Whether its locale is not the one whose texts come first.
        is_behind: bool,
        /// Empty if the name has none.
        locale: String,
        /// The key of a variant.
        key: Option<String>,
    },
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
                Some(TextName::NoLocale) => ElementRole::of_text(""),
                Some(TextName::Canonical(tag) | TextName::Misspelt(tag) | TextName::OtherShape(_, Some(tag))) => {
                    ElementRole::of_text(&tag)
                }
                Some(TextName::OtherShape(locale, None)) => ElementRole::of_text(&locale),
            },
        }
    }

    fn of_text(tag: &str) -> ElementRole {
        let (locale, key) = split_variant(tag);
        ElementRole::Text { is_behind: true, locale: locale.to_owned(), key: key.map(str::to_owned) }
    }
}

/// Returns the locale whose texts come first, behind those without a locale, which belong to the default locale.
fn first_locale(elements: &[(ElementRole, &Element<'_>)], default_locale: Option<&str>) -> Option<String> {
    let locales = || {
        elements.iter().filter_map(|(role, _)| match role {
            ElementRole::Text { locale, .. } => Some(locale.as_str()),
            _ => None,
        })
    };
    let default = locales().find(|locale| Some(*locale) == default_locale);
    let first = default.or_else(|| locales().find(|locale| locale.is_empty())).or_else(|| locales().next());
    first.map(str::to_owned)
}

/// Returns the values as written, with aligned segments.
fn values<'d>(elements: &[(ElementRole, &'d Element<'d>)], line_ending: &str) -> Vec<Cow<'d, str>> {
    let mut rows = Vec::new();
    for (role, element) in elements {
        match (role, &element.value) {
            (ElementRole::Visemes, Value::String(string)) => {
                rows.push(SegmentRow::fixed(spelling::segments(string, false)));
            }
            (ElementRole::Text { .. } | ElementRole::Events, Value::String(string)) => {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the names of the formatted texts without `text_`.
    fn order(names: &[&str], default_locale: Option<&str>) -> Vec<String> {
        let texts: Vec<String> = names.iter().map(|name| format!("\"text{name}\": \"a\"")).collect();
        let formatted = |text: &str| {
            let document = crate::parse(text.as_bytes()).document.unwrap();
            format(&document, Style { default_locale, ..Style::default() })
        };
        let text = formatted(&format!("{{ {} }}", texts.join(", ")));
        assert_eq!(formatted(&text), text, "formatted twice");
        text.split("\"text")
            .skip(1)
            .map(|rest| rest[..rest.find('"').unwrap()].trim_start_matches('_').into())
            .collect()
    }

    #[test]
    fn variants_follow_their_text() {
        let texts = ["_pl-pl-x-few", "_en-us-x-one", "_pl-pl", "_de-de", "_en-us", "_en-us-x-fem", "_de-de-x-one"];
        let english = ["en-us", "en-us-x-fem", "en-us-x-one"];
        let german = ["de-de", "de-de-x-one"];
        let polish = ["pl-pl", "pl-pl-x-few"];
        assert_eq!(order(&texts, Some("en-us")), [&english[..], &german, &polish].concat(), "the default locale");
        assert_eq!(order(&texts, Some("fr-fr")), [&polish[..], &german, &english].concat(), "that of the first text");
        assert_eq!(order(&texts, None), [&polish[..], &german, &english].concat());
        assert_eq!(order(&["_pl-pl", "", "_de-de-x-one", "_de-de"], None), ["", "de-de", "de-de-x-one", "pl-pl"]);
        assert_eq!(order(&["_fr-fr", "_de-de", "_en-us-x-one"], Some("en-us")), ["en-us-x-one", "de-de", "fr-fr"]);
    }
}
