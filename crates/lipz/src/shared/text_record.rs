//! The record of what translations were made from, as a file of the project.

use crate::shared::settings_file::Project;
use crate::{console, interrupt};
use lipz_compiler::{Compiler, Content, Input, Options, replace_file, rewrite_file};
use lipz_diagnostics::{Code, Report, Source};
use lipz_texts::{TextRecord, texts_of};
use std::collections::HashSet;
use std::path::{Component, Path, PathBuf};
use std::{env, fs, io};

/// Its name.
pub(crate) const RECORD_NAME: &str = "lipz-texts.txt";

/// The record of a project, and where it is.
pub(crate) struct RecordFile {
    pub(crate) record: TextRecord,
    /// Old and new paths of Lipz files that were renamed since it was written.
    pub(crate) renamed: Vec<(String, String)>,
    /// Files that it knows and that are no more.
    pub(crate) lost: Vec<String>,
    path: PathBuf,
    /// The folder that paths in it start from, and the one that all others do, from the root.
    folder: PathBuf,
    current: PathBuf,
    /// What is in it; `None` if there is none.
    before: Option<Vec<u8>>,
}

impl RecordFile {
    /// Reads the record of a project, and finds out which files of it were renamed. An empty one if there is none; lines that
    /// say nothing are reported.
    ///
    /// # Errors
    /// If it cannot be read, or is another file.
    pub(crate) fn open(project: &Project, inputs: &[Input]) -> Result<(RecordFile, Option<Report>), Report> {
        let path = place(project);
        let before = match fs::read(&path) {
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
            let message = format!("`{}` is not a record of translations, and is left alone", console::path(&path));
            let help = "give it another name: lipz keeps there what each translation was made from";
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

    /// What the record calls a Lipz file: its path below the folder of the record.
    pub(crate) fn name(&self, input: &Input) -> String {
        let path = match &input.content {
            Content::File(path) => from_root(&self.current, path),
            // The text of a file that is not saved yet.
            Content::Bytes { name, .. } => from_root(&self.current, Path::new(name)),
        };
        let below = path.strip_prefix(&self.folder).unwrap_or(&path);
        let parts = below.components().map(|part| part.as_os_str().to_string_lossy());
        parts.collect::<Vec<_>>().join("/")
    }

    /// All that [`name`](RecordFile::name) depends on besides the Lipz file.
    pub(crate) fn folders(&self) -> Vec<u8> {
        [&self.folder, &self.current].map(|folder| folder.as_os_str().as_encoded_bytes()).join(&0)
    }

    /// What is in the file; nothing if there is none.
    pub(crate) fn bytes(&self) -> &[u8] {
        self.before.as_deref().unwrap_or_default()
    }

    /// Whether there is a file.
    pub(crate) fn exists(&self) -> bool {
        self.before.is_some()
    }

    /// Its path, for people.
    pub(crate) fn shown(&self) -> String {
        console::path(&self.path)
    }

    /// Writes it if it says something new; whether it does.
    ///
    /// # Errors
    /// If it cannot be written, or somebody else has changed it meanwhile.
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

    /// What to say about a record that did not exist before.
    pub(crate) fn introduction(&self) -> String {
        format!(
            "{} is new: it says which source texts translations were made from. Keep it with the Lipz files; git merges it \
             by lines with `{RECORD_NAME} merge=union` in .gitattributes.\n",
            self.shown()
        )
    }

    /// Files that are no more are looked for among those that it does not know.
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

/// Where the record of a project is: beside its settings, or in the folder of its sources or the nearest one above that has
/// one.
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

/// A path from the root, without `.` and `..`.
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
