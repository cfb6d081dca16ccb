//! `lipz watch` as users run it: files change, and the bank follows.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "tests")]

mod support;

#[cfg(unix)]
use lipz_host::Dialogue;
use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};
use support::{Scene, lipz, tree};

/// The time limit of a step on a busy machine.
const DEADLINE: Duration = Duration::from_secs(30);
/// The interval between checks whether it is done.
const LOOK: Duration = Duration::from_millis(50);
/// Enough time for many runs if each caused the next.
const MANY_RUNS: Duration = Duration::from_secs(1);

const AYE: &str = r#"{ "text_en-us": "Aye." }"#;
const NO: &str = r#"{ "text_en-us": "No." }"#;
const BROKEN: &str = r#"{ "text_en-us": "Per"#;
const BANK: &str = "out/b.lipzbank";

/// A running `lipz watch`; it ends with the test.
struct Watch<'a> {
    scene: &'a Scene,
    child: Child,
    stdout: Arc<Mutex<String>>,
    stderr: Arc<Mutex<String>>,
}

impl Drop for Watch<'_> {
    fn drop(&mut self) {
        // Fails if the test has ended it.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Collects the output of a stream.
fn collect(mut stream: impl Read + Send + 'static) -> Arc<Mutex<String>> {
    let text = Arc::new(Mutex::new(String::new()));
    let collected = Arc::clone(&text);
    thread::spawn(move || {
        let mut buffer = [0; 4096];
        while let Ok(length @ 1..) = stream.read(&mut buffer) {
            text.lock().unwrap().push_str(&String::from_utf8_lossy(&buffer[..length]));
        }
    });
    collected
}

impl<'a> Watch<'a> {
    fn start(scene: &'a Scene, arguments: &[&str]) -> Watch<'a> {
        Watch::spawn(scene, Command::new(env!("CARGO_BIN_EXE_lipz")).arg("watch").args(arguments))
    }

    fn spawn(scene: &'a Scene, command: &mut Command) -> Watch<'a> {
        let mut child = command
            .current_dir(scene.path())
            .env("NO_COLOR", "1")
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let (stdout, stderr) = (collect(child.stdout.take().unwrap()), collect(child.stderr.take().unwrap()));
        Watch { scene, child, stdout, stderr }
    }

    /// Starts it on a scene whose first run succeeds.
    fn started(scene: &'a Scene, arguments: &[&str]) -> Watch<'a> {
        let watch = Watch::start(scene, arguments);
        watch.until("watching", |watch| watch.stdout().contains("watching"));
        watch
    }

    fn stdout(&self) -> String {
        self.stdout.lock().unwrap().clone()
    }

    fn stderr(&self) -> String {
        self.stderr.lock().unwrap().clone()
    }

    /// Returns the number of runs with this result.
    fn count(&self, result: &str) -> usize {
        self.stdout().matches(result).count()
    }

    /// Sends it a signal, for example `INT`.
    #[cfg(unix)]
    fn signal(&self, name: &str) {
        let arguments = ["-s", name, &self.child.id().to_string()];
        assert!(Command::new("kill").args(arguments).status().unwrap().success());
    }

    fn until(&self, what: &str, mut holds: impl FnMut(&Watch<'_>) -> bool) {
        let start = Instant::now();
        while !holds(self) {
            let (stdout, stderr) = (self.stdout(), self.stderr());
            assert!(start.elapsed() < DEADLINE, "not within {DEADLINE:?}: {what}\n{stdout}\n{stderr}");
            thread::sleep(LOOK);
        }
    }

    /// Waits until the bank equals the result of `lipz pack` on the sources.
    fn until_packed(&self, what: &str, sources: &str) {
        self.until_packed_with(what, &[sources]);
    }

    /// The same with further arguments of `lipz pack`.
    fn until_packed_with(&self, what: &str, arguments: &[&str]) {
        self.scene.prepare(&[&["pack", "-o", "expected/b.lipzbank"], arguments].concat());
        let expected = fs::read(self.scene.path().join("expected/b.lipzbank")).unwrap();
        self.until(what, |watch| fs::read(watch.scene.path().join(BANK)).is_ok_and(|bank| bank == expected));
    }

    /// Makes a change that causes errors, and waits for the diagnostic. The bank stays.
    fn refuses(&self, change: impl FnOnce(), diagnostic: &str) {
        let (before, runs) = (self.bank(), self.count("not packed: the old bank is kept"));
        change();
        self.until(diagnostic, |watch| {
            watch.stderr().contains(diagnostic) && watch.count("not packed: the old bank is kept") > runs
        });
        assert_eq!(self.bank(), before);
    }

    fn bank(&self) -> Vec<u8> {
        fs::read(self.scene.path().join(BANK)).unwrap()
    }
}

#[test]
fn the_bank_follows_the_files() {
    let scene = Scene::new();
    scene.write("voices/a.lipz", AYE);
    let watch = Watch::started(&scene, &["voices", "-o", BANK]);
    watch.until_packed("the first pack", "voices");
    let voices = scene.path().join("voices");
    scene.write("voices/a.lipz", NO);
    watch.until_packed("a changed file", "voices");
    watch.refuses(|| scene.write("voices/a.lipz", BROKEN), "error[LZ0108]");
    scene.write("voices/a.lipz", AYE);
    scene.write("voices/b.lipz", NO);
    watch.until_packed("mended, and a new file", "voices");
    fs::write(voices.join("b.lipz~"), AYE).unwrap();
    fs::rename(voices.join("b.lipz~"), voices.join("b.lipz")).unwrap();
    watch.until_packed("a file replaced as editors do it", "voices");
    scene.write("voices/act1/c.lipz", AYE);
    watch.until_packed("a new folder", "voices");
    scene.write("voices/act1/c.lipz", NO);
    watch.until_packed("a changed file in it", "voices");
    fs::rename(voices.join("act1"), voices.join("act2")).unwrap();
    watch.until_packed("a renamed folder", "voices");
    fs::rename(voices.join("act2"), scene.path().join("away")).unwrap();
    watch.until_packed("a folder moved away", "voices");
    fs::remove_file(voices.join("b.lipz")).unwrap();
    watch.until_packed("a removed file", "voices");
}

/// For any changes of files and folders, in one step or several, the bank equals that of `lipz pack`.
#[test]
fn the_bank_follows_everything() {
    let scene = Scene::new();
    let mut seed = 7_u64;
    let mut next = |below: usize| {
        seed = seed.wrapping_mul(0x5851_F42D_4C95_7F2D).wrapping_add(0x1405_7B7E_F767_814F);
        (seed >> 33) as usize % below
    };
    let clip = |take: usize, text: &str| {
        let (mouth, event) =
            ("MA-E".repeat(1 + take % 5), ["", "|otto feels sad"][usize::from(take.is_multiple_of(7))]);
        let events = if event.is_empty() { String::new() } else { format!(r#", "events": "{event}""#) };
        format!(
            r#"{{ "fps": 24, "viseme_type": "blair", "visemes": "{mouth}|A", "text_en-us": "{text}|Aye.", "text_de-de": "{text}!|Ja."{events} }}"#
        )
    };
    let settings = |strips: bool| {
        format!("sources = [\"voices\"]\noutput = \"{BANK}\"\ndefault-locale = \"en-us\"\nstrip = {strips}\n")
    };
    scene.write("lipz.toml", settings(false));
    (0..24).for_each(|number| {
        scene.write(&format!("voices/act{}/{number}.lipz", number % 3), clip(number, &format!("Line {number}.")));
    });
    let at = |name: String| scene.path().join("voices").join(name);
    let watch = Watch::started(&scene, &[]);
    for step in 0..40 {
        for _ in 0..1 + next(2) {
            let (number, take) = (next(24), next(1000));
            let act = format!("act{}", number % 3);
            let file = at(format!("{act}/{number}.lipz"));
            let text = format!("Take {take}.");
            let kind = next(12);
            println!("step {step}: {kind} of {act}/{number}, take {take}"); // shown if the test fails
            match kind {
                // Most changes write a file.
                0..=3 if file.is_file() => fs::write(&file, clip(take, &text)).unwrap(),
                4 if file.is_file() => {
                    fs::write(at("draft.tmp".to_owned()), clip(take, &text)).unwrap();
                    fs::rename(at("draft.tmp".to_owned()), &file).unwrap();
                }
                5 if file.is_file() => fs::write(&file, format!(" {}", fs::read_to_string(&file).unwrap())).unwrap(),
                6 if file.is_file() => fs::write(&file, clip(take, "Line 1.")).unwrap(),
                7 if file.is_file() => fs::remove_file(&file).unwrap(),
                8 if file.is_file() => fs::rename(&file, file.with_file_name(format!("{take}-{number}.lipz"))).unwrap(),
                9 if at(act.clone()).is_dir() => fs::rename(at(act), at(format!("scene{step}-{take}"))).unwrap(),
                10 => scene.write("lipz.toml", settings(take.is_multiple_of(2))),
                _ => scene.write(&format!("voices/{act}/{number}.lipz"), clip(take, &text)),
            }
        }
        watch.until_packed_with(&format!("step {step}"), &[]);
    }
    assert!(watch.count("packed into") > 20, "{}", watch.stdout());
}

#[test]
fn dubs_follow_their_files() {
    let scene = Scene::new();
    scene.write("lipz.toml", "default-locale = \"en-us\"\n[voices]\nen-us = \"{key}\"\nde-de = \"de/{key}\"\n");
    scene.write("voices/a.lipz", r#"{ "fps": 24, "visemes": "MA", "text_en-us": "Aye.", "text_de-de": "Ja." }"#);
    let watch = Watch::started(&scene, &["voices", "-o", BANK]);
    for (what, dub) in [("a new dub", "AMA"), ("another take of it", "AMAA")] {
        scene.write("voices/de/a.lipz", format!(r#"{{ "fps": 24, "visemes": "{dub}" }}"#));
        watch.until_packed(what, "voices");
    }
    watch.refuses(|| scene.write("voices/de/a.lipz", r#"{ "fps": 24, "visemes": "A|M" }"#), "error[LZ2002]");
    fs::remove_file(scene.path().join("voices/de/a.lipz")).unwrap();
    watch.until_packed("no dub", "voices");
}

#[test]
fn a_layer_follows_the_files() {
    let scene = Scene::new();
    scene.write("voices/a.lipz", AYE);
    scene.write("voices/b.lipz", NO);
    scene.prepare(&["pack", "voices", "-o", "base.lipzbank"]);
    let over = ["voices", "--over", "base.lipzbank"];
    let watch = Watch::start(&scene, &[&over[..], &["-o", BANK]].concat());
    watch.until("no difference from the base", |watch| watch.stderr().contains("error[LZ2101]"));
    scene.write("voices/a.lipz", NO);
    watch.until_packed_with("a changed file", &over);
    fs::remove_file(scene.path().join("voices/b.lipz")).unwrap();
    watch.until_packed_with("a removal", &over);
    // The bank below is a different one.
    scene.write("base/c.lipz", AYE);
    scene.prepare(&["pack", "base", "-o", "base.lipzbank"]);
    scene.write("voices/a.lipz", AYE);
    watch.until_packed_with("another base", &over);
}

#[test]
fn a_bank_with_the_same_bytes_is_not_written() {
    let scene = Scene::new();
    scene.write("voices/a.lipz", AYE);
    let watch = Watch::started(&scene, &["voices/*.lipz", "-o", BANK, "--config", "strip=true"]);
    let written = || fs::metadata(scene.path().join(BANK)).unwrap().modified().unwrap();
    let before = written();
    scene.write("voices/a.lipz", format!("\n{AYE}\n"));
    watch.until("a run without a change", |watch| watch.count("unchanged: 1 clip in out/b.lipzbank") > 0);
    assert_eq!(written(), before);
}

/// Returns the message about reused files.
fn recalled(count: usize, of: &str) -> String {
    format!("{count} of {of} recalled from the bank")
}

#[test]
fn only_changed_files_are_read_again() {
    let scene = Scene::new();
    scene.write("voices/a.lipz", AYE);
    scene.write("voices/b.lipz", NO);
    let watch = Watch::started(&scene, &["voices", "-o", BANK, "--config", "split-locales=true", "--timings"]);
    watch.until("a first run", |watch| watch.count(&recalled(0, "2 clips")) == 1);
    scene.write("voices/b.lipz", BROKEN);
    watch.until("errors", |watch| watch.count("not packed") > 0);
    scene.write("voices/b.lipz", AYE);
    watch.until("what came before the errors", |watch| watch.count(&recalled(1, "2 clips")) > 0);
}

#[test]
fn a_cache_is_taken_over_and_left() {
    let scene = Scene::new();
    scene.write("voices/a.lipz", AYE);
    let arguments = ["voices", "-o", BANK, "--cache", "dialogue.cache", "--timings"];
    scene.prepare(&[&["pack"], &arguments[..]].concat());
    let watch = Watch::started(&scene, &arguments);
    watch.until("a first run that recalls", |watch| watch.count(&recalled(1, "1 clip")) == 1);
    scene.write("voices/b.lipz", NO);
    watch.until("a new file", |watch| watch.count(&recalled(1, "2 clips")) > 0);
    drop(watch);
    let packed = lipz(scene.path(), [&["pack"], &arguments[..]].concat());
    assert!(packed.stdout.contains(&recalled(2, "2 clips")), "{}", packed.stdout);
    let refused = Watch::start(&scene, &["voices", "-o", BANK, "--cache", "voices/a.lipz"]);
    refused.until("the diagnostic", |watch| watch.stderr().contains("is not a lipz cache and is not overwritten"));
}

/// The bank is packed, and reported as packed, if only an additional output fails.
#[test]
fn a_cache_or_depfile_that_cannot_be_written_is_no_failure_of_the_bank() {
    let scene = Scene::new();
    scene.write("voices/a.lipz", AYE);
    let watch = Watch::started(&scene, &["voices", "-o", BANK, "--cache", "cache", "--depfile", "b.d"]);
    let cannot_be_written = |name: &str| {
        fs::remove_file(scene.path().join(name)).unwrap();
        fs::create_dir(scene.path().join(name)).unwrap();
    };
    cannot_be_written("cache");
    scene.write("voices/a.lipz", NO);
    watch.until_packed("a run without its cache", "voices");
    watch.until("the diagnostic", |watch| watch.stderr().contains("error[LZ0904]: `cache` "));
    cannot_be_written("b.d");
    scene.write("voices/b.lipz", NO);
    watch.until_packed("a run without its depfile", "voices");
    watch.until("the diagnostic", |watch| watch.stderr().contains("error[LZ0904]: `b.d` "));
    watch.until("that it is packed", |watch| watch.count("2 clips packed into out/b.lipzbank") > 0);
    assert_eq!(watch.count("not packed"), 0, "{}", watch.stdout());
}

#[test]
fn outputs_among_the_sources_cause_no_run() {
    let scene = Scene::new();
    scene.write("a.lipz", AYE);
    let watch =
        Watch::started(&scene, &[".", "-o", "b.lipzbank", "--depfile", "b.d", "--config", "split-locales=true"]);
    scene.write("a.lipz", NO);
    watch.until("a second run", |watch| watch.count("1 clip packed into b.lipzbank and 1 text bank") == 2);
    let before = watch.stdout();
    scene.write("notes.txt", "Read this.");
    thread::sleep(MANY_RUNS);
    // A busy machine may split one change into two.
    assert!(watch.count("nothing changed") <= 1, "before: {before}\nafter: {}", watch.stdout());
    assert_eq!(watch.count("packed into"), 2);
}

#[test]
fn settings_take_effect() {
    let scene = Scene::new();
    scene.write("voices/a.lipz", AYE);
    scene.write("others/b.lipz", NO);
    scene.write("lipz.toml", "sources = [\"voices\"]\noutput = \"out/b.lipzbank\"\n");
    let watch = Watch::started(&scene, &[]);
    watch.until_packed("the first pack", "voices");
    watch.refuses(|| scene.write("lipz.toml", "sources = [\"others\"]\noutput = "), "error[LZ10");
    scene.write("lipz.toml", "sources = [\"others\"]\noutput = \"out/b.lipzbank\"\n");
    watch.until_packed("other sources", "others");
    scene.write("others/b.lipz", AYE);
    watch.until_packed("a change in them", "others");
    watch.refuses(|| fs::remove_file(scene.path().join("lipz.toml")).unwrap(), "no sources are named");
    scene.write("lipz.toml", "sources = [\"voices\"]\noutput = \"out/b.lipzbank\"\n");
    watch.until_packed("settings that are back", "voices");
}

#[test]
fn sources_may_come_and_go() {
    let scene = Scene::new();
    let watch = Watch::start(&scene, &["voices", "-o", BANK]);
    watch.until("a missing folder is named", |watch| {
        watch.stderr().contains("`voices` does not exist") && watch.stdout().contains("waiting for voices")
    });
    assert_eq!(watch.count("not packed: the bank does not exist yet"), 1);
    scene.write("voices/a.lipz", AYE);
    watch.until_packed("a folder that came", "voices");
    watch.refuses(|| fs::remove_dir_all(scene.path().join("voices")).unwrap(), "`voices` does not exist");
    scene.write("voices/a.lipz", NO);
    watch.until_packed("a folder that came back", "voices");
    scene.write("voices/a.lipz", AYE);
    watch.until_packed("a change in it", "voices");
}

#[test]
fn files_can_be_looked_at_instead() {
    let scene = Scene::new();
    scene.write("voices/a.lipz", AYE);
    let watch = Watch::started(&scene, &["--poll=0.1", "voices", "-o", BANK]);
    scene.write("voices/b.lipz", NO);
    watch.until_packed("a new file", "voices");
    watch.refuses(|| scene.write("voices/b.lipz", BROKEN), "error[LZ0108]");
    scene.write("voices/b.lipz", AYE);
    watch.until_packed("mended", "voices");
}

#[test]
fn every_run_prints_a_document_for_programs() {
    let scene = Scene::new();
    scene.write("voices/a.lipz", AYE);
    let watch = Watch::start(&scene, &["voices", "-o", BANK, "--output-format", "json"]);
    let documents = |watch: &Watch<'_>| {
        let stdout = watch.stdout();
        let documents = serde_json::Deserializer::from_str(&stdout).into_iter::<serde_json::Value>();
        documents.map_while(Result::ok).collect::<Vec<_>>()
    };
    watch.until("a document", |watch| documents(watch).len() == 1);
    scene.write("voices/a.lipz", BROKEN);
    watch.until("a document with a diagnostic", |watch| {
        documents(watch).last().unwrap().to_string().contains("\"LZ0108\"")
    });
}

#[cfg(unix)]
#[test]
fn an_interrupted_watch_leaves_whole_files() {
    support::make_interruptible();
    for signal in ["INT", "TERM", "HUP"] {
        let scene = Scene::new();
        scene.write("voices/a.lipz", AYE);
        let mut watch = Watch::started(&scene, &["voices", "-o", BANK]);
        watch.signal(signal);
        assert_eq!(watch.child.wait().unwrap().code(), Some(130));
        watch.until("the last word", |watch| watch.stderr() == "interrupted\n");
        assert_eq!(tree(scene.path()), ["out", BANK, "voices", "voices/a.lipz"]);
    }
}

/// Signals that are ignored from the start, as with `nohup` or in the background of a script, stay ignored. Other
/// signals end it as usual.
#[cfg(unix)]
#[test]
fn ignored_signals_stay_ignored() {
    support::make_interruptible();
    for (ignored, ends) in [("INT", "TERM"), ("HUP", "TERM"), ("HUP", "INT"), ("TERM", "INT")] {
        let scene = Scene::new();
        scene.write("voices/a.lipz", AYE);
        let script = format!("trap '' {ignored}; exec \"$0\" watch voices -o {BANK}");
        let mut watch = Watch::spawn(&scene, Command::new("sh").args(["-c", &script, env!("CARGO_BIN_EXE_lipz")]));
        watch.until("watching", |watch| watch.stdout().contains("watching"));
        watch.signal(ignored);
        scene.write("voices/a.lipz", NO);
        watch.until("a run after it", |watch| watch.count("packed into") == 2);
        watch.signal(ends);
        assert_eq!(watch.child.wait().unwrap().code(), Some(130), "{ends} while {ignored} is ignored");
        watch.until("the last word", |watch| watch.stderr() == "interrupted\n");
        assert_eq!(tree(scene.path()), ["out", BANK, "voices", "voices/a.lipz"]);
    }
}

#[test]
fn what_cannot_be_watched_is_refused() {
    let scene = Scene::new();
    scene.write("voices/a.lipz", AYE);
    let refused = |arguments: &[&str], message: &str| {
        let outcome = lipz(Path::new(scene.path()), [&["watch"], arguments].concat());
        assert_eq!(outcome.code, 2, "{arguments:?}");
        assert!(outcome.stderr.contains(message), "{arguments:?}: {}", outcome.stderr);
    };
    refused(&["-", "-o", BANK], "standard input and output cannot be watched");
    refused(&["voices", "-o", "-"], "standard input and output cannot be watched");
    refused(&["voices"], "no bank to write is named");
    refused(&["-o", BANK], "no sources are named");
    refused(&["voices", "-o", BANK, "--config", "no.toml"], "`no.toml` does not exist");
    refused(&["voices", "-o", BANK, "--poll=0"], "a number of seconds above 0");
    refused(&["voices", "-o", BANK, "--poll=NaN"], "a number of seconds above 0");
    assert_eq!(tree(scene.path()), ["voices", "voices/a.lipz"]);
}

/// A program that maps the bank moves from version to version, and keeps the old one after errors in the sources or
/// damage to the bank.
#[cfg(unix)] // elsewhere a mapped file is not replaced
#[test]
fn a_running_program_follows_the_bank() {
    let scene = Scene::new();
    scene.write("voices/a.lipz", AYE);
    let watch = Watch::started(&scene, &["voices", "-o", BANK]);
    let path = scene.path().join(BANK);
    let mut live = Dialogue::open([&path]).unwrap();
    let says = |version: &Dialogue| {
        let clip = version.clip_by_key("a").unwrap();
        clip.segment(0).unwrap().text(version.locale("en-us").unwrap()).unwrap().to_string()
    };
    let first = live.clone();
    assert_eq!(says(&first), "Aye.");
    scene.write("voices/a.lipz", NO);
    watch.until("the new text", |_| live.refresh().is_ok() && says(&live) == "No.");
    watch.refuses(|| scene.write("voices/a.lipz", BROKEN), "error[LZ0108]");
    assert!(live.refresh().unwrap().is_empty());
    // A different program replaces the bank with a damaged copy.
    fs::write(path.with_extension("copy"), &watch.bank()[..100]).unwrap();
    fs::rename(path.with_extension("copy"), &path).unwrap();
    assert!(live.refresh().is_err());
    assert_eq!(says(&live), "No.");
    scene.write("voices/a.lipz", AYE);
    watch.until("the bank that was packed again", |_| live.refresh().is_ok() && says(&live) == "Aye.");
    assert_eq!(says(&first), "Aye.");
}
