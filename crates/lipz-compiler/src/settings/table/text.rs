//! `[text]`: how texts are displayed and how long they may be.

use super::Setting;

pub(super) const TEXT: &[Setting] = &[
    Setting {
        name: "literal-braces",
        flat_name: "literal-braces",
        about: "Display braces as they are: `{0}` is a placeholder of the game, not meta information.",
        default: "false",
        example: "false",
        read: |value, to| to.settings.options.literal_braces = value.boolean(&mut to.diagnostics).unwrap_or_default(),
    },
    Setting {
        name: "line-columns",
        flat_name: "max-line-columns",
        about: "Columns of a line; East Asian wide characters count two.",
        default: "no limit",
        example: "42",
        read: |value, to| to.settings.options.text_limits.line_columns = value.count(&mut to.diagnostics),
    },
    Setting {
        name: "lines",
        flat_name: "max-lines",
        about: "Lines of a segment.",
        default: "no limit",
        example: "2",
        read: |value, to| to.settings.options.text_limits.lines = value.count(&mut to.diagnostics),
    },
    Setting {
        name: "characters-per-second",
        flat_name: "max-characters-per-second",
        about: "Characters of a segment per second of its time, which a player has to read.",
        default: "no limit",
        example: "17",
        read: |value, to| to.settings.options.text_limits.characters_per_second = value.positive(&mut to.diagnostics),
    },
];
