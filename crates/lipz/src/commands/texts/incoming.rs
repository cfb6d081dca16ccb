//! Files of translations, read, and what is wrong with them.

use crate::console;
use crate::reporter::{Abort, Reporter};
use crate::shared::{formats, patterns, stdio};
use lipz_diagnostics::{Diagnostic, Report, Source};
use lipz_texts::{Entry, ReadOptions, read};
use std::fs;
use std::path::PathBuf;

/// What was read of the files of translations.
#[derive(Default)]
pub(super) struct Incoming {
    /// Names and texts of the files.
    pub(super) sources: Vec<Source>,
    pub(super) entries: Vec<Entry>,
    /// What was found, with the number of the file.
    pub(super) found: Vec<(usize, Diagnostic)>,
}

impl Incoming {
    /// Reads all files.
    pub(super) fn read(
        files: &[PathBuf],
        named: Option<lipz_texts::Format>,
        options: &ReadOptions,
        reporter: &mut Reporter,
        reports: &mut Vec<Report>,
    ) -> Result<Incoming, Abort> {
        let mut all = Incoming::default();
        for path in patterns::files(files) {
            let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
            let is_standard = stdio::is_meant(&path);
            let Some(format) = lipz_texts::Format::of_extension(extension).or(named) else {
                let message = match is_standard {
                    true => "the format of standard input is not known".to_owned(),
                    false => format!("the extension of `{}` names no format", console::path(&path)),
                };
                let tip = "files of translations end in .po, .xlf, .csv, .tsv, .xlsx or .json; `--text-format` names a format";
                return Err(reporter.usage(message, tip));
            };
            let name = if is_standard { stdio::input_name() } else { console::path(&path) };
            let bytes = if is_standard { stdio::read(u64::MAX) } else { fs::read(&path) };
            let bytes = match bytes {
                Ok(bytes) => bytes,
                Err(error) => {
                    reports.push(formats::unreadable(&path, &error));
                    continue;
                }
            };
            let number = all.sources.len();
            let incoming = read(format, &bytes, options);
            all.entries.extend(incoming.entries.into_iter().map(|mut entry| {
                entry.file = number;
                entry
            }));
            all.found.extend(incoming.diagnostics.into_iter().map(|diagnostic| (number, diagnostic)));
            all.sources.push(Source::new(name, incoming.text));
        }
        Ok(all)
    }

    /// What was found, by files.
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
