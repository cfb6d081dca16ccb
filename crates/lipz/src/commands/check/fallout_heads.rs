//! `lipz check --fallout-heads`: the images of talking heads and `heads.lst`.

use crate::CommandResult;
use crate::reporter::Reporter;
use crate::shared::input_file;
use crate::{Outcome, console};
use lipz_diagnostics::{Code, Diagnostic, Report, Source};
use lipz_interop::fallout::heads::{Content, Disposition, Head, HeadFile, check_file, compare, read_list};
use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{fs, io};

/// The extensions of lists and of images.
const LIST: &str = "lst";
const PICTURE: &str = "frm";

/// Checks the FRM files of talking heads: their names, whether phoneme files have a frame for each of the nine mouth
/// shapes, and whether heads.lst counts the same files. Lists the files of each head.
///
/// Names follow "A Description of the LIP File Format v2 Used in Fallout 2"; case does not matter.
pub(super) fn run(paths: &[PathBuf], is_quiet: bool, reporter: &mut Reporter) -> CommandResult {
    let mut checked = CheckedHeads::default();
    for path in paths {
        checked.source(path);
    }
    let CheckedHeads { files, reports } = checked;
    let outcome = Outcome::from_reports(&reports);
    reporter.add(reports);
    if is_quiet || files.is_empty() {
        return Ok(outcome);
    }
    reporter.print(&table(&files))?;
    Ok(outcome)
}

#[derive(Default)]
struct CheckedHeads {
    files: Vec<HeadFile>,
    reports: Vec<Report>,
}

impl CheckedHeads {
    fn source(&mut self, path: &Path) {
        if path.is_dir() {
            self.folder(path);
        } else if has_extension(path, LIST) {
            self.list(path);
        } else {
            self.picture(path);
        }
    }

    /// Checks the images of a folder against its list, if it has one.
    fn folder(&mut self, folder: &Path) {
        let Some(paths) = self.read(folder, listed) else { return };
        if let Some(list) = paths.iter().find(|path| has_extension(path, LIST)) {
            self.list(list);
        } else if paths.iter().any(|path| has_extension(path, PICTURE)) {
            self.pictures(&paths);
        } else {
            let shown = console::path(folder);
            let diagnostic = Diagnostic::new(Code::NoSources, format!("no FRM files in `{shown}`"));
            let help = "unpack the archives of the game; its heads are in the folder art/heads";
            self.reports.push(Report::about(shown, diagnostic.help(help)));
        }
    }

    /// Checks a list against the images next to it.
    fn list(&mut self, path: &Path) {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let Some(bytes) = self.read(path, input_file::read) else { return };
        let Some(paths) = self.read(folder, listed) else { return };
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let (heads, mut found): (Vec<Head>, _) = read_list(&text);
        let files = self.pictures(&paths);
        found.extend(compare(&heads, &files));
        self.add(Source::new(console::path(path), text), found);
    }

    /// Checks and returns those of `paths` that are images.
    fn pictures(&mut self, paths: &[PathBuf]) -> Vec<HeadFile> {
        let before = self.files.len();
        for path in paths.iter().filter(|path| has_extension(path, PICTURE)) {
            self.picture(path);
        }
        self.files.get(before..).unwrap_or_default().to_vec()
    }

    fn picture(&mut self, path: &Path) {
        let Some(bytes) = self.read(path, input_file::read) else { return };
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let (file, found) = check_file(&name, &bytes);
        self.files.extend(file);
        self.add(Source::new(console::path(path), ""), found);
    }

    fn add(&mut self, source: Source, diagnostics: Vec<Diagnostic>) {
        if !diagnostics.is_empty() {
            self.reports.push(Report::new(source, diagnostics));
        }
    }

    /// Returns the result of `read`, or `None` after reporting its error.
    fn read<T>(&mut self, path: &Path, read: impl FnOnce(&Path) -> io::Result<T>) -> Option<T> {
        read(path).map_err(|error| self.reports.push(input_file::unreadable(path, &error))).ok()
    }
}

/// Returns the files of a folder, sorted by name.
fn listed(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut paths = fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<io::Result<Vec<_>>>()?;
    paths.sort();
    Ok(paths)
}

fn has_extension(path: &Path, extension: &str) -> bool {
    path.extension().is_some_and(|found| found.eq_ignore_ascii_case(extension))
}

/// Returns a table of the files of each head, and of the emotions that its dispositions show.
fn table(files: &[HeadFile]) -> String {
    let roots: BTreeSet<&str> = files.iter().map(|file| file.root.as_str()).collect();
    let width = roots.iter().map(|root| root.len()).max().unwrap_or(0).max("head".len());
    let mut text = format!("{:width$}  disposition  mouth shapes  fidgets  emotions\n", "head");
    for root in roots {
        for disposition in Disposition::ALL {
            let own = files.iter().filter(|file| file.root == root && file.disposition == disposition);
            let has_mouth = own.clone().any(|file| file.content == Content::Phonemes);
            let fidgets = own.filter(|file| matches!(file.content, Content::Fidget(_))).count();
            let mouth = if has_mouth { "yes" } else { "no" };
            let emotions = disposition.emotions().join(", ");
            let disposition = disposition.to_string();
            let _ = writeln!(text, "{root:width$}  {disposition:11}  {mouth:12}  {fidgets:7}  {emotions}");
        }
    }
    text
}
