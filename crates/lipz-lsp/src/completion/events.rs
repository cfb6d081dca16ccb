//! The words of events: subject, verb and object.

use super::{Offer, emotions};
use crate::project::KnownProject;
use crate::words::Role;
use lipz_file::event::SEPARATOR;
use lipz_file::text::{DELIMITER, is_white_space};
use lsp_types::CompletionItemKind;
use std::ops::Range;

/// The verbs, and their meanings.
const VERBS: [(&str, &str); 12] = [
    ("feels", "shows an emotion until it changes"),
    ("sees", "looks at a character or a prop for a moment"),
    ("stares", "looks at a character or a prop until it stops"),
    ("stops staring", "looks away"),
    ("points", "points at a character or a prop until it stops"),
    ("stops pointing", "lowers the hand"),
    ("does", "performs an action of the game"),
    ("nods", "nods the head, with an optional strength"),
    ("shakes", "shakes the head, with an optional strength"),
    ("breathes", "takes a breath, with an optional depth"),
    ("blinks", "closes the eyes for a moment"),
    ("looks away", "averts the eyes for a moment"),
];

/// Returns the range of the word that contains byte `at` of a string, which starts at `start`.
pub(super) fn word_around(text: &str, start: usize, at: usize) -> Range<usize> {
    let ends = |c: char| is_white_space(c) || matches!(c, SEPARATOR | DELIMITER | '+' | '"');
    let before = text.get(start..at).unwrap_or_default();
    let behind = text.get(at..).unwrap_or_default();
    let first = before.rfind(ends).map_or(start, |place| start + place + 1);
    first..at + behind.find(ends).unwrap_or(behind.len())
}

/// Returns the completions after the events in `before`.
pub(super) fn offers(before: &str, known: &KnownProject) -> Vec<Offer> {
    let part = before.rsplit([SEPARATOR, DELIMITER]).next().unwrap_or_default();
    let mut words: Vec<&str> = part.split(is_white_space).filter(|word| !word.is_empty()).collect();
    if !part.ends_with(is_white_space) {
        words.pop(); // incomplete
    }
    let named = |role, detail: &str, kind| named(known, role, detail, kind);
    let things = || named(Role::Target, "character or prop", CompletionItemKind::VARIABLE);
    // A blend follows `feels`: `feels anger 2 + joy`.
    if let Some(feels) = words.iter().position(|word| *word == "feels") {
        let blend = part.split_once("feels").map_or("", |(_, blend)| blend);
        let term = blend.rsplit('+').next().unwrap_or_default();
        return if feels < 2 { emotions::in_term(term, known) } else { Vec::new() };
    }
    match words.as_slice() {
        [] => verbs().into_iter().chain(named(Role::Character, "character", CompletionItemKind::VARIABLE)).collect(),
        [.., "sees" | "stares" | "points"] => things(),
        [.., "nods" | "shakes" | "breathes" | "blinks" | "away"] => Vec::new(),
        [.., "does"] => named(Role::Action, "action", CompletionItemKind::FUNCTION),
        [.., "looks"] => vec![Offer::new("away", "verb", CompletionItemKind::KEYWORD)],
        [.., "stops"] => {
            ["staring", "pointing"].map(|word| Offer::new(word, "verb", CompletionItemKind::KEYWORD)).into()
        }
        [_] => verbs(),
        _ => Vec::new(),
    }
}

fn verbs() -> Vec<Offer> {
    VERBS.map(|(verb, about)| Offer::new(verb, about, CompletionItemKind::KEYWORD)).into()
}

fn named(known: &KnownProject, role: Role, detail: &str, kind: CompletionItemKind) -> Vec<Offer> {
    let names = known.words.allowed(role, known.project.settings.options.get_known_names());
    names.into_iter().map(|name| Offer::new(name, detail, kind)).collect()
}

#[cfg(test)]
mod tests {
    use super::super::tests::at;
    use crate::project::KnownProject;
    use lipz_compiler::{KnownNames, Options};

    fn known() -> KnownProject {
        let mut known = KnownProject::default();
        let names = KnownNames::new().characters(["mara"]).props(["door"]).actions(["wave"]);
        known.project.settings.options = Options::new().known_names(names);
        known
    }

    #[test]
    fn each_word_of_an_event_has_its_own_offers() {
        let offered = |events: &str| at(&format!("{{\"events\": \"{events}\"}}"), &known());
        assert!(offered("§").0.contains(&"mara".to_owned()) && offered("a|, §").0.contains(&"feels".to_owned()));
        assert_eq!(offered("mara §").0.len(), 12, "verbs");
        assert!(offered("mara §").0.contains(&"looks away".to_owned()), "what lipz adds, too");
        assert_eq!(offered("looks §").0, ["away"]);
        assert_eq!(offered("feels sad, mara poi§nts").1, "{\"events\": \"feels sad, mara feels\"}");
        assert_eq!(offered("mara points d§").0, ["door", "mara"]);
        assert_eq!(offered("mara does §").0, ["wave"]);
        assert_eq!(offered("stops §").0, ["staring", "pointing"]);
        let emotions = offered("feels §").0;
        assert!(emotions.contains(&"happy".to_owned()) && emotions.contains(&"joy".to_owned()), "{emotions:?}");
        assert_eq!(offered("feels anger 2 + §").0, emotions);
        assert_eq!(offered("mara points door §").0.len(), 0);
    }
}
