//! Segments that start like Character Event Syntax but do not follow it, in a project that registers names.
//!
//! Prose and scripts are also valid. If a project registers names, a segment is meant as events if it contains an event,
//! or if its first word is a verb of the syntax or a registered character.

use super::names::{Role, RoleNames};
use crate::project::KnownNames;
use lipz_diagnostics::{Code, Diagnostic, Span, escape};
use lipz_file::event::{self, Part};
use lipz_file::text;
use std::ops::Range;

/// Verbs that need an object, each with an example.
const WITH_OBJECT: [(&str, &str); 6] = [
    ("feels", "feels sad"),
    ("sees", "sees door"),
    ("stares", "stares door"),
    ("points", "points door"),
    ("does", "does wave"),
    ("stops", "stops staring"),
];
/// The other verbs.
const ALONE: [&str; 5] = ["nods", "shakes", "breathes", "blinks", "looks"];

/// The parts that keep a segment from being events, if it is meant as such.
pub(super) fn broken<'s>(segment: &'s str, known_names: &KnownNames) -> impl Iterator<Item = Part<'s>> {
    let is_meant = has_registry(known_names) && is_meant(segment, known_names);
    event::parts(segment).filter(move |part| is_meant && part.event().is_none())
}

fn has_registry(known_names: &KnownNames) -> bool {
    let KnownNames { characters, props, emotions, actions, .. } = known_names;
    [characters, props, actions].into_iter().any(Option::is_some) || !emotions.is_empty()
}

fn is_meant(segment: &str, known_names: &KnownNames) -> bool {
    let characters = RoleNames::new(Role::Character, known_names);
    let first = event::parts(segment).next().and_then(|part| part.words().next());
    let is_verb = |word: &str| WITH_OBJECT.iter().any(|(verb, _)| *verb == word) || ALONE.contains(&word);
    first.is_some_and(|word| is_verb(word.text) || characters.contains(word.text))
        || event::parts(segment).any(|part| part.event().is_some())
}

/// Returns the diagnostic for such a part.
pub(super) fn diagnostic(part: Part<'_>, span: impl Fn(Range<usize>) -> Span) -> Diagnostic {
    let written = text::trim(part.text);
    let start = part.start + part.text.find(written).unwrap_or(0);
    let last = part.words().last().and_then(|last| WITH_OBJECT.iter().find(|(verb, _)| *verb == last.text));
    let (message, help) = match (written, last) {
        ("", _) => ("an event is missing next to this `,`".to_owned(), "add the event, or remove the `,`".to_owned()),
        (_, Some((verb, example))) if part.words().count() <= 2 => {
            (format!("`{verb}` needs an object"), format!("add an object, as in `{example}`"))
        }
        _ => (
            format!("{} is not Character Event Syntax", escape::quoted(written)),
            "write a character, a verb and its object, as in `amy feels sad`; for a custom action, write `amy does wave`"
                .to_owned(),
        ),
    };
    Diagnostic::at(Code::BrokenEvent, span(start..start + written.len()), message)
        .note("the whole segment is kept as text; games do not see its events")
        .help(help)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    fn found<'s>(segment: &'s str, known_names: &KnownNames) -> Vec<&'s str> {
        broken(segment, known_names).map(|part| text::trim(part.text)).collect()
    }

    #[test]
    fn what_starts_like_events_is_reported_in_a_project_with_names() {
        let names = |names: &str| Some(names.split(' ').map(str::to_owned).collect::<BTreeSet<_>>());
        let known = KnownNames { characters: names("amy mara otto"), props: names("lamp"), ..KnownNames::default() };
        for (segment, parts) in [
            ("feels sad; otto feels happy", vec!["feels sad; otto feels happy"]),
            ("feels", vec!["feels"]),
            ("points, amy feels sad", vec!["points"]),
            ("amy mara feels sad", vec!["amy mara feels sad"]),
            ("does wave lamp", vec!["does wave lamp"]),
            ("feels sad, gasps", vec!["gasps"]),
            ("gasps, feels sad", vec!["gasps"]),
            ("amy", vec!["amy"]),
        ] {
            assert_eq!(found(segment, &known), parts, "{segment}");
            assert_eq!(found(segment, &KnownNames::default()), [""; 0], "{segment}");
        }
        for other in ["gasps", "He points at the door, slowly", "say('amy')", "", "wave hand"] {
            assert_eq!(found(other, &known), [""; 0], "{other}");
        }
    }
}
