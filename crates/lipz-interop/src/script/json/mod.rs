//! Scripts in JSON: compiled stories of Ink, and exported projects of articy:draft.

mod articy;
mod ink;

use super::{Purpose, Script};
use crate::json::{Node, root};
use lipz_diagnostics::{Code, Diagnostic, Span, escape};

/// A line of a story or project.
#[derive(Clone, PartialEq, Eq, Debug)]
struct ExportedLine {
    id: String,
    /// The text; empty if it is different each time or unknown.
    text: String,
    /// The position of the ID.
    span: Span,
}

/// Reads the lines of a JSON file. Their positions are those of their IDs.
pub(super) fn of_json(text: &str, purpose: Purpose<'_>) -> (Script, Vec<Diagnostic>) {
    let mut script = Script::default();
    let mut found = Vec::new();
    let Some(file) = root(text, &mut found) else { return (script, found) };
    let (lines, message) = match (file.get(&["inkVersion"]), file.get(&["Packages"])) {
        (Some(_), _) => {
            let (lines, too_deep) = ink::lines(file);
            found.extend(too_deep);
            (lines, "the story has no line with a tag such as `# id: mara_hello`")
        }
        (None, Some(packages)) => {
            (articy::lines(packages), "the project has no dialogue fragment with a technical name and a text")
        }
        (None, None) => {
            (Vec::new(), "the file is neither a compiled story of Ink nor an exported project of articy:draft")
        }
    };
    if lines.is_empty() && found.is_empty() {
        found.push(Diagnostic::new(Code::ForeignSyntax, message));
    }
    // A recording needs a text of its own.
    let is_used = |line: &ExportedLine| purpose != Purpose::Recordings || !line.text.is_empty();
    for ExportedLine { id, text, span } in lines.into_iter().filter(is_used) {
        if !script.add(&id, text, span) {
            let message = format!("{} has a different text above", escape::quoted(&id));
            found.push(Diagnostic::at(Code::ForeignOddity, span, message).note("the first text is used"));
        }
    }
    (script, found)
}

/// Returns the position of `part` in the string `node`, or that of the whole string if `part` is written differently
/// there.
fn span_in(node: Node<'_>, part: &str) -> Span {
    // A tag ends with its ID.
    match node.line.text.rfind(part) {
        Some(at) => Span::new(node.line.at + at, node.line.at + at + part.len()),
        None => node.span(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::Script;

    #[test]
    fn other_files_are_refused() {
        for (file, message) in [
            ("{}", "the file is neither a compiled story of Ink nor an exported project of articy:draft"),
            ("[]", "the file is neither a compiled story of Ink nor an exported project of articy:draft"),
            ("id,text\na,A.\n", "the file is not JSON: expected value"),
            (
                r#"{"inkVersion":21,"root":["^Hi.","\n"]}"#,
                "the story has no line with a tag such as `# id: mara_hello`",
            ),
            (r#"{"Packages":[]}"#, "the project has no dialogue fragment with a technical name and a text"),
        ] {
            let (_, _, found) = Script::read_lines("a.json", file.as_bytes(), None);
            assert_eq!(found.iter().map(|found| found.message.as_str()).collect::<Vec<_>>(), [message]);
        }
        let (_, source, found) = Script::read_lines("a.JSON", b"{\n  \"a\": }", None);
        assert_eq!(source.text.get(found[0].start() as usize..), Some("}"), "{found:?}");
        let empty = Script::read_lines("a.json", b"", None).2;
        assert!(empty[0].message.contains("JSON"), "{empty:?}");
    }
}
