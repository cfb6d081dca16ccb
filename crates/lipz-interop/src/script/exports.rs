//! Lines of scripts in JSON: compiled stories of Ink, and exported projects of articy:draft.

use super::{Script, normal};
use lipz_diagnostics::{Code, Diagnostic, Span};
use serde_json::Value;

/// The deepest nesting of containers in a story.
const MAX_DEPTH: usize = 64;

/// Reads the lines of a JSON file. Their positions are those of their IDs, searched in the text in order.
pub(super) fn of_json(text: &str) -> (Script, Vec<Diagnostic>) {
    let mut lines = Vec::new();
    let message = match serde_json::from_str::<Value>(text) {
        Ok(story) if story.get("inkVersion").is_some() => {
            ink(story.get("root").unwrap_or(&Value::Null), MAX_DEPTH, &mut InkState::default(), &mut lines);
            "the story has no line with a tag such as `# id: mara_hello`"
        }
        Ok(project) if project.get("Packages").is_some() => {
            articy(&project, &mut lines);
            "the project has no dialogue fragment with a technical name and a text"
        }
        Ok(_) => "the file is neither a compiled story of Ink nor an exported project of articy:draft",
        Err(error) => {
            let start = place_of(text, error.line(), error.column());
            let found = Diagnostic::at(
                Code::ForeignSyntax,
                Span::new(start, start),
                format!("the script is not JSON: {error}"),
            );
            return (Script::default(), vec![found]);
        }
    };
    let mut script = Script::default();
    let mut found = Vec::new();
    if lines.is_empty() {
        found.push(Diagnostic::new(Code::ForeignSyntax, message));
    }
    let mut from = 0;
    for (id, line) in lines {
        let start = text.get(from..).and_then(|rest| rest.find(&id)).map_or(from, |at| from + at);
        let span = Span::new(start, start + id.len());
        from = span.end as usize;
        if !script.add(normal(&id), line, span) {
            let message = format!("{} has a different text above", lipz_diagnostics::escape::quoted(&id));
            found.push(Diagnostic::at(Code::ForeignOddity, span, message).note("the first text is used"));
        }
    }
    (script, found)
}

/// The line of a story that is being read.
#[derive(Default)]
struct InkState {
    text: String,
    id: Option<String>,
    is_tag: bool,
}

/// Collects the lines of a container of Ink: texts start with `^`, a line ends with `\n`, and tags are between `#` and
/// `/#`.
fn ink(container: &Value, depth: usize, state: &mut InkState, lines: &mut Vec<(String, String)>) {
    let Some(depth) = depth.checked_sub(1) else { return };
    match container {
        Value::String(token) => match token.as_str() {
            "#" => state.is_tag = true,
            "/#" => state.is_tag = false,
            "\n" => {
                let text = std::mem::take(&mut state.text).trim().to_owned();
                lines.extend(state.id.take().filter(|_| !text.is_empty()).map(|id| (id, text)));
            }
            token => match token.strip_prefix('^') {
                Some(tag) if state.is_tag => {
                    let id = tag.trim().strip_prefix("id:").map(|id| id.trim().to_owned());
                    state.id = id.filter(|id| !id.is_empty()).or(state.id.take());
                }
                Some(text) => state.text.push_str(text),
                None => {}
            },
        },
        Value::Array(parts) => parts.iter().for_each(|part| ink(part, depth, state, lines)),
        Value::Object(named) => named.values().for_each(|part| ink(part, depth, state, lines)),
        _ => {}
    }
}

/// Collects the dialogue fragments of an exported project.
fn articy(project: &Value, lines: &mut Vec<(String, String)>) {
    let packages = project.get("Packages").and_then(Value::as_array).into_iter().flatten();
    let models = packages.filter_map(|package| package.get("Models")?.as_array()).flatten();
    for model in models {
        let own = |name: &str| model.get("Properties")?.get(name)?.as_str().map(str::to_owned);
        let is_spoken = model.get("Type").and_then(Value::as_str).is_some_and(|kind| kind.contains("DialogueFragment"))
            || own("Speaker").is_some();
        let line = own("TechnicalName").zip(own("Text")).filter(|(_, text)| !text.trim().is_empty());
        lines.extend(line.filter(|_| is_spoken));
    }
}

/// Returns the offset of a line and a column, both from 1.
fn place_of(text: &str, line: usize, column: usize) -> usize {
    let start: usize = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
    let mut place = (start + column.saturating_sub(1)).min(text.len());
    while !text.is_char_boundary(place) {
        place -= 1;
    }
    place
}

#[cfg(test)]
mod tests {
    use super::super::Script;

    #[test]
    fn stories_and_projects_have_lines_with_ids() {
        // As inklecate 1.1 compiles `Hello, Otto. # id: mara_hello`, and a choice.
        let story = r##"{"inkVersion":21,"root":[["^Hello, ","^Otto. ","#","^id: mara_hello","/#","\n","^Nobody says this.","\n",
            {"c-0":["#","^id:otto_yes","/#","^Yes.","\n","done"]}],"done",null],"listDefs":{}}"##;
        let (script, source, found) = Script::read("story.ink.json", story.as_bytes(), None);
        assert_eq!(found, []);
        let lines: Vec<(&str, &str)> = script.lines().iter().map(|line| (line.path, line.text)).collect();
        assert_eq!(lines, [("mara_hello", "Hello, Otto."), ("otto_yes", "Yes.")]);
        let span = script.lines()[1].span;
        assert_eq!(&source.text[span.start as usize..span.end as usize], "otto_yes");
        let project = r#"{"Packages":[{"Models":[
            {"Type":"DialogueFragment","Properties":{"TechnicalName":"DFr_1","Text":"Hello.","Speaker":"0x01"}},
            {"Type":"Hub","Properties":{"TechnicalName":"Hub_1","Text":"not spoken"}}]}]}"#;
        let (script, _, found) = Script::read("export.json", project.as_bytes(), None);
        assert_eq!((found, script.text_of("DFr_1"), script.len()), (Vec::new(), Some("Hello."), 1));
    }

    #[test]
    fn other_files_are_refused() {
        for (file, message) in [
            ("{}", "the file is neither a compiled story of Ink nor an exported project of articy:draft"),
            (
                r#"{"inkVersion":21,"root":["^Hi.","\n"]}"#,
                "the story has no line with a tag such as `# id: mara_hello`",
            ),
            (r#"{"Packages":[]}"#, "the project has no dialogue fragment with a technical name and a text"),
        ] {
            let (_, _, found) = Script::read("a.json", file.as_bytes(), None);
            assert_eq!(found.iter().map(|found| found.message.as_str()).collect::<Vec<_>>(), [message]);
        }
        let (_, _, found) = Script::read("a.json", b"{\n  \"a\": }", None);
        assert!(found[0].message.starts_with("the script is not JSON"), "{found:?}");
        let deep = format!("{{\"inkVersion\":21,\"root\":{}{}}}", "[".repeat(100), "]".repeat(100));
        assert_eq!(Script::read("a.json", deep.as_bytes(), None).2.len(), 1);
    }
}
