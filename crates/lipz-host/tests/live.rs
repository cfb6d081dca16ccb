//! A bank that is replaced while programs read it: nobody ever sees half of one.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

use lipz_bank::{Bank, ClipId, Cursor, ErrorKind, Fps, Micros};
use lipz_compiler::{Compiler, Input};
use lipz_host::{FileBytes, LiveBank, OpenError, OwnedBank};
use std::fs::{self, File};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};
use std::thread;
use std::time::{Duration, Instant, SystemTime};
use tempfile::TempDir;

/// How long a step may take on a machine that is busy with other things.
const DEADLINE: Duration = Duration::from_secs(60);

/// A way to open a live bank.
type Open = fn(&Path) -> Result<LiveBank, OpenError>;

/// In memory and mapped. On Windows no file is replaced while it is mapped.
const WAYS: &[Open] = if cfg!(windows) { &[in_memory] } else { &[in_memory, mapped] };

fn in_memory(path: &Path) -> Result<LiveBank, OpenError> {
    LiveBank::open(path)
}

#[allow(unsafe_code, reason = "tests rename new files over old ones")]
fn mapped(path: &Path) -> Result<LiveBank, OpenError> {
    // SAFETY: no test changes or truncates a file that it has mapped.
    unsafe { LiveBank::open_mapped(path) }
}

/// A bank that says the same number everywhere: in texts, events, and the length of its clips.
fn version(number: usize) -> Vec<u8> {
    let file = format!(
        r#"{{ "visemes": "{}", "text_en-us": "{number}", "text_de-de": "{number}", "events": "feels v{number}" }}"#,
        "A".repeat(number)
    );
    let inputs: Vec<Input> = (0..30).map(|clip| Input::from_bytes(format!("clip-{clip}"), file.clone())).collect();
    Compiler::default().compile(&inputs).bank.unwrap()
}

/// The number that all of a bank says.
fn number(bank: &Bank<'_>) -> usize {
    let mut numbers: Vec<usize> = Vec::new();
    for clip in bank.clips() {
        numbers.push(clip.frames().len());
        let segment = clip.segment(0).unwrap();
        numbers.extend(bank.locales().map(|locale| segment.text(locale).unwrap().parse::<usize>().unwrap()));
        let event = segment.events().next().unwrap().to_string();
        numbers.push(event.strip_prefix("feels v").unwrap().parse().unwrap());
    }
    assert_eq!(numbers.len(), 30 * 4);
    assert!(numbers.iter().all(|number| *number == numbers[0]), "of several versions: {numbers:?}");
    numbers[0]
}

/// The ways in which a copy goes wrong.
fn damaged(bank: &[u8], way: usize) -> Vec<u8> {
    let mut bytes = bank.to_vec();
    match way % 5 {
        0 => bytes.truncate(bank.len() / 2),
        1 => bytes[bank.len() / 2] ^= 1,
        2 => bytes.clear(),
        3 => bytes.extend(b"more"),
        _ => bytes = br#"{ "text_en-us": "No bank." }"#.to_vec(),
    }
    bytes
}

/// Replaces a file as `lipz pack` does.
fn replace(path: &Path, bytes: &[u8]) {
    let temporary = path.with_extension("new");
    fs::write(&temporary, bytes).unwrap();
    fs::rename(&temporary, path).unwrap();
}

/// A folder with version 1.
fn scene() -> (TempDir, std::path::PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("dialogue.lipzbank");
    fs::write(&path, version(1)).unwrap();
    (folder, path)
}

fn until(what: &str, holds: impl Fn() -> bool) {
    let start = Instant::now();
    while !holds() {
        assert!(start.elapsed() < DEADLINE, "not within {DEADLINE:?}: {what}");
        thread::yield_now();
    }
}

#[test]
fn readers_see_whole_banks_while_a_writer_replaces_them() {
    let banks: Vec<Vec<u8>> = (1..=8).map(version).collect();
    for (way, open) in WAYS.iter().enumerate() {
        let (_folder, path) = scene();
        let live = open(&path).unwrap();
        let first = live.current();
        let is_over = AtomicBool::new(false);
        let [swapped, refused, read] = [(); 3].map(|()| AtomicUsize::new(0));
        thread::scope(|scope| {
            for _ in 0..3 {
                scope.spawn(|| {
                    while !is_over.load(Relaxed) {
                        let version = live.current();
                        let seen = number(version.bank());
                        // Once more, while it is being replaced.
                        assert_eq!(number(version.bank()), seen);
                        read.fetch_add(1, Relaxed);
                    }
                });
            }
            scope.spawn(|| {
                while !is_over.load(Relaxed) {
                    match live.refresh() {
                        Ok(true) => swapped.fetch_add(1, Relaxed),
                        Ok(false) => 0,
                        Err(OpenError::Bank(_)) => refused.fetch_add(1, Relaxed),
                        Err(error) => panic!("{error}"),
                    };
                }
            });
            for round in 0..400 {
                let bank = &banks[round % banks.len()];
                let before = [&swapped, &refused].map(|count| count.load(Relaxed));
                replace(&path, &damaged(bank, round));
                // The other side keeps up now and then only.
                if round % 20 == 0 {
                    until("a refusal", || refused.load(Relaxed) > before[1]);
                }
                replace(&path, bank);
                if round % 20 == 0 {
                    until("a new version", || swapped.load(Relaxed) > before[0]);
                }
            }
            is_over.store(true, Relaxed);
        });
        // The last word of the writer is round 399.
        let _ = live.refresh().unwrap();
        assert_eq!(number(live.current().bank()), 8, "way {way}");
        assert_eq!(number(first.bank()), 1, "who holds a version reads on from it");
        assert!(read.load(Relaxed) > 0 && swapped.load(Relaxed) >= 20 && refused.load(Relaxed) >= 20);
    }
}

#[test]
fn the_same_file_is_not_read_again() {
    let (_folder, path) = scene();
    let live = LiveBank::open(&path).unwrap();
    assert!(!live.refresh().unwrap());
    replace(&path, &version(2));
    assert!(live.refresh().unwrap());
    assert!(!live.refresh().unwrap());
    assert_eq!(number(live.current().bank()), 2);
    assert_eq!(live.path(), path);
}

#[test]
fn a_damaged_file_is_refused_until_it_changes() {
    let (_folder, path) = scene();
    let live = LiveBank::open(&path).unwrap();
    replace(&path, &damaged(&version(2), 1));
    let refusal = || match live.refresh() {
        Err(OpenError::Bank(error)) => error.kind(),
        other => panic!("{other:?}"),
    };
    // Just written: there may be more to come.
    assert_eq!([refusal(), refusal()], [ErrorKind::Checksum; 2]);
    let an_hour_ago = SystemTime::now() - Duration::from_secs(3600);
    File::options().write(true).open(&path).unwrap().set_modified(an_hour_ago).unwrap();
    assert_eq!(refusal(), ErrorKind::Checksum);
    assert!(!live.refresh().unwrap(), "refused, and the same as before");
    assert_eq!(number(live.current().bank()), 1);
    replace(&path, &version(2));
    assert!(live.refresh().unwrap());
    assert_eq!(number(live.current().bank()), 2);
}

#[test]
fn a_missing_file_keeps_the_old_bank() {
    let (folder, path) = scene();
    let live = LiveBank::open(&path).unwrap();
    fs::rename(&path, folder.path().join("away")).unwrap();
    for _ in 0..2 {
        assert!(matches!(live.refresh(), Err(OpenError::File(error)) if error.kind() == std::io::ErrorKind::NotFound));
    }
    assert_eq!(number(live.current().bank()), 1);
    fs::rename(folder.path().join("away"), &path).unwrap();
    live.refresh().unwrap();
    assert_eq!(number(live.current().bank()), 1);
}

/// What is held in memory was verified for good.
#[test]
fn memory_does_not_change_with_the_file() {
    let (_folder, path) = scene();
    let live = LiveBank::open(&path).unwrap();
    let bank = live.current();
    File::options().write(true).open(&path).unwrap().set_len(10).unwrap();
    assert_eq!(number(bank.bank()), 1);
    assert!(matches!(live.refresh(), Err(OpenError::Bank(_))));
}

#[test]
fn what_cannot_be_opened_says_why() {
    let (folder, path) = scene();
    for open in WAYS {
        let missing = open(&folder.path().join("none")).unwrap_err();
        assert!(matches!(missing, OpenError::File(_)), "{missing}");
        let directory = open(folder.path()).unwrap_err();
        let OpenError::File(error) = &directory else { panic!("{directory}") };
        assert!(cfg!(windows) || error.kind() == std::io::ErrorKind::IsADirectory, "{error}");
        fs::write(&path, b"").unwrap();
        let empty = open(&path).unwrap_err();
        assert!(matches!(&empty, OpenError::Bank(error) if error.kind() == ErrorKind::TooShort), "{empty}");
    }
    assert!(FileBytes::read(folder.path()).is_err() && OwnedBank::open(folder.path()).is_err(), "a folder");
    assert!(OwnedBank::from_bytes(version(3).into()).unwrap().verify().is_ok());
}

#[test]
#[allow(unsafe_code, reason = "nobody changes the file")]
fn a_map_has_the_bytes_of_the_file() {
    let (_folder, path) = scene();
    // SAFETY: nobody changes the file.
    let (bytes, bank) = unsafe { (FileBytes::map(&path).unwrap(), OwnedBank::open_mapped(&path).unwrap()) };
    assert_eq!(*bytes, *FileBytes::read(&path).unwrap());
    assert_eq!(number(bank.verify().unwrap().bank()), 1);
}

/// What is playing goes on in the new version; a handle of the old one leads to nothing there.
#[test]
fn a_cursor_outlives_its_bank_and_a_locale_does_not() {
    let (_folder, path) = scene();
    let live = LiveBank::open(&path).unwrap();
    let old = live.current();
    let id = ClipId::from_key("clip-7");
    let mut cursor = Cursor::new(&old.bank().clip(id).unwrap().or_fps(Fps::whole(24))).unwrap();
    assert_eq!(cursor.advance_to(&old.bank().clip(id).unwrap(), Micros(0)).count(), 1);
    replace(&path, &version(5));
    assert!(live.refresh().unwrap());
    let new = live.current();
    let clip = new.bank().clip(id).unwrap();
    assert_eq!(cursor.advance_to(&clip, Micros(83_334)).count(), 0, "its one segment has fired");
    assert_eq!((cursor.frame(), cursor.viseme(&clip).to_char(), cursor.is_over()), (Some(2), 'A', false));
    let (german, segment) = (old.bank().locale("de-de").unwrap(), cursor.segment(&clip).unwrap());
    assert!(german.is_of(old.bank()) && !german.is_of(new.bank()));
    let stale = catch_unwind(AssertUnwindSafe(|| segment.text(german)));
    assert!(if cfg!(debug_assertions) { stale.is_err() } else { matches!(stale, Ok(None)) });
    let german = new.bank().locale("de-de").unwrap();
    assert_eq!(segment.text(german).unwrap().as_str(), "5");
}
