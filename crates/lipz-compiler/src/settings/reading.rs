//! From the TOML of a settings file to settings: tables and names, known and unknown.

use super::audio::refused_pattern;
use super::syntax::Faults;
use super::table::{Content, TABLES, Table};
use super::value::{Value, canonical_locale, span};
use super::{Settings, lint};
use crate::FileLevels;
use crate::discover::plain;
use lipz_diagnostics::{Code, Diagnostic, Levels, Span, escape, suggest::nearest};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

/// What stands for every locale in the table of coverage.
const ALL_LOCALES: &str = "all";

/// What was read so far.
pub(super) struct Reading<'t> {
    pub(super) settings: Settings,
    pub(super) folder: &'t Path,
    pub(super) diagnostics: Vec<Diagnostic>,
    /// Levels of groups of lints: they hold where no lint is named by itself.
    groups: Levels,
    /// Where each level was set.
    levels: BTreeMap<Code, Span>,
}

/// The settings in `text`, with paths that count from `folder`.
pub(super) fn read(text: &str, folder: &Path, diagnostics: &mut Vec<Diagnostic>) -> Settings {
    let (root, errors) = DeTable::parse_recoverable(text);
    let mut reading = Reading {
        settings: Settings::default(),
        folder,
        diagnostics: Vec::new(),
        groups: Levels::new(),
        levels: BTreeMap::new(),
    };
    for table in TABLES {
        reading.table(table, root.get_ref());
    }
    reading.unknown_names("", root.get_ref());
    let Reading { mut settings, groups, diagnostics: mut found, .. } = reading;
    let named = std::mem::replace(&mut settings.options.levels, groups);
    settings.options.levels.extend(named);
    if settings.sources.is_empty() {
        settings.sources.push(plain(folder));
    }
    let faults = Faults::new(text, &errors);
    found.retain(|diagnostic| {
        let places = diagnostic.primary.iter().chain(&diagnostic.labels);
        !places.into_iter().any(|label| faults.may_have_made_up(label.span))
    });
    diagnostics.extend(faults.diagnostics(root.get_ref()));
    diagnostics.append(&mut found);
    settings
}

impl<'t> Reading<'t> {
    /// Reads the settings of one table.
    fn table(&mut self, table: &Table, root: &'t DeTable<'t>) {
        let entries = match table.name {
            "" => root,
            name => match root.get_key_value(name) {
                None => return,
                Some((key, node)) => match node.get_ref() {
                    DeValue::Table(entries) => entries,
                    _ => {
                        let value = Value { name: name.to_owned(), key: key.span(), node };
                        let help = format!("write [{name}] on a line of its own, and its settings below");
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
                        (setting.read)(&Value { name, key: key.span(), node }, self);
                    }
                }
                if !table.name.is_empty() {
                    self.unknown_names(table.name, entries);
                }
            }
            Content::Map(map) => {
                for (key, node) in entries {
                    let name = dotted(table.name, key.get_ref());
                    (map.read)(key.get_ref(), &Value { name, key: key.span(), node }, self);
                }
            }
        }
    }

    /// Reports the entries of a table that are no settings.
    fn unknown_names(&mut self, table: &str, entries: &DeTable<'_>) {
        let known = names(table);
        for (key, _) in entries.iter().filter(|(key, _)| !known.contains(&key.get_ref().as_ref())) {
            self.diagnostics.push(unknown_name(table, key, &known));
        }
    }

    /// Whether locales may be any BCP 47 tags.
    pub(super) fn extended(&self) -> bool {
        self.settings.options.extended_locales
    }

    pub(super) fn refuse(&mut self, value: &Value<'_>, what: &str, help: &str) {
        value.refuse::<()>(what, help, &mut self.diagnostics);
    }

    /// A list of words that events mention.
    pub(super) fn words(&mut self, value: &Value<'_>) -> Option<BTreeSet<String>> {
        value.list(&mut self.diagnostics, Value::word).map(FromIterator::from_iter)
    }

    /// The locale that a key names.
    fn locale_of_key(&mut self, name: &str, value: &Value<'_>) -> Option<String> {
        match canonical_locale(name, self.extended()) {
            Ok(locale) => Some(locale),
            Err((what, help)) => {
                let message = format!("{} {what}", escape::quoted(name));
                self.diagnostics.push(Diagnostic::at(Code::SettingValue, span(&value.key), message).help(help));
                None
            }
        }
    }

    /// Reports the second entry of a locale, whose key spells it in another way than the first.
    fn locale_twice(&mut self, locale: &str, value: &Value<'_>) {
        let message = format!("a second entry for the locale `{locale}`");
        let diagnostic = Diagnostic::at(Code::SettingValue, span(&value.key), message);
        self.diagnostics.push(diagnostic.help("remove one of the two"));
    }

    /// The share of the clips that must have a text in the locale `name`, or in all.
    pub(super) fn min_coverage(&mut self, name: &str, value: &Value<'_>) {
        let locale = if name == ALL_LOCALES { None } else { Some(self.locale_of_key(name, value)) };
        let Some(percent) = value.percent(&mut self.diagnostics) else { return };
        let wanted = &mut self.settings.options.min_coverage;
        match locale {
            None => wanted.all = Some(percent),
            Some(Some(locale)) => {
                if wanted.locales.insert(locale.clone(), percent).is_some() {
                    self.locale_twice(&locale, value);
                }
            }
            Some(None) => {}
        }
    }

    /// The locales that the locale `name` falls back to.
    pub(super) fn fallback(&mut self, name: &str, value: &Value<'_>) {
        let extended = self.extended();
        let locale = self.locale_of_key(name, value);
        let chain = value.list(&mut self.diagnostics, |item, diagnostics| {
            let other = item.locale(extended, diagnostics)?;
            match &locale {
                Some(locale) if *locale == other => {
                    item.refuse("falls back to itself", "name other locales", diagnostics)
                }
                _ => Some(other),
            }
        });
        if let (Some(locale), Some(chain)) = (locale, chain)
            && self.settings.options.fallbacks.insert(locale.clone(), chain).is_some()
        {
            self.locale_twice(&locale, value);
        }
    }

    /// The recordings of the voice in the locale `name`.
    pub(super) fn voice(&mut self, name: &str, value: &Value<'_>) {
        let locale = self.locale_of_key(name, value);
        let Some(pattern) = value.text(&mut self.diagnostics) else { return };
        if let Some((what, help)) = refused_pattern(pattern) {
            return self.refuse(value, what, help);
        }
        if let Some(locale) = locale
            && self.settings.audio.voices.insert(locale.clone(), pattern.to_owned()).is_some()
        {
            self.locale_twice(&locale, value);
        }
    }

    /// The level of the lint or group `name`; or levels for the files that it matches, if it has a table.
    pub(super) fn level(&mut self, name: &str, value: &Value<'_>) {
        if let DeValue::Table(levels) = value.node.get_ref() {
            return self.levels_of_files(name, value, levels);
        }
        let selection = lint::Selection::named(name);
        if selection.is_none() {
            let message = format!("{} is not a lint", escape::quoted(name));
            let help = match lint::suggestion(name) {
                Some(known) => format!("did you mean `{known}`?"),
                None => "diagnostics show their code in brackets: write that, or the name of the lint".to_owned(),
            };
            self.diagnostics.push(Diagnostic::at(Code::UnknownLint, span(&value.key), message).help(help));
        }
        let Some(text) = value.text(&mut self.diagnostics) else { return };
        let level = match lint::level(text) {
            Ok(level) => level,
            Err(meant) => {
                let help = match meant {
                    Some(known) => format!("did you mean \"{known}\"?"),
                    None => "the levels are \"allow\", \"warn\" and \"deny\"".to_owned(),
                };
                return self.refuse(value, "is not a level", &help);
            }
        };
        match selection {
            Some(lint::Selection::One(code)) => self.level_of(code, level, value),
            Some(group) => self.groups.extend(group.codes().into_iter().map(|code| (code, level))),
            None => {}
        }
    }

    /// Levels for the files that match a pattern, which counts from the folder of the settings.
    fn levels_of_files(&mut self, pattern: &str, value: &Value<'_>, levels: &DeTable<'_>) {
        let project = (std::mem::take(&mut self.groups), std::mem::take(&mut self.levels));
        let project_levels = std::mem::take(&mut self.settings.options.levels);
        for (key, node) in levels {
            let name = dotted(&value.name, key.get_ref());
            let value = Value { name, key: key.span(), node };
            match node.get_ref() {
                DeValue::Table(_) => {
                    self.refuse(&value, "is not a level", "the levels are \"allow\", \"warn\" and \"deny\"");
                }
                _ => self.level(key.get_ref(), &value),
            }
        }
        let mut of_files = std::mem::replace(&mut self.groups, project.0);
        self.levels = project.1;
        of_files.extend(std::mem::replace(&mut self.settings.options.levels, project_levels));
        match FileLevels::new(self.folder, pattern, of_files) {
            Ok(of_files) => self.settings.options.files_levels.push(of_files),
            Err(error) => {
                let message = format!("{} is not a pattern of files: {}", escape::quoted(pattern), error.msg);
                let help = "write paths from the folder of lipz.toml: `voices/old/**`; `*` matches all but a slash";
                self.diagnostics.push(Diagnostic::at(Code::SettingValue, span(&value.key), message).help(help));
            }
        }
    }

    fn level_of(&mut self, code: Code, level: Option<lipz_diagnostics::Severity>, value: &Value<'_>) {
        let name = code.name();
        if let Some(why) = lint::refusal(code, level) {
            let message = format!("`{name}` is an error that cannot be lowered");
            let diagnostic =
                Diagnostic::at(Code::FixedLevel, value.span(), message).also(span(&value.key), code.summary());
            self.diagnostics.push(diagnostic.help(why));
        } else if let Some(before) = self.levels.insert(code, span(&value.key)) {
            let message = format!("`{name}` and `{code}` are one lint, whose level is set twice");
            let diagnostic =
                Diagnostic::at(Code::SettingValue, span(&value.key), message).also(before, "the first one");
            self.diagnostics.push(diagnostic.help("remove one of the two"));
        } else {
            self.settings.options.levels.set(code, level);
        }
    }
}

/// The names that may stand in a table; in the root also those of the other tables.
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
    // A setting below a table's name belongs to the table: the usual slip.
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
    // In a table, a name of the whole file would be the next mistake.
    let elsewhere = || {
        let others = TABLES.iter().filter(|other| table.is_empty() || !other.name.is_empty());
        others.flat_map(setting_names)
    };
    match nearest(name, known.iter().copied()).or_else(|| nearest(name, elsewhere())) {
        Some(known) => diagnostic(&place).help(format!("did you mean `{known}`?")),
        None => diagnostic(&place).help(match table {
            "" => format!("settings and tables are {}", known.join(", ")),
            table => format!("the settings of [{table}] are {}", known.join(", ")),
        }),
    }
}

/// Where the file has the setting with this name, which holds where there are no tables.
fn of_flat_name(name: &str) -> Option<String> {
    let is_meant = |names: &str| names.split(", ").any(|flat| flat == name);
    TABLES.iter().find_map(|table| match &table.content {
        Content::Settings(settings) => settings
            .iter()
            .find(|setting| is_meant(setting.flat_name))
            .map(|setting| format!("`{name}` is `{}` in [{}]", setting.name, table.name)),
        Content::Map(map) => {
            let entry = || Some(format!("`{name}` is an entry of [{}]: {}", table.name, map.examples.first()?));
            is_meant(map.flat_name).then(entry).flatten()
        }
    })
}

/// The name of a setting with that of its table: `text.lines`.
fn dotted(table: &str, name: &str) -> String {
    if table.is_empty() { name.to_owned() } else { format!("{table}.{name}") }
}
