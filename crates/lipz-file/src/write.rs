//! Writes a document as a Lipz file.

use crate::{Document, Value};

/// Returns the document as JSON text: one element per line, indented by two spaces, with a final newline. Parsing it
/// leads to an equal document.
pub fn write(document: &Document<'_>) -> String {
    let mut out = String::from("{");
    for (index, element) in document.elements.iter().enumerate() {
        out.push_str(if index == 0 { "\n  " } else { ",\n  " });
        out.push_str(&literal(&element.name.text));
        out.push_str(": ");
        match &element.value {
            Value::String(string) => out.push_str(&literal(&string.text)),
            Value::Number(raw) | Value::Other(raw) => out.push_str(&raw.text),
        }
    }
    out.push_str(if document.elements.is_empty() { "}\n" } else { "\n}\n" });
    out
}

/// Returns a text as a JSON string literal, including its quotes. Characters outside ASCII are unchanged.
///
/// ```
/// assert_eq!(lipz_file::literal("\"Né\"\n"), r#""\"Né\"\n""#);
/// ```
pub fn literal(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}
