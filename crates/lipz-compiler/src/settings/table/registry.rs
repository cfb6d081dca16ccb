//! `[registry]`: names that events and curves may use.

use super::Setting;
use crate::settings::value::Value;

pub(super) const REGISTRY: &[Setting] = &[
    Setting {
        name: "characters",
        flat_name: "characters",
        about: "Characters of the scenes.",
        default: "any",
        example: "[\"samson\", \"amy\"]",
        read: |value, to| to.settings.options.known_names.characters = to.words(value),
    },
    Setting {
        name: "props",
        flat_name: "props",
        about: "Things that characters look or point at, other than characters.",
        default: "any",
        example: "[\"door\", \"lamp\"]",
        read: |value, to| to.settings.options.known_names.props = to.words(value),
    },
    Setting {
        name: "emotions",
        flat_name: "emotions",
        about: "Emotions beyond those of the specification. What they look like stands in [emotions].",
        default: "none",
        example: "[\"nervous\"]",
        read: |value, to| to.settings.options.known_names.emotions = to.words(value).unwrap_or_default(),
    },
    Setting {
        name: "actions",
        flat_name: "actions",
        about: "Actions of `does`.",
        default: "any",
        example: "[\"wave\", \"nod\"]",
        read: |value, to| to.settings.options.known_names.actions = to.words(value),
    },
    Setting {
        name: "curves",
        flat_name: "curves",
        about: "Curves of the project's rigs, beyond the emotions and the blend shapes of ARKit.",
        default: "any",
        example: "[\"ears\", \"tail\"]",
        read: |value, to| {
            let name = |item: &Value<'_>, diagnostics: &mut Vec<_>| item.text(diagnostics).map(str::to_owned);
            to.settings.options.known_names.curves = value.list(&mut to.diagnostics, name).map(FromIterator::from_iter);
        },
    },
];
