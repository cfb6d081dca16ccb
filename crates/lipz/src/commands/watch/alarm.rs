//! Waiting for changes: collects events of the file system until they pause.

use super::scope::{Scope, concerns};
use crate::console;
use lipz_diagnostics::{Code, Report};
use notify::event::{AccessKind, AccessMode};
use notify::{ErrorKind, Event, EventKind, RecommendedWatcher, Watcher, recommended_watcher};
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

/// The pause without events that ends a change, because editors write a file in several steps.
const QUIET: Duration = Duration::from_millis(100);
/// The longest time for collecting events.
const PATIENCE: Duration = Duration::from_secs(1);
/// The interval of checks of folders that cannot be watched, usually because they do not exist.
const RETRY: Duration = Duration::from_secs(1);

/// The most paths that are passed on. After more changes, all files are checked.
const MOST_PATHS: usize = 1000;

/// A change of the file system.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Change {
    /// Whether a relevant file was changed, added or removed. If false, compare the state of the files to find out.
    pub(crate) is_certain: bool,
    /// All paths with events, as spelled by the system; `None` if they are incomplete.
    pub(super) paths: Option<BTreeSet<PathBuf>>,
}

impl Change {
    /// A change of unknown extent.
    const PERHAPS: Change = Change { is_certain: false, paths: None };

    /// Returns the union of both changes.
    fn and(self, next: Change) -> Change {
        let paths = self.paths.zip(next.paths).map(|(mut paths, mut next)| {
            paths.append(&mut next);
            paths
        });
        let paths = paths.filter(|paths| paths.len() <= MOST_PATHS);
        Change { is_certain: self.is_certain || next.is_certain, paths }
    }
}

/// Reports that files may have changed.
///
/// It is set again before all files are checked. This adds folders that replaced others of the same name, and folders
/// that a watcher missed. Changes between two settings are not lost, because all watchers send to the same channel.
pub(crate) struct Alarm {
    bell: Sender<Change>,
    rings: Receiver<Change>,
    /// The interval of checks, instead of waiting for events.
    poll: Option<Duration>,
    watcher: Option<RecommendedWatcher>,
    /// Folders that cannot be watched at present.
    unwatched: Vec<PathBuf>,
}

impl Alarm {
    pub(crate) fn new(poll: Option<Duration>) -> Alarm {
        let (bell, rings) = channel();
        Alarm { bell, rings, poll, watcher: None, unwatched: Vec::new() }
    }

    /// Watches the current contents of the scope.
    ///
    /// # Errors
    ///
    /// If the system does not support watching, or has reached its limit.
    pub(crate) fn set(&mut self, scope: &Scope) -> Result<(), Report> {
        if self.poll.is_some() {
            return Ok(());
        }
        // The watcher needs a thread, and stays silent without one.
        if let Err(error) = thread::Builder::new().spawn(|| ()) {
            return Err(cannot_watch(&error.into()));
        }
        self.unwatched.clear();
        let bell = self.bell.clone();
        let settings_name = scope.settings_name().map(ToOwned::to_owned);
        let mut watcher = recommended_watcher(move |event: notify::Result<Event>| {
            let concerns = |path: &PathBuf| concerns(settings_name.as_deref(), path);
            // An error concerns one folder. A check of the files shows more about it.
            let change = event.map_or(Some(Change::PERHAPS), |event| weigh(event, concerns));
            if let Some(change) = change {
                // The receiver is gone when the watch has ended.
                let _ = bell.send(change);
            }
        })
        .map_err(|error| cannot_watch(&error))?;
        for (folder, mode) in scope.folders() {
            match watcher.watch(&folder, mode) {
                Ok(()) => {}
                Err(error) if matches!(error.kind, ErrorKind::MaxFilesWatch) => return Err(cannot_watch(&error)),
                Err(_) => self.unwatched.push(folder),
            }
        }
        self.watcher = Some(watcher);
        Ok(())
    }

    /// Describes the watched folders for people.
    pub(crate) fn describe(&self, scope: &Scope) -> String {
        let (missing, watched): (Vec<_>, Vec<_>) = scope.places().into_iter().partition(|place| !place.exists());
        let list = |paths: &[PathBuf]| paths.iter().map(|path| console::path(path)).collect::<Vec<_>>().join(", ");
        let mut text = String::new();
        if !watched.is_empty() {
            text += &format!("          watching {}; press Ctrl-C to stop\n", list(&watched));
        }
        if !missing.is_empty() {
            text += &format!("          waiting for {}\n", list(&missing));
        }
        text
    }

    /// Waits for the start and the end of a change.
    pub(crate) fn wait(&self) -> Change {
        let retry = (!self.unwatched.is_empty()).then_some(RETRY);
        let first = match self.poll.or(retry) {
            Some(period) => self.rings.recv_timeout(period).ok(),
            None => self.rings.recv().ok(),
        };
        let Some(mut change) = first else { return Change::PERHAPS };
        let start = Instant::now();
        while start.elapsed() < PATIENCE {
            match self.rings.recv_timeout(QUIET) {
                Ok(next) => change = change.and(next),
                Err(_) => break,
            }
        }
        change
    }
}

/// Returns the report that the system does not support watching.
fn cannot_watch(error: &notify::Error) -> Report {
    let help = "check the files every few seconds with `--poll`, or raise the limits of the system";
    Report::failure("", Code::WatchFailed, format!("files cannot be watched: {error}"), help)
}

/// Returns the change that an event describes, or `None` if it is irrelevant. Packing itself reads and writes files.
fn weigh(event: Event, concerns: impl Fn(&PathBuf) -> bool) -> Option<Change> {
    let is_certain = event.paths.iter().any(concerns);
    match event.kind {
        // Too many events to distinguish. They may result from reading only.
        _ if event.need_rescan() => return Some(Change::PERHAPS),
        // This event also follows writing through a memory map.
        EventKind::Access(AccessKind::Close(AccessMode::Write)) if is_certain => {}
        EventKind::Access(_) => return None,
        // Ignore this event unless a path is a folder, or missing and therefore perhaps a former folder.
        _ if !is_certain && event.paths.iter().all(|path| path.is_file()) => return None,
        _ => {}
    }
    Some(Change { is_certain, paths: Some(event.paths.into_iter().collect()) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use notify::event::{CreateKind, DataChange, Flag, ModifyKind, RemoveKind, RenameMode};

    #[test]
    fn events_are_weighed() {
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str| {
            let path = folder.path().join(name);
            std::fs::write(&path, "").unwrap();
            path
        };
        let clip = file("a.LIPZ");
        let settings = file("lipz.toml");
        let (note, gone) = (file("a.txt"), folder.path().join("gone"));
        let data = EventKind::Modify(ModifyKind::Data(DataChange::Any));
        let from = EventKind::Modify(ModifyKind::Name(RenameMode::From));
        let read = EventKind::Access(AccessKind::Close(AccessMode::Read));
        let written = EventKind::Access(AccessKind::Close(AccessMode::Write));
        let of = |kind, path: &PathBuf| weigh(Event::new(kind).add_path(path.clone()), |path| concerns(None, path));
        let weigh = |kind, path: &PathBuf| {
            let change = of(kind, path)?;
            assert_eq!(change.paths, Some(BTreeSet::from([path.clone()])));
            Some(change.is_certain)
        };
        assert_eq!(weigh(data, &clip), Some(true));
        assert_eq!(weigh(data, &settings), Some(true));
        assert_eq!(weigh(EventKind::Remove(RemoveKind::File), &gone.with_extension("lipz")), Some(true));
        assert_eq!(weigh(read, &clip), None, "packing reads it");
        assert_eq!((weigh(written, &clip), weigh(written, &note)), (Some(true), None));
        assert_eq!(weigh(data, &note), None);
        assert_eq!(weigh(EventKind::Create(CreateKind::Folder), &folder.path().into()), Some(false));
        assert_eq!(weigh(from, &gone), Some(false), "it may have been a folder");
    }

    #[test]
    fn lost_events_are_looked_after() {
        let event = Event::new(EventKind::Other).set_flag(Flag::Rescan).add_path("a.lipz".into());
        assert_eq!(weigh(event, |_| true), Some(Change::PERHAPS));
    }

    #[test]
    fn a_burst_is_one_change() {
        let alarm = Alarm::new(None);
        let change = |is_certain, path: &str| Change { is_certain, paths: Some(BTreeSet::from([path.into()])) };
        for change in [change(false, "a"), change(true, "b"), change(false, "a")] {
            alarm.bell.send(change).unwrap();
        }
        let both = Change { is_certain: true, paths: Some(["a", "b"].map(PathBuf::from).into()) };
        assert_eq!(alarm.wait(), both);
        assert!(alarm.rings.try_recv().is_err(), "all of it is over");
        for change in [change(true, "a"), Change::PERHAPS, change(false, "b")] {
            alarm.bell.send(change).unwrap();
        }
        assert_eq!(alarm.wait(), Change { is_certain: true, paths: None });
        (0..=MOST_PATHS).for_each(|number| alarm.bell.send(change(false, &number.to_string())).unwrap());
        assert_eq!(alarm.wait(), Change::PERHAPS);
    }
}
