//! `[text]`: display and limits of texts.

use super::Setting;
use crate::project::settings::value::NamedValue;
use lipz_diagnostics::Diagnostic;
use lipz_file::placeholder::PlaceholderPattern;

pub(super) const TEXT: &[Setting] = &[
    Setting {
        name: "literal-braces",
        flat_name: "literal-braces",
        about: "Display braces as they are, so that `{0}` is a placeholder for the game instead of meta.",
        default: "false",
        example: "false",
        read: |value, to| to.settings.options.literal_braces = value.boolean(&mut to.diagnostics).unwrap_or_default(),
    },
    Setting {
        name: "line-columns",
        flat_name: "max-line-columns",
        about: "Maximum number of columns in a line; East Asian wide characters count as two.",
        default: "no limit",
        example: "42",
        read: |value, to| to.settings.options.text_limits.line_columns = value.count(&mut to.diagnostics),
    },
    Setting {
        name: "line-pixels",
        flat_name: "max-line-pixels",
        about: "Maximum width of a line in pixels, for `lipz check`. Needs `font` and `font-pixels`.",
        default: "no limit",
        example: "640",
        read: |value, to| to.settings.pixel_limits.project.line_pixels = to.line_pixels(None, value),
    },
    Setting {
        name: "font",
        flat_name: "",
        about: "Font of the game (TrueType or OpenType), in which lipz measures lines. lipz also reports characters \
            that the font lacks.",
        default: "none",
        example: "\"fonts/game.ttf\"",
        read: |value, to| to.settings.pixel_limits.project.font = to.named_file(value),
    },
    Setting {
        name: "font-pixels",
        flat_name: "",
        about: "Size of the font: the number of pixels of an em.",
        default: "none",
        example: "32",
        read: |value, to| to.settings.pixel_limits.project.font_pixels = value.positive(&mut to.diagnostics),
    },
    Setting {
        name: "lines",
        flat_name: "max-lines",
        about: "Maximum number of lines in a segment.",
        default: "no limit",
        example: "2",
        read: |value, to| to.settings.options.text_limits.lines = value.count(&mut to.diagnostics),
    },
    Setting {
        name: "characters-per-second",
        flat_name: "max-characters-per-second",
        about: "Maximum number of characters per second that a player has to read in a segment.",
        default: "no limit",
        example: "17",
        read: |value, to| to.settings.options.text_limits.characters_per_second = value.positive(&mut to.diagnostics),
    },
    Setting {
        name: "shortest-seconds",
        flat_name: "",
        about: "Minimum number of seconds for which a segment with a text is shown.",
        default: "no limit",
        example: "0.8",
        read: |value, to| to.settings.options.text_limits.shortest_seconds = value.positive(&mut to.diagnostics),
    },
    Setting {
        name: "terms",
        flat_name: "",
        about: "CSV file of terms, with a column for each locale and a row for each term. lipz reports translations that \
            lack the translation of a term.",
        default: "none",
        example: "\"terms.csv\"",
        read: |value, to| to.settings.terms = to.named_file(value),
    },
    Setting {
        name: "placeholders",
        flat_name: "",
        about: "Patterns of placeholders that the game replaces, in addition to `{name}`, `%s` and `$name`: `*` stands \
            for any text before the rest of the pattern. lipz reports translations that lack one.",
        default: "none",
        example: "[\"[item:*]\", \"#*#\"]",
        read: |value, to| {
            let patterns = value.list(&mut to.diagnostics, pattern);
            to.settings.placeholders = patterns.unwrap_or_default();
        },
    },
    Setting {
        name: "locales",
        flat_name: "",
        about: "Limits and fonts that replace those above in a locale, or in all locales of a language: \
            `line-columns`, `line-pixels`, `font`, `font-pixels`, `lines`, `characters-per-second` and \
            `shortest-seconds`.",
        default: "none",
        example: "{ ja = { characters-per-second = 4, line-columns = 26 } }",
        read: |value, to| to.text_locales(value),
    },
];

fn pattern(value: &NamedValue<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<PlaceholderPattern> {
    let help = "begin with the text that all of these placeholders begin with, as in \"[item:*]\"";
    match value.text(diagnostics)?.parse() {
        Ok(pattern) => Some(pattern),
        Err(error) => value.refuse(format!("is not a pattern of placeholders: {error}"), help, diagnostics),
    }
}
