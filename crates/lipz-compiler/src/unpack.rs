//! Unpacking a bank into a folder of Lipz files.

use crate::key::{EXTENSION, folded, refusal};
use crate::raise::Documents;
use crate::{Report, discover};
use cap_std::ambient_authority;
use cap_std::fs::Dir;
use cap_tempfile::TempFile;
use lipz::{Code, Diagnostic};
use lipz_bank::Bank;
use std::collections::HashMap;
use std::io::{self, Write};
use std::path::Path;

/// What unpacking gave.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Unpacked {
    /// Files written.
    pub files: usize,
    /// Whether they are exact, or display forms of a stripped bank.
    pub is_exact: bool,
}

/// Writes every clip of a verified `bank` as a Lipz file into `folder`, which is made if it does
/// not exist. `progress` is called with 1 for every file.
///
/// Nothing is written outside `folder`, also where a link in it leads out. Each file appears whole
/// or not at all. Files that exist are replaced only with `overwrite`.
///
/// # Errors
/// Keys that cannot be file names everywhere, or that would be one file, and files that exist: found
/// before the first file is written. Then whatever the file system refuses.
pub fn unpack(
    bank: &Bank<'_>,
    folder: &Path,
    overwrite: bool,
    progress: &dyn Fn(u64),
) -> Result<Unpacked, Vec<Report>> {
    let documents = Documents::of(bank).map_err(|report| vec![report])?;
    let refused = refused_keys(bank);
    if !refused.is_empty() {
        return Err(refused);
    }
    let failed = |path: String, error: &io::Error| {
        let headline = format!("`{path}` cannot be written: {error}");
        vec![Report::about(path, Diagnostic::new(Code::OutputFailed, headline))]
    };
    let shown = discover::display(folder);
    let output = std::fs::create_dir_all(folder)
        .and_then(|()| Dir::open_ambient_dir(folder, ambient_authority()))
        .map_err(|error| failed(shown.clone(), &error))?;
    if !overwrite {
        let existing = existing_files(bank, &output, &shown);
        if !existing.is_empty() {
            return Err(existing);
        }
    }
    let mut files = 0;
    for document in documents.iter() {
        let (key, document) = document.map_err(|report| vec![report])?;
        let name = format!("{key}.{EXTENSION}");
        let text = lipz::write(&document);
        write_file(&output, &name, text.as_bytes()).map_err(|error| failed(format!("{shown}/{name}"), &error))?;
        files += 1;
        progress(1);
    }
    Ok(Unpacked { files, is_exact: documents.is_exact() })
}

/// Keys that would leave the folder, cannot be file names, or would be one file.
fn refused_keys(bank: &Bank<'_>) -> Vec<Report> {
    let mut reports = Vec::new();
    let mut seen: HashMap<String, &str> = HashMap::with_capacity(bank.clip_count());
    for clip in bank.clips() {
        let key = clip.key();
        let finding = if let Some(why) = refusal(key) {
            Diagnostic::new(Code::RefusedKey, format!("the key `{}` cannot be unpacked: {why}", key.escape_debug()))
        } else if let Some(other) = seen.insert(folded(key), key) {
            Diagnostic::new(Code::KeyClash, format!("the keys `{other}` and `{key}` are one file on some systems"))
        } else {
            continue;
        };
        reports.push(Report::about("", finding.note("nothing was written")));
    }
    reports
}

fn existing_files(bank: &Bank<'_>, output: &Dir, shown: &str) -> Vec<Report> {
    let names = bank.clips().map(|clip| format!("{}.{EXTENSION}", clip.key()));
    names
        .filter(|name| output.symlink_metadata(name).is_ok())
        .map(|name| {
            let path = format!("{shown}/{name}");
            let finding = Diagnostic::new(Code::WouldOverwrite, format!("`{path}` is there already"));
            Report::about(
                path,
                finding.note("nothing was written").help("unpack into another folder, or replace files with --force"),
            )
        })
        .collect()
}

/// Writes a file below `output` under a temporary name, then renames it.
fn write_file(output: &Dir, name: &str, bytes: &[u8]) -> io::Result<()> {
    let (folder, file) = match name.rsplit_once('/') {
        Some((folder, file)) => {
            output.create_dir_all(folder)?;
            (&output.open_dir(folder)?, file)
        }
        None => (output, name),
    };
    let mut temporary = TempFile::new(folder)?;
    temporary.write_all(bytes)?;
    temporary.replace(file)
}
