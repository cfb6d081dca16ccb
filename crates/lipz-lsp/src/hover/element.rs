//! Descriptions of the elements of the format, from its JSON Schema.

use lipz_file::locale::text_name;
use lipz_file::schema::json_schema;
use serde_json::Value;
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// The title and the description of each element, with `text` for all texts.
static ELEMENTS: LazyLock<BTreeMap<String, (String, String)>> = LazyLock::new(|| {
    let schema: Value = serde_json::from_str(&json_schema(false)).unwrap_or_default();
    let entries = |part: &str| schema.get(part).and_then(Value::as_object).cloned().unwrap_or_default();
    let known = entries("properties").into_iter();
    let texts = entries("patternProperties").into_iter().map(|(_, text)| ("text".to_owned(), text));
    let string = |value: &Value, field: &str| value.get(field).and_then(Value::as_str).unwrap_or_default().to_owned();
    known.chain(texts).map(|(name, value)| (name, (string(&value, "title"), string(&value, "description")))).collect()
});

/// Returns the title and the description of the element with this name; `None` if the format does not define it.
pub(crate) fn about(name: &str) -> Option<(&'static str, &'static str)> {
    let name = if text_name(name).is_some() { "text" } else { name };
    let (title, about) = ELEMENTS.get(name)?;
    Some((title, about))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_element_is_explained() {
        for name in ["visemes", "viseme_type", "fps", "events", "curves", "phones", "text_en-us", "text"] {
            assert!(about(name).is_some_and(|(title, text)| !title.is_empty() && text.len() > 20), "{name}");
        }
        assert_eq!(about("x_take"), None);
    }
}
