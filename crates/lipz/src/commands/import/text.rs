//! `--text`: what is said, for one clip or for many.

use crate::console;
use lipz_diagnostics::{Code, Diagnostic, Report};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Where the texts of clips come from.
pub(super) enum Texts {
    /// The files have them, or nobody has.
    OfFiles,
    /// The text of the one clip.
    One(String),
    /// A folder with a file `KEY.txt` for each clip.
    Folder(PathBuf),
}

impl Texts {
    /// The texts that `--text` names; a text by itself cannot be that of `several` clips.
    pub(super) fn from_argument(named: Option<&str>, several: bool) -> Result<Texts, Report> {
        let Some(named) = named else { return Ok(Texts::OfFiles) };
        let path = Path::new(named);
        if path.is_dir() {
            return Ok(Texts::Folder(path.to_owned()));
        }
        if several {
            let help = "name a folder that has a file KEY.txt for each of them";
            return Err(Report::failure("", Code::Usage, "several files cannot have the same text", help));
        }
        if path.is_file() { text(path).map(Texts::One) } else { Ok(Texts::One(named.to_owned())) }
    }

    /// The text of the clip with this key, if it has one.
    pub(super) fn of_key(&self, key: &str) -> Result<Option<String>, Report> {
        match self {
            Texts::OfFiles => Ok(None),
            Texts::One(text) => Ok(Some(text.clone())),
            Texts::Folder(folder) => {
                let path = folder.join(format!("{key}.txt"));
                if path.is_file() { text(&path).map(Some) } else { Ok(None) }
            }
        }
    }
}

/// The text in a file, without the line break at its end.
fn text(path: &Path) -> Result<String, Report> {
    let shown = console::path(path);
    let bytes = fs::read(path).map_err(|error: io::Error| {
        let message = format!("`{shown}` cannot be read: {error}");
        Report::about(shown.clone(), Diagnostic::new(Code::UnreadableFile, message))
    })?;
    let mut diagnostics = Vec::new();
    match lipz_file::decode_marked(&bytes, &mut diagnostics) {
        Some(text) => Ok(lipz_file::text::trim(text).to_owned()),
        None => Err(Report::from_bytes(shown, &bytes, diagnostics)),
    }
}
