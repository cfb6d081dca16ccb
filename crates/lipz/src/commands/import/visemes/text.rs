//! `--script`: the transcript of one clip, or a folder of transcripts.

use crate::console;
use crate::shared::input_file::{self, is_hidden, unreadable};
use lipz_compiler::key;
use lipz_diagnostics::{Code, Diagnostic, Report};
use lipz_interop::{Encoding, to_utf8};
use std::cell::OnceCell;
use std::collections::HashMap;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use walkdir::WalkDir;

/// The extension of text files in a folder, after the key.
pub(super) const EXTENSION: &str = "txt";

/// The source of the clips' texts.
pub(super) enum TextSource {
    /// The imported files themselves, or no source.
    OfFiles,
    /// The text of the one clip.
    One(String),
    /// A folder with a file `KEY.txt` for each clip.
    Folder(TextFolder),
}

/// A folder of texts.
pub(super) struct TextFolder {
    pub(super) path: PathBuf,
    /// The encoding of files that are not UTF-8.
    encoding: Option<&'static Encoding>,
    /// The keys of its texts, by the keys that some file systems treat as equal. Read when a key has no file.
    keys: OnceCell<HashMap<String, String>>,
}

impl TextSource {
    /// Reads the texts that `--script` names. A single file cannot serve `several` clips. Files that are not UTF-8 are
    /// in `encoding`. Adds warnings about the file to `reports`.
    pub(super) fn from_argument(
        named: Option<&Path>,
        several: bool,
        encoding: Option<&'static Encoding>,
        reports: &mut Vec<Report>,
    ) -> Result<TextSource, Report> {
        let Some(path) = named else { return Ok(TextSource::OfFiles) };
        if path.is_dir() {
            return Ok(TextSource::Folder(TextFolder { path: path.to_owned(), encoding, keys: OnceCell::new() }));
        }
        if several {
            let help = "name a folder that has a file KEY.txt for each of them";
            return Err(Report::failure("", Code::Usage, "several files cannot have the same text", help));
        }
        text(path, encoding, reports).map(TextSource::One)
    }

    /// Returns the text of the clip with this key, if it has one. Adds warnings about its file to `reports`.
    pub(super) fn of_key(&self, key: &str, reports: &mut Vec<Report>) -> Result<Option<String>, Report> {
        match self {
            TextSource::OfFiles => Ok(None),
            TextSource::One(text) => Ok(Some(text.clone())),
            TextSource::Folder(folder) => {
                folder.file(key).map(|path| text(&path, folder.encoding, reports)).transpose()
            }
        }
    }
}

impl TextFolder {
    /// Returns the file with the text of a key. Case and Unicode normalisation may differ.
    fn file(&self, key: &str) -> Option<PathBuf> {
        let path = |key: &str| Some(self.path.join(format!("{key}.{EXTENSION}"))).filter(|path| path.is_file());
        let by_folded = || {
            let keys = self.keys(|_| false).unwrap_or_default();
            keys.into_iter().map(|key| (key::folded(&key), key)).collect()
        };
        path(key).or_else(|| path(self.keys.get_or_init(by_folded).get(&key::folded(key))?))
    }

    /// Returns the keys of the texts in order, without hidden files and those for which `is_other` is true.
    pub(super) fn keys(&self, is_other: impl Fn(&Path) -> bool) -> Result<Vec<String>, Report> {
        let entries = WalkDir::new(&self.path).follow_links(true).sort_by_file_name().into_iter();
        let mut keys = Vec::new();
        for entry in entries.filter_entry(|entry| !is_hidden(entry)) {
            let entry = entry.map_err(|error| {
                let message = format!("a folder of texts cannot be read: {error}");
                Report::about(console::path(&self.path), Diagnostic::new(Code::UnreadableFile, message))
            })?;
            let path = entry.path();
            if path.extension() != Some(OsStr::new(EXTENSION)) || !entry.file_type().is_file() || is_other(path) {
                continue;
            }
            let parts = path.with_extension("");
            let parts = parts.strip_prefix(&self.path).unwrap_or(&parts).components();
            keys.push(parts.map(|part| part.as_os_str().to_string_lossy()).collect::<Vec<_>>().join("/"));
        }
        Ok(keys)
    }
}

/// Returns the text of a file, without the line break at its end. Adds warnings about the file to `reports`.
fn text(path: &Path, encoding: Option<&'static Encoding>, reports: &mut Vec<Report>) -> Result<String, Report> {
    let bytes = input_file::read(path).map_err(|error| unreadable(path, &error))?;
    let mut diagnostics = Vec::new();
    let utf8 = to_utf8(&bytes, encoding, false, &mut diagnostics);
    let decoded = lipz_file::decode_marked(&utf8, &mut diagnostics);
    let text = decoded.map(|text| lipz_file::text::trim(text).to_owned());
    let report = Report::from_bytes(console::path(path), &utf8, diagnostics);
    match text {
        Some(text) => {
            reports.extend((!report.diagnostics.is_empty()).then_some(report));
            Ok(text)
        }
        None => Err(report),
    }
}
