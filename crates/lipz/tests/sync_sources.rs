//! `lipz sync` with real-world inputs: nested folders, scripts with mistakes, files that are not recordings, folders
//! without permissions, several languages.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use support::sound::{RATE_HZ, voice, wav};
use support::{Scene, lipz, tree};

const LINE: &[(bool, u32)] = &[(false, 200), (true, 500), (false, 200)];

/// Runs `lipz`. Returns the exit code, the output and the diagnostics.
fn run(scene: &Scene, arguments: &[&str]) -> (i32, String, String) {
    let run = lipz(scene.path(), arguments);
    (run.code, run.stdout, run.stderr)
}

/// Runs `lipz sync` on the folder `rec`, with a script of these rows.
fn with_script(scene: &Scene, script: &str) -> (i32, String, String) {
    scene.write("lines.csv", script);
    let allow = "LZ1707,LZ1708";
    run(
        scene,
        &["sync", "rec", "-o", "voices", "--script", "lines.csv", "--config", "audio.locale=en-us", "--allow", allow],
    )
}

fn text_of(scene: &Scene, file: &str) -> String {
    let text = fs::read_to_string(scene.path().join("voices").join(file)).unwrap();
    text.split_once("text_en-us\" :").unwrap().1.split('"').nth(1).unwrap().to_owned()
}

#[test]
fn folders_in_the_script_tell_lines_of_one_name_apart() {
    let scene = Scene::new();
    for file in ["rec/act1/mayor.wav", "rec/act2/mayor.wav", "rec/\u{dc}n\u{ef} \u{6771}/der B\u{e4}r.wav"] {
        scene.write(file, voice(LINE, 1));
    }
    let rows = "file,text\nact1/mayor,Who?\nact2\\mayor.wav,What?\nDER B\u{c4}R,Where?\nmayor,Never.\n";
    let (code, told, found) = with_script(&scene, rows);
    assert_eq!((code, told.lines().next()), (0, Some("3 clips synced, in voices")), "{found}");
    // Patterns, and a root for sources that would otherwise give two recordings the same key.
    let of_pattern = ["sync", "rec/*/m*.wav", "rec/act1", "-o", "rms", "--viseme-type", "rms"];
    let (code, _, twice) = run(&scene, &of_pattern);
    assert!(code == 2 && twice.contains("error[LZ0802]: the key `mayor` appears twice"), "{twice}");
    assert_eq!(run(&scene, &[&of_pattern[..], &["--config", "root=rec"]].concat()).1, "2 clips synced, in rms\n");
    let written = tree(&scene.path().join("rms"));
    assert_eq!(written, ["act1", "act1/mayor.lipz", "act2", "act2/mayor.lipz", "lipz-sync.txt"]);
    let texts = ["act1/mayor.lipz", "act2/mayor.lipz", "\u{dc}n\u{ef} \u{6771}/der B\u{e4}r.lipz"];
    assert_eq!(texts.map(|file| text_of(&scene, file)), ["Who?", "What?", "Where?"]);
    assert!(found.contains("LZ1713") && found.contains("`mayor`") && found.contains("--> lines.csv"), "{found}");
}

#[test]
fn scripts_with_mistakes_are_told_by_line() {
    let scene = Scene::new();
    scene.write("rec/a.wav", voice(LINE, 1));
    for (script, message) in [
        ("", "the first line does not name the columns"),
        ("name,words\na,Who?\n", "the first line does not name the columns"),
        ("file,words\na,Who?\n", "the first line has no column `text`"),
        ("file,text\n,Who?\n", "the row has no file name"),
        ("file,text\na\n", "the row has no text"),
    ] {
        let (code, told, found) = with_script(&scene, script);
        assert_eq!((code, told.as_str()), (1, ""), "{script}");
        assert!(found.contains(&format!("error[LZ1101]: {message}\n --> lines.csv:")), "{script}: {found}");
    }
    let (code, _, found) = with_script(&scene, "Speaker,Audio File,Dialogue\nMara,A.WAV,Who?\n");
    assert_eq!((code, text_of(&scene, "a.lipz").as_str()), (0, "Who?"), "{found}");
    fs::remove_dir_all(scene.path().join("voices")).unwrap();
    let (code, _, found) = with_script(&scene, "file;text\na;Who?\nA.wav;What?\n");
    assert_eq!((code, text_of(&scene, "a.lipz").as_str()), (0, "Who?"), "{found}");
    assert!(found.contains("[LZ1104]: `A.wav` has a different text in a row above\n --> lines.csv:3:1"), "{found}");
}

#[test]
fn nothing_in_a_folder_of_recordings_is_passed_over_in_silence() {
    let scene = Scene::new();
    scene.write("rec/a.wav", voice(LINE, 1));
    scene.write("rec/a.flac", "another one");
    scene.write("rec/a.txt", "Who?");
    scene.write("rec/lonely.txt", "Never recorded.");
    scene.write("rec/phone.m4a", "\0\0\0\x1cftypM4A \0\0\0\0");
    let noise: Vec<u8> = (0..5_000_u32).map(|at| (at.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    scene.write("rec/noise.mp3", noise);
    let (code, told, found) = run(&scene, &["sync", "rec", "-o", "voices", "--config", "audio.locale=en-us"]);
    assert_eq!((code, told.lines().next()), (1, Some("1 clip synced, 1 refused, in voices")), "{found}");
    for expected in [
        "warning[LZ1702]: the recording is not used because `rec/a.wav` has the same name\n--> rec/a.flac",
        "warning[LZ1713]: the text `rec/lonely.txt` has no recording\n--> rec",
        "error[LZ1704]: the recording cannot be used: this is an MPEG-4 file (M4A, AAC), which is not supported\n--> \
            rec/phone.m4a",
        "error[LZ1704]: the recording cannot be used: this is not a WAV, AIFF, FLAC, Ogg Vorbis or MP3 file, or its beginning \
         is damaged\n--> rec/noise.mp3",
    ] {
        assert!(found.contains(expected), "{expected}\n\n{found}");
    }
    // The clip of an unreadable recording, and a pattern that names the recording.
    scene.write("voices/phone.lipz", r#"{ "visemes": "AA", "viseme_type": "blair", "fps": 24 }"#);
    fs::remove_file(scene.path().join("rec/noise.mp3")).unwrap();
    let (_, _, found) = run(&scene, &["check", "voices", "--audio", "rec", "--config", "audio.pattern={key}.wav"]);
    // The text of `a` differs from the only recording of these tests.
    let told = ["[LZ1701]", "[LZ1707]", "[LZ1715]"].map(|code| found.matches(code).count());
    assert_eq!(found.matches("[LZ").count(), told.iter().sum::<usize>(), "{found}");
    assert!(found.contains("`rec/phone.m4a` exists, but its format is not supported"), "{found}");
}

#[test]
fn of_what_cannot_be_heard_only_that_is_said() {
    let scene = Scene::new();
    scene.write("rec/a.wav", wav(RATE_HZ, &[0; 16_000]));
    scene.write("rec/a.txt", "There is much to say, and nobody says it.");
    let (code, told, found) = run(&scene, &["sync", "rec", "-o", "voices", "--config", "audio.locale=en-us"]);
    assert_eq!((code, told.as_str()), (0, "1 clip synced, in voices\n"), "{found}");
    assert!(found.contains("warning[LZ1716]: the recording is silent"), "{found}");
    assert_eq!(found.matches("[LZ").count(), 1, "{found}");
    // The check reports it as well, without making visemes.
    let (_, _, found) = run(&scene, &["check", "voices", "--audio", "rec", "--quiet"]);
    assert!(found.contains("warning[LZ1716]: the recording is silent\n--> rec/a.wav"), "{found}");
}

#[test]
fn the_output_is_a_folder_that_can_be_written() {
    let scene = Scene::new();
    scene.write("rec/a.wav", voice(LINE, 1));
    scene.write("rec/b.wav", voice(LINE, 2));
    scene.write("file", "mine");
    let (code, _, found) = run(&scene, &["sync", "rec", "-o", "file", "--viseme-type", "rms"]);
    assert!(code == 2 && found.contains("error[LZ1601]: `file` is a file"), "{found}");
    fs::create_dir(scene.path().join("empty")).unwrap();
    let (code, _, found) = run(&scene, &["sync", "empty", "-o", "voices"]);
    assert!(code == 2 && found.contains("error[LZ0805]: no recordings in `empty`"), "{found}");
    // A record that cannot be written is reported once, not for each clip.
    #[cfg(unix)]
    {
        fs::create_dir(scene.path().join("voices")).unwrap();
        let record = scene.path().join("voices").join(lipz_sync::RECORD_NAME);
        std::os::unix::fs::symlink(scene.path().join("nowhere/record"), record).unwrap();
        let (code, told, found) = run(&scene, &["sync", "rec", "-o", "voices", "--viseme-type", "rms"]);
        assert_eq!((code, told.as_str()), (2, "0 clips synced, 2 refused, in voices\n"), "{found}");
        assert_eq!(found.matches("error[LZ0904]").count(), 1, "{found}");
        let written = tree(&scene.path().join("voices"));
        assert_eq!(written, [lipz_sync::RECORD_NAME], "visemes are not written without a record");
    }
}

#[test]
fn the_first_run_of_a_project_is_told_how_to_begin() {
    let scene = Scene::new();
    scene.write("voices/notes.txt", "");
    scene.write("rec/mayor.wav", voice(LINE, 1));
    let (code, _, found) = run(&scene, &["sync", "voices", "--audio", "rec"]);
    assert!(code == 2 && found.contains("error[LZ0805]: no Lipz files in `voices`"), "{found}");
    assert!(
        found.contains("= help: make the first Lipz files from recordings: lipz sync recordings -o voices"),
        "{found}"
    );
}

#[test]
fn each_voice_has_its_recordings_text_and_language() {
    let scene = Scene::new();
    scene.write(
        "lipz.toml",
        "sources = [\"voices\"]\nroot = \"voices\"\ndefault-locale = \"en-us\"\n[audio]\nfolder = \"rec\"\n\
         [voices]\nen-us = \"en/{key}\"\nde-de = \"de/{key}\"\n",
    );
    let both = r#"{ "text_en-us": "Who goes|there?", "text_de-de": "Wer|da?" }"#;
    scene.write("voices/mayor.lipz", both);
    scene.write("rec/en/mayor.wav", voice(LINE, 1));
    scene.write("rec/de/mayor.wav", voice(LINE, 2));
    let allow = ["--allow", "LZ1707,LZ1715"];
    let told = |arguments: &[&str]| {
        let (code, told, found) = run(&scene, &[arguments, &allow].concat());
        assert_eq!(code, 0, "{found}");
        (told.lines().next().unwrap_or_default().to_owned(), found)
    };
    assert_eq!(told(&["sync"]), ("2 clips synced, in voices".to_owned(), String::new()));
    let english = fs::read_to_string(scene.path().join("voices/mayor.lipz")).unwrap();
    assert_eq!(told(&["check"]).1, "", "the dub belongs to the clip, too");
    fs::remove_dir_all(scene.path().join("voices/de")).unwrap();
    assert_eq!(told(&["check"]).1, "", "even without visemes of its own");
    // A different voice has different visemes, from a different recording.
    assert_eq!(told(&["check", "--config", "audio.locale=de-de"]).1.matches("[LZ1705]").count(), 1);
    assert_eq!(
        told(&["sync", "--config", "audio.locale=de-de"]).0,
        "2 clips synced, in voices",
        "now English is the dub"
    );
    fs::remove_dir_all(scene.path().join("voices/en")).unwrap();
    assert_ne!(fs::read_to_string(scene.path().join("voices/mayor.lipz")).unwrap(), english);
    // The bank contains the recording of the voice.
    for (locale, file) in [("en-us", "rec/en/mayor.wav"), ("de-de", "rec/de/mayor.wav")] {
        let locale_setting = format!("audio.locale={locale}");
        told(&["pack", "-o", "b.lipzbank", "--config", "audio.in-bank=true", "--config", &locale_setting]);
        let bytes = fs::read(scene.path().join("b.lipzbank")).unwrap();
        let bank = lipz_bank::Bank::open(&bytes).unwrap().verify().unwrap();
        let recording = bank.clip_by_key("mayor").unwrap().recording().unwrap();
        assert_eq!(recording.content_hash(), hash(&fs::read(scene.path().join(file)).unwrap()), "{locale}");
    }
    // A line that is missing in one language, and a separate folder of clips for a language.
    fs::remove_file(scene.path().join("rec/de/mayor.wav")).unwrap();
    let missing = told(&["check"]).1;
    assert!(missing.contains("[LZ1701]: the clip has no recording in `de-de`"), "{missing}");
    scene.write("rec/de/otto.wav", voice(LINE, 3));
    scene.write("voices/de/otto.lipz", both);
    let (told, found) = told(&["sync", "--config", "voices.de-de=de/{key}"]);
    assert_eq!((told.as_str(), found.as_str()), ("2 clips synced, in voices", ""));
    let record = fs::read_to_string(scene.path().join("voices/lipz-sync.txt")).unwrap();
    assert!(record.contains("de/otto.lipz"), "{record}");
}

/// Returns the content hash of a recording, as docs/reference/bank-format.md describes it.
fn hash(bytes: &[u8]) -> u64 {
    lipz_sync::content_hash(bytes).unwrap()
}
