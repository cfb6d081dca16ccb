//! Checks of whole projects, one at a time, on a separate thread.

use super::{Server, path_name};
use crate::project::{CheckedProject, KnownProject, Project, each_file};
use crate::words::Words;
use crossbeam_channel::{Receiver, Sender, unbounded};
use lipz_sync::Recordings;
use std::collections::{BTreeMap, HashMap};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

/// The time until the next try if the system has no thread.
const NO_THREAD: Duration = Duration::from_secs(1);
/// The pause in typing before a project is checked.
const PAUSE: Duration = Duration::from_millis(300);

/// A project whose check takes longer is checked when a file is saved, not while you type.
const LONGEST_WHILE_TYPING: Duration = Duration::from_millis(1_000);

/// The caller's check of a whole project.
type Check = dyn Fn(&Project, &HashMap<String, String>) -> CheckedProject + Send + Sync;

/// The result of checking a project.
pub(super) struct CheckRun {
    pub(super) home: PathBuf,
    pub(super) checked: CheckedProject,
    pub(super) words: Words,
    pub(super) recordings: Recordings,
    /// The versions of the open files that it used, by path name.
    pub(super) versions: HashMap<String, i32>,
    pub(super) took: Duration,
}

/// The pending checks, and the running one.
pub(super) struct Runs {
    check: Arc<Check>,
    sender: Sender<CheckRun>,
    pub(super) results: Receiver<CheckRun>,
    is_running: bool,
    /// The start time of each pending check.
    wanted: BTreeMap<PathBuf, Instant>,
    took: HashMap<PathBuf, Duration>,
}

impl Runs {
    pub(super) fn new(
        check: impl Fn(&Project, &HashMap<String, String>) -> CheckedProject + Send + Sync + 'static,
    ) -> Runs {
        let (sender, results) = unbounded();
        let (wanted, took) = (BTreeMap::new(), HashMap::new());
        Runs { check: Arc::new(check), sender, results, is_running: false, wanted, took }
    }

    /// Schedules a check now.
    pub(super) fn soon(&mut self, home: &Path) {
        self.wanted.insert(home.to_owned(), Instant::now());
    }

    /// Schedules a check after a pause, if it is fast.
    pub(super) fn after_typing(&mut self, home: &Path) {
        if self.took.get(home).is_some_and(|took| *took <= LONGEST_WHILE_TYPING) {
            self.wanted.insert(home.to_owned(), Instant::now() + PAUSE);
        }
    }

    /// Returns the start of the next check; `None` while one runs.
    pub(super) fn next_start(&self) -> Option<Instant> {
        self.wanted.values().min().copied().filter(|_| !self.is_running)
    }

    /// Records the end of a check.
    pub(super) fn done(&mut self, home: &Path, took: Duration) {
        self.is_running = false;
        self.took.insert(home.to_owned(), took);
    }
}

impl<W: Write> Server<W> {
    /// Starts the check that is due.
    pub(super) fn start_run(&mut self) -> io::Result<()> {
        let due = self.runs.wanted.iter().min_by_key(|(_, start)| **start).map(|(home, _)| home.clone());
        let Some(home) = due.filter(|_| !self.runs.is_running) else { return Ok(()) };
        self.runs.wanted.remove(&home);
        if self.projects.get_mut(&home).is_some_and(KnownProject::follow_settings) {
            // They were changed by an editor that does not report changed files.
            self.documents.values_mut().for_each(|document| document.is_stale = true);
            self.publish_settings(&home)?;
        }
        let Some(known) = self.projects.get(&home) else { return Ok(()) };
        let project = known.project.clone();
        let open = self.documents.values().filter_map(|document| Some((document.path.clone()?, document)));
        let open: Vec<(PathBuf, i32, String)> =
            open.map(|(path, document)| (path, document.version, document.text.clone())).collect();
        let (check, sender) = (Arc::clone(&self.runs.check), self.runs.sender.clone());
        let again = home.clone();
        let work = move || {
            // The server may already be gone.
            let _ = sender.send(run(home, &project, &*check, open));
        };
        self.runs.is_running = thread::Builder::new().spawn(work).is_ok();
        if !self.runs.is_running {
            // The system has no thread now. Later it may have one.
            self.runs.wanted.insert(again, Instant::now() + NO_THREAD);
        }
        Ok(())
    }
}

fn run(home: PathBuf, project: &Project, check: &Check, open: Vec<(PathBuf, i32, String)>) -> CheckRun {
    let start = Instant::now();
    let versions = open.iter().map(|(path, version, _)| (path_name(path), *version)).collect();
    // Saved files are read from disk, because records refer to them by path.
    let is_unsaved =
        |(path, _, text): &(PathBuf, i32, String)| std::fs::read(path).ok().as_deref() != Some(text.as_bytes());
    let unsaved = open.into_iter().filter(is_unsaved).map(|(path, _, text)| (path_name(&path), text)).collect();
    let checked = check(project, &unsaved);
    let mut words = Words::default();
    for found in each_file(project, &checked.inputs, &unsaved, words_of) {
        words.add(found);
    }
    let (recordings, _) = Recordings::discover_with_reports(&project.settings);
    CheckRun { home, checked, words, recordings, versions, took: start.elapsed() }
}

fn words_of(_name: &str, bytes: &[u8]) -> Words {
    lipz_file::parse(bytes).document.map(|document| Words::of(&document)).unwrap_or_default()
}
