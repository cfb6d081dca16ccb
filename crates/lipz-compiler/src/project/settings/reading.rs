//! The state of reading a settings file, and the reading of entries with names chosen by a project.

use super::audio::refused_pattern;
use super::text::LinePixels;
use super::value::{NamedValue, canonical_locale, span};
use super::{NamedFile, Settings, lint};
use crate::files::path::plain;
use crate::project::FileLevels;
use lipz_diagnostics::{Code, Diagnostic, Levels, Source, Span, escape};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toml::de::{DeTable, DeValue};

/// The key for all locales in the coverage table.
const ALL_LOCALES: &str = "all";

/// The settings read so far.
pub(super) struct SettingsReader<'t> {
    pub(super) settings: Settings,
    /// The file, with its name in messages.
    pub(super) source: &'t Arc<Source>,
    pub(super) folder: &'t Path,
    pub(super) diagnostics: Vec<Diagnostic>,
    /// Levels of groups of lints, which apply to lints that are not named individually.
    pub(super) groups: Levels,
    /// The position of each level.
    pub(super) levels: BTreeMap<Code, Span>,
    /// The name of the rig to bake, and its position, until all rigs are read.
    pub(super) baked: Option<(String, Span)>,
    /// The limits in pixels, until all fonts are read.
    pub(super) line_pixels: Vec<LinePixels>,
    /// The entries read with a locale as key, by table and locale.
    pub(super) locales: BTreeSet<(&'static str, String)>,
}

impl SettingsReader<'_> {
    /// Whether any BCP 47 tags are accepted as locales.
    pub(super) fn extended(&self) -> bool {
        self.settings.options.extended_locales
    }

    pub(super) fn refuse(&mut self, value: &NamedValue<'_>, what: &str, help: &str) {
        value.refuse::<()>(what, help, &mut self.diagnostics);
    }

    /// Reads the name of a file, which is read when it is needed.
    pub(super) fn named_file(&mut self, value: &NamedValue<'_>) -> Option<NamedFile> {
        let path = inside(self.folder, value.text(&mut self.diagnostics)?);
        Some(NamedFile::at(path, self.source, value.span()))
    }

    /// Reads a list of words that events may use.
    pub(super) fn words(&mut self, value: &NamedValue<'_>) -> Option<BTreeSet<String>> {
        value.list(&mut self.diagnostics, NamedValue::word).map(FromIterator::from_iter)
    }

    /// Reads the locale in a key.
    pub(super) fn locale_of_key(&mut self, name: &str, value: &NamedValue<'_>) -> Option<String> {
        match canonical_locale(name, self.extended()) {
            Ok(locale) => Some(locale),
            Err((what, help)) => {
                let message = format!("{} {what}", escape::quoted(name));
                self.diagnostics.push(Diagnostic::at(Code::SettingValue, span(&value.key), message).help(help));
                None
            }
        }
    }

    /// Reports a second entry for a locale in a table, whose key has a different spelling than the first.
    pub(super) fn refuse_second(&mut self, table: &'static str, locale: String, value: &NamedValue<'_>) {
        let message = format!("the locale `{locale}` has two entries");
        if self.locales.insert((table, locale)) {
            return;
        }
        let diagnostic = Diagnostic::at(Code::SettingValue, span(&value.key), message);
        self.diagnostics.push(diagnostic.help("remove one of the two"));
    }

    /// Reads the share of clips that must have a text in the locale `name`, or in all.
    pub(super) fn min_coverage(&mut self, name: &str, value: &NamedValue<'_>) {
        let locale = if name == ALL_LOCALES { None } else { Some(self.locale_of_key(name, value)) };
        let Some(percent) = value.percent(&mut self.diagnostics) else { return };
        let wanted = &mut self.settings.options.min_coverage;
        match locale {
            None => wanted.all = Some(percent),
            Some(Some(locale)) => {
                wanted.locales.insert(locale.clone(), percent);
                self.refuse_second("coverage", locale, value);
            }
            Some(None) => {}
        }
    }

    /// Reads the locales that the locale `name` falls back to.
    pub(super) fn fallback(&mut self, name: &str, value: &NamedValue<'_>) {
        let extended = self.extended();
        let locale = self.locale_of_key(name, value);
        let chain = value.list(&mut self.diagnostics, |item, diagnostics| {
            let other = item.locale(extended, diagnostics)?;
            match &locale {
                Some(locale) if *locale == other => {
                    item.refuse("falls back to itself", "name different locales", diagnostics)
                }
                _ => Some(other),
            }
        });
        if let (Some(locale), Some(chain)) = (locale, chain) {
            self.settings.options.fallbacks.insert(locale.clone(), chain);
            self.refuse_second("fallbacks", locale, value);
        }
    }

    /// Reads the recordings of the voice in the locale `name`.
    pub(super) fn voice(&mut self, name: &str, value: &NamedValue<'_>) {
        let locale = self.locale_of_key(name, value);
        let Some(pattern) = value.text(&mut self.diagnostics) else { return };
        if let Some((what, help)) = refused_pattern(pattern) {
            return self.refuse(value, what, help);
        }
        if let Some(locale) = locale {
            self.settings.audio.voices.insert(locale.clone(), pattern.to_owned());
            self.refuse_second("voices", locale, value);
        }
    }

    /// Reads the level of the lint or group `name`, or, for a table, levels for the files that match `name`.
    pub(super) fn level(&mut self, name: &str, value: &NamedValue<'_>) {
        if let DeValue::Table(levels) = value.node.get_ref() {
            return self.levels_of_files(name, value, levels);
        }
        let selection = lint::Selection::named(name);
        if selection.is_none() {
            let message = format!("{} is not a lint", escape::quoted(name));
            let found = Diagnostic::at(Code::UnknownLint, span(&value.key), message);
            self.diagnostics.push(match lint::suggestion(name) {
                Some(known) => found.help(format!("did you mean `{known}`?")).suggest(span(&value.key), known),
                None => found.help("write the name of the lint, or its code, which diagnostics show in brackets"),
            });
        }
        let Some(text) = value.text(&mut self.diagnostics) else { return };
        let level = match lint::level(text) {
            Ok(level) => level,
            Err(meant) => {
                let otherwise = "write \"allow\", \"warn\" or \"deny\"";
                value.refuse_unknown::<()>("is not a level", meant, otherwise, &mut self.diagnostics);
                return;
            }
        };
        match selection {
            Some(lint::Selection::One(code)) => self.level_of(code, level, value),
            Some(group) => self.groups.extend(group.codes().into_iter().map(|code| (code, level))),
            None => {}
        }
    }

    /// Reads levels for the files that match a pattern, which is relative to the folder of the settings.
    fn levels_of_files(&mut self, pattern: &str, value: &NamedValue<'_>, levels: &DeTable<'_>) {
        let project = (std::mem::take(&mut self.groups), std::mem::take(&mut self.levels));
        let project_levels = std::mem::take(&mut self.settings.options.levels);
        for (key, node) in levels {
            let name = dotted(&value.name, key.get_ref());
            let value = NamedValue { name, key: key.span(), node };
            match node.get_ref() {
                DeValue::Table(_) => {
                    self.refuse(&value, "is not a level", "write \"allow\", \"warn\" or \"deny\"");
                }
                _ => self.level(key.get_ref(), &value),
            }
        }
        let mut of_files = std::mem::replace(&mut self.groups, project.0);
        self.levels = project.1;
        of_files.extend(std::mem::replace(&mut self.settings.options.levels, project_levels));
        match FileLevels::new(self.folder, pattern, of_files) {
            Ok(of_files) => self.settings.options.files_levels.push(of_files.at(span(&value.key))),
            Err(error) => {
                let message = format!("{} is not a file pattern: {}", escape::quoted(pattern), error.msg);
                let help =
                    "write a path from the folder of lipz.toml, such as `voices/old/**`; `*` matches all but a slash";
                self.diagnostics.push(Diagnostic::at(Code::SettingValue, span(&value.key), message).help(help));
            }
        }
    }

    fn level_of(&mut self, code: Code, level: Option<lipz_diagnostics::Severity>, value: &NamedValue<'_>) {
        let name = code.name();
        if let Some(why) = lint::refusal(code, level) {
            let message = format!("`{name}` is an error that cannot be lowered");
            let diagnostic =
                Diagnostic::at(Code::FixedLevel, value.span(), message).also(span(&value.key), code.summary());
            self.diagnostics.push(diagnostic.help(why));
        } else if let Some(before) = self.levels.insert(code, span(&value.key)) {
            let message = format!("`{name}` and `{code}` set the level of the same lint");
            let diagnostic =
                Diagnostic::at(Code::SettingValue, span(&value.key), message).also(before, "first definition");
            self.diagnostics.push(diagnostic.help("remove one of the two"));
        } else {
            self.settings.options.levels.set(code, level);
        }
    }
}

/// Returns the name of a setting with that of its table: `text.lines`.
pub(super) fn dotted(table: &str, name: &str) -> String {
    if table.is_empty() { name.to_owned() } else { format!("{table}.{name}") }
}

/// Returns the path of `name`, which is relative to `folder`.
pub(super) fn inside(folder: &Path, name: &str) -> PathBuf {
    plain(&folder.join(name))
}
