//! Lines of exported projects of articy:draft: their dialogue fragments.

use super::{ExportedLine, span_in};
use crate::json::Node;
use std::collections::HashMap;

/// Returns the dialogue fragments of packages that have a technical name and a text.
pub(super) fn lines(packages: Node<'_>) -> Vec<ExportedLine> {
    let models = packages.items().into_iter().flatten().filter_map(|package| package.get(&["Models"])?.items());
    fragments(models.flatten(), &HashMap::new())
}

/// Returns those of a package of articy:draft X, with the texts by their keys.
pub(super) fn lines_of_package(objects: Node<'_>, texts: &HashMap<String, String>) -> Vec<ExportedLine> {
    fragments(objects.items().into_iter().flatten(), texts)
}

fn fragments<'n>(models: impl Iterator<Item = Node<'n>>, texts: &HashMap<String, String>) -> Vec<ExportedLine> {
    models.filter_map(|model| line(model, texts)).collect()
}

/// Returns the name of a file with objects, if `packages` are those of a manifest of articy:draft X.
pub(super) fn objects_of_manifest(packages: Node<'_>) -> Option<String> {
    let files = packages.items()?.into_iter().find_map(|package| package.get(&["Files"]))?;
    files.get(&["Objects"])?.get(&["FileName"])?.string()
}

fn line(model: Node<'_>, texts: &HashMap<String, String>) -> Option<ExportedLine> {
    let properties = model.get(&["Properties"])?;
    let is_fragment = model.get(&["Type"]).and_then(Node::string).is_some_and(|kind| kind.contains("DialogueFragment"));
    if !is_fragment && properties.get(&["Speaker"]).and_then(Node::string).is_none() {
        return None;
    }
    let name = properties.get(&["TechnicalName"])?;
    let id = name.string()?.trim().to_owned();
    let text = properties.get(&["Text"])?.string()?;
    let text = texts.get(&text).cloned().unwrap_or(text);
    if id.is_empty() || text.trim().is_empty() {
        return None;
    }
    // A project with localisation exports its texts to other files, and their keys to this one.
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

    /// The JSON export of articy:draft X (`"ExportVersion": "2.0"` in its manifest, as `PackagesImport.cpp` and
    /// `ArticyTexts.cpp` of ArticyXImporterForUnreal read it): objects and texts in two files.
    #[test]
    fn packages_have_their_texts_in_a_second_file() {
        let objects = r#"{"Objects":[
            {"Type":"Dialogue","Properties":{"TechnicalName":"Dlg_1","DisplayName":"Dlg_1.DisplayName","Text":""}},
            {"Type":"DialogueFragment","Properties":{"TechnicalName":"DFr_1","Speaker":"0x01","Text":"DFr_1.Text"}},
            {"Type":"DialogueFragment","Properties":{"TechnicalName":"DFr_2","Speaker":"0x01","Text":"DFr_2.Text"}},
            {"Type":"DialogueFragment","Properties":{"TechnicalName":"DFr_3","Speaker":"0x01","Text":""}}]}"#;
        let texts = r#"{"Dlg_1.DisplayName":{"":{"Text":"Conversation"},"Context":"Flow/Conversation"},
            "DFr_1.Text":{"":{"Text":"Hi."},"Context":"Flow/Conversation/Mara: \"Hi.\""},
            "DFr_2.Text":{"de-DE":{"Text":"Nein."},"en":{"Text":"No.","VOAsset":"0x02"},"Context":"Flow"}}"#;
        let read = |locale| {
            let (script, _, found) =
                Script::read_lines_with_texts("objects.json", objects.as_bytes(), texts.as_bytes(), locale);
            assert_eq!(found, []);
            script.lines().iter().map(|line| (line.path.to_owned(), line.text.to_owned())).collect::<Vec<_>>()
        };
        let lines = |second: &str| vec![("DFr_1".into(), "Hi.".into()), ("DFr_2".into(), second.to_owned())];
        assert_eq!(read(Some("en-us")), lines("No."));
        assert_eq!(read(Some("de-de")), lines("Nein."));
        assert_eq!(read(None), lines(""), "the language is unknown");
        let german = texts.replace(r#"{"":{"#, r#"{"en":{"Text":"A"},"de-DE":{"#);
        let (_, _, found) =
            Script::read_lines_with_texts("objects.json", objects.as_bytes(), german.as_bytes(), Some("fr-fr"));
        assert_eq!(found[0].message, "the package has no texts in fr-fr, and lipz does not compare them");
        let (script, _, found) = Script::read_lines("objects.json", objects.as_bytes(), None);
        assert_eq!((script.len(), found[0].code.to_string().as_str()), (2, "LZ1104"));
        let (_, _, found) = Script::read("objects.json", objects.as_bytes(), None);
        assert!(found[0].is_error(), "a script of recordings needs texts: {found:?}");
        let (_, _, found) = Script::read_lines_with_texts("objects.json", objects.as_bytes(), b"{", None);
        assert!(
            found[0].message.starts_with("the texts of the package (_localization.json) cannot be read"),
            "{found:?}"
        );
        let manifest = r#"{"Settings":{"ExportVersion":"2.0"},"Packages":[{"Name":"All","Files":{
            "Objects":{"FileName":"package_01_objects.json"},"Texts":{"FileName":"package_01_localization.json"}}}]}"#;
        for file in [manifest, texts] {
            let (_, _, found) = Script::read_lines("manifest.json", file.as_bytes(), None);
            assert!(found[0].is_error() && found[0].help.as_ref().unwrap().contains("_objects.json"), "{found:?}");
        }
        let beside = Script::texts_beside("export/package_01_objects.json".as_ref());
        assert_eq!(beside, Some("export/package_01_localization.json".into()));
        assert_eq!(Script::texts_beside("export/manifest.json".as_ref()), None);
    }
}
