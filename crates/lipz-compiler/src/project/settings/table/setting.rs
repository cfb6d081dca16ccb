//! The description of a setting, and of a table.

use crate::project::settings::reading::SettingsReader;
use crate::project::settings::value::NamedValue;

/// A table of `lipz.toml`.
pub struct Table {
    /// Its name; empty for the settings before the first table.
    pub name: &'static str,
    /// A description of its settings, in one sentence.
    pub about: &'static str,
    /// Its contents.
    pub content: Content,
}

/// The contents of a table.
pub enum Content {
    /// Settings with fixed names.
    Settings(&'static [Setting]),
    /// Entries with names that the project chooses.
    Map(Map),
}

/// One setting.
pub struct Setting {
    /// Its name in the table.
    pub name: &'static str,
    /// A name without a table, such as `max-lines`, for which messages suggest this setting.
    pub flat_name: &'static str,
    /// A description, in one or two sentences.
    pub about: &'static str,
    /// The default, described.
    pub default: &'static str,
    /// A value: the default if it can be written, otherwise an example.
    pub example: &'static str,
    pub(in crate::project::settings) read: fn(&NamedValue<'_>, &mut SettingsReader<'_>),
}

/// Settings of one kind, with names that the project chooses.
pub struct Map {
    /// The meaning of the names.
    pub name: &'static str,
    /// Names of entries without tables, separated by `, `; empty if there are none.
    pub flat_name: &'static str,
    /// The value for names without an entry.
    pub default: &'static str,
    /// Sample entries.
    pub examples: &'static [&'static str],
    /// Reads the entry with this name.
    pub(in crate::project::settings) read: fn(&str, &NamedValue<'_>, &mut SettingsReader<'_>),
}
