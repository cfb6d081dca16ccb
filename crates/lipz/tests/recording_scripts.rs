//! Recording scripts: their lines, what comes back from the studio, and the lengths of dubs.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use support::sound::voice;
use support::{Outcome, Scene, lipz};

const SETTINGS: &str = "sources = [\"voices\"]
root = \"voices\"
default-locale = \"en-us\"

[registry]
characters = [\"mara\", \"otto\"]

[audio]
folder = \"rec\"

[voices]
en-us = \"en/{key}\"
de-de = \"de/{key}\"

[dubs]
\"act1/**\" = \"time-constrained\"
\"act1/mara-hello\" = \"lip-sync\"
";

/// Speech in a recording, in milliseconds.
const SECOND: &[(bool, u32)] = &[(false, 200), (true, 600), (false, 200)];
const LONG: &[(bool, u32)] = &[(false, 200), (true, 1200), (false, 200)];

fn scene() -> Scene {
    let scene = Scene::new();
    scene.write("lipz.toml", SETTINGS);
    let clip = |english: &str, german: &str| {
        format!("{{ \"text_en-us\": \"{english}\", \"text_de-de\": \"{german}\", \"events\": \"feels joy\" }}")
    };
    scene.write("voices/act1/mara-hello.lipz", clip("Hello, {smiling} Otto!", "Hallo, {smiling} Otto!"));
    scene.write("voices/act1/otto-yes.lipz", clip("{speaker: Otto} Yes.", "{speaker: Otto} Ja."));
    scene.write("voices/act2/mara-bye.lipz", clip("Bye now.", "=Tschüss."));
    scene.write("rec/en/act1/mara-hello.wav", voice(SECOND, 1));
    scene
}

fn export(scene: &Scene, arguments: &[&str]) -> Outcome {
    lipz(scene.path(), ["export", "recording-script"].iter().chain(arguments))
}

/// Returns the cells of each row of a script as CSV, without the header.
fn rows(scene: &Scene, arguments: &[&str]) -> Vec<Vec<String>> {
    let printed = export(scene, &[&["csv", "-o", "-"], arguments].concat());
    assert_eq!((printed.code, printed.stderr.as_str()), (0, ""));
    let rows = printed.stdout.lines().skip(1);
    // No cell has a line break, and only texts have quotes.
    rows.map(|row| {
        let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(row.as_bytes());
        let record = reader.records().next().unwrap().unwrap();
        record.iter().map(str::to_owned).collect()
    })
    .collect()
}

#[test]
fn lines_come_with_all_that_an_actor_and_a_studio_need() {
    let scene = scene();
    let lines = rows(&scene, &["--locale", "de-de"]);
    let shown: Vec<[&str; 11]> =
        lines.iter().map(|row| [1, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12].map(|at| row[at].as_str())).collect();
    let not = "not recorded";
    let (hello, guten) = ("Hello, {smiling} Otto!", "Hallo, {smiling} Otto!");
    assert_eq!(
        shown,
        [
            [
                "act1/mara-hello",
                "mara",
                "act1",
                "feels joy; smiling",
                "lip-sync",
                "1.00",
                "0.95 to 1.05",
                not,
                hello,
                guten,
                "de/act1/mara-hello"
            ],
            [
                "act2/mara-bye",
                "mara",
                "act2",
                "feels joy",
                "voice-over",
                "",
                "",
                not,
                "Bye now.",
                "'=Tschüss.",
                "de/act2/mara-bye"
            ],
            [
                "act1/otto-yes",
                "otto",
                "act1",
                "feels joy",
                "time-constrained",
                "",
                "",
                not,
                "{speaker: Otto} Yes.",
                "{speaker: Otto} Ja.",
                "de/act1/otto-yes"
            ],
        ]
    );
    // The originals have neither a second text nor a range.
    let original = rows(&scene, &["--state", "missing"]);
    assert_eq!(original.len(), 2);
    assert!(original.iter().all(|row| row[7].is_empty() && row[11].starts_with("en/")), "{original:?}");
    let sessions = rows(&scene, &["--locale", "de-de", "--session-lines", "1"]);
    assert_eq!(sessions.iter().map(|row| row[2].as_str()).collect::<Vec<_>>(), ["1", "2", "1"]);
}

#[test]
fn pick_ups_are_lines_without_a_current_recording() {
    let scene = scene();
    assert_eq!(lipz(scene.path(), ["sync", "--quiet", "--allow", "warnings"]).code, 0);
    scene.write("rec/de/act1/mara-hello.wav", voice(LONG, 2));
    let states = |states: &str| rows(&scene, &["--locale", "de-de", "--state", states]);
    assert_eq!(states("length")[0][9], "too long (1.600 s)");
    scene.write("rec/de/act1/mara-hello.wav", voice(SECOND, 2));
    assert_eq!(states("recorded").len(), 1);
    assert_eq!(lipz(scene.path(), ["sync", "--quiet", "--allow", "warnings"]).code, 0);
    let none = export(&scene, &["csv", "-o", "-", "--locale", "de-de", "--state", "stale"]);
    assert!(none.code == 2 && none.stderr.contains("no line is in the state stale"), "{none:?}");
    let text = fs::read_to_string(scene.path().join("voices/act1/mara-hello.lipz")).unwrap();
    scene.write("voices/act1/mara-hello.lipz", text.replace("Hallo", "Servus"));
    assert_eq!(states("stale")[0][9], "the text has changed");
    assert_eq!(states("missing,stale,length").len(), 3);
}

#[test]
fn takes_and_texts_come_back_from_the_studio() {
    for (format, name) in [("csv", "script.csv"), ("xlsx", "script.xlsx")] {
        let scene = scene();
        let written = export(&scene, &[format, "--locale", "de-de", "-o", name]);
        let summary = format!("3 lines with 4 words for 2 characters written into {name}\n");
        assert_eq!((written.code, written.stdout.as_str()), (0, summary.as_str()), "{written:?}");
        // Nothing was changed yet.
        let unchanged = lipz(scene.path(), ["import", "texts", name]);
        assert_eq!((unchanged.code, unchanged.stderr.as_str()), (0, ""), "{format}");
        let again = lipz(scene.path(), ["import", "recordings", name, "voices"]);
        assert!(again.code == 2 && again.stderr.contains("no take is chosen"), "{again:?}");
    }
    let scene = scene();
    assert_eq!(export(&scene, &["csv", "--locale", "de-de", "-o", "script.csv"]).code, 0);
    let script = fs::read_to_string(scene.path().join("script.csv")).unwrap();
    let chosen = script.replace("de/act1/mara-hello,", "de/act1/mara-hello,2").replace("Hallo, {", "Grüß Gott, {");
    let chosen = chosen.replace("de/act1/otto-yes,", "de/act1/otto-yes,odd/otto.flac");
    scene.write("script.csv", chosen.replace("de/act1/otto-yes,odd/otto.flac", "de/act1/otto-yes,otto-yes-odd.wav"));
    for (take, seed) in [("mara-hello_1.wav", 1), ("mara-hello_2.wav", 2), ("otto-yes-odd.wav", 3)] {
        scene.write(&format!("takes/monday/{take}"), voice(SECOND, seed));
    }
    let import = |more: &[&str]| lipz(scene.path(), ["import", "recordings", "script.csv", "takes"].iter().chain(more));
    let copied = import(&[]);
    assert_eq!(
        (copied.code, copied.stdout.as_str()),
        (0, "takes copied: 2 new, 0 replaced, 0 unchanged\n"),
        "{copied:?}"
    );
    let recording = |name: &str| fs::read(scene.path().join(name)).unwrap();
    assert!(recording("rec/de/act1/mara-hello.wav") == recording("takes/monday/mara-hello_2.wav"));
    assert_eq!(import(&[]).stdout, "takes copied: 0 new, 0 replaced, 2 unchanged\n");
    let texts = lipz(scene.path(), ["import", "texts", "script.csv"]);
    assert_eq!((texts.code, texts.stderr.as_str()), (0, ""));
    let hello = fs::read_to_string(scene.path().join("voices/act1/mara-hello.lipz")).unwrap();
    assert!(hello.contains("Grüß Gott, {smiling} Otto!"), "{hello}");
    // A retake replaces a recording only on request.
    scene.write("takes/monday/mara-hello_2.wav", voice(LONG, 4));
    let refused = import(&[]);
    assert!(refused.code == 1 && refused.stderr.contains("already exists"), "{refused:?}");
    // A missing take copies nothing.
    let complete = fs::read_to_string(scene.path().join("script.csv")).unwrap();
    scene.write("script.csv", complete.replace("otto-yes-odd.wav", "otto-yes-even.wav"));
    let before = recording("rec/de/act1/mara-hello.wav");
    let refused = import(&["--overwrite"]);
    assert!(refused.code == 1 && refused.stderr.contains("is missing in takes"), "{refused:?}");
    assert!(recording("rec/de/act1/mara-hello.wav") == before);
    scene.write("script.csv", complete);
    assert_eq!(import(&["--overwrite"]).stdout, "takes copied: 0 new, 1 replaced, 1 unchanged\n");
}

/// A studio that works with the recording sheet of Yarn Spinner adds a column for the chosen takes.
#[test]
fn takes_are_chosen_in_a_sheet_of_yarn_spinner() {
    let scene = scene();
    let sheet = "character,text,id,line,take\r\nMara,\"Hello, Otto!\",line:act1/mara-hello,3,\r\n,,,,\r\n\
        Otto,Yes.,line:act1/otto-yes,4,2\r\n,,,,\r\n";
    scene.write("sheet.csv", sheet);
    scene.write("takes/otto-yes_2.wav", voice(SECOND, 1));
    let copied = lipz(scene.path(), ["import", "recordings", "sheet.csv", "takes"]);
    let summary = "takes copied: 1 new, 0 replaced, 0 unchanged\n";
    assert_eq!((copied.code, copied.stdout.as_str(), copied.stderr.as_str()), (0, summary, ""));
    assert!(scene.path().join("rec/en/act1/otto-yes.wav").exists());
}

#[test]
fn takes_that_cannot_be_found_are_reported() {
    let mut scene = scene();
    assert_eq!(export(&scene, &["csv", "--locale", "de-de", "-o", "script.csv"]).code, 0);
    let script = fs::read_to_string(scene.path().join("script.csv")).unwrap();
    let choose = |take: &str| script.replace("de/act1/mara-hello,", &format!("de/act1/mara-hello,{take}"));
    let run = ["import", "recordings", "script.csv", "takes"];
    scene.write("takes/mara-hello_1.wav", voice(SECOND, 1));
    scene.write("takes/late/mara-hello-take1.wav", voice(SECOND, 2));
    scene.write("script.csv", choose("3"));
    scene.expect("LZ1918-unusable-take", &run);
    scene.write("script.csv", choose("1"));
    scene.expect("LZ1918-unusable-take-ambiguous", &run);
    scene.write("script.csv", choose("late/mara-hello-take1"));
    assert_eq!(lipz(scene.path(), run).code, 0);
    scene.write(
        "script.csv",
        format!("{}{}", choose("late/mara-hello-take1"), choose("mara-hello_1.wav").lines().nth(1).unwrap()),
    );
    scene.expect("LZ1918-unusable-take-twice", &run);
    let path = scene.path().join("rec/de/act1/mara-hello.flac");
    fs::rename(scene.path().join("rec/de/act1/mara-hello.wav"), path).unwrap();
    scene.write("script.csv", choose("mara-hello_1.wav"));
    scene.expect("LZ1918-unusable-take-format", &run);
    scene.finish(4);
}

#[test]
fn doubtful_takes_are_refused() {
    let scene = scene();
    let refused = |script: &str, more: &[&str], expected: &str| {
        scene.write("script.csv", script);
        let arguments = ["import", "recordings", "script.csv", "takes"];
        let refused = lipz(scene.path(), arguments.iter().chain(more));
        assert!(refused.code != 0 && refused.stderr.contains(expected), "{expected}: {refused:?}");
        assert!(!scene.path().join("rec/de").exists(), "{expected}");
    };
    // `mara-hello_12` is not take 2 of `mara-hello_1`, and act2 has its own takes.
    scene.write("takes/mara-hello_12.wav", voice(SECOND, 1));
    scene.write("takes/act2/mara-bye_1.wav", voice(SECOND, 2));
    scene.write("takes/notes_1.wav", "not a sound");
    let head = "key,de-de,take\n";
    refused(&format!("{head}act1/mara-hello,Hallo,2\n"), &[], "take 2 of `act1/mara-hello` is missing");
    let twice = format!("{head}act1/mara-hello,Hallo,mara-hello_12\nact1/otto-yes,Ja,mara-hello_12.wav\n");
    refused(&twice, &[], "is chosen for `act1/otto-yes` and for `act1/mara-hello`");
    refused(&format!("{head}act1/mara-hello,Hallo,notes_1.wav\n"), &[], "notes_1.wav");
    refused(&format!("{head},Hallo,12\n"), &[], "the row has a take, but no key");
    refused(&format!("{head}act1/mara-hallo,Hallo,12\n"), &[], "the project has no clip `act1/mara-hallo`");
    let good = format!("{head}act1/mara-hello,Hallo,12\n");
    refused(&good, &["--locale", "fr-fr"], "the script is for de-de, not for fr-fr");
    refused(&good.replace("de-de", "fr-fr"), &[], "the project has no voice in fr-fr");
    let several = "key,de-de,fr-fr,take\nact1/mara-hello,Hallo,Salut,12\n";
    refused(several, &[], "the table has translations into 2 locales");
    refused("key,de-de,take,take\na,b,1,2\n", &[], "a second column has the name `take`");
    refused("key,de-de\nact1/mara-hello,Hallo\n", &[], "no column has the chosen takes");
    // The name of a scene's folder tells its takes from those of others.
    scene.write("takes/mara-bye_1.wav", voice(SECOND, 3));
    scene.write("script.csv", format!("{head}act2/mara-bye,Tschüss,1\n"));
    let copied = lipz(scene.path(), ["import", "recordings", "script.csv", "takes"]);
    assert_eq!((copied.code, copied.stdout.as_str()), (0, "takes copied: 1 new, 0 replaced, 0 unchanged\n"));
    let path = |name: &str| fs::read(scene.path().join(name)).unwrap();
    assert!(path("rec/de/act2/mara-bye.wav") == path("takes/act2/mara-bye_1.wav"));
}

/// Two files may have one name, and the folder of a scene may be the end of a different one.
#[test]
fn takes_are_exactly_the_named_files() {
    let scene = scene();
    scene.write("voices/x/act1/mara-hello.lipz", "{ \"text_en-us\": \"Hello.\", \"text_de-de\": \"Hallo.\" }");
    let import = |take: &str| {
        scene.write("script.csv", format!("key,de-de,take\nact1/mara-hello,Hallo,{take}\n"));
        lipz(scene.path(), ["import", "recordings", "script.csv", "takes"])
    };
    scene.write("takes/x/act1/mara-hello_1.wav", voice(SECOND, 1));
    let other = import("1");
    assert!(other.code == 1 && other.stderr.contains("take 1 of `act1/mara-hello` is missing"), "{other:?}");
    scene.write("takes/act1/mara-hello_1.wav", voice(SECOND, 2));
    scene.write("takes/act1/mara-hello_1.flac", "not the same sound");
    for cell in ["1", "act1/mara-hello_1"] {
        let several = import(cell);
        assert!(several.code == 1 && several.stderr.contains("may be `act1/mara-hello_1."), "{several:?}");
    }
    let missing = import("mara-hello_1.mp3");
    assert!(missing.code == 1 && missing.stderr.contains("is missing in takes"), "{missing:?}");
    assert_eq!(import("act1/mara-hello_1.wav").stdout, "takes copied: 1 new, 0 replaced, 0 unchanged\n");
    let bytes = |name: &str| fs::read(scene.path().join(name)).unwrap();
    assert!(bytes("rec/de/act1/mara-hello.wav") == bytes("takes/act1/mara-hello_1.wav"));
    let file = lipz(scene.path(), ["import", "recordings", "script.csv", "takes/act1/mara-hello_1.wav"]);
    assert!(file.code == 2 && file.stderr.contains("is a file, not a folder of takes"), "{file:?}");
    let missing = lipz(scene.path(), ["import", "recordings", "script.csv", "nothing"]);
    assert!(missing.code == 2 && missing.stderr.contains("`nothing` does not exist"), "{missing:?}");
    let unnamed = lipz(scene.path(), ["import", "recordings", "-", "takes"]);
    assert!(unnamed.code == 2 && unnamed.stderr.contains("--stdin-filename"), "{unnamed:?}");
    scene.write("script.csv", b"PK\x03\x04\x14\x00\x86");
    let archive = lipz(scene.path(), ["import", "recordings", "script.csv", "takes"]);
    assert!(archive.stderr.contains("the file is a spreadsheet or an archive"), "{archive:?}");
}

#[test]
fn a_project_without_recordings_has_a_script() {
    let scene = scene();
    fs::remove_dir_all(scene.path().join("rec")).unwrap();
    assert_eq!(rows(&scene, &["--locale", "de-de"]).len(), 3);
    scene.write("voices/act2/silent.lipz", "{ \"events\": \"feels joy\" }");
    let written = export(&scene, &["csv", "--locale", "de-de", "-o", "script.csv"]);
    assert!(written.stdout.contains("; left out 1 clip without a text in en-us"), "{written:?}");
    assert!(written.stdout.contains("; no recordings: `rec` does not exist"), "{written:?}");
    // The script is also a list of the lines.
    fs::create_dir(scene.path().join("rec")).unwrap();
    let lines = lipz(scene.path(), ["check", "--lines", "script.csv", "--allow", "warnings", "--warn", "LZ1921"]);
    assert!(!lines.stderr.contains("LZ1921") && lines.code == 0, "{lines:?}");
    let script = fs::read_to_string(scene.path().join("script.csv")).unwrap();
    scene.write("script.csv", script.replace("Bye now.", "See you."));
    let lines = lipz(scene.path(), ["check", "--lines", "script.csv", "--allow", "warnings", "--warn", "LZ1921"]);
    assert!(lines.stderr.contains("LZ1921"), "the lines belong to the clips: {lines:?}");
    let folder = export(&scene, &["csv", "--locale", "de-de", "-o", "voices"]);
    assert!(folder.code == 2 && folder.stderr.contains("`voices` is a folder"), "{folder:?}");
    let unknown = export(&scene, &["csv", "--locale", "fr-fr", "-o", "-"]);
    assert!(unknown.code == 2 && unknown.stderr.contains("the project has no voice in fr-fr"), "{unknown:?}");
}

/// The last pattern that matches a clip applies, whatever its name.
#[test]
fn patterns_of_dubs_apply_in_the_order_of_the_file() {
    let scene = scene();
    let status = |dubs: &str| {
        scene.write("lipz.toml", format!("{}[dubs]\n{dubs}", SETTINGS.split("[dubs]").next().unwrap()));
        rows(&scene, &["--locale", "de-de"]).iter().find(|row| row[1] == "act1/mara-hello").unwrap()[6].clone()
    };
    let [all, one] = ["\"act1/**\" = \"voice-over\"\n", "\"act1/mara-*\" = 3\n"];
    assert_eq!(status(&format!("{all}{one}")), "time-constrained (3 %)");
    assert_eq!(status(&format!("{one}{all}")), "voice-over");
}

#[test]
fn dubs_of_another_length_are_reported() {
    let mut scene = scene();
    scene.write("rec/de/act1/mara-hello.wav", voice(LONG, 2));
    let check = ["check", "--quiet", "--allow", "LZ1701,LZ1702,LZ1707,LZ1715"];
    scene.expect("LZ2007-dub-length", &check);
    scene.write("rec/de/act1/mara-hello.wav", voice(SECOND, 2));
    assert_eq!(lipz(scene.path(), check).stderr, "");
    scene.write("rec/de/act1/mara-hello.wav", voice(LONG, 2));
    scene.write("lipz.toml", SETTINGS.replace("\"lip-sync\"", "70"));
    assert_eq!(lipz(scene.path(), check).stderr, "");
    scene.write("lipz.toml", SETTINGS.replace("\"lip-sync\"", "\"lipsync\""));
    let refused = lipz(scene.path(), check);
    assert!(refused.code != 0 && refused.stderr.contains("did you mean \"lip-sync\"?"), "{refused:?}");
    scene.finish(1);
}
