//! `[registry]`: names that events and curves may use.

use super::Setting;
use crate::project::settings::value::NamedValue;

pub(super) const REGISTRY: &[Setting] = &[
    Setting {
        name: "characters",
        flat_name: "characters",
        about: "Characters in the scenes.",
        default: "any",
        example: "[\"samson\", \"amy\"]",
        read: |value, to| to.settings.options.known_names.characters = to.words(value),
    },
    Setting {
        name: "props",
        flat_name: "props",
        about: "Props: objects, not characters, that characters look or point at.",
        default: "any",
        example: "[\"door\", \"lamp\"]",
        read: |value, to| to.settings.options.known_names.props = to.words(value),
    },
    Setting {
        name: "emotions",
        flat_name: "emotions",
        about: "Emotions in addition to those in the specification. Define their faces in [emotions].",
        default: "none",
        example: "[\"nervous\"]",
        read: |value, to| to.settings.options.known_names.emotions = to.words(value).unwrap_or_default(),
    },
    Setting {
        name: "actions",
        flat_name: "actions",
        about: "Actions that may follow `does`.",
        default: "any",
        example: "[\"wave\", \"nod\"]",
        read: |value, to| to.settings.options.known_names.actions = to.words(value),
    },
    Setting {
        name: "curves",
        flat_name: "curves",
        about: "Curves of the project's rigs, in addition to the emotions and the ARKit blend shapes.",
        default: "any",
        example: "[\"ears\", \"tail\"]",
        read: |value, to| {
            let name = |item: &NamedValue<'_>, diagnostics: &mut Vec<_>| item.text(diagnostics).map(str::to_owned);
            to.settings.options.known_names.curves = value.list(&mut to.diagnostics, name).map(FromIterator::from_iter);
        },
    },
];
