//! Emotions and their values: in the braces of texts, and after `feels`.

use super::Offer;
use crate::project::KnownProject;
use lipz_file::text::{DELIMITER, is_white_space};
use lipz_types::Emotion;
use lsp_types::CompletionItemKind;
use std::collections::BTreeSet;
use std::ops::Range;

/// Visibly different values, from which writers derive the others.
const VALUES: [(&str, &str); 6] = [
    ("1", "a trace"),
    ("2", "a little"),
    ("3", "medium, as in a blend of three"),
    ("5", "the usual value"),
    ("8", "strong"),
    ("10", "the maximum"),
];

/// Alternatives to the project's duration of a change.
const OVER: [(&str, &str); 2] = [("over 0.1s", "at once"), ("over 1s", "slowly")];

/// Returns the completions in braces that are open before a position in a text; nothing outside braces.
pub(super) fn in_braces(before: &str, known: &KnownProject) -> Vec<Offer> {
    let segment = before.rsplit(DELIMITER).next().unwrap_or_default();
    match segment.rfind(['{', '}']).map(|at| segment.split_at(at)) {
        Some((_, meta)) if meta.starts_with('{') => {
            let term = meta.get(1..).unwrap_or_default().rsplit(['+', ',']).next().unwrap_or_default();
            in_term(term, known)
        }
        _ => Vec::new(),
    }
}

/// Returns the range of the word that contains byte `at` of a text.
pub(super) fn word_around(text: &str, start: usize, at: usize) -> Range<usize> {
    let ends = |c: char| is_white_space(c) || matches!(c, '{' | '}' | '+' | ',' | DELIMITER | '"');
    let before = text.get(start..at).unwrap_or_default();
    let behind = text.get(at..).unwrap_or_default();
    // All whitespace characters have one byte, as the other delimiters.
    let first = before.rfind(ends).map_or(start, |place| start + place + 1);
    first..at + behind.find(ends).unwrap_or(behind.len())
}

/// Returns the completions in one emotion of a blend.
pub(super) fn in_term(term: &str, known: &KnownProject) -> Vec<Offer> {
    let mut words: Vec<&str> = term.split(is_white_space).filter(|word| !word.is_empty()).collect();
    if !term.ends_with(is_white_space) {
        words.pop(); // incomplete
    }
    let fixed =
        |offers: &[(&str, &str)], kind| offers.iter().map(|(label, about)| Offer::new(*label, *about, kind)).collect();
    let over = || fixed(&OVER, CompletionItemKind::KEYWORD);
    match words.as_slice() {
        [] => names(known),
        [name] if is_emotion(name, known) => {
            let mut offers: Vec<Offer> = fixed(&VALUES, CompletionItemKind::VALUE);
            offers.extend(over());
            offers
        }
        [name, _] if is_emotion(name, known) => over(),
        _ => Vec::new(),
    }
}

/// Returns the names of emotions: attributes, then emotions composed of these, then custom ones that only events use.
fn names(known: &KnownProject) -> Vec<Offer> {
    let options = &known.project.settings.options;
    let mut seen = BTreeSet::new();
    let names = options.get_emotions().names().map(str::to_owned);
    let names = names
        .chain(lipz_file::event::EMOTIONS.map(str::to_owned))
        .chain(options.get_known_names().get_emotions().iter().cloned());
    names
        .filter(|name| seen.insert(name.clone()))
        .map(|name| {
            let about = about(&name, known);
            Offer::new(name, about, CompletionItemKind::ENUM_MEMBER)
        })
        .collect()
}

fn about(name: &str, known: &KnownProject) -> String {
    let attributes = known.project.settings.options.get_emotions().attributes(name);
    match attributes.as_slice() {
        _ if Emotion::from_name(name).is_some() => "emotion, 0 to 10".to_owned(),
        [] => "emotion without a face".to_owned(),
        some => {
            let one = |(emotion, value): &(Emotion, i32)| format!("{} {}", emotion.name(), f64::from(*value) / 1e3);
            format!("emotion: {}", some.iter().map(one).collect::<Vec<_>>().join(", "))
        }
    }
}

fn is_emotion(name: &str, known: &KnownProject) -> bool {
    known.project.settings.options.get_emotions().names().any(|own| own == name)
}

#[cfg(test)]
mod tests {
    use super::super::tests::at;
    use crate::project::KnownProject;

    fn offered(text: &str) -> (Vec<String>, String) {
        at(&format!("{{\"text_en-us\": \"{text}\"}}"), &KnownProject::default())
    }

    #[test]
    fn emotions_are_offered_in_braces_and_nowhere_else() {
        let (names, first) = offered("Aye. {§} No.");
        assert_eq!(names[..2], ["sadness", "anger"]);
        assert!(names.contains(&"calm".to_owned()) && names.contains(&"suspicious".to_owned()), "{names:?}");
        assert_eq!(first, "{\"text_en-us\": \"Aye. {sadness} No.\"}");
        assert_eq!(offered("{anger 2 + an§ger 3}").0, names);
        assert_eq!(offered("{anger 2, §").0, names);
        for text in ["§", "{anger} §", "{anger|§", "a }§"] {
            assert_eq!(offered(text).0.len(), 0, "{text}");
        }
    }

    #[test]
    fn emotions_have_values_and_times() {
        let (values, first) = offered("{anger §} No.");
        assert_eq!(values[..3], ["1", "2", "3"]);
        assert_eq!(first, "{\"text_en-us\": \"{anger 1} No.\"}");
        assert_eq!(offered("{anger 2.2 §}").0, ["over 0.1s", "over 1s"]);
        assert_eq!(offered("{louder §}").0.len(), 0, "a note");
    }
}
