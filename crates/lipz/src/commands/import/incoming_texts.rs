//! Translation files as read, with their problems.

use crate::console;
use crate::reporter::{Abort, Reporter};
use crate::shared::{input_file, patterns, stdio};
use lipz_diagnostics::{Diagnostic, Report, Source};
use lipz_texts::{ChosenTake, Entry, ReadOptions, read};
use std::ffi::OsStr;
use std::io;
use std::path::{Path, PathBuf};

/// The contents of the translation files.
#[derive(Default)]
pub(super) struct IncomingTexts {
    /// Names and texts of the files.
    pub(super) sources: Vec<Source>,
    pub(super) entries: Vec<Entry>,
    /// The chosen takes of recording scripts, each with the number of its file.
    pub(super) takes: Vec<(usize, ChosenTake)>,
    /// The diagnostics, each with the number of its file.
    pub(super) found: Vec<(usize, Diagnostic)>,
}

const EXTENSIONS: &str = "use a .po, .xlf, .csv, .tsv, .xlsx, .ods or .json file";
const NAME_STANDARD: &str = "name a file with its extension: `--stdin-filename de-de.po`";

impl IncomingTexts {
    /// Reads all files.
    pub(super) fn read(
        files: &[PathBuf],
        options: &ReadOptions,
        reporter: &mut Reporter,
        reports: &mut Vec<Report>,
    ) -> Result<IncomingTexts, Abort> {
        let mut all = IncomingTexts::default();
        for path in patterns::files(files) {
            let is_standard = stdio::is_meant(&path);
            let named = if is_standard { stdio::name() } else { Some(path.clone()) };
            let extension = named.as_deref().and_then(Path::extension).and_then(OsStr::to_str).unwrap_or_default();
            let Some(format) = lipz_texts::Format::of_extension(extension) else {
                let name = console::path(&path);
                let (message, tip) = match is_standard {
                    true => ("the format of standard input is not set".to_owned(), NAME_STANDARD),
                    false if path.is_dir() => {
                        (format!("`{name}` is a folder"), "name the files in it, as in texts/*.po")
                    }
                    false => (format!("`{name}` does not have the extension of a supported format"), EXTENSIONS),
                };
                return Err(reporter.usage(message, tip));
            };
            let name = if is_standard { stdio::input_name() } else { console::path(&path) };
            let bytes = match is_standard {
                true => input_file::read_from(io::stdin().lock(), 0),
                false => input_file::read(&path),
            };
            let bytes = match bytes {
                Ok(bytes) => bytes,
                Err(error) => {
                    reports.push(input_file::unreadable(&path, &error));
                    continue;
                }
            };
            let number = all.sources.len();
            let incoming = read(format, &bytes, options);
            all.entries.extend(incoming.entries.into_iter().map(|mut entry| {
                entry.file = number;
                entry
            }));
            all.takes.extend(incoming.takes.into_iter().map(|take| (number, take)));
            all.found.extend(incoming.diagnostics.into_iter().map(|diagnostic| (number, diagnostic)));
            all.sources.push(Source::new(name, incoming.text));
        }
        Ok(all)
    }

    /// Returns the diagnostics, grouped by file.
    pub(super) fn reports(self) -> Vec<Report> {
        let mut by_file: Vec<Vec<Diagnostic>> = vec![Vec::new(); self.sources.len()];
        for (file, diagnostic) in self.found {
            if let Some(found) = by_file.get_mut(file) {
                found.push(diagnostic);
            }
        }
        let reports = self.sources.into_iter().zip(by_file).filter(|(_, found)| !found.is_empty());
        reports
            .map(|(source, mut found)| {
                found.sort_by_key(Diagnostic::start);
                lipz_diagnostics::bound::limit(&mut found);
                Report::new(source, found)
            })
            .collect()
    }
}
