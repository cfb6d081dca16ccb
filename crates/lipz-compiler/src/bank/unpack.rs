//! Unpacking a dialogue to a folder of Lipz files.

use crate::bank::decompile::Documents;
use crate::files::Replacements;
use crate::files::output::{failed as not_written, file_in_the_way};
use crate::files::path::display;
use crate::files::temporary::OpenFolder;
use crate::sources::key::{EXTENSION, clash, folded, refusal};
use cap_std::ambient_authority;
use cap_std::fs::Dir;
use lipz_bank::{Clip, Dialogue};
use lipz_diagnostics::{Code, Diagnostic, Report, escape};
use lipz_file::Document;
use std::collections::HashMap;
use std::io;
use std::path::Path;
use std::sync::Arc;

/// The result of unpacking.
#[derive(Debug)]
#[non_exhaustive]
pub struct Unpacked {
    /// The number of files written.
    pub files: usize,
    /// Whether they are exact, instead of display forms from a stripped bank.
    pub is_exact: bool,
    /// A warning for each replaced file with texts or other elements that the bank lacks.
    pub lost: Vec<Report>,
}

/// Writes every clip of a verified dialogue as a Lipz file into `folder`, which is created if it does not exist. Calls
/// `progress` with 1 for every file that is passed to `files`, which writes them in groups. All of them are written on
/// return.
///
/// Nothing is written outside `folder`, even if a link in it points elsewhere. Each file appears completely or not at
/// all. Existing files are replaced only with `overwrite`.
///
/// # Errors
/// Before the first file is written: keys that are not valid file names on all systems, or that differ too little to be
/// separate files; source records that cannot be decoded; files that would be far longer than the bank; and existing
/// files. Later: errors of the file system.
pub fn unpack(
    dialogue: &Dialogue<'_>,
    folder: &Path,
    overwrite: bool,
    files: &Replacements,
    progress: &dyn Fn(u64),
) -> Result<Unpacked, Vec<Report>> {
    let documents = Documents::from_dialogue(dialogue).map_err(|report| vec![report])?;
    let mut refused = refused_keys(documents.clips());
    // Decode twice instead of keeping the documents, because they may not fit into memory.
    refused.extend(documents.iter().filter_map(Result::err));
    if !refused.is_empty() {
        return Err(refused);
    }
    let failed = |path: String, why: String| {
        let message = format!("`{path}` cannot be written: {why}");
        vec![Report::about(path, Diagnostic::new(Code::OutputFailed, message))]
    };
    let shown = display(folder);
    let output = std::fs::create_dir_all(folder)
        .and_then(|()| Dir::open_ambient_dir(folder, ambient_authority()))
        .map_err(|error| {
            let why = match file_in_the_way(folder) {
                Some(file) if file == folder => "it is a file, not a folder".into(),
                Some(file) => format!("`{}` is a file, not a folder", display(file)),
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
    // Files written before the first failure are complete and stay.
    unwritten.extend(files.finish());
    if !unwritten.is_empty() {
        return Err(unwritten);
    }
    Ok(Unpacked { files: count, is_exact: documents.is_exact(), lost })
}

/// The folders below the output, created if they do not exist.
struct Folders<'o> {
    output: &'o Dir,
    path: &'o Path,
    /// The last folder and its name. Keys are sorted, and therefore grouped by folder.
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

/// Returns a report about content of a replaced file that the bank lacks, if any.
fn loss(output: &Dir, name: &str, shown: &str, document: &Document<'_>) -> Option<Report> {
    let bytes = output.read(name).ok()?;
    let path = format!("{shown}/{name}");
    let message = match lipz_file::parse(&bytes).document {
        Some(before) => {
            let lost: Vec<String> = before.lost_in(document).map(|name| escape::quoted(name).to_string()).collect();
            if lost.is_empty() {
                return None;
            }
            format!("`{path}` is replaced without its {}", lost.join(", "))
        }
        None => format!("`{path}` is replaced, although its content cannot be read"),
    };
    Some(Report::about(path, Diagnostic::new(Code::ClipReplaced, message)))
}

/// Returns reports about keys that would leave the folder, are not valid file names, or would be the same file.
fn refused_keys(clips: &[Clip<'_>]) -> Vec<Report> {
    let mut reports = Vec::new();
    let mut seen: HashMap<String, &str> = HashMap::with_capacity(clips.len());
    for clip in clips {
        let key = clip.key();
        let diagnostic = if let Some(why) = refusal(key) {
            let message = format!("the key `{}` cannot be unpacked: {why}", escape::text(key));
            Diagnostic::new(Code::RefusedKey, message)
                .help("unpack a bank that lipz wrote; this one was edited or made by another program")
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
            let diagnostic = Diagnostic::new(Code::WouldOverwrite, format!("`{path}` already exists"));
            Report::about(
                path,
                diagnostic
                    .note("nothing was written")
                    .help("unpack into a different folder, or allow files to be replaced"),
            )
        })
        .collect()
}

/// Returns the part of the path `name` below `output` that prevents writing the file, with a description.
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
