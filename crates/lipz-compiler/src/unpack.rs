//! Unpacking a dialogue into a folder of Lipz files.

use crate::decompile::Documents;
use crate::key::{EXTENSION, clash, folded, refusal};
use crate::output::{failed as not_written, file_in_the_way};
use crate::temporary::OpenFolder;
use crate::{Replacements, discover};
use cap_std::ambient_authority;
use cap_std::fs::Dir;
use lipz_bank::{Clip, Dialogue};
use lipz_diagnostics::{Code, Diagnostic, Report, escape};
use lipz_file::Document;
use std::collections::HashMap;
use std::io;
use std::path::Path;
use std::sync::Arc;

/// What unpacking gave.
#[derive(Debug)]
#[non_exhaustive]
pub struct Unpacked {
    /// Files written.
    pub files: usize,
    /// Whether they are exact, or display forms of a stripped bank.
    pub is_exact: bool,
    /// Files that were replaced, and had texts or other elements that the bank does not have: a warning for each.
    pub lost: Vec<Report>,
}

/// Writes every clip of a verified dialogue as a Lipz file into `folder`, which is made if it does
/// not exist. `progress` is called with 1 for every file that is handed to `files`, which bring them to disk in groups;
/// all of them, when this returns.
///
/// Nothing is written outside `folder`, also where a link in it leads out. Each file appears whole
/// or not at all. Files that exist are replaced only with `overwrite`.
///
/// # Errors
/// Keys that cannot be file names everywhere, or that would be one file, source records that cannot be
/// decoded, files that would be far longer than the bank, and files that exist: found before the first file is written. Then whatever the file system
/// refuses.
pub fn unpack(
    dialogue: &Dialogue<'_>,
    folder: &Path,
    overwrite: bool,
    files: &Replacements,
    progress: &dyn Fn(u64),
) -> Result<Unpacked, Vec<Report>> {
    let documents = Documents::from_dialogue(dialogue).map_err(|report| vec![report])?;
    let mut refused = refused_keys(documents.clips());
    // Decoded twice rather than kept: a bank can hold more than fits the memory.
    refused.extend(documents.iter().filter_map(Result::err));
    if !refused.is_empty() {
        return Err(refused);
    }
    let failed = |path: String, why: String| {
        let message = format!("`{path}` cannot be written: {why}");
        vec![Report::about(path, Diagnostic::new(Code::OutputFailed, message))]
    };
    let shown = discover::display(folder);
    let output = std::fs::create_dir_all(folder)
        .and_then(|()| Dir::open_ambient_dir(folder, ambient_authority()))
        .map_err(|error| {
            let why = match file_in_the_way(folder) {
                Some(file) if file == folder => "it is a file, not a folder".into(),
                Some(file) => format!("`{}` is a file, not a folder", discover::display(file)),
                None => return vec![not_written(folder, &error)],
            };
            failed(shown.clone(), why)
        })?;
    if !overwrite {
        let existing = existing_files(documents.clips(), &output, &shown);
        if !existing.is_empty() {
            return Err(existing);
        }
    }
    let mut folders = Folders { output: &output, path: folder, last: None };
    let (mut count, mut lost, mut unwritten) = (0, Vec::new(), Vec::new());
    for document in documents.iter() {
        let (key, document) = document.map_err(|report| vec![report])?;
        let name = format!("{key}.{EXTENSION}");
        lost.extend(if overwrite { loss(&output, &name, &shown, &document) } else { None });
        let text = lipz_file::write(&document);
        let (parent, file) = name.rsplit_once('/').unwrap_or(("", &name));
        let written = folders
            .open(parent)
            .and_then(|parent| files.replace_below(&parent, file, &folder.join(&name), text.as_bytes()));
        if let Err(error) = written {
            unwritten = match obstacle(&output, &name) {
                Some((part, what)) if part == name => failed(format!("{shown}/{name}"), format!("it is {what}")),
                Some((part, what)) => failed(format!("{shown}/{name}"), format!("`{shown}/{part}` is {what}")),
                None => vec![not_written(&folder.join(&name), &error)],
            };
            break;
        }
        count += 1;
        progress(1);
    }
    // What was written before the first that cannot be is whole, and stays.
    unwritten.extend(files.finish());
    if !unwritten.is_empty() {
        return Err(unwritten);
    }
    Ok(Unpacked { files: count, is_exact: documents.is_exact(), lost })
}

/// The folders below the output, made where there are none.
struct Folders<'o> {
    output: &'o Dir,
    path: &'o Path,
    /// The last one and its name: keys come in their order, folder by folder.
    last: Option<(String, Arc<OpenFolder>)>,
}

impl Folders<'_> {
    fn open(&mut self, name: &str) -> io::Result<Arc<OpenFolder>> {
        if let Some((last, folder)) = &self.last
            && last == name
        {
            return Ok(Arc::clone(folder));
        }
        let dir = if name.is_empty() {
            self.output.try_clone()?
        } else {
            self.output.create_dir_all(name)?;
            self.output.open_dir(name)?
        };
        let folder = Arc::new(OpenFolder { dir, path: self.path.join(name) });
        self.last = Some((name.to_owned(), Arc::clone(&folder)));
        Ok(folder)
    }
}

/// What a file that is replaced has and the bank does not, if anything.
fn loss(output: &Dir, name: &str, shown: &str, document: &Document<'_>) -> Option<Report> {
    let bytes = output.read(name).ok()?;
    let path = format!("{shown}/{name}");
    let message = match lipz_file::parse(&bytes).document {
        Some(before) => {
            let lost: Vec<String> = before.lost_in(document).map(|name| escape::quoted(name).to_string()).collect();
            if lost.is_empty() {
                return None;
            }
            format!("`{path}` is replaced, without its {}", lost.join(", "))
        }
        None => format!("`{path}` is replaced: what it had cannot be read"),
    };
    Some(Report::about(path, Diagnostic::new(Code::ClipReplaced, message)))
}

/// Keys that would leave the folder, cannot be file names, or would be one file.
fn refused_keys(clips: &[Clip<'_>]) -> Vec<Report> {
    let mut reports = Vec::new();
    let mut seen: HashMap<String, &str> = HashMap::with_capacity(clips.len());
    for clip in clips {
        let key = clip.key();
        let diagnostic = if let Some(why) = refusal(key) {
            let message = format!("the key `{}` cannot be unpacked: {why}", escape::text(key));
            Diagnostic::new(Code::RefusedKey, message).help("this bank was changed or not made by lipz")
        } else if let Some(other) = seen.insert(folded(key), key) {
            clash(other, key)
        } else {
            continue;
        };
        reports.push(Report::about("", diagnostic.note("nothing was written")));
    }
    reports
}

fn existing_files(clips: &[Clip<'_>], output: &Dir, shown: &str) -> Vec<Report> {
    let names = clips.iter().map(|clip| format!("{}.{EXTENSION}", clip.key()));
    names
        .filter(|name| output.symlink_metadata(name).is_ok())
        .map(|name| {
            let path = format!("{shown}/{name}");
            let diagnostic = Diagnostic::new(Code::WouldOverwrite, format!("`{path}` exists already"));
            Report::about(
                path,
                diagnostic
                    .note("nothing was written")
                    .help("unpack into another folder, or allow files to be replaced"),
            )
        })
        .collect()
}

/// The part of the path `name` below `output` in which no file can be written, and what it is.
fn obstacle<'n>(output: &Dir, name: &'n str) -> Option<(&'n str, &'static str)> {
    let folders = name.match_indices('/').filter_map(|(at, _)| name.get(..at));
    for folder in folders {
        let metadata = output.symlink_metadata(folder).ok()?;
        let what = match (metadata.is_symlink(), output.metadata(folder)) {
            (_, Ok(target)) if target.is_dir() => continue,
            (false, _) => "a file, not a folder",
            (true, Ok(_)) => "a link to a file, not to a folder",
            (true, Err(error)) if error.kind() == io::ErrorKind::NotFound => "a link to a folder that does not exist",
            (true, Err(_)) => "a link that leads out of the folder",
        };
        return Some((folder, what));
    }
    output.symlink_metadata(name).is_ok_and(|metadata| metadata.is_dir()).then_some((name, "a folder"))
}
