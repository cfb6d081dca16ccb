//! Names in the settings file of a project: `[registry]`.

use lipz_diagnostics::Span;
use toml::de::{DeTable, DeValue};

/// Returns the positions of `name` in the lists `lists` of `[registry]`, including its quotes.
pub(super) fn places(text: &str, lists: &[&str], name: &str) -> Vec<Span> {
    let (root, _) = DeTable::parse_recoverable(text);
    let Some(DeValue::Table(registry)) = root.get_ref().get("registry").map(toml::Spanned::get_ref) else {
        return Vec::new();
    };
    let arrays = lists.iter().filter_map(|list| match registry.get(*list)?.get_ref() {
        DeValue::Array(items) => Some(items),
        _ => None,
    });
    let is_name = |value: &DeValue<'_>| matches!(value, DeValue::String(text) if text.as_ref() == name);
    let items = arrays.flat_map(|items| items.iter()).filter(|item| is_name(item.get_ref()));
    items.map(|item| Span::new(item.span().start, item.span().end)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_found_in_their_lists_only() {
        let text = "default-locale = \"mara\"\n[registry]\ncharacters = [\n  'mara', # mara\n  \"otto\"]\nprops=[\"m\\u0061ra\"]\nactions = [\"mara\"]\n";
        let found: Vec<&str> =
            places(text, &["characters", "props"], "mara").iter().map(|span| &text[span.range()]).collect();
        assert_eq!(found, ["'mara'", "\"m\\u0061ra\""]);
        assert_eq!(places("registry = 1", &["props"], "mara"), []);
        assert_eq!(places("[registry]\nprops = [\"mara\"", &["props"], "mara").len(), 1, "a file with mistakes");
    }
}
