//! The record of the source texts of translations, a file of the project.

use crate::shared::input_file;
use crate::shared::settings_file::Project;
use crate::{console, interrupt};
use lipz_compiler::{Compiler, Content, Input, Options, replace_file, rewrite_file};
use lipz_diagnostics::{Code, Report, Source};
use lipz_texts::{TextRecord, texts_of};
use std::collections::HashSet;
use std::path::{Component, Path, PathBuf};
use std::{env, io};

/// The name of its file.
pub(crate) const RECORD_NAME: &str = "lipz-texts.txt";

/// The record of a project, and its path.
pub(crate) struct RecordFile {
    pub(crate) record: TextRecord,
    /// Old and new paths of Lipz files that were renamed since the last write.
    pub(crate) renamed: Vec<(String, String)>,
    /// Recorded files that do not exist.
    pub(crate) lost: Vec<String>,
    path: PathBuf,
    /// The folder of the record and the current folder, both from the root. Recorded paths are relative to the first,
    /// all others to the second.
    folder: PathBuf,
    current: PathBuf,
    /// Its contents; `None` if the file does not exist.
    before: Option<Vec<u8>>,
}

impl RecordFile {
    /// Reads the record of a project, or creates an empty one, and detects which of its files were renamed. Reports
    /// invalid lines.
    ///
    /// # Errors
    /// If it cannot be read, or the file is not a record.
    pub(crate) fn open(project: &Project, inputs: &[Input]) -> Result<(RecordFile, Option<Report>), Report> {
        let path = place(project);
        let before = match input_file::read(&path) {
            Ok(bytes) => Some(bytes),
            Err(error) if error.kind() == io::ErrorKind::NotFound => None,
            Err(error) => {
                let message = format!("`{}` cannot be read: {error}", console::path(&path));
                let help = "check that you may read it, or move it away";
                return Err(Report::failure(console::path(&path), Code::UnreadableFile, message, help));
            }
        };
        let text = String::from_utf8_lossy(before.as_deref().unwrap_or_default());
        let Some((record, odd_lines)) = TextRecord::parse(&text) else {
            let message = format!("`{}` is not a record of translations", console::path(&path));
            let help = "rename it, so that lipz can record the source texts of translations in a file with this name";
            return Err(Report::failure(console::path(&path), Code::OutputFailed, message, help));
        };
        let report =
            (!odd_lines.is_empty()).then(|| Report::new(Source::new(console::path(&path), text.clone()), odd_lines));
        let current = env::current_dir().unwrap_or_default();
        let folder = from_root(&current, path.parent().unwrap_or(Path::new("")));
        let mut file = RecordFile { record, renamed: Vec::new(), lost: Vec::new(), path, folder, current, before };
        file.follow(inputs, &project.settings.options);
        Ok((file, report))
    }

    /// Returns the name of a Lipz file in the record: its path relative to the folder of the record.
    pub(crate) fn name(&self, input: &Input) -> String {
        let path = match &input.content {
            Content::File(path) => from_root(&self.current, path),
            // The text of an unsaved file.
            Content::Bytes { name, .. } => from_root(&self.current, Path::new(name)),
        };
        let below = path.strip_prefix(&self.folder).unwrap_or(&path);
        let parts = below.components().map(|part| part.as_os_str().to_string_lossy());
        parts.collect::<Vec<_>>().join("/")
    }

    /// Returns everything that [`name`](RecordFile::name) depends on besides the Lipz file.
    pub(crate) fn folders(&self) -> Vec<u8> {
        [&self.folder, &self.current].map(|folder| folder.as_os_str().as_encoded_bytes()).join(&0)
    }

    /// Returns the contents of the file, or nothing if it does not exist.
    pub(crate) fn bytes(&self) -> &[u8] {
        self.before.as_deref().unwrap_or_default()
    }

    /// Whether the file exists.
    pub(crate) fn exists(&self) -> bool {
        self.before.is_some()
    }

    /// Returns its path for people.
    pub(crate) fn shown(&self) -> String {
        console::path(&self.path)
    }

    /// Writes the record if it has changed. Returns whether it has.
    ///
    /// # Errors
    /// If it cannot be written, or if another program has changed it in the meantime.
    pub(crate) fn write(&self) -> Result<bool, Report> {
        let text = self.record.to_string();
        if self.before.as_deref() == Some(text.as_bytes()) || (self.before.is_none() && self.record.is_empty()) {
            return Ok(false);
        }
        interrupt::whole(|| match &self.before {
            Some(before) => rewrite_file(&self.path, before, text.as_bytes()),
            None => replace_file(&self.path, text.as_bytes()),
        })?;
        Ok(true)
    }

    /// Returns a message about a new record.
    pub(crate) fn introduction(&self) -> String {
        format!(
            "{} is new. It records the source texts of translations. Keep it with the Lipz files. git merges \
             it by lines if .gitattributes contains `{RECORD_NAME} merge=union`.\n",
            self.shown()
        )
    }

    /// Detects renamed files: searches for missing files among those that are not in the record.
    fn follow(&mut self, inputs: &[Input], options: &Options) {
        if self.record.is_empty() {
            return;
        }
        let names: Vec<String> = inputs.iter().map(|input| self.name(input)).collect();
        let known: HashSet<&str> = names.iter().map(String::as_str).collect();
        let missing = self.record.files().filter(|file| !known.contains(file));
        let lost: Vec<String> = missing.filter(|file| !self.folder.join(file).exists()).map(str::to_owned).collect();
        if lost.is_empty() {
            return;
        }
        let new: Vec<Input> = inputs
            .iter()
            .zip(&names)
            .filter(|(_, name)| !self.record.has(name))
            .map(|(input, _)| input.clone())
            .collect();
        let texts = Compiler::new(options.clone()).each_file(&new, |_, bytes| {
            let document = lipz_file::parse(bytes).document.unwrap_or_default();
            texts_of(&document, options.get_default_locale())
        });
        let texts: Vec<_> =
            new.iter().zip(texts).filter_map(|(input, texts)| Some((self.name(input), texts.ok()?))).collect();
        self.renamed = self.record.follow(&lost, &texts);
        self.lost = lost.into_iter().filter(|lost| self.record.has(lost)).collect();
    }
}

/// Returns the path of a project's record: next to the settings, or in the folder of the sources or the nearest parent
/// folder that has one.
fn place(project: &Project) -> PathBuf {
    if let Some(settings) = &project.file {
        return settings.with_file_name(RECORD_NAME);
    }
    let folder = |path: &Path| path.ancestors().find(|path| path.is_dir()).map(Path::to_owned);
    let sources = project.settings.sources.first().and_then(|source| folder(source));
    let folder = project.settings.root.clone().or(sources).unwrap_or_default();
    let existing = folder.ancestors().map(|above| above.join(RECORD_NAME)).find(|path| path.is_file());
    existing.unwrap_or_else(|| folder.join(RECORD_NAME))
}

/// Returns a path from the root, without `.` and `..`.
pub(crate) fn from_root(current: &Path, path: &Path) -> PathBuf {
    let mut whole = PathBuf::new();
    for part in current.join(path).components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir => drop(whole.pop()),
            part => whole.push(part),
        }
    }
    whole
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_from_the_root() {
        let at = |path: &str| from_root(Path::new("/a/b"), Path::new(path));
        assert_eq!(at("./c/../d.lipz"), Path::new("/a/b/d.lipz"));
        assert_eq!(at("../d.lipz"), Path::new("/a/d.lipz"));
        assert_eq!(at("/d.lipz"), Path::new("/d.lipz"));
        assert_eq!(at(""), Path::new("/a/b"));
    }
}
