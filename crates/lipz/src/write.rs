//! Writing a document as a Lipz file.

use crate::{Document, Value};

/// The document as JSON text: one element a line, two blanks of indentation, a newline at the end.
/// Reading it again gives an equal document.
pub fn write(document: &Document<'_>) -> String {
    let mut out = String::from("{");
    for (index, element) in document.elements.iter().enumerate() {
        out.push_str(if index == 0 { "\n  " } else { ",\n  " });
        push_string(&mut out, &element.name.text);
        out.push_str(": ");
        match &element.value {
            Value::String(string) => push_string(&mut out, &string.text),
            Value::Number(raw) | Value::Other(raw) => out.push_str(&raw.text),
        }
    }
    out.push_str(if document.elements.is_empty() { "}\n" } else { "\n}\n" });
    out
}

/// Appends a JSON string literal. Characters outside ASCII stay as they are.
fn push_string(out: &mut String, text: &str) {
    out.push_str(&serde_json::Value::from(text).to_string());
}
