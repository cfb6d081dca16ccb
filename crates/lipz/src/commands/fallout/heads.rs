//! `lipz fallout heads`: the pictures of talking heads and `heads.lst`.

use crate::Ended;
use crate::reporter::Reporter;
use crate::shared::formats;
use crate::{Outcome, console};
use clap::Args;
use lipz_diagnostics::{Code, Diagnostic, Report, Source};
use lipz_interop::fallout::heads::{Content, Disposition, Head, HeadFile, check_file, compare, read_list};
use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{fs, io};

/// The extensions of lists and of pictures.
const LIST: &str = "lst";
const PICTURE: &str = "frm";

/// Check the FRM files of talking heads: their names, that phoneme files have a frame for each of the nine
/// mouth shapes, and that the files are those that heads.lst counts.
///
/// Lists what each head has. Names follow "A Description of the LIP File Format v2 Used in
/// Fallout 2"; case does not matter.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz fallout heads data/art/heads
  lipz fallout heads data/art/heads/heads.lst
  lipz fallout heads eldergp.frm eldernp.frm elderbp.frm")]
pub(crate) struct Heads {
    /// Folders, lists (.lst), which are compared with the folders in which they lie, or FRM files
    #[arg(value_name = "FILES", required = true)]
    paths: Vec<PathBuf>,

    /// Show only diagnostics
    #[arg(short, long)]
    quiet: bool,
}

pub(crate) fn run(arguments: &Heads, reporter: &mut Reporter) -> Ended {
    let mut checked = Checked::default();
    for path in &arguments.paths {
        checked.source(path);
    }
    let Checked { files, reports } = checked;
    let outcome = Outcome::from_reports(&reports);
    reporter.add(reports);
    if arguments.quiet || files.is_empty() {
        return Ok(outcome);
    }
    reporter.print(&table(&files))?;
    Ok(outcome)
}

#[derive(Default)]
struct Checked {
    files: Vec<HeadFile>,
    reports: Vec<Report>,
}

impl Checked {
    fn source(&mut self, path: &Path) {
        if path.is_dir() {
            self.folder(path);
        } else if has_extension(path, LIST) {
            self.list(path);
        } else {
            self.picture(path);
        }
    }

    /// The pictures of a folder, compared with its list if it has one.
    fn folder(&mut self, folder: &Path) {
        let Some(paths) = self.read(folder, listed) else { return };
        if let Some(list) = paths.iter().find(|path| has_extension(path, LIST)) {
            self.list(list);
        } else if paths.iter().any(|path| has_extension(path, PICTURE)) {
            self.pictures(&paths);
        } else {
            let shown = console::path(folder);
            let diagnostic = Diagnostic::new(Code::NoSources, format!("no FRM files in `{shown}`"));
            let help = "heads are below art/heads in the data of the game; its archives must be unpacked first";
            self.reports.push(Report::about(shown, diagnostic.help(help)));
        }
    }

    /// A list, compared with the pictures beside it.
    fn list(&mut self, path: &Path) {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let Some(bytes) = self.read(path, |path| fs::read(path)) else { return };
        let Some(paths) = self.read(folder, listed) else { return };
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let (heads, mut found): (Vec<Head>, _) = read_list(&text);
        let files = self.pictures(&paths);
        found.extend(compare(&heads, &files));
        self.add(Source::new(console::path(path), text), found);
    }

    /// Checks those of `paths` that are pictures, and gives them.
    fn pictures(&mut self, paths: &[PathBuf]) -> Vec<HeadFile> {
        let before = self.files.len();
        for path in paths.iter().filter(|path| has_extension(path, PICTURE)) {
            self.picture(path);
        }
        self.files.get(before..).unwrap_or_default().to_vec()
    }

    fn picture(&mut self, path: &Path) {
        let Some(bytes) = self.read(path, |path| fs::read(path)) else { return };
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

    /// What `read` gives; reports why it gives nothing.
    fn read<T>(&mut self, path: &Path, read: impl FnOnce(&Path) -> io::Result<T>) -> Option<T> {
        read(path).map_err(|error| self.reports.push(formats::unreadable(path, &error))).ok()
    }
}

/// The files of a folder, in the order of their names.
fn listed(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut paths = fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<io::Result<Vec<_>>>()?;
    paths.sort();
    Ok(paths)
}

fn has_extension(path: &Path, extension: &str) -> bool {
    path.extension().is_some_and(|found| found.eq_ignore_ascii_case(extension))
}

/// What each head has, and the emotions that its dispositions show.
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
