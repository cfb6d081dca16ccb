//! Scripts in JSON: compiled stories of Ink, and exported projects of articy:draft.

mod articy;
pub(super) mod articy_texts;
mod ink;

use super::{Purpose, Script};
use crate::json::{Node, root};
use lipz_diagnostics::{Code, Diagnostic, Span, escape};
use std::collections::HashMap;

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
    let member = |name: &str| file.get(&[name]);
    let (lines, message, help) = match (member("inkVersion"), member("Packages"), member("Objects")) {
        (Some(_), ..) => {
            let (lines, too_deep) = ink::lines(file);
            found.extend(too_deep);
            (lines, "the story has no line with a tag such as `# id: mara_hello`", None)
        }
        (None, Some(packages), _) => match articy::objects_of_manifest(packages) {
            None => {
                (articy::lines(packages), "the project has no dialogue fragment with a technical name and a text", None)
            }
            Some(objects) => (
                articy::lines(packages),
                "the file lists the packages of an articy:draft project, but does not contain lines",
                Some(format!("read the file with the objects instead: {}", escape::quoted(&objects))),
            ),
        },
        (None, None, Some(objects)) => {
            let message = "the package has no dialogue fragment with a technical name and a text";
            (of_package(objects, purpose, &mut found), message, None)
        }
        (None, None, None) => {
            let help = "read the file with the objects instead, whose name is package_…_objects.json";
            let message = "the file is neither a compiled story of Ink nor an exported project of articy:draft";
            (Vec::new(), message, articy_texts::are_texts(file).then(|| help.to_owned()))
        }
    };
    if lines.is_empty() && found.is_empty() {
        let nothing = Diagnostic::new(Code::ForeignSyntax, message);
        found.push(match help {
            Some(help) => nothing.help(help),
            None => nothing,
        });
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

/// Returns the lines of a package of articy:draft X.
fn of_package(objects: Node<'_>, purpose: Purpose<'_>, found: &mut Vec<Diagnostic>) -> Vec<ExportedLine> {
    let texts = match purpose {
        Purpose::Lines { locale, texts: Some(texts) } => articy_texts::read(texts, locale, found),
        _ => HashMap::new(),
    };
    let lines = articy::lines_of_package(objects, &texts);
    let is_without = texts.is_empty() && found.is_empty() && lines.iter().any(|line| line.text.is_empty());
    found.extend(is_without.then(|| without_texts(purpose)));
    lines
}

/// Returns the diagnostic for a package whose lines have no texts.
fn without_texts(purpose: Purpose<'_>) -> Diagnostic {
    match purpose {
        Purpose::Recordings => Diagnostic::new(Code::ForeignSyntax, "the texts of the package are in a different file")
            .help("export the lines as CSV with the columns `file` and `text`"),
        Purpose::Lines { locale: Some(locale), texts: Some(_) } => {
            let message = format!("the package has no texts in {locale}, and lipz does not compare them");
            Diagnostic::new(Code::ForeignOddity, message).help("name a locale of the project, or export it again")
        }
        Purpose::Lines { .. } => {
            let message = "the texts of the package are missing, and lipz does not compare them";
            Diagnostic::new(Code::ForeignOddity, message)
                .help("put the file package_…_localization.json of the same export next to this file")
        }
    }
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
