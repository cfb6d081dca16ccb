//! Files are replaced while programs read them: no program ever reads half of a version.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

use lipz_bank::{ClipId, Cursor, ErrorKind, Fps, Micros};
use lipz_compiler::{Compiler, Input};
use lipz_host::{Dialogue, FileBytes, OpenError, Source};
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};
use std::thread;
use std::time::{Duration, Instant, SystemTime};
use tempfile::TempDir;

/// The time allowed for a step on a busy machine.
const DEADLINE: Duration = Duration::from_secs(60);

/// A way to open a dialogue.
type Open = fn(&Path) -> Result<Dialogue, OpenError>;

/// In memory and mapped. On Windows, a mapped file cannot be replaced.
const WAYS: &[Open] = if cfg!(windows) { &[in_memory] } else { &[in_memory, mapped] };

fn in_memory(path: &Path) -> Result<Dialogue, OpenError> {
    Dialogue::open([path])
}

#[allow(unsafe_code, reason = "tests rename new files over old ones")]
fn mapped(path: &Path) -> Result<Dialogue, OpenError> {
    // SAFETY: no test changes or truncates a file that it has mapped.
    unsafe { Dialogue::open_mapped([path]) }
}

/// Returns a bank with the same number in texts, events, and the length of its clips.
fn version(number: usize) -> Vec<u8> {
    let file = format!(
        r#"{{ "visemes": "{}", "text_en-us": "{number}", "text_de-de": "{number}", "events": "feels v{number}" }}"#,
        "A".repeat(number)
    );
    let inputs: Vec<Input> = (0..30).map(|clip| Input::from_bytes(format!("clip-{clip}"), file.clone())).collect();
    Compiler::default().compile(&inputs).bank.unwrap()
}

/// Returns the number of a version.
fn number(dialogue: &Dialogue) -> usize {
    let mut numbers: Vec<usize> = Vec::new();
    for clip in dialogue.clips() {
        numbers.push(clip.frames().len());
        let segment = clip.segment(0).unwrap();
        numbers.extend(dialogue.locales().map(|locale| segment.text(locale).unwrap().parse::<usize>().unwrap()));
        let event = segment.events().next().unwrap().to_string();
        numbers.push(event.strip_prefix("feels v").unwrap().parse().unwrap());
    }
    assert_eq!(numbers.len(), 30 * 4);
    assert!(numbers.iter().all(|number| *number == numbers[0]), "of several versions: {numbers:?}");
    numbers[0]
}

/// Damages a copy in one of several ways.
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

/// Creates a folder with version 1.
fn scene() -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("dialogue.lipzbank");
    fs::write(&path, version(1)).unwrap();
    (folder, path)
}

/// Whether a refresh has opened something new.
fn is_new(dialogue: &mut Dialogue) -> bool {
    !dialogue.refresh().unwrap().is_empty()
}

fn until(what: &str, holds: impl Fn() -> bool) {
    let start = Instant::now();
    while !holds() {
        assert!(start.elapsed() < DEADLINE, "not within {DEADLINE:?}: {what}");
        thread::yield_now();
    }
}

/// Stops the threads of a test when it is dropped.
struct Stop<'a>(&'a AtomicBool);

impl Drop for Stop<'_> {
    fn drop(&mut self) {
        self.0.store(true, Relaxed);
    }
}

#[test]
fn readers_see_whole_versions_while_a_writer_replaces_them() {
    let banks: Vec<Vec<u8>> = (1..=8).map(version).collect();
    for (way, open) in WAYS.iter().enumerate() {
        let (_folder, path) = scene();
        let mut dialogue = open(&path).unwrap();
        let first = dialogue.clone();
        // The readers clone this dialogue.
        let current = Mutex::new(dialogue.clone());
        let is_over = AtomicBool::new(false);
        let [swapped, refused, read] = [(); 3].map(|()| AtomicUsize::new(0));
        thread::scope(|scope| {
            for _ in 0..3 {
                scope.spawn(|| {
                    while !is_over.load(Relaxed) {
                        let version = current.lock().unwrap().clone();
                        let seen = number(&version);
                        // Again, while it is being replaced.
                        assert_eq!(number(&version), seen);
                        read.fetch_add(1, Relaxed);
                    }
                });
            }
            scope.spawn(|| {
                while !is_over.load(Relaxed) {
                    match dialogue.refresh() {
                        Ok(changes) if changes.is_empty() => {}
                        Ok(changes) => {
                            assert!(changes.files().eq([path.as_path()]));
                            *current.lock().unwrap() = dialogue.clone();
                            swapped.fetch_add(1, Relaxed);
                        }
                        Err(error) => {
                            assert!(error.bank_error().is_some(), "{error}");
                            refused.fetch_add(1, Relaxed);
                        }
                    }
                }
            });
            // Also stops the threads if a step takes too long.
            let _stop = Stop(&is_over);
            for round in 0..400 {
                let bank = &banks[round % banks.len()];
                let before = refused.load(Relaxed);
                replace(&path, &damaged(bank, round));
                // The other side only keeps up occasionally.
                if round % 20 == 0 {
                    until("a refusal", || refused.load(Relaxed) > before);
                }
                replace(&path, bank);
                if round % 20 == 0 {
                    until("this version", || number(&current.lock().unwrap().clone()) == round % banks.len() + 1);
                }
            }
        });
        // Round 399 writes the last version.
        let _ = dialogue.refresh().unwrap();
        assert_eq!(number(&dialogue), 8, "way {way}");
        assert_eq!(number(&first), 1, "a clone stays at its version");
        assert!(read.load(Relaxed) > 0 && swapped.load(Relaxed) >= 15 && refused.load(Relaxed) >= 20);
    }
}

#[test]
fn the_same_file_is_not_taken_in_again() {
    let (_folder, path) = scene();
    let mut dialogue = Dialogue::open([&path]).unwrap();
    assert!(!is_new(&mut dialogue));
    replace(&path, &version(2));
    assert!(is_new(&mut dialogue) && !is_new(&mut dialogue));
    assert_eq!(number(&dialogue), 2);
    assert!(dialogue.files().eq([path.as_path()]));
}

/// The clocks of some file systems tick every two seconds: a new version within that time can look like the one before.
#[test]
fn a_version_that_looks_like_the_one_before_is_taken_in() {
    let (_folder, path) = scene();
    let same_length = |text: &str| {
        let file = format!(r#"{{ "visemes": "MA", "text_en-us": "{text}" }}"#);
        Compiler::default().compile(&[Input::from_bytes("line", file.as_bytes())]).into_bank().unwrap()
    };
    fs::write(&path, same_length("Aye.")).unwrap();
    let mut dialogue = Dialogue::open([&path]).unwrap();
    for text in ["Nay.", "Aye.", "Nay."] {
        fs::write(&path, same_length(text)).unwrap();
        assert!(is_new(&mut dialogue));
        let clip = dialogue.clip_by_key("line").unwrap();
        assert_eq!(clip.segment(0).unwrap().text(dialogue.locale("en-us").unwrap()).unwrap().as_str(), text);
        assert!(!is_new(&mut dialogue));
    }
}

#[test]
fn a_damaged_file_is_refused_until_it_changes() {
    let (_folder, path) = scene();
    let mut dialogue = Dialogue::open([&path]).unwrap();
    replace(&path, &damaged(&version(2), 1));
    let refusal = |dialogue: &mut Dialogue| dialogue.refresh().unwrap_err().bank_error().unwrap().kind();
    // The file was just written, so it may change again.
    assert_eq!([refusal(&mut dialogue), refusal(&mut dialogue)], [ErrorKind::Checksum; 2]);
    let an_hour_ago = SystemTime::now() - Duration::from_secs(3600);
    File::options().write(true).open(&path).unwrap().set_modified(an_hour_ago).unwrap();
    assert_eq!(refusal(&mut dialogue), ErrorKind::Checksum);
    assert!(!is_new(&mut dialogue), "refused, and the same as before");
    assert_eq!(number(&dialogue), 1);
    replace(&path, &version(2));
    assert!(is_new(&mut dialogue));
    assert_eq!(number(&dialogue), 2);
}

#[test]
fn a_missing_file_keeps_the_old_version() {
    let (folder, path) = scene();
    let mut dialogue = Dialogue::open([&path]).unwrap();
    fs::rename(&path, folder.path().join("away")).unwrap();
    for _ in 0..2 {
        let error = dialogue.refresh().unwrap_err();
        assert_eq!(error.io_error().unwrap().kind(), std::io::ErrorKind::NotFound);
    }
    assert_eq!(number(&dialogue), 1);
    fs::rename(folder.path().join("away"), &path).unwrap();
    dialogue.refresh().unwrap();
    assert_eq!(number(&dialogue), 1);
}

/// Contents in memory stay verified.
#[test]
fn memory_does_not_change_with_the_file() {
    let (_folder, path) = scene();
    let mut dialogue = Dialogue::open([&path]).unwrap();
    File::options().write(true).open(&path).unwrap().set_len(10).unwrap();
    assert_eq!(number(&dialogue), 1);
    assert!(dialogue.refresh().unwrap_err().bank_error().is_some());
}

#[test]
fn errors_name_the_file_and_the_remedy() {
    let (folder, path) = scene();
    for open in WAYS {
        let missing = open(&folder.path().join("none")).unwrap_err();
        assert!(missing.io_error().is_some() && missing.path() == folder.path().join("none"), "{missing}");
        assert!(missing.to_string().contains("check the path"), "{missing}");
        let directory = open(folder.path()).unwrap_err();
        let kind = directory.io_error().unwrap().kind();
        assert!(cfg!(windows) || kind == std::io::ErrorKind::IsADirectory, "{directory}");
        fs::write(&path, b"").unwrap();
        let empty = open(&path).unwrap_err();
        assert_eq!(empty.bank_error().unwrap().kind(), ErrorKind::TooShort, "{empty}");
        assert!(empty.to_string().contains("pack it again"), "{empty}");
    }
    let none: [&str; 0] = [];
    assert_eq!(Dialogue::open(none).unwrap_err().bank_error().unwrap().kind(), ErrorKind::LayerCount);
}

#[test]
#[allow(unsafe_code, reason = "no process changes the file")]
fn all_ways_to_open_answer_alike() {
    let (_folder, path) = scene();
    // SAFETY: no process changes the file.
    let (bytes, mapped) =
        unsafe { (FileBytes::map(&path).unwrap(), Dialogue::open_mapped_unverified([&path]).unwrap()) };
    assert_eq!(*bytes, *FileBytes::read(&path).unwrap());
    let given = Dialogue::open([Source::bytes("dialogue.lipzbank", version(1))]).unwrap();
    let mut all = [given, mapped, Dialogue::open_unverified([&path]).unwrap(), Dialogue::open([&path]).unwrap()];
    assert!(all.iter().all(|dialogue| number(dialogue) == 1));
    // Bytes do not change.
    replace(&path, &version(2));
    assert_eq!(all.each_mut().map(is_new), [false, true, true, true]);
    assert_eq!(all.each_ref().map(number), [1, 2, 2, 2]);
}

/// A playing cursor continues in the new version. A handle of the old version leads to nothing, and never to a panic.
#[test]
fn a_cursor_outlives_its_version_and_a_locale_does_not() {
    let (_folder, path) = scene();
    let mut dialogue = Dialogue::open([&path]).unwrap();
    let old = dialogue.clone();
    let id = ClipId::from_key("clip-7");
    let mut cursor = Cursor::new(&old.clip(id).unwrap().or_fps(Fps::whole(24))).unwrap();
    assert_eq!(cursor.advance_to(&old.clip(id).unwrap(), Micros(0)).count(), 1);
    let german = old.locale("de-de").unwrap();
    replace(&path, &version(5));
    assert!(is_new(&mut dialogue));
    let clip = dialogue.clip(id).unwrap();
    assert_eq!(cursor.advance_to(&clip, Micros(83_334)).count(), 0, "its one segment has fired");
    assert_eq!((cursor.frame(), cursor.viseme(&clip).to_char(), cursor.is_over()), (Some(2), 'A', false));
    let segment = cursor.segment(&clip).unwrap();
    assert_eq!((segment.text(german), dialogue.locale_tag(german), old.locale_tag(german)), (None, "", "de-de"));
    assert_eq!(segment.text(dialogue.locale("de-de").unwrap()).unwrap().as_str(), "5");
}
