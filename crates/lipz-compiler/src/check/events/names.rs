//! Names in events, compared with the names that the project registers.

use crate::check::names::inside;
use crate::project::KnownNames;
use lipz_diagnostics::{Code, Diagnostic, Span, escape, suggest};
use lipz_file::event::{Event, Word};
use std::collections::BTreeSet;

/// The maximum number of known names in a diagnostic.
const LISTED: usize = 20;

/// The emotions of the specification, then the additions of lipz: the twelve attributes, and other presets.
const FEELINGS: [&str; 27] = [
    "neutral",
    "amused",
    "happy",
    "sad",
    "irritated",
    "angry",
    "suspicious",
    "confused",
    "afraid",
    "thinking",
    "evil",
    "sadness",
    "anger",
    "joy",
    "fear",
    "disgust",
    "surprise",
    "shock",
    "perplexed",
    "asleep",
    "pain",
    "exertion",
    "shout",
    "calm",
    "lying",
    "good",
    "bad",
];

/// The kind of thing that a word of an event names.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    Character,
    Emotion,
    /// A character or a prop.
    Target,
    Action,
}

impl Role {
    /// Returns the role of the object of a verb.
    pub(super) fn of_object(verb: &str) -> Option<Role> {
        match verb {
            "feels" => Some(Role::Emotion),
            "sees" | "stares" | "points" => Some(Role::Target),
            "does" => Some(Role::Action),
            _ => None,
        }
    }
}

/// The names that are allowed in a role.
pub(super) struct RoleNames<'r> {
    specified: &'static [&'static str],
    registered: [Option<&'r BTreeSet<String>>; 2],
    /// Whether the list is complete. A target can be a character or a prop, so both must be registered.
    is_complete: bool,
}

impl<'r> RoleNames<'r> {
    pub(super) fn new(role: Role, known_names: &'r KnownNames) -> RoleNames<'r> {
        let (characters, props) = (known_names.characters.as_ref(), known_names.props.as_ref());
        let actions = known_names.actions.as_ref();
        let (specified, registered, is_complete): (&[_], _, _) = match role {
            Role::Character => (&[], [characters, None], characters.is_some()),
            Role::Emotion => (&FEELINGS, [Some(&known_names.emotions), None], true),
            Role::Target => (&[], [characters, props], characters.is_some() && props.is_some()),
            Role::Action => (&[], [actions, None], actions.is_some()),
        };
        RoleNames { specified, registered, is_complete }
    }

    /// Whether a name is listed with exactly this spelling.
    pub(super) fn contains(&self, name: &str) -> bool {
        self.specified.contains(&name) || self.registered.into_iter().flatten().any(|names| names.contains(name))
    }

    /// Returns the name that was probably meant.
    pub(super) fn nearest(&self, written: &str) -> Option<&'r str> {
        suggest::nearest(written, self.iter())
    }

    fn iter(&self) -> impl Iterator<Item = &'r str> {
        let registered = self.registered.into_iter().flatten().flatten().map(String::as_str);
        self.specified.iter().copied().chain(registered)
    }

    /// Returns the names for a message, or the start of a long list; `None` if there are no names.
    fn listed(&self) -> Option<String> {
        let shown: Vec<_> = self.iter().take(LISTED).map(escape::text).collect();
        match self.iter().count() {
            0 => None,
            count if count > LISTED => Some(format!("{} and {} more", shown.join(", "), count - LISTED)),
            _ => Some(shown.join(", ")),
        }
    }
}

/// A name that is not registered.
pub(super) struct UnregisteredName<'t> {
    role: Role,
    pub(super) word: Word<'t>,
}

/// Returns the names in an event that are not registered, for roles with a complete list of names.
pub(super) fn unknown<'t>(
    event: &Event<'t>,
    known_names: &KnownNames,
) -> impl Iterator<Item = UnregisteredName<'t>> + use<'t> {
    let character = event.character.map(|word| (Role::Character, word));
    let object = Role::of_object(event.command.verb()).zip(event.command.object());
    let is_unknown = |(role, word): &(Role, Word<'_>)| {
        let names = RoleNames::new(*role, known_names);
        names.is_complete && !names.contains(word.text)
    };
    [character, object]
        .map(|name| name.filter(is_unknown))
        .into_iter()
        .flatten()
        .map(|(role, word)| UnregisteredName { role, word })
}

impl UnregisteredName<'_> {
    pub(super) fn code(&self) -> Code {
        match self.role {
            Role::Character => Code::UnknownCharacter,
            Role::Emotion => Code::UnknownEmotion,
            Role::Target => Code::UnknownTarget,
            Role::Action => Code::UnknownAction,
        }
    }

    pub(super) fn diagnostic(&self, span: Span, known_names: &KnownNames) -> Diagnostic {
        let (what, known, lists) = match self.role {
            Role::Character => ("not a registered character", "registered characters", ["characters"].as_slice()),
            Role::Emotion => ("not a known emotion", "emotions", ["emotions"].as_slice()),
            Role::Target => (
                "neither a registered character nor a registered prop",
                "registered characters and props",
                ["characters", "props"].as_slice(),
            ),
            Role::Action => ("not a registered action", "registered actions", ["actions"].as_slice()),
        };
        let names = RoleNames::new(self.role, known_names);
        let message = format!("{} is {what}", escape::quoted(self.word.text));
        let diagnostic = Diagnostic::at(self.code(), span, message).note(match names.listed() {
            Some(listed) => format!("the {known} are {listed}"),
            None => format!("there are no {known}"),
        });
        match names.nearest(self.word.text) {
            Some(name) => {
                diagnostic.help(format!("did you mean {}?", escape::quoted(name))).suggest(span, inside(name))
            }
            None => {
                let lists = lists.join("` or `");
                diagnostic.help(format!("add it to `{lists}` in `[registry]` of lipz.toml if your game supports it"))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lipz_bank::face::Emotion;
    use lipz_file::{emotion, event};

    #[test]
    fn feelings_are_those_of_the_specification_and_of_lipz() {
        let known: BTreeSet<&str> = FEELINGS.into_iter().collect();
        let presets = emotion::PRESETS.iter().map(|(name, _)| *name);
        let others = event::EMOTIONS.into_iter().chain(Emotion::ALL.map(Emotion::name));
        assert_eq!(known, presets.chain(others).collect());
        assert_eq!(FEELINGS[..event::EMOTIONS.len()], event::EMOTIONS);
    }
}
