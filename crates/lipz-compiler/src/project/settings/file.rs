//! Reading the file `lipz.toml`, with every diagnostic at its position.

use super::Settings;
use super::read;
use crate::files::path::display;
use lipz_diagnostics::{Code, Diagnostic, Report, Source};
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// The maximum length of a settings file. A longer file was named by mistake.
const MAX_BYTES: u64 = 1 << 20;

impl Settings {
    /// Reads the settings file at `path`. Paths in the file are relative to its folder.
    ///
    /// The settings keep the [warnings](Settings::warnings) about the file.
    ///
    /// # Errors
    /// All diagnostics about the file, if it cannot be read or one of them is an error.
    pub fn read(path: impl AsRef<Path>) -> Result<Settings, Report> {
        without_errors(Settings::read_with_report(path))
    }

    /// Reads the settings in `bytes`, with their `name` in messages. Paths in them are relative to `folder`.
    ///
    /// ```
    /// use lipz_compiler::settings::Settings;
    /// let settings = Settings::parse("sources = [\"voices\"]", "lipz.toml", "game")?;
    /// assert_eq!(settings.sources, [std::path::Path::new("game/voices")]);
    ///
    /// let error = Settings::parse("strip = 1", "lipz.toml", "game").unwrap_err();
    /// assert!(error.to_string().starts_with("lipz.toml:1:9: error[LZ1003]"), "{error}");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// All diagnostics, if one of them is an error.
    pub fn parse(
        bytes: impl AsRef<[u8]>,
        name: impl Into<String>,
        folder: impl AsRef<Path>,
    ) -> Result<Settings, Report> {
        without_errors(Settings::parse_with_report(bytes, name, folder))
    }

    /// Reads the settings file at `path`, and continues after errors.
    ///
    /// This is for tools that report everything at once, such as the command `lipz` and editors. Settings with errors
    /// get their defaults, as do all settings of an unreadable file: if the report [has errors](Report::has_errors),
    /// these are not the settings of the project. All other programs should call [`read`](Settings::read).
    #[must_use = "check the report for errors in the settings"]
    pub fn read_with_report(path: impl AsRef<Path>) -> (Settings, Report) {
        let path = path.as_ref();
        let name = display(path);
        match read_limited(path) {
            Ok(bytes) => Settings::parse_with_report(&bytes, name, path.parent().unwrap_or(Path::new(""))),
            Err(error) => (Settings::default(), Report::about(name.as_str(), unreadable(&name, &error))),
        }
    }

    /// Reads the settings in `bytes`, and continues after errors, like
    /// [`read_with_report`](Settings::read_with_report).
    #[must_use = "check the report for errors in the settings"]
    pub fn parse_with_report(
        bytes: impl AsRef<[u8]>,
        name: impl Into<String>,
        folder: impl AsRef<Path>,
    ) -> (Settings, Report) {
        let (name, bytes, folder) = (name.into(), bytes.as_ref(), folder.as_ref());
        // A byte order mark is allowed in TOML.
        let mut diagnostics = Vec::new();
        let settings = match lipz_file::decode_marked(bytes, &mut diagnostics) {
            Some(text) => read::read(Source::new(name.as_str(), text), folder, &mut diagnostics),
            None => Settings::default(),
        };
        settings.options.levels.apply(&mut diagnostics);
        diagnostics.sort_by_key(Diagnostic::start);
        (settings, Report::from_bytes(name, bytes, diagnostics))
    }
}

/// Returns the settings with their warnings, unless there are errors.
fn without_errors((mut settings, report): (Settings, Report)) -> Result<Settings, Report> {
    if report.has_errors() {
        return Err(report);
    }
    settings.warnings = (!report.diagnostics.is_empty()).then_some(report);
    Ok(settings)
}

/// Returns the bytes of a settings file, up to just above its maximum length.
fn read_limited(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(path)?.take(MAX_BYTES + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MAX_BYTES { Err(io::ErrorKind::FileTooLarge.into()) } else { Ok(bytes) }
}

fn unreadable(name: &str, error: &io::Error) -> Diagnostic {
    let diagnostic =
        |what: &str| Diagnostic::new(Code::SettingsUnreadable, format!("the settings file `{name}` {what}"));
    match error.kind() {
        io::ErrorKind::NotFound => diagnostic("does not exist").help("check the spelling of the path"),
        io::ErrorKind::IsADirectory => diagnostic("is a folder").help("name the file in it"),
        io::ErrorKind::FileTooLarge => diagnostic("is larger than 1 MiB").help("name a settings file: lipz.toml"),
        _ => diagnostic(&format!("cannot be read: {error}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_is_too_long_is_not_read() {
        let file = tempfile::NamedTempFile::new().unwrap();
        let diagnostics = || Settings::read_with_report(file.path()).1.diagnostics;
        file.as_file().set_len(MAX_BYTES).unwrap();
        assert!(diagnostics().iter().all(|diagnostic| diagnostic.code != Code::SettingsUnreadable));
        file.as_file().set_len(MAX_BYTES + 1).unwrap();
        assert!(diagnostics().iter().any(|diagnostic| diagnostic.code == Code::SettingsUnreadable));
    }

    #[test]
    fn a_file_with_errors_gives_no_settings() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("lipz.toml");
        let missing = Settings::read(&file).unwrap_err();
        assert_eq!(missing.diagnostics[0].code, Code::SettingsUnreadable);
        std::fs::write(&file, "strip = true\nsourcs = []\n").unwrap();
        assert_eq!(Settings::read(&file).unwrap_err(), Settings::read_with_report(&file).1);
        std::fs::write(&file, "strip = true\n").unwrap();
        let settings = Settings::read(&file).unwrap();
        assert!(settings.options.strip && settings.warnings().is_empty());
    }

    #[test]
    fn settings_keep_their_warnings() {
        let warning = Report::about("lipz.toml", Diagnostic::new(Code::ByteOrderMark, "a mark"));
        let settings = without_errors((Settings::default(), warning.clone())).unwrap();
        assert_eq!(settings.warnings(), [warning]);
    }
}
