//! The state of a project's files, and which of them are affected by a change of the file system.

use super::scope::concerns;
use crate::shared::inputs::FoundInputs;
use lipz_compiler::settings::Settings;
use lipz_compiler::{Content, Input};
use lipz_diagnostics::Report;
use std::collections::{BTreeMap, BTreeSet};
use std::env;
use std::ffi::OsStr;
use std::fs::Metadata;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime};

/// Metadata of files, without their contents. Two states differ if a file was changed, added, removed or moved between
/// them.
pub(crate) struct State {
    /// The Lipz files, sorted by path.
    inputs: Vec<Input>,
    looks: Vec<Option<Look>>,
    /// All other relevant files.
    others: Vec<(PathBuf, Option<Look>)>,
    /// Sources that are missing or cannot be read.
    problems: Vec<Report>,
    /// The folders of the Lipz files. `None` if a file is reachable by several paths, as far as the system reports
    /// that: events name only one of these.
    folders: Option<BTreeMap<PathBuf, Identity>>,
    took: Duration,
}

/// Length and modification time of a file.
type Look = (u64, Option<SystemTime>);

/// The numbers of a file and of its file system.
type Identity = (u64, u64);

/// The content that changed paths affect.
#[derive(PartialEq, Eq, Debug)]
pub(crate) enum Scent {
    /// Nothing relevant.
    Nothing,
    /// The contents of the inputs with these numbers, and nothing else.
    Inputs(Vec<usize>),
    /// Not known without a check of all files.
    Unknown,
}

impl State {
    /// Returns the current state of all files.
    pub(super) fn of(settings: &Settings, settings_file: Option<&Path>) -> State {
        let start = Instant::now();
        let (inputs, problems) = settings.discover_with_reports();
        let mut folders = Folders::default();
        let looks = inputs.iter().map(|input| path(input).and_then(|path| folders.look(path))).collect();
        let paths = settings_file.map(Path::to_owned).into_iter().chain(lipz_sync::dependencies(settings));
        let others = paths.map(|path| (look(path.metadata().ok().as_ref()), path)).map(|(look, path)| (path, look));
        let folders = folders.distinct().filter(|_| problems.is_empty());
        State { looks, others: others.collect(), problems, folders, took: start.elapsed(), inputs }
    }

    /// Reads the metadata of the inputs with these numbers again.
    pub(super) fn look_again(&mut self, numbers: &BTreeSet<usize>) {
        for number in numbers {
            let path = self.inputs.get(*number).and_then(path);
            if let (Some(seen), Some(path)) = (self.looks.get_mut(*number), path) {
                *seen = look(path.metadata().ok().as_ref());
            }
        }
        self.took = Duration::ZERO;
    }

    /// Returns the inputs for a run.
    pub(super) fn found(&self) -> FoundInputs<'_> {
        FoundInputs { inputs: self.inputs.as_slice().into(), reports: self.problems.clone(), took: self.took }
    }

    /// Returns the content that events on these paths affect, or `Unknown` in case of doubt.
    pub(super) fn judge(&self, paths: &BTreeSet<PathBuf>, settings_name: Option<&OsStr>) -> Scent {
        let (Some(folders), Ok(current)) = (&self.folders, env::current_dir()) else { return Scent::Unknown };
        let (mut inputs, mut is_something_gone) = (Vec::new(), false);
        for path in paths {
            let concerns = concerns(settings_name, path);
            match (self.number(path, &current), path.symlink_metadata()) {
                (Some(number), Ok(found)) if is_only_path(&found) => inputs.push(number),
                (None, Ok(found)) if found.is_file() && !concerns => {}
                (None, Err(error)) if error.kind() == ErrorKind::NotFound && !concerns => is_something_gone = true,
                _ => return Scent::Unknown,
            }
        }
        // It may have been a folder.
        let is_there = |(folder, before): (&PathBuf, &Identity)| identity(folder) == Some(*before);
        if is_something_gone && !folders.iter().all(is_there) {
            return Scent::Unknown;
        }
        if inputs.is_empty() { Scent::Nothing } else { Scent::Inputs(inputs) }
    }

    /// Returns the paths of the inputs.
    fn paths(&self) -> impl Iterator<Item = Option<&OsStr>> {
        self.inputs.iter().map(|input| path(input).map(Path::as_os_str))
    }

    /// Returns the number of the input with this path, which the system may spell from the root.
    fn number(&self, called: &Path, current: &Path) -> Option<usize> {
        let find = |called: &Path| {
            let order = |input: &Input| path(input).map(Path::as_os_str).cmp(&Some(called.as_os_str()));
            self.inputs.binary_search_by(order).ok()
        };
        find(called).or_else(|| find(called.strip_prefix(current).ok()?))
    }
}

impl PartialEq for State {
    fn eq(&self, other: &State) -> bool {
        self.looks == other.looks
            && self.others == other.others
            && self.problems == other.problems
            && self.paths().eq(other.paths())
    }
}

/// The folders of the examined files.
#[derive(Default)]
struct Folders {
    paths: BTreeSet<PathBuf>,
    last: PathBuf,
    /// Whether one of the files has several paths, or is a link.
    has_other_paths: bool,
}

impl Folders {
    /// Reads the metadata of a file.
    fn look(&mut self, path: &Path) -> Option<Look> {
        let folder = path.parent().unwrap_or(Path::new(""));
        if folder.as_os_str() != self.last.as_os_str() || self.paths.is_empty() {
            folder.clone_into(&mut self.last);
            self.paths.insert(if folder.as_os_str().is_empty() { PathBuf::from(".") } else { folder.to_owned() });
        }
        let metadata = path.symlink_metadata().ok();
        if metadata.as_ref().is_some_and(is_only_path) {
            return look(metadata.as_ref());
        }
        self.has_other_paths = true;
        look(path.metadata().ok().as_ref())
    }

    /// Returns the folders with their identities, unless a file or a folder has several paths.
    fn distinct(self) -> Option<BTreeMap<PathBuf, Identity>> {
        if self.has_other_paths {
            return None;
        }
        let identified = self.paths.into_iter().map(|path| Some((identity(&path)?, path)));
        let by_identity: BTreeMap<Identity, PathBuf> = {
            let all: Vec<(Identity, PathBuf)> = identified.collect::<Option<_>>()?;
            let count = all.len();
            Some(BTreeMap::from_iter(all)).filter(|distinct| distinct.len() == count)?
        };
        Some(by_identity.into_iter().map(|(identity, path)| (path, identity)).collect())
    }
}

fn path(input: &Input) -> Option<&Path> {
    match &input.content {
        Content::File(path) => Some(path),
        Content::Bytes { .. } => None,
    }
}

fn look(metadata: Option<&Metadata>) -> Option<Look> {
    metadata.map(|metadata| (metadata.len(), metadata.modified().ok()))
}

/// Whether a file has only one path, as far as its metadata shows.
#[cfg(unix)]
fn is_only_path(metadata: &Metadata) -> bool {
    use std::os::unix::fs::MetadataExt;
    metadata.is_file() && metadata.nlink() == 1
}

#[cfg(unix)]
fn identity(folder: &Path) -> Option<Identity> {
    use std::os::unix::fs::MetadataExt;
    let metadata = folder.metadata().ok()?;
    Some((metadata.dev(), metadata.ino()))
}

/// The standard library does not provide this on other systems.
#[cfg(not(unix))]
fn is_only_path(_metadata: &Metadata) -> bool {
    false
}

#[cfg(not(unix))]
fn identity(_folder: &Path) -> Option<Identity> {
    None
}

#[cfg(test)]
#[cfg(unix)]
mod tests {
    use super::*;
    use std::fs;

    fn state(folder: &Path) -> State {
        State::of(&Settings::from_sources(vec![folder.to_owned()]), None)
    }

    fn scene() -> tempfile::TempDir {
        let scene = tempfile::tempdir().unwrap();
        for name in ["a.lipz", "act1/b.lipz", "act1/notes.txt"] {
            let path = scene.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, "{}").unwrap();
        }
        scene
    }

    fn judge(state: &State, folder: &Path, names: &[&str]) -> Scent {
        state.judge(&names.iter().map(|name| folder.join(name)).collect(), None)
    }

    #[test]
    fn contents_are_told_from_all_else() {
        let scene = scene();
        let state = state(scene.path());
        let judge = |names: &[&str]| judge(&state, scene.path(), names);
        assert_eq!(judge(&["a.lipz", "act1/b.lipz", "act1/notes.txt"]), Scent::Inputs(vec![0, 1]));
        assert_eq!(judge(&["act1/notes.txt", "gone", "act1/.b.lipz.swp"]), Scent::Nothing);
        for unknown in ["act1", "new.lipz", "lipz.toml", "lipz-sync.txt", "hello.wav"] {
            assert_eq!(judge(&["a.lipz", unknown]), Scent::Unknown, "{unknown}");
        }
        fs::remove_file(scene.path().join("a.lipz")).unwrap();
        assert_eq!(judge(&["a.lipz"]), Scent::Unknown, "removed");
        std::os::unix::fs::symlink("act1/b.lipz", scene.path().join("a.lipz")).unwrap();
        assert_eq!(judge(&["a.lipz"]), Scent::Unknown, "a link");
        fs::rename(scene.path().join("act1"), scene.path().join("act2")).unwrap();
        assert_eq!(judge(&["gone"]), Scent::Unknown, "that was the folder, by another path");
    }

    #[test]
    fn files_with_several_paths_are_all_looked_at() {
        type Change = fn(&Path);
        let changes: [Change; 4] = [
            |folder| fs::hard_link(folder.join("a.lipz"), folder.join("c.lipz")).unwrap(),
            |folder| std::os::unix::fs::symlink("a.lipz", folder.join("c.lipz")).unwrap(),
            |folder| std::os::unix::fs::symlink("act1", folder.join("act2")).unwrap(),
            |folder| std::os::unix::fs::symlink("none", folder.join("c.lipz")).unwrap(),
        ];
        for change in changes {
            let scene = scene();
            assert_eq!(judge(&state(scene.path()), scene.path(), &["act1/b.lipz"]), Scent::Inputs(vec![1]));
            change(scene.path());
            assert_eq!(judge(&state(scene.path()), scene.path(), &["act1/b.lipz"]), Scent::Unknown);
        }
    }

    #[test]
    fn a_state_that_is_looked_at_again_is_that_of_now() {
        let scene = scene();
        let mut before = state(scene.path());
        assert!(before == state(scene.path()));
        fs::write(scene.path().join("a.lipz"), "{ }").unwrap();
        assert!(before != state(scene.path()));
        before.look_again(&BTreeSet::from([0]));
        assert!(before == state(scene.path()));
        fs::rename(scene.path().join("a.lipz"), scene.path().join("b.lipz")).unwrap();
        assert!(before != state(scene.path()));
    }
}
