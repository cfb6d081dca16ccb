//! The names of curves that a file does not have yet.

use super::Offer;
use super::names::Around;
use crate::context;
use crate::document::Document;
use crate::project::Known;
use lipz_file::curve::ARKIT;
use lipz_types::{Emotion, FaceCurve};
use lsp_types::CompletionItemKind;
use std::collections::HashSet;

/// Those that lipz knows and those of the project: emotions, what moves a face, the project's own, blend shapes.
pub(super) fn offers(document: &Document, known: &Known, around: Around) -> Vec<Offer> {
    let present: HashSet<&str> = context::curve_names(&document.text).into_iter().collect();
    let mut all: Vec<(&str, &str)> = Vec::new();
    all.extend(Emotion::ALL.map(|emotion| (emotion.name(), "emotion, 0 to 10")));
    all.extend(FaceCurve::ALL.map(|curve| (curve.name(), "moves the face")));
    let own = known.project.settings.options.get_known_names().get_curves().into_iter().flatten();
    all.extend(own.map(|name| (name.as_str(), "curve of the project")));
    all.extend(ARKIT.map(|name| (name, "blend shape of ARKit, 0 to 1")));
    all.retain(|(name, _)| !present.contains(name));
    all.into_iter().map(|(name, about)| offer(name, about, around)).collect()
}

fn offer(name: &str, about: &str, around: Around) -> Offer {
    let text = match around {
        Around::Nothing => format!("\"{name}\": \"0:$0\""),
        Around::Quote => format!("{name}\": \"0:$0\""),
        Around::Colon => name.to_owned(),
    };
    Offer { text, ..Offer::new(name, about, CompletionItemKind::PROPERTY) }
}

#[cfg(test)]
mod tests {
    use super::super::tests::at;
    use crate::project::Known;
    use lipz_compiler::{KnownNames, Options};

    #[test]
    fn curves_that_are_missing_are_offered() {
        let mut known = Known::default();
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
