//! The words of events, and the locales of texts.

use lipz_compiler::KnownNames;
use lipz_file::event::parts;
use lipz_file::locale::{TextName, text_name};
use lipz_file::{Document, JsonString, Value, event, text};
use lipz_types::Command;
use std::collections::BTreeSet;
use std::ops::Range;

/// The role of a word in an event.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Role {
    /// The character that acts.
    Character,
    /// A character or a prop that is looked or pointed at.
    Target,
    /// The emotion of a character.
    Emotion,
    /// The action of a character.
    Action,
}

/// The words that a project uses.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub(crate) struct Words {
    pub(crate) characters: BTreeSet<String>,
    pub(crate) targets: BTreeSet<String>,
    pub(crate) emotions: BTreeSet<String>,
    pub(crate) actions: BTreeSet<String>,
    pub(crate) locales: BTreeSet<String>,
}

impl Words {
    /// Returns the words of a Lipz file.
    pub(crate) fn of(document: &Document<'_>) -> Words {
        let mut words = Words::default();
        if let Some(events) = events(document) {
            each(&events.text, |role, range| {
                let word = events.text.get(range).unwrap_or_default();
                let set = words.set(role);
                if !set.contains(word) {
                    set.insert(word.to_owned());
                }
            });
        }
        for element in &document.elements {
            if let Some(TextName::Canonical(tag)) = text_name(&element.name.text) {
                words.locales.insert(tag);
            }
        }
        words
    }

    /// Adds the words of another file.
    pub(crate) fn add(&mut self, other: Words) {
        self.characters.extend(other.characters);
        self.targets.extend(other.targets);
        self.emotions.extend(other.emotions);
        self.actions.extend(other.actions);
        self.locales.extend(other.locales);
    }

    /// Returns the words that the project's list allows, or, without a list, the words that it uses.
    pub(crate) fn allowed(&self, role: Role, names: &KnownNames) -> BTreeSet<String> {
        let listed = |list: Option<&BTreeSet<String>>, used: &BTreeSet<String>| list.unwrap_or(used).clone();
        let characters = || listed(names.get_characters(), &self.characters);
        match role {
            Role::Character => characters(),
            Role::Target => characters().into_iter().chain(listed(names.get_props(), &self.targets)).collect(),
            Role::Action => listed(names.get_actions(), &self.actions),
            Role::Emotion => {
                let known = event::EMOTIONS.map(str::to_owned).into_iter().chain(names.get_emotions().iter().cloned());
                let attributes = lipz_types::Emotion::ALL.iter().map(|emotion| emotion.name().to_owned());
                known.chain(attributes).collect()
            }
        }
    }

    fn set(&mut self, role: Role) -> &mut BTreeSet<String> {
        match role {
            Role::Character => &mut self.characters,
            Role::Target => &mut self.targets,
            Role::Emotion => &mut self.emotions,
            Role::Action => &mut self.actions,
        }
    }
}

/// Returns the events of a Lipz file.
pub(crate) fn events<'d, 's>(document: &'d Document<'s>) -> Option<&'d JsonString<'s>> {
    match &document.get("events")?.value {
        Value::String(string) => Some(string),
        _ => None,
    }
}

/// Calls `found` with each word of typed events, and its range.
pub(crate) fn each(events: &str, mut found: impl FnMut(Role, Range<usize>)) {
    for segment in text::segments(events) {
        let text = events.get(segment.clone()).unwrap_or_default();
        if event::parse(text).is_none() {
            continue; // a different syntax
        }
        for part in parts(text) {
            let mut word =
                |role, range: Range<usize>| found(role, range.start + segment.start..range.end + segment.start);
            if let Some((event, blend)) = part.feeling() {
                event.character.iter().for_each(|character| word(Role::Character, character.range()));
                blend.terms.iter().for_each(|term| word(Role::Emotion, term.name.range()));
            } else if let Some(event) = part.event() {
                event.character.iter().for_each(|character| word(Role::Character, character.range()));
                let role = match event.command {
                    Command::Does(_) => Role::Action,
                    // The strength of a gesture.
                    Command::Nods(_) | Command::Shakes(_) | Command::Breathes(_) => continue,
                    _ => Role::Target,
                };
                event.command.object().iter().for_each(|object| word(role, object.range()));
            }
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn words_of_events_are_told_apart() {
        let events =
            "mara feels anger 2 + joy, points door|script(1), otto does wave| does nod, otto stares mara, nods 4";
        let mut found = Vec::new();
        each(events, |role, range| found.push((role, &events[range])));
        let expected = [
            (Role::Character, "mara"),
            (Role::Emotion, "anger"),
            (Role::Emotion, "joy"),
            (Role::Target, "door"),
            (Role::Action, "nod"),
            (Role::Character, "otto"),
            (Role::Target, "mara"),
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn lists_of_the_project_come_before_what_it_uses() {
        let document =
            lipz_file::parse(br#"{"events": "mara sees lamp", "text_de-de": "", "text": ""}"#).document.unwrap();
        let words = Words::of(&document);
        assert_eq!(words.locales.iter().collect::<Vec<_>>(), ["de-de"]);
        let names = KnownNames::default();
        assert_eq!(words.allowed(Role::Target, &names).into_iter().collect::<Vec<_>>(), ["lamp", "mara"]);
        let names = names.characters(["otto"]);
        assert_eq!(words.allowed(Role::Target, &names).into_iter().collect::<Vec<_>>(), ["lamp", "otto"]);
    }
}
