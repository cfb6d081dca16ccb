//! Waiting for changes: events of the file system, gathered until there is quiet.

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

/// How long there must be no event: editors write a file in several steps.
const QUIET: Duration = Duration::from_millis(100);
/// How long to gather events at most.
const PATIENCE: Duration = Duration::from_secs(1);
/// How often to look at folders that cannot be watched, most often because they do not exist.
const RETRY: Duration = Duration::from_secs(1);

/// Paths of which one is told at most; of more, all files are looked at.
const MOST_PATHS: usize = 1000;

/// What has happened.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Change {
    /// Whether a file that matters was changed, added or removed. Otherwise the state of the files shows whether something
    /// matters.
    pub(crate) is_certain: bool,
    /// All paths on which something has happened, as the system calls them; `None` if there may be others.
    pub(super) paths: Option<BTreeSet<PathBuf>>,
}

impl Change {
    /// Something happened, somewhere.
    const PERHAPS: Change = Change { is_certain: false, paths: None };

    /// Both.
    fn and(self, next: Change) -> Change {
        let paths = self.paths.zip(next.paths).map(|(mut paths, mut next)| {
            paths.append(&mut next);
            paths
        });
        let paths = paths.filter(|paths| paths.len() <= MOST_PATHS);
        Change { is_certain: self.is_certain || next.is_certain, paths }
    }
}

/// Rings when files may have changed.
///
/// It is set anew before all files are looked at: folders that were replaced by others of the same name are watched then,
/// and so are those that a watcher missed. What happens between two settings is not lost: all watchers
/// ring the same bell.
pub(crate) struct Alarm {
    bell: Sender<Change>,
    rings: Receiver<Change>,
    /// How often to look, instead of waiting for events.
    poll: Option<Duration>,
    watcher: Option<RecommendedWatcher>,
    /// Folders that cannot be watched for now.
    unwatched: Vec<PathBuf>,
}

impl Alarm {
    pub(crate) fn new(poll: Option<Duration>) -> Alarm {
        let (bell, rings) = channel();
        Alarm { bell, rings, poll, watcher: None, unwatched: Vec::new() }
    }

    /// Watches what is in the scope now.
    ///
    /// # Errors
    ///
    /// The system watches nothing, or nothing more.
    pub(crate) fn set(&mut self, scope: &Scope) -> Result<(), Report> {
        if self.poll.is_some() {
            return Ok(());
        }
        // The watcher takes a thread, and hears nothing without one.
        if let Err(error) = thread::Builder::new().spawn(|| ()) {
            return Err(cannot_watch(&error.into()));
        }
        self.unwatched.clear();
        let bell = self.bell.clone();
        let settings_name = scope.settings_name().map(ToOwned::to_owned);
        let mut watcher = recommended_watcher(move |event: notify::Result<Event>| {
            let concerns = |path: &PathBuf| concerns(settings_name.as_deref(), path);
            // An error is that of one folder; looking at the files tells more about it.
            let change = event.map_or(Some(Change::PERHAPS), |event| weigh(event, concerns));
            if let Some(change) = change {
                // Nobody hears it when the watch has ended.
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

    /// What it watches, and what it waits for, for people.
    pub(crate) fn describe(&self, scope: &Scope) -> String {
        let (missing, watched): (Vec<_>, Vec<_>) = scope.places().into_iter().partition(|place| !place.exists());
        let list = |paths: &[PathBuf]| paths.iter().map(|path| console::path(path)).collect::<Vec<_>>().join(", ");
        let mut text = String::new();
        if !watched.is_empty() {
            text += &format!("          watching {}; Ctrl-C ends\n", list(&watched));
        }
        if !missing.is_empty() {
            text += &format!("          waiting for {}\n", list(&missing));
        }
        text
    }

    /// Waits for a change, and until it is over.
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

/// The report that the system does not watch.
fn cannot_watch(error: &notify::Error) -> Report {
    let help = "look at the files every few seconds with `--poll`, or raise the limits of the system";
    Report::failure("", Code::WatchFailed, format!("files cannot be watched: {error}"), help)
}

/// What an event says; `None` if nothing that matters. Packing itself reads files and writes others.
fn weigh(event: Event, concerns: impl Fn(&PathBuf) -> bool) -> Option<Change> {
    let is_certain = event.paths.iter().any(concerns);
    match event.kind {
        // Too many events to be told apart, perhaps those of reading.
        _ if event.need_rescan() => return Some(Change::PERHAPS),
        // Also what was written through a memory map ends so.
        EventKind::Access(AccessKind::Close(AccessMode::Write)) if is_certain => {}
        EventKind::Access(_) => return None,
        // Not a folder, nor what is no longer there and may have been one.
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
