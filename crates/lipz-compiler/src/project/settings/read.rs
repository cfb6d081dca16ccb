//! Conversion of the TOML of a settings file to settings: tables and names, known and unknown.

use super::Settings;
use super::reading::{SettingsReader, dotted};
use super::syntax::Faults;
use super::table::{Content, TABLES, Table, find_flat};
use super::value::{NamedValue, span};
use crate::files::path::plain;
use lipz_diagnostics::{Code, Diagnostic, Levels, Source, escape, suggest::nearest};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::Arc;
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

/// Reads the settings in `source`, with paths relative to `folder`.
pub(super) fn read(source: Source, folder: &Path, diagnostics: &mut Vec<Diagnostic>) -> Settings {
    let (mut settings, levels) = read_over(Settings::default(), source, folder, diagnostics);
    settings.options.levels = levels;
    if settings.sources.is_empty() {
        settings.sources.push(plain(folder));
    }
    settings
}

/// Returns `settings` overridden by those in `source`, and the levels in `source` separately.
pub(super) fn read_over(
    settings: Settings,
    source: Source,
    folder: &Path,
    diagnostics: &mut Vec<Diagnostic>,
) -> (Settings, Levels) {
    let source = Arc::new(source);
    let text = source.text.as_str();
    let (root, errors) = DeTable::parse_recoverable(text);
    let mut reading = SettingsReader {
        settings,
        source: &source,
        folder,
        diagnostics: Vec::new(),
        groups: Levels::new(),
        levels: BTreeMap::new(),
        baked: None,
        line_pixels: Vec::new(),
        locales: BTreeSet::new(),
    };
    let before = std::mem::take(&mut reading.settings.options.levels);
    for table in TABLES {
        reading.table(table, root.get_ref());
    }
    reading.resolve_baked_rig();
    reading.check_line_pixels();
    reading.unknown_names("", root.get_ref());
    let SettingsReader { mut settings, groups: mut levels, diagnostics: mut found, .. } = reading;
    levels.extend(std::mem::replace(&mut settings.options.levels, before));
    let faults = Faults::new(text, &errors);
    found.retain(|diagnostic| {
        let places = diagnostic.primary.iter().chain(&diagnostic.labels);
        !places.into_iter().any(|label| faults.may_have_made_up(label.span))
    });
    diagnostics.extend(faults.diagnostics(root.get_ref()));
    diagnostics.append(&mut found);
    (settings, levels)
}

impl<'t> SettingsReader<'t> {
    /// Reads the settings of one table.
    fn table(&mut self, table: &Table, root: &'t DeTable<'t>) {
        let entries = match table.name {
            "" => root,
            name => match root.get_key_value(name) {
                None => return,
                Some((key, node)) => match node.get_ref() {
                    DeValue::Table(entries) => entries,
                    _ => {
                        let value = NamedValue { name: name.to_owned(), key: key.span(), node };
                        let help = format!("write [{name}] on its own line, and its settings below");
                        value.wrong_type::<()>("a table", &help, &mut self.diagnostics);
                        return;
                    }
                },
            },
        };
        match &table.content {
            Content::Settings(settings) => {
                for setting in *settings {
                    if let Some((key, node)) = entries.get_key_value(setting.name) {
                        let name = dotted(table.name, setting.name);
                        (setting.read)(&NamedValue { name, key: key.span(), node }, self);
                    }
                }
                if !table.name.is_empty() {
                    self.unknown_names(table.name, entries);
                }
            }
            Content::Map(map) => {
                // The parser sorts entries by name, but the last of several patterns applies.
                let mut in_order: Vec<_> = entries.iter().collect();
                in_order.sort_by_key(|(key, _)| key.span().start);
                for (key, node) in in_order {
                    let name = dotted(table.name, key.get_ref());
                    (map.read)(key.get_ref(), &NamedValue { name, key: key.span(), node }, self);
                }
            }
        }
    }

    /// Reports the entries of a table that are not settings.
    fn unknown_names(&mut self, table: &str, entries: &DeTable<'_>) {
        let known = names(table);
        for (key, _) in entries.iter().filter(|(key, _)| !known.contains(&key.get_ref().as_ref())) {
            self.diagnostics.push(unknown_name(table, key, &known));
        }
    }
}

/// Returns the allowed names in a table; in the root, also the names of the other tables.
fn names(table: &str) -> Vec<&'static str> {
    let own = TABLES.iter().filter(|found| found.name == table).flat_map(setting_names);
    let tables = TABLES.iter().map(|table| table.name).filter(|name| table.is_empty() && !name.is_empty());
    own.chain(tables).collect()
}

fn setting_names(table: &Table) -> impl Iterator<Item = &'static str> {
    let settings = match table.content {
        Content::Settings(settings) => settings,
        Content::Map(_) => &[],
    };
    settings.iter().map(|setting| setting.name)
}

fn unknown_name(table: &str, key: &Spanned<DeString<'_>>, known: &[&'static str]) -> Diagnostic {
    let name = key.get_ref().as_ref();
    let diagnostic = |what: &str| {
        Diagnostic::at(Code::UnknownSetting, span(&key.span()), format!("{} {what}", escape::quoted(name)))
    };
    // A setting after a table's header belongs to the table, which is the usual mistake.
    if let Some(other) = TABLES.iter().find(|other| setting_names(other).any(|setting| setting == name)) {
        return match (other.name, table) {
            ("", table) => diagnostic(&format!("is not a setting of [{table}]")).help("write it above the first table"),
            (other, _) => diagnostic(&format!("is a setting of [{other}]")).help(format!("write it below [{other}]")),
        };
    }
    let place = if table.is_empty() { "is not a setting".to_owned() } else { format!("is not a setting of [{table}]") };
    if let Some(help) = of_flat_name(name) {
        return diagnostic(&place).help(help);
    }
    // Inside a table, suggesting a root-level name would lead to the next mistake.
    let elsewhere = || {
        let others = TABLES.iter().filter(|other| table.is_empty() || !other.name.is_empty());
        others.flat_map(setting_names)
    };
    match nearest(name, known.iter().copied()).or_else(|| nearest(name, elsewhere())) {
        Some(known) => diagnostic(&place).help(format!("did you mean `{known}`?")).suggest(span(&key.span()), known),
        None => diagnostic(&place).help(match table {
            "" => format!("the settings and tables are {}", known.join(", ")),
            table => format!("the settings of [{table}] are {}", known.join(", ")),
        }),
    }
}

/// Returns the help for a setting that users expect outside its table.
fn of_flat_name(name: &str) -> Option<String> {
    let (table, setting) = find_flat(name)?;
    Some(match &table.content {
        Content::Settings(_) => format!("write `{name}` as `{setting}` in [{}]", table.name),
        Content::Map(map) => format!("write `{name}` as an entry of [{}]: {}", table.name, map.examples.first()?),
    })
}
