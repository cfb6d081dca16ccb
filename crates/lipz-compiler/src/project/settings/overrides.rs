//! Settings on a command line, which override those of the file.

use super::{Settings, read};
use lipz_diagnostics::{Diagnostic, Report, Source};
use std::path::Path;
use toml::de::DeTable;

impl Settings {
    /// Overrides settings with assignments such as `text.lines=2`: the table, a dot, and the name of a setting; and a
    /// value in TOML, or a string without its quotes. If several assignments set the same setting, the last one
    /// applies. Levels of lints apply to all files and override the settings for individual files. Paths are relative
    /// to the current folder.
    ///
    /// ```
    /// use lipz_compiler::settings::Settings;
    /// let mut settings = Settings::parse("sources = [\"voices\"]", "lipz.toml", "")?;
    /// settings.assign(["strip=true", "output=dialogue.lipzbank"], "--config")?;
    /// assert_eq!(settings.output.as_deref(), Some("dialogue.lipzbank".as_ref()));
    ///
    /// let error = settings.assign(["text.line=2"], "--config").unwrap_err();
    /// assert!(error.to_string().starts_with("--config:1:6: error[LZ1002]"), "{error}");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// All diagnostics about the assignments, with their `name` in messages, if there are errors. The settings then
    /// stay unchanged.
    pub fn assign<'a>(
        &mut self,
        assignments: impl IntoIterator<Item = &'a str>,
        name: impl Into<String>,
    ) -> Result<Vec<Report>, Report> {
        let (name, text) = (name.into(), document(assignments));
        let source = Source::new(name.as_str(), text.as_str());
        let mut diagnostics = Vec::new();
        let (mut settings, levels) = read::read_over(self.clone(), source, Path::new(""), &mut diagnostics);
        levels.into_iter().for_each(|(code, level)| settings.options.overrule(code, level));
        settings.options.levels.apply(&mut diagnostics);
        diagnostics.sort_by_key(Diagnostic::start);
        let report = Report::from_bytes(name, text.as_bytes(), diagnostics);
        if report.has_errors() {
            return Err(report);
        }
        *self = settings;
        Ok(if report.diagnostics.is_empty() { Vec::new() } else { vec![report] })
    }
}

/// Returns a TOML document with all assignments, one per line.
fn document<'a>(assignments: impl IntoIterator<Item = &'a str>) -> String {
    let mut lines: Vec<(&str, String)> = Vec::new();
    for assignment in assignments {
        let (key, value) = assignment.split_once('=').unwrap_or((assignment, ""));
        let key = key.trim();
        lines.retain(|(before, _)| *before != key);
        lines.push((key, line(key, value.trim())));
    }
    lines.into_iter().map(|(_, line)| line + "\n").collect()
}

/// Returns one assignment. A value that is not TOML is a string, because shells remove the quotes.
fn line(key: &str, value: &str) -> String {
    let is_toml = |line: &str| DeTable::parse(line).is_ok();
    let (plain, quoted) = (format!("{key}={value}"), format!("{key}={}", lipz_file::literal(value)));
    let has_lines = value.contains(['\n', '\r']);
    if has_lines || (!is_toml(&plain) && is_toml(&quoted)) { quoted } else { plain }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settings(file: &str, assignments: &[&str]) -> Settings {
        let mut settings = Settings::parse(file, "lipz.toml", "").unwrap();
        assert_eq!(settings.assign(assignments.iter().copied(), "--config").unwrap(), []);
        settings
    }

    #[test]
    fn assignments_replace_what_the_file_says() {
        let file = "strip = true\n[text]\nlines = 3\nline-columns = 40\n[coverage]\nall = 50\nde-de = 90\n";
        let assigned = settings(file, &["text.lines=2", "coverage.de-de = 100", "strip=false", "root=voices/a"]);
        let limits = assigned.options.get_text_limits();
        assert_eq!((limits.lines, limits.line_columns), (Some(2), Some(40)));
        let coverage = assigned.options.get_min_coverage();
        assert_eq!((coverage.all, coverage.locales["de-de"]), (Some(50.0), 100.0));
        assert!(!assigned.options.strip && assigned.root == Some("voices/a".into()));
        assert_eq!(assigned.sources, settings(file, &[]).sources);
    }

    #[test]
    fn texts_need_no_quotes() {
        // Decomposed, as macOS returns the names of files, with the characters that TOML escapes.
        for path in ["e\u{301}.lipzbank", "C:\\a b\\\u{200b}.lipzbank", "it's \"b\".lipzbank"] {
            let assigned = settings("", &[&format!("output={path}")]);
            assert_eq!(assigned.output, Some(path.into()), "{path}");
        }
    }

    #[test]
    fn lists_are_toml_and_the_last_of_two_values_holds() {
        let assigned = settings("", &["locales=['de-de']", "extended-locales=true", "locales=[\"es-419\"]"]);
        assert_eq!(assigned.options.get_locales().unwrap().iter().collect::<Vec<_>>(), ["es-419"]);
    }

    #[test]
    fn levels_hold_for_all_files() {
        let file = "[lints]\nwarnings = \"deny\"\n\"old/**\" = { unknown-emotion = \"allow\" }\n";
        let deny = settings(file, &["lints.unknown-emotion=warn"]);
        let code = lipz_diagnostics::Code::UnknownEmotion;
        for file in ["old/a.lipz", "new/a.lipz"] {
            assert_eq!(deny.options.levels_for(file).severity(code), Some(lipz_diagnostics::Severity::Warning));
        }
    }

    #[test]
    fn what_is_wrong_changes_nothing_and_has_its_place() {
        for (assignment, place) in [("lines=2", "1:1"), ("strip=maybe", "1:7"), ("text.lines", "1:"), ("=", "1:")] {
            let mut assigned = settings("strip = true", &[]);
            let error = assigned.assign(["pseudo=true", assignment], "--config").unwrap_err();
            let place = place.replacen('1', "2", 1);
            assert!(error.to_string().contains(&format!("--config:{place}")), "{assignment}: {error}");
            assert!(assigned.options.strip && !assigned.options.pseudo);
        }
    }
}
