//! Lines of exported projects of articy:draft: their dialogue fragments.

use super::{ExportedLine, span_in};
use crate::json::Node;

/// Returns the dialogue fragments that have a technical name and a text.
pub(super) fn lines(packages: Node<'_>) -> Vec<ExportedLine> {
    let models = packages.items().into_iter().flatten().filter_map(|package| package.get(&["Models"])?.items());
    models.flatten().filter_map(line).collect()
}

fn line(model: Node<'_>) -> Option<ExportedLine> {
    let properties = model.get(&["Properties"])?;
    let is_fragment = model.get(&["Type"]).and_then(Node::string).is_some_and(|kind| kind.contains("DialogueFragment"));
    if !is_fragment && properties.get(&["Speaker"]).and_then(Node::string).is_none() {
        return None;
    }
    let name = properties.get(&["TechnicalName"])?;
    let id = name.string()?.trim().to_owned();
    let text = properties.get(&["Text"])?.string()?;
    if id.is_empty() || text.trim().is_empty() {
        return None;
    }
    // A project with localisation exports its texts to spreadsheets, and their keys to JSON.
    let is_key = text.strip_prefix(&id).is_some_and(|rest| rest == ".Text");
    let span = span_in(name, &id);
    Some(ExportedLine { id, text: if is_key { String::new() } else { text }, span })
}

#[cfg(test)]
mod tests {
    use super::super::super::Script;

    #[test]
    fn fragments_with_names_are_lines() {
        let project = r#"{"Project":{"Name":"DFr_1"},"Packages":[{"Models":[
            {"Type":"DialogueFragment","Properties":{"TechnicalName":"DFr_1","Text":"Hello.","Speaker":"0x01"}},
            {"Type":"DialogueFragment","Properties":{"TechnicalName":"","Text":"No name."}},
            {"Type":"DialogueFragment","Properties":{"TechnicalName":"DFr_2","Text":" "}},
            {"Type":"DialogueFragment","Properties":{"TechnicalName":"DFr_3","Text":"DFr_3.Text"}},
            {"Type":"MyLine","Properties":{"TechnicalName":"DFr_4","Text":"A template.","Speaker":"0x01"}},
            {"Type":"Hub","Properties":{"TechnicalName":"Hub_1","Text":"not spoken"}}]}]}"#;
        let (script, source, found) = Script::read_lines("export.json", project.as_bytes(), None);
        assert_eq!(found, []);
        let lines: Vec<(&str, &str)> = script.lines().iter().map(|line| (line.path, line.text)).collect();
        assert_eq!(lines, [("DFr_1", "Hello."), ("DFr_3", ""), ("DFr_4", "A template.")]);
        let first = script.lines()[0].span.start as usize;
        assert!(source.text[..first].ends_with(r#""TechnicalName":""#), "not the name of the project");
    }
}
