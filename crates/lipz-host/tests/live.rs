//! A bank that is replaced while programs read it: nobody ever sees half of one.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

use lipz_bank::{Bank, ErrorKind};
use lipz_compiler::{Compiler, Input};
use lipz_host::{Error, FileBytes, Hold, LiveBank, OwnedBank};
use std::fs::{self, File};
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};
use std::thread;
use std::time::{Duration, Instant, SystemTime};
use tempfile::TempDir;

/// How long a step may take on a machine that is busy with other things.
const DEADLINE: Duration = Duration::from_secs(60);

/// On Windows no file is replaced while it is mapped.
const HOLDS: &[Hold] = if cfg!(windows) { &[Hold::InMemory] } else { &[Hold::Mapped, Hold::InMemory] };

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
fn readers_see_bank_with_textss_while_a_writer_replaces_them() {
    let banks: Vec<Vec<u8>> = (1..=8).map(version).collect();
    for &hold in HOLDS {
        let (_folder, path) = scene();
        let live = LiveBank::open(&path, hold).unwrap();
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
                        Err(Error::Bank(_)) => refused.fetch_add(1, Relaxed),
                        Err(Error::File(error)) => panic!("{error}"),
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
        assert_eq!(number(live.current().bank()), 8, "{hold:?}");
        assert_eq!(number(first.bank()), 1, "who holds a version reads on from it");
        assert!(read.load(Relaxed) > 0 && swapped.load(Relaxed) >= 20 && refused.load(Relaxed) >= 20);
    }
}

#[test]
fn the_same_file_is_not_read_again() {
    let (_folder, path) = scene();
    let live = LiveBank::open(&path, HOLDS[0]).unwrap();
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
    let live = LiveBank::open(&path, HOLDS[0]).unwrap();
    replace(&path, &damaged(&version(2), 1));
    let refusal = || match live.refresh() {
        Err(Error::Bank(error)) => error.kind(),
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
    let live = LiveBank::open(&path, HOLDS[0]).unwrap();
    fs::rename(&path, folder.path().join("away")).unwrap();
    for _ in 0..2 {
        assert!(matches!(live.refresh(), Err(Error::File(error)) if error.kind() == std::io::ErrorKind::NotFound));
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
    let live = LiveBank::open(&path, Hold::InMemory).unwrap();
    let bank = live.current();
    File::options().write(true).open(&path).unwrap().set_len(10).unwrap();
    assert_eq!(number(bank.bank()), 1);
    assert!(matches!(live.refresh(), Err(Error::Bank(_))));
}

#[test]
fn what_cannot_be_opened_says_why() {
    let (folder, path) = scene();
    for &hold in HOLDS {
        let missing = OwnedBank::open(folder.path().join("none"), hold).unwrap_err();
        assert!(matches!(missing, Error::File(_)), "{missing}");
        assert!(FileBytes::open(folder.path(), hold).is_err(), "a folder");
        fs::write(&path, b"").unwrap();
        let empty = OwnedBank::open(&path, hold).unwrap_err();
        assert!(matches!(&empty, Error::Bank(error) if error.kind() == ErrorKind::TooShort), "{empty}");
    }
    assert!(OwnedBank::of(version(3).into()).unwrap().verify().is_ok());
}
