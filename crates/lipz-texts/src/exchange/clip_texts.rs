//! The texts of a Lipz file by locale.

use lipz_file::locale::{TextName, text_name};
use lipz_file::text::{segments, trim};
use lipz_file::{Document, Element, JsonString, Value};
use std::collections::{BTreeMap, HashMap};

/// The texts of a clip, by locale and segment.
pub type ClipTexts = BTreeMap<String, Vec<String>>;

/// Returns the texts of a clip by locale, with one string per segment, without whitespace at its ends. `text` without a
/// locale is in the default locale.
pub fn texts_of(clip: &Document<'_>, default_locale: Option<&str>) -> ClipTexts {
    strings(clip, default_locale).into_iter().map(|(locale, string)| (locale, trimmed(&string.text))).collect()
}

/// Returns the unchanged texts of a clip by locale. Of two in one locale, the first counts.
pub(crate) fn strings<'d>(clip: &'d Document<'_>, default_locale: Option<&str>) -> HashMap<String, &'d JsonString<'d>> {
    let string = |element: &'d Element<'_>| match &element.value {
        Value::String(string) => Some((tag_of(&element.name.text, default_locale)?, string)),
        _ => None,
    };
    clip.elements.iter().rev().filter_map(string).collect()
}

/// Returns the segments of a text without whitespace at their ends.
pub(crate) fn trimmed(text: &str) -> Vec<String> {
    segments(text).map(|range| trim(text.get(range).unwrap_or_default()).to_owned()).collect()
}

/// Returns the locale of a text from the name of its element.
pub(crate) fn tag_of(name: &str, default_locale: Option<&str>) -> Option<String> {
    match text_name(name)? {
        TextName::NoLocale => default_locale.map(str::to_owned),
        text => text.tag(),
    }
}
