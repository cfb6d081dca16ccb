//! `lipz sync` on recordings and their files, in several runs.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use support::sound::{RATE_HZ, voice, wav};
use support::{Scene, lipz, repository, tree};

/// Silence, a second of voice, a pause, another second of voice, silence: 2.9 s, 70 frames.
const LINE: &[(bool, u32)] = &[(false, 300), (true, 1000), (false, 400), (true, 1000), (false, 200)];

fn read(scene: &Scene, name: &str) -> String {
    fs::read_to_string(scene.path().join(name)).unwrap()
}

/// Returns the value of a string element as written.
fn element(text: &str, name: &str) -> String {
    let (_, rest) = text.split_once(&format!("\"{name}\"")).unwrap();
    rest.split('"').nth(1).unwrap().to_owned()
}

/// Runs `lipz sync`. Returns its exit code, the first line of its output, and its diagnostics.
fn sync(scene: &Scene, arguments: &[&str]) -> (i32, String, String) {
    let run = lipz(scene.path(), ["sync"].iter().chain(arguments));
    (run.code, run.stdout.lines().next().unwrap_or_default().to_owned(), run.stderr)
}

#[test]
fn recordings_become_lipz_files() {
    let scene = Scene::new();
    scene.write("rec/act1/mara.wav", voice(LINE, 1));
    scene.write("rec/otto.wav", voice(LINE, 2));
    scene.write("rec/hum.wav", voice(LINE, 3));
    scene.write("rec/otto.txt", "Good evening,| mayor.\n");
    scene.write("lines.csv", "file,text\nmara,\"Who goes there?\"\n");
    let arguments = ["rec", "-o", "voices", "--script", "lines.csv", "--config", "audio.locale=en-us"];
    let (code, told, found) = sync(&scene, &arguments);
    assert_eq!((code, told.as_str()), (0, "3 clips synced, in voices"), "{found}");
    assert_eq!(found.matches("warning[LZ1708]").count(), 1, "{found}");
    let (mara, otto) = (read(&scene, "voices/act1/mara.lipz"), read(&scene, "voices/otto.lipz"));
    assert_eq!(element(&mara, "text_en-us"), "Who goes there?");
    let visemes = element(&mara, "visemes");
    assert_eq!(visemes.len(), 70, "{visemes}");
    assert!(visemes.starts_with("----") && visemes.ends_with("---"), "{visemes}");
    assert_eq!((element(&otto, "visemes").matches('|').count(), element(&otto, "visemes").len()), (1, 71));
    assert!(otto.contains("\"viseme_type\" : \"blair\"") && otto.contains("\"fps\" :"), "{otto}");
    let hum = element(&read(&scene, "voices/hum.lipz"), "visemes");
    assert!(
        hum.bytes().any(|code| code != b'-') && hum.starts_with("---"),
        "without a text, the recognised phones: {hum}"
    );
    let checked = lipz(scene.path(), ["check", "voices", "--audio", "rec", "--allow", "LZ1715,LZ1707"]);
    assert_eq!(
        (checked.code, checked.stderr.as_str()),
        (0, ""),
        "a buzz does not match the text, but everything else does"
    );
    // The second run does not change or touch a file.
    let before = tree(scene.path());
    let record = read(&scene, "voices/lipz-sync.txt");
    assert_eq!(record.lines().filter(|line| !line.starts_with('#')).count(), 3);
    assert_eq!(sync(&scene, &arguments).1, "0 clips synced, 3 unchanged, in voices");
    assert_eq!(
        sync(&scene, &["voices", "--audio", "rec", "--config", "audio.locale=en-us"]).1,
        "0 clips synced, 3 unchanged, in voices"
    );
    assert_eq!((tree(scene.path()), read(&scene, "voices/lipz-sync.txt")), (before, record));
    assert_eq!(
        sync(&scene, &["rec", "-o", "rms", "--viseme-type", "rms", "--fps", "12", "--config", "default-locale=en-us"])
            .1,
        "3 clips synced, in rms"
    );
    let rms = element(&read(&scene, "rms/hum.lipz"), "visemes");
    assert!(rms.len() == 35 && rms.contains('9') && rms.starts_with("--"), "{rms}");
}

const WRITTEN: &str = "{ \"visemes\": \"----\", \"mood\": {\"a\": 1},\n  \"text_en-us\": \"Good|evening, {softly} mayor.\", \"text_de-de\": \"Guten|Abend.\",\n  \"events\": \"amy feels sad|\", \"fps\": 24, \"viseme_type\": \"blair\" }\n";

#[test]
fn everything_but_the_mouth_stays() {
    let scene = Scene::new();
    scene.write("voices/a.lipz", WRITTEN);
    scene.write("rec/a.wav", voice(LINE, 1));
    assert_eq!(
        sync(&scene, &["voices", "--audio", "rec", "--config", "default-locale=en-us"]).1,
        "1 clip synced, in voices"
    );
    let text = read(&scene, "voices/a.lipz");
    let visemes = element(&text, "visemes");
    assert_eq!(visemes.matches('|').count(), 1, "{visemes}");
    assert_eq!(text.replace(&visemes, "----"), WRITTEN);
    assert_eq!(lipz(scene.path(), ["check", "voices"]).code, 0);
}

#[test]
fn hand_work_is_kept() {
    let mut scene = Scene::new();
    let arguments = ["voices", "--audio", "rec"];
    for name in ["edited", "moved", "drawn", "synced"] {
        scene.write(&format!("rec/{name}.wav"), voice(LINE, 1));
        scene.write(&format!("voices/{name}.lipz"), r#"{ "text_en-us": "Who goes|there?" }"#);
    }
    scene.write("voices/drawn.lipz", r#"{ "visemes": "MAMA|EO", "text_en-us": "Who goes|there?" }"#);
    let (_, told, found) = sync(&scene, &arguments);
    assert_eq!(told, "3 clips synced, 1 kept, in voices");
    assert!(
        found.contains("warning[LZ1706]: the visemes were made by hand or by another tool, so they are kept"),
        "{found}"
    );
    // Also of words in two segments.
    assert!(found.contains("warning[LZ1707]: from 0.29 s to 2.71 s, the recording differs from `Who goes|there`"));
    let edit = |name: &str, change: &dyn Fn(&str) -> String| {
        let path = format!("voices/{name}.lipz");
        let text = read(&scene, &path);
        let visemes = element(&text, "visemes");
        scene.write(&path, text.replace(&visemes, &change(&visemes)));
    };
    edit("edited", &|visemes| visemes.replacen('-', "M", 1));
    edit("moved", &|visemes| format!("-|{}", visemes.replace('|', "").strip_prefix('-').unwrap()));
    let (code, told, found) = sync(&scene, &[&arguments[..], &["--allow", "LZ1706", "--allow", "LZ1707"]].concat());
    assert_eq!((code, told.as_str(), found.as_str()), (0, "0 clips synced, 2 unchanged, 2 kept, in voices", ""));
    // A retake of all recordings.
    let drawn = read(&scene, "voices/drawn.lipz");
    let edited = read(&scene, "voices/edited.lipz");
    for name in ["edited", "moved", "drawn", "synced"] {
        scene.write(&format!("rec/{name}.wav"), voice(LINE, 2));
    }
    let stale = lipz(scene.path(), ["check", "voices", "--audio", "rec"]).stderr;
    assert_eq!(stale.matches("[LZ1705]: the visemes were made from a different recording").count(), 3, "{stale}");
    let (_, told, found) = sync(&scene, &arguments);
    assert_eq!(told, "2 clips synced, 2 kept, in voices");
    assert!(found.contains("the visemes were edited by hand, and their recording or text has changed"), "{found}");
    assert_eq!((read(&scene, "voices/drawn.lipz"), read(&scene, "voices/edited.lipz")), (drawn, edited));
    let forced = [&arguments[..], &["--discard-edits"]].concat();
    assert_eq!(sync(&scene, &forced).1, "2 clips synced, 2 unchanged, in voices");
    assert_eq!(sync(&scene, &arguments).1, "0 clips synced, 4 unchanged, in voices");
    // A different text, and a different setting.
    edit("synced", &|visemes| visemes.to_owned());
    let text = read(&scene, "voices/synced.lipz");
    scene.write("voices/synced.lipz", text.replace("there?", "here?"));
    let text = read(&scene, "voices/synced.lipz");
    // The displayed text does not depend on the visemes.
    scene.write("voices/synced.lipz", text.replace(&element(&text, "visemes"), "MA|EO"));
    let allow = "LZ1702,LZ1703,LZ1714,LZ1715";
    let check =
        ["check", "voices/synced.lipz", "--config", "root=voices", "--audio", "rec", "--quiet", "--allow", allow];
    scene.expect("LZ1915-outdated-recording", &check);
    scene.write("voices/synced.lipz", &text);
    // From now on, the visemes count as made for the new text. The recording does not, for any change of the visemes.
    let told = lipz(scene.path(), ["sync"].iter().chain(&arguments)).stdout;
    assert!(told.starts_with("1 clip synced, 3 unchanged, in voices\n"), "{told}");
    let older = "\nrecordings older than their texts (record these lines again, or `lipz approve` them)\n  synced\n";
    assert!(told.contains(older), "{told}");
    let told = lipz(scene.path(), ["sync"].iter().chain(&arguments).chain(&["--config", "sync.lead-ms=0"])).stdout;
    assert!(told.starts_with("4 clips synced, in voices\n") && !told.contains("older than"), "{told}");
    let is_told = || lipz(scene.path(), check).stderr.contains("LZ1915");
    assert!(is_told(), "it has not been recorded again");
    let recorded = fs::read(scene.path().join("rec/synced.wav")).unwrap();
    scene.write("rec/synced.wav", voice(LINE, 4));
    assert!(!is_told(), "it has been recorded again");
    scene.write("rec/synced.wav", recorded);
    let (text, old) = (read(&scene, "voices/synced.lipz"), "here?");
    scene.write("voices/synced.lipz", text.replace(old, "there?"));
    assert!(!is_told(), "the text is the recorded one again");
    scene.write("voices/synced.lipz", text);
    assert!(is_told());
    // Without the record, the origin of visemes is unknown.
    fs::remove_file(scene.path().join("voices/lipz-sync.txt")).unwrap();
    assert_eq!(sync(&scene, &arguments).1, "0 clips synced, 4 kept, in voices");
}

#[test]
fn one_bad_file_keeps_no_other_from_its_mouth() {
    let mut scene = Scene::new();
    for name in ["broken", "good", "empty", "cut", "noise"] {
        scene.write(&format!("voices/{name}.lipz"), r#"{ "text_en-us": "Who?" }"#);
        scene.write(&format!("rec/{name}.wav"), voice(LINE, 1));
    }
    scene.write("voices/broken.lipz", r#"{ "text_en-us": "Who?", "fps": 24, }"#);
    scene.write("voices/silent.lipz", r#"{ "text_en-us": "Who?" }"#);
    scene.write("rec/empty.wav", "");
    let whole = voice(LINE, 1);
    scene.write("rec/cut.wav", &whole[..whole.len() / 2 + 1]);
    scene.write("rec/noise.wav", [0x55; 5000]);
    let (code, told, found) = sync(&scene, &["voices", "--audio", "rec"]);
    assert_eq!((code, told.as_str()), (1, "2 clips synced, 3 refused, 1 without a recording, in voices"), "{found}");
    assert!(found.contains("warning[LZ1711]: the recording ends in the middle of its data"), "{found}");
    assert_eq!(found.matches("error[LZ1704]").count(), 2, "{found}");
    assert_eq!(read(&scene, "voices/broken.lipz"), r#"{ "text_en-us": "Who?", "fps": 24, }"#);
    assert!(read(&scene, "voices/good.lipz").contains("visemes"));
    // A file at the path of the record that is not a record.
    scene.write("notes.txt", "my notes");
    let refused = lipz(scene.path(), ["sync", "voices", "--audio", "rec", "--config", "audio.record=notes.txt"]);
    assert!(
        refused.code == 2 && refused.stderr.contains("is not a record of visemes and their recordings"),
        "{}",
        refused.stderr
    );
    assert_eq!(read(&scene, "notes.txt"), "my notes");
    scene.expect("LZ1601-usage-sync-no-recordings", &["sync", "voices"]);
    scene.expect("LZ1601-usage-sync-other-keys", &["sync", "voices", "--audio", "voices"]);
    scene.write("lines.csv", "file,text\ngood,Who?\nbroken,Who?\n");
    scene.expect(
        "LZ1601-usage-sync-no-locale",
        &["sync", "rec/good.wav", "-o", "new", "--script", "lines.csv", "--allow", "warnings"],
    );
    scene.write("rec2/Good.wav", voice(LINE, 1));
    scene.expect("LZ0801-key-clash-recordings", &["sync", "rec/good.wav", "rec2", "-o", "new", "--quiet"]);
    assert!(!scene.path().join("new").exists());
    scene.finish(4);
}

#[test]
fn what_is_odd_is_reported() {
    let mut scene = Scene::new();
    let silence: &[(bool, u32)] = &[(false, 1500), (true, 1000)];
    scene.write("rec/a.wav", voice(silence, 1));
    scene.write("rec/b.wav", voice(silence, 2));
    let clip = |visemes: &str| format!("{{ \"visemes\": \"{visemes}\", \"viseme_type\": \"blair\", \"fps\": 8 }}");
    scene.write("voices/a.lipz", clip("AEAEAE|AEAEAEAEAEAEAE"));
    scene.write("voices/b.lipz", clip("------------A|-------"));
    let check = ["check", "voices", "--audio", "rec", "--quiet", "--config", "audio.cache=rec.cache"];
    scene.expect("LZ1714-moving-in-silence", &check);
    let cached = read(&scene, "rec.cache");
    assert_eq!(cached.lines().count(), 3, "{cached}");
    scene.expect("LZ1715-resting-in-speech", &check);
    assert_eq!(read(&scene, "rec.cache"), cached);
    scene.write("voices/b.lipz", r#"{ "text_en-us": "Li'sar{say: L IX}" }"#);
    scene.write("voices/a.lipz", r#"{ "mood": 1 }"#);
    scene.write("lexicon.txt", "WESNOTH  W EX S\n");
    let sync =
        ["sync", "voices", "--audio", "rec", "--quiet", "--config", "sync.lexicon=lexicon.txt", "--allow", "LZ0203"];
    scene.expect("LZ1710-pronunciation", &sync);
    scene.write("drawn/a.lipz", clip("AEAEAEAEAEAEAEAEAE--"));
    scene.expect("LZ1706-mouth-kept", &["sync", "drawn", "--audio", "rec", "--quiet"]);
    scene.write("rec/b.wav", voice(silence, 3));
    scene.expect(
        "LZ1705-stale-mouth",
        &["check", "voices", "--audio", "rec", "--quiet", "--allow", "LZ1714,LZ1715,LZ0406,LZ0203"],
    );
    scene.write("voices/lipz-sync.txt", format!("{}<<<<<<< HEAD\n", read(&scene, "voices/lipz-sync.txt")));
    scene.expect(
        "LZ1712-sync-record-line",
        &["sync", "voices", "--audio", "rec", "--quiet", "--allow", "LZ1706,LZ1707,LZ1708"],
    );
    scene.write("new/a.lipz", r#"{ "text_en-us": "Aye." }"#);
    scene.write("lines.csv", "file,text\na,No.\nz,Never.\nb,\"She sees, six fish.\"\n");
    let of_script = ["sync", "rec", "-o", "new", "--script", "lines.csv", "--config", "audio.locale=en-us", "--quiet"];
    scene.expect("LZ1709-other-text", &[&of_script[..], &["--allow", "LZ1707,LZ1713"]].concat());
    scene.expect("LZ1713-script-without-recording", &[&of_script[..], &["--allow", "LZ1707,LZ1709"]].concat());
    let of_b =
        ["sync", "rec/b.wav", "-o", "doubtful", "--script", "lines.csv", "--config", "audio.locale=en-us", "--quiet"];
    scene.expect("LZ1707-text-mismatch", &[&of_b[..], &["--allow", "LZ1713"]].concat());
    scene.expect("LZ1708-no-script", &["sync", "rec/a.wav", "-o", "mute", "--quiet"]);
    scene.write("rec/a.wav", wav(RATE_HZ, &[0; 20_000]));
    scene.expect("LZ1716-silent-recording", &["sync", "rec/a.wav", "-o", "quiet", "--quiet", "--allow", "LZ1708"]);
    let loud: Vec<i16> = (0..20_000).map(|at| if at % 160 < 40 { i16::MAX } else { -8_000 }).collect();
    scene.write("rec/a.wav", wav(RATE_HZ, &loud));
    scene.expect(
        "LZ1717-clipped-recording",
        &["sync", "rec/a.wav", "-o", "loud", "--quiet", "--allow", "LZ1708,LZ1720"],
    );
    let hiss: Vec<i16> = (0..20_000_u32).map(|at| (at.wrapping_mul(2_654_435_761) >> 19) as i16 - 4_096).collect();
    scene.write("rec/a.wav", wav(RATE_HZ, &hiss));
    scene.expect("LZ1720-no-speech", &["sync", "rec/a.wav", "-o", "noise", "--quiet", "--allow", "LZ1708"]);
    let whole = voice(silence, 1);
    scene.write("rec/a.wav", &whole[..whole.len() - 5001]);
    scene.expect("LZ1711-damaged-sound", &["sync", "rec/a.wav", "-o", "cut", "--quiet", "--allow", "LZ1708"]);
    scene.finish(14);
}

/// A voice in loud noise looks like noise alone, but its text was found in it.
#[test]
fn a_recording_in_which_the_text_was_found_is_speech() {
    let scene = Scene::new();
    let clean = fs::read(repository().join("fixtures/speech/bobby.wav")).unwrap();
    let (head, samples) = clean.split_at(44);
    let noise = |at: u32| (at.wrapping_mul(2_654_435_761) >> 16) as i32 / 4 - 8_000;
    let with_noise = |(at, sample): (u32, &[u8; 2])| {
        let sum = i32::from(i16::from_le_bytes(*sample)) + noise(at);
        i16::try_from(sum).unwrap().to_le_bytes()
    };
    let noisy: Vec<u8> = (0..).zip(samples.as_chunks().0).flat_map(with_noise).collect();
    scene.write("rec/bobby.wav", [head, &noisy].concat());
    scene.write("rec/bobby.txt", "Bobby ripped the ledger.");
    scene.write("lipz.toml", "default-locale = \"en-us\"\nsources = [\"v\"]\n[audio]\nfolder = \"rec\"\n");
    let synced = lipz(scene.path(), ["sync", "rec", "-o", "v"]);
    assert_eq!((synced.code, synced.stderr.as_str()), (0, ""));
    assert_eq!(lipz(scene.path(), ["check"]).stderr, "");
    // Without the record of the run, lipz knows only the spectrum.
    fs::remove_file(scene.path().join("v/lipz-sync.txt")).unwrap();
    let checked = lipz(scene.path(), ["check"]);
    assert!(checked.stderr.contains("LZ1720"), "{checked:?}");
}

/// Without a text, the opening of the lips follows the probabilities of all phones, in a curve that belongs to lipz while
/// the phones are guessed.
#[test]
fn recordings_without_a_text_get_the_opening_of_the_lips() {
    let scene = Scene::new();
    scene.write("rec/bobby.wav", fs::read(repository().join("fixtures/speech/bobby.wav")).unwrap());
    scene.write("lipz.toml", "sources = [\"v\"]\n[audio]\nfolder = \"rec\"\n[sync]\nphones = true\n");
    let file = || fs::read_to_string(scene.path().join("v/bobby.lipz")).unwrap();
    let sync = || lipz(scene.path(), ["sync", "--config", "default-locale=en-us"]);
    scene.write("v/bobby.lipz", r#"{ "curves": { "joy": "0:2" } }"#);
    sync();
    let guessed = file();
    assert!(
        guessed.contains("\"guessed ") && guessed.contains("\"opening\"") && guessed.contains("\"joy\""),
        "{guessed}"
    );
    // With a text, the phones are certain, and the curve goes.
    scene.write("v/bobby.lipz", guessed.replacen('{', "{ \"text_en-us\": \"Bobby ripped the ledger.\",", 1));
    sync();
    let certain = file();
    assert!(!certain.contains("opening") && certain.contains("\"joy\"") && certain.contains("B@"), "{certain}");
    // A curve of the animator stays.
    scene.write("v/bobby.lipz", r#"{ "curves": { "opening": "0:0.25" } }"#);
    sync();
    let kept = file();
    assert!(kept.contains("\"guessed ") && kept.contains("\"0:0.25\""), "{kept}");
}
