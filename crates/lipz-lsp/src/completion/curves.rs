//! The names of curves that a file lacks.

use super::Offer;
use super::names::NameContext;
use crate::context;
use crate::document::Document;
use crate::project::KnownProject;
use lipz_file::curve::ARKIT;
use lipz_types::{Emotion, FaceCurve};
use lsp_types::CompletionItemKind;
use std::collections::HashSet;

/// Returns the names defined by lipz and the project: emotions, facial controls, the project's own curves, blend
/// shapes.
pub(super) fn offers(document: &Document, known: &KnownProject, around: NameContext) -> Vec<Offer> {
    let present: HashSet<&str> = context::curve_names(&document.text).into_iter().collect();
    let mut all: Vec<(&str, &str)> = Vec::new();
    all.extend(Emotion::ALL.map(|emotion| (emotion.name(), "emotion, 0 to 10")));
    all.extend(FaceCurve::ALL.map(|curve| (curve.name(), "moves the face")));
    let own = known.project.settings.options.get_known_names().get_curves().into_iter().flatten();
    all.extend(own.map(|name| (name.as_str(), "curve of the project")));
    all.extend(ARKIT.map(|name| (name, "ARKit blend shape, 0 to 1")));
    all.retain(|(name, _)| !present.contains(name));
    all.into_iter().map(|(name, about)| offer(name, about, around)).collect()
}

fn offer(name: &str, about: &str, around: NameContext) -> Offer {
    let text = match around {
        NameContext::Nothing => format!("\"{name}\": \"0:$0\""),
        NameContext::Quote => format!("{name}\": \"0:$0\""),
        NameContext::Colon => name.to_owned(),
    };
    Offer { text, ..Offer::new(name, about, CompletionItemKind::PROPERTY) }
}

#[cfg(test)]
mod tests {
    use super::super::tests::at;
    use crate::project::KnownProject;
    use lipz_compiler::{KnownNames, Options};

    #[test]
    fn curves_that_are_missing_are_offered() {
        let mut known = KnownProject::default();
        known.project.settings.options = Options::new().known_names(KnownNames::new().curves(["sparks"]));
        let (names, first) = at("{ \"curves\": { \"sadness\": \"0:1\", \"§\" } }", &known);
        assert_eq!(names.len(), 11 + 15 + 1 + 52);
        assert_eq!(first, "{ \"curves\": { \"sadness\": \"0:1\", \"anger\": \"0:$0\" } }");
        for name in ["headYaw", "sparks", "jawOpen"] {
            assert!(names.iter().any(|known| known == name), "{name}");
        }
        assert_eq!(at("{ \"curves\": { §", &known).1, "{ \"curves\": { \"sadness\": \"0:$0\"");
        assert_eq!(at("{ \"curves\": { \"an§\": \"0:1\" } }", &known).1, "{ \"curves\": { \"sadness\": \"0:1\" } }");
        assert_eq!(at("{ \"curves\": { \"anger\": \"0:§\" } }", &known).0.len(), 0);
    }
}
