//! Assignment of subtitle files to clips by name.

use crate::Abort;
use crate::console;
use crate::reporter::Reporter;
use crate::shared::input_file;
use lipz_compiler::Options;
use lipz_diagnostics::{Code, Diagnostic, Report, Severity};
use lipz_file::locale::{canonical_tag, language, unknown_parts};
use lipz_interop::subtitles::SubtitleFormat;
use std::io;
use std::path::{Path, PathBuf};
use walkdir::WalkDir;

/// A subtitle file.
pub(super) struct SubtitleFile {
    pub(super) path: PathBuf,
    /// The key of its clip.
    pub(super) key: String,
    pub(super) locale: String,
    pub(super) format: SubtitleFormat,
}

/// Finds subtitle files among the arguments and in their folders. Keys are relative to these folders.
pub(super) fn find(
    named: &[PathBuf],
    options: &Options,
    reports: &mut Vec<Report>,
    reporter: &mut Reporter,
) -> Result<Vec<SubtitleFile>, Abort> {
    let mut found = Vec::new();
    for place in named {
        let (files_before, reports_before) = (found.len(), reports.len());
        for entry in
            WalkDir::new(place).sort_by_file_name().into_iter().filter_entry(|entry| !input_file::is_hidden(entry))
        {
            match entry {
                Ok(entry) if entry.file_type().is_dir() => {}
                Ok(entry) => match format(entry.path()) {
                    Some(format) => match file(place, entry.path(), format, options) {
                        Ok(file) => found.push(file),
                        Err(report) => reports.push(report),
                    },
                    None if entry.depth() == 0 => {
                        let message = format!("`{}` does not have the extension .srt or .vtt", console::path(place));
                        return Err(reporter.usage(&message, "rename it after its format"));
                    }
                    // Folders may contain other files.
                    None => {}
                },
                Err(error) => reports.push(unreadable(place, &error)),
            }
        }
        if found.len() == files_before && reports.len() == reports_before {
            let shown = console::path(place);
            let diagnostic = Diagnostic::new(Code::NoSources, format!("no subtitle files in `{shown}`"));
            reports.push(Report::about(shown, diagnostic.help("name files with the extension .srt or .vtt")));
        }
    }
    Ok(found)
}

fn unreadable(place: &Path, error: &walkdir::Error) -> Report {
    let path = error.path().unwrap_or(place);
    match error.io_error() {
        Some(error) => input_file::unreadable(path, error),
        None => input_file::unreadable(path, &io::Error::other("a link leads back to a folder above it")),
    }
}

fn format(path: &Path) -> Option<SubtitleFormat> {
    SubtitleFormat::of_extension(path.extension()?.to_str()?)
}

/// Derives clip and locale from the name of a file: `act1/mayor.de-de.vtt` is clip `act1/mayor` in `de-de`.
fn file(place: &Path, path: &Path, format: SubtitleFormat, options: &Options) -> Result<SubtitleFile, Report> {
    let inside = path.strip_prefix(place).ok().filter(|inside| !inside.as_os_str().is_empty());
    let inside = inside.or_else(|| path.file_name().map(Path::new)).unwrap_or(path).with_extension("");
    let parts: Vec<_> = inside.components().map(|part| part.as_os_str().to_string_lossy()).collect();
    let stem = parts.join("/");
    let tagged =
        stem.rsplit_once('.').and_then(|(key, tag)| Some((key, canonical_tag(tag, options.get_extended_locales())?)));
    let suffix = stem.rsplit_once('.').filter(|(_, suffix)| is_language(suffix));
    let (key, locale) = match (tagged, suffix, options.get_default_locale()) {
        (Some((key, locale)), ..) => (key.to_owned(), locale),
        (None, Some((key, suffix)), Some(locale)) if suffix.eq_ignore_ascii_case(language(locale)) => {
            (key.to_owned(), locale.to_owned())
        }
        (None, None, Some(locale)) => (stem, locale.to_owned()),
        (None, suffix, _) => {
            let shown = console::path(path);
            let mut diagnostic = Diagnostic::new(Code::TextLeftOut, format!("`{shown}` does not name its locale"));
            // No clip is written for the file.
            diagnostic.severity = Severity::Error;
            if let Some((_, suffix)) = suffix {
                diagnostic = diagnostic.note(format!("`{suffix}` is a language without a country"));
            }
            let extension = format.extension();
            let help = match suffix {
                Some((key, _)) => format!("add the country to the name, as in {key}.en-us.{extension}"),
                None => format!("rename it to {stem}.en-us.{extension}, or name the locale: --locale en-us"),
            };
            return Err(Report::about(shown, diagnostic.help(help)));
        }
    };
    Ok(SubtitleFile { path: path.to_owned(), key, locale, format })
}

/// Whether the end of a name is a language, as in `movie.de.srt`.
fn is_language(suffix: &str) -> bool {
    suffix.len() == 2 && !unknown_parts(&suffix.to_ascii_lowercase()).0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_tell_clip_and_locale() {
        let options = |default: Option<&str>| {
            let options = Options::new();
            default.map_or(options.clone(), |locale| options.default_locale(locale).unwrap())
        };
        let of = |place: &str, path: &str, default| {
            let found = file(place.as_ref(), path.as_ref(), SubtitleFormat::Srt, &options(default)).ok()?;
            Some((found.key, found.locale))
        };
        let some = |key: &str, locale: &str| Some((key.to_owned(), locale.to_owned()));
        assert_eq!(of("in", "in/act1/mayor.de-de.srt", None), some("act1/mayor", "de-de"));
        assert_eq!(of("in/mayor.de_DE.srt", "in/mayor.de_DE.srt", None), some("mayor", "de-de"));
        assert_eq!(of("in", "in/mayor.take.2.srt", Some("en-us")), some("mayor.take.2", "en-us"));
        assert_eq!(of("in", "in/mayor.srt", None), None);
        assert_eq!(of("in", "in/mayor.de.srt", None), None);
        assert_eq!(of("in", "in/mayor.de.srt", Some("de-at")), some("mayor", "de-at"));
        assert_eq!(of("in", "in/mayor.de.srt", Some("en-us")), None, "another language");
    }
}
