//! `lipz import visemes`, `lipz export visemes`, `lipz print maps`: their files, and their output about files of other
//! tools.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use support::{Scene, lipz, repository, tree, with_input};

const TSV: &str = "0.00\tX\n0.25\tD\n0.50\tA\n0.75\tX\n1.00\tX\n";

/// A table with all of Papagayo's names except one, and an invalid code.
const BAD_MAP: &str =
    "name = \"our-rig\"\nversion = 1\nviseme-type = \"blair\"\n\n[to-lipz]\nMBP = \"M\"\nWQ = \"Q\"\n";

#[test]
fn what_is_wrong_with_files_of_other_tools() {
    let mut scene = Scene::new();
    let files = [
        ("LZ1101-foreign-syntax", "rhubarb-tsv", "mayor.tsv", "0.00\tX\n0,25\tD\n0.50\tX\n"),
        ("LZ1101-foreign-syntax-json", "rhubarb-json", "mayor.json", "{ \"mouthCues\": [\n  { start: 0 }\n] }\n"),
        ("LZ1102-foreign-cut-off", "rhubarb-tsv", "mayor.tsv", "0.00\tX\n"),
        ("LZ1102-foreign-cut-off-binary", "kotor", "mayor.lip", "LIP V1.0\0\0\0\0\u{1}\0\0\0\0\0"),
        ("LZ1103-foreign-value", "rhubarb-tsv", "mayor.tsv", "0.00\tX\n99999999\tX\n"),
        ("LZ1104-foreign-oddity", "moho", "mayor.dat", "1 rest\n4 MBP\n9 rest\n"),
        ("LZ1105-unknown-symbol", "moho", "mayor.dat", "MohoSwitch1\n1 rest\n4 MPB\n6 AI\n9 MPB\n12 rest\n"),
        ("LZ1106-times-backwards", "rhubarb-tsv", "mayor.tsv", "0.00\tX\n0.50\tD\n0.25\tA\n0.75\tX\n"),
        ("LZ1107-no-shapes", "rhubarb-json", "mayor.json", "{ \"mouthCues\": [] }"),
        ("LZ1108-shapes-lost", "rhubarb-tsv", "mayor.tsv", "0.00\tX\n0.23\tC\n0.24\tD\n0.50\tX\n"),
    ];
    for (name, format, file, text) in files {
        scene.write(file, text);
        scene.expect(name, &["import", "visemes", format, file, "-o", "voices", "--quiet"]);
    }
    let text = ["--script", "mayor.txt", "--locale", "en-us", "--segments", "sentences"];
    scene.write("mayor.txt", "One? Two and three and four.");
    scene.write("mayor.tsv", TSV);
    let import = ["import", "visemes", "rhubarb-tsv", "mayor.tsv", "-o", "voices", "--quiet", "--overwrite"];
    scene.expect("LZ1109-segment-guessed", &[import.as_slice(), &text].concat());
    fs::remove_file(scene.path().join("voices/mayor.lipz")).unwrap();
    scene.expect("LZ1110-text-left-out", &[import.as_slice(), &["--script", "mayor.txt"]].concat());
    scene.write("our-rig.toml", BAD_MAP);
    scene.expect("LZ1111-map-refused", &[import.as_slice(), &["--map", "our-rig.toml"]].concat());
    scene.expect("LZ1111-map-refused-unknown", &[import.as_slice(), &["--map", "papagaya"]].concat());
    scene.finish(14);
}

#[test]
fn what_other_tools_cannot_hold() {
    let mut scene = Scene::new();
    scene.write("voices/mayor.lipz", "{ \"visemes\": \"MAE-\", \"viseme_type\": \"blair\" }");
    let export = ["export", "visemes", "rhubarb-tsv", "voices", "-o", "out", "--quiet"];
    scene.expect("LZ1112-not-exportable", &export);
    scene.write("voices/mayor.lipz", "{ \"visemes\": \"193-\", \"viseme_type\": \"rms\", \"fps\": 24 }");
    scene.expect("LZ1112-not-exportable-rms", &export);
    scene.write("voices/mayor.lipz", "{ \"visemes\": \"MWWE-\", \"viseme_type\": \"blair\", \"fps\": 24 }");
    scene.expect("LZ1113-export-loss", &export);
    scene.finish(3);
}

#[test]
fn files_are_named_after_their_sources_and_nothing_is_replaced() {
    let scene = Scene::new();
    scene.write("recorded/mayor.tsv", TSV);
    scene.write("recorded/act1/mayor.tsv", TSV);
    let import = |more: &[&str]| {
        let arguments = [&["import", "visemes", "rhubarb-tsv", "recorded/mayor.tsv", "-o", "voices"], more].concat();
        lipz(scene.path(), arguments)
    };
    let first = import(&[]);
    let said = "1 file imported from rhubarb-tsv into voices, with the mapping table rhubarb 1\n";
    assert_eq!((first.code, first.stdout.as_str(), first.stderr.as_str()), (0, said, ""));
    let clip = fs::read_to_string(scene.path().join("voices/mayor.lipz")).unwrap();
    assert!(clip.contains("\"------AAAAAAMMMMMM------\""), "{clip}");
    let report = import(&["--output-format", "json"]);
    let report: serde_json::Value = serde_json::from_str(&report.stdout).unwrap();
    assert_eq!(report["import"]["clips"][0]["map"], "rhubarb 1", "{report}");
    let same = import(&["recorded/act1/mayor.tsv"]);
    assert!(same.code == 1 && same.stderr.contains("error[LZ0802]"), "{}", same.stderr);
    assert_eq!(import(&["--viseme-type", "toonboom"]).code, 0);
    let clip = fs::read_to_string(scene.path().join("voices/mayor.lipz")).unwrap();
    assert!(clip.contains("\"------DDDDDDAAAAAA------\""), "{clip}");
    assert_eq!(lipz(scene.path(), ["check", "voices"]).code, 0);
    assert_eq!(tree(&scene.path().join("voices")), ["mayor.lipz"]);
    let by_pattern = lipz(scene.path(), ["import", "visemes", "rhubarb-tsv", "recorded/*/*.tsv", "-o", "more"]);
    assert_eq!((by_pattern.code, tree(&scene.path().join("more"))), (0, vec!["mayor.lipz".to_owned()]));
    let nothing = lipz(scene.path(), ["import", "visemes", "rhubarb-tsv", "recorded/*.tvs", "-o", "more"]);
    assert!(nothing.code == 2 && nothing.stderr.contains("`recorded/*.tvs` does not exist"), "{}", nothing.stderr);
}

#[test]
fn folders_stay_below_a_root_and_one_clash_stops_nothing_else() {
    let scene = Scene::new();
    for file in ["speech/act1/mayor.tsv", "speech/act2/MAYOR.tsv", "speech/act2/con.tsv", "speech/act2/tom.tsv"] {
        scene.write(file, TSV);
    }
    let flat = lipz(scene.path(), ["import", "visemes", "rhubarb-tsv", "speech/**/*.tsv", "-o", "flat"]);
    assert_eq!((flat.code, tree(&scene.path().join("flat"))), (1, vec!["tom.lipz".to_owned()]), "{}", flat.stderr);
    assert!(flat.stderr.contains("error[LZ0801]") && flat.stderr.contains("error[LZ0803]"), "{}", flat.stderr);
    assert!(flat.stdout.starts_with("1 file imported"), "{}", flat.stdout);
    let rooted = lipz(
        scene.path(),
        ["import", "visemes", "rhubarb-tsv", "speech/act?/[mMt]*.tsv", "-o", "voices", "--root", "speech"],
    );
    assert_eq!((rooted.code, rooted.stderr.as_str()), (0, ""));
    let voices = ["act1", "act1/mayor.lipz", "act2", "act2/MAYOR.lipz", "act2/tom.lipz"];
    assert_eq!(tree(&scene.path().join("voices")), voices);
    let elsewhere = lipz(
        scene.path(),
        ["import", "visemes", "rhubarb-tsv", "speech/act2/tom.tsv", "-o", "voices", "--root", "act2"],
    );
    assert!(elsewhere.code == 1 && elsewhere.stderr.contains("is not below the root `act2`"), "{}", elsewhere.stderr);
}

/// A clip and a link to it are one file, which cannot get the visemes of two files.
#[cfg(unix)]
#[test]
fn files_that_are_not_written_are_not_counted() {
    let scene = Scene::new();
    scene.write("a.tsv", TSV);
    scene.write("b.tsv", TSV.replace('A', "C"));
    scene.write("voices/a.lipz", r#"{ "visemes": "MA-", "viseme_type": "blair", "fps": 24 }"#);
    std::os::unix::fs::symlink("a.lipz", scene.path().join("voices/b.lipz")).unwrap();
    let import = ["import", "visemes", "rhubarb-tsv", "a.tsv", "b.tsv", "-o", "voices"];
    let imported = lipz(scene.path(), import);
    assert!(imported.stderr.contains("another program has changed it in the meantime"), "{}", imported.stderr);
    assert!(imported.stdout.starts_with("1 file imported from rhubarb-tsv into voices, "), "{}", imported.stdout);
    assert!(imported.stdout.contains("\n1 existing file: only its visemes are new\n"), "{}", imported.stdout);
}

#[test]
fn texts_and_files_that_do_not_belong_together_are_told() {
    let mut scene = Scene::new();
    for file in ["a.tsv", "b.tsv", "c.tsv"] {
        scene.write(file, TSV);
    }
    scene.write("script.csv", "file,text\na.wav,One.\nd.wav,Four.\ne.wav,Five.\n");
    let import =
        ["import", "visemes", "rhubarb-tsv", "a.tsv", "b.tsv", "c.tsv", "-o", "voices", "--locale", "en-us", "--quiet"];
    scene.expect("LZ1116-text-not-joined", &[&import[..], &["--script", "script.csv"]].concat());
    for text in ["a.txt", "d.txt", "act1/b.txt", ".b.txt", "notes.md"] {
        scene.write(&format!("texts/{text}"), "One.");
    }
    scene.expect("LZ1116-text-not-joined-folder", &[&import[..], &["--script", "texts"]].concat());
    let one =
        ["import", "visemes", "rhubarb-tsv", "a.tsv", "-o", "voices", "--locale", "en-us", "--script", "script.csv"];
    assert_eq!(lipz(scene.path(), one).stderr, "", "the other rows of the script are ignored");
    scene.finish(2);
}

#[test]
fn texts_of_other_encodings() {
    let scene = Scene::new();
    scene.write("a.tsv", TSV);
    scene.write("b.tsv", TSV);
    scene.write("texts/a.txt", b"\xC4\xE0.");
    scene.write("texts/b.txt", "Нет.");
    let text = |key: &str| fs::read_to_string(scene.path().join(format!("voices/{key}.lipz"))).unwrap_or_default();
    let both = [
        "import",
        "visemes",
        "rhubarb-tsv",
        "a.tsv",
        "b.tsv",
        "-o",
        "voices",
        "--locale",
        "ru-ru",
        "--script",
        "texts",
    ];
    let refused = lipz(scene.path(), both);
    assert_eq!((refused.code, text("a").as_str()), (1, ""), "{}", refused.stderr);
    assert!(refused.stderr.contains("error[LZ0003]: the file is not UTF-8 (byte 0xC4)"), "{}", refused.stderr);
    let named = lipz(scene.path(), [&both[..], &["--encoding", "windows-1251"]].concat());
    assert_eq!(named.code, 0, "{}", named.stderr);
    assert!(text("a").contains("Да.") && text("b").contains("Нет."), "{}{}", text("a"), text("b"));
    assert!(named.stderr.contains("the file is UTF-8, not windows-1251"), "{}", named.stderr);
    let one = ["import", "visemes", "rhubarb-tsv", "a.tsv", "-o", "-", "--locale", "ru-ru", "--script", "texts/a.txt"];
    let printed = lipz(scene.path(), [&one[..], &["--encoding", "windows-1251"]].concat());
    assert!(printed.stdout.contains("Да."), "{}{}", printed.stdout, printed.stderr);
}

#[test]
fn frames_of_moho_count_from_where_its_reader_does() {
    let scene = Scene::new();
    scene.write("voices/mayor.lipz", r#"{ "visemes": "MA", "viseme_type": "blair", "fps": 24 }"#);
    for (base, expected) in [("0", "MohoSwitch1\n0 MBP\n1 AI\n2 rest\n"), ("1", "MohoSwitch1\n1 MBP\n2 AI\n3 rest\n")] {
        scene.prepare(&["export", "visemes", "moho", "voices", "-o", "out", "--overwrite", "--dat-base", base]);
        assert_eq!(fs::read_to_string(scene.path().join("out/mayor.dat")).unwrap(), expected);
        scene.prepare(&["import", "visemes", "moho", "out/mayor.dat", "-o", "back", "--dat-base", base]);
        assert!(fs::read_to_string(scene.path().join("back/mayor.lipz")).unwrap().contains("\"MA\""));
    }
}

#[test]
fn voices_of_other_languages_have_their_table() {
    let scene = Scene::new();
    let marks =
        "{\"time\":0,\"type\":\"viseme\",\"value\":\"B\"}\n{\"time\":500,\"type\":\"viseme\",\"value\":\"J\"}\n";
    scene.write("hola.marks", format!("{marks}{{\"time\":1000,\"type\":\"viseme\",\"value\":\"sil\"}}\n"));
    let run = lipz(scene.path(), ["import", "visemes", "polly", "hola.marks", "-o", "voices"]);
    assert!(run.code == 0 && run.stdout.contains("mapping table polly-languages 2"), "{run:?}");
}

#[test]
fn noise_of_computed_times_is_no_gap() {
    let scene = Scene::new();
    let cue =
        |start: &str, end: &str, value: &str| format!("{{\"start\":{start},\"end\":{end},\"value\":\"{value}\"}}");
    let cues = [cue("0", "28.849999999999998", "D"), cue("28.85", "30", "A")].join(",");
    scene.write("mayor.json", format!("{{\"mouthCues\":[{cues}]}}"));
    let run = lipz(scene.path(), ["import", "visemes", "rhubarb-json", "mayor.json", "-o", "voices"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
}

#[test]
fn a_second_language_joins_the_first() {
    let mut scene = Scene::new();
    scene.write("eld_1.tsv", TSV);
    let import = |script: &'static str, locale: &'static str| {
        [
            "import",
            "visemes",
            "rhubarb-tsv",
            "eld_1.tsv",
            "-o",
            "voices",
            "--script",
            script,
            "--locale",
            locale,
            "--quiet",
        ]
    };
    scene.write("en.msg", "{1}{eld_1}{Greetings.}");
    scene.write("ru.msg", b"{1}{eld_1}{\xC4\xE0.}");
    scene.prepare(&import("en.msg", "en-us"));
    scene.prepare(&[&import("ru.msg", "ru-ru")[..], &["--encoding", "windows-1251"]].concat());
    let clip = fs::read_to_string(scene.path().join("voices/eld_1.lipz")).unwrap();
    assert!(clip.contains("\"Greetings.\"") && clip.contains("\"Да.\""), "{clip}");
    scene.write("ru8.msg", "{1}{eld_1}{Да.}");
    scene.expect(
        "LZ1104-foreign-oddity-utf8",
        &[&import("ru8.msg", "ru-ru")[..], &["--encoding", "windows-1251"]].concat(),
    );
    scene.expect("LZ1104-foreign-oddity-guessed", &import("ru.msg", "ru-ru"));
    assert_eq!(fs::read_to_string(scene.path().join("voices/eld_1.lipz")).unwrap(), clip);
    scene.finish(2);
}

#[test]
fn projects_in_the_encoding_of_their_system() {
    let scene = Scene::new();
    let pgo = fs::read_to_string(repository().join("fixtures/interop/papagayo/hello.pgo")).unwrap();
    let latin: Vec<u8> = pgo.replace("hello", "h\u{e9}llo").chars().map(|c| u8::try_from(c).unwrap()).collect();
    scene.write("hello.pgo", &latin);
    let import = ["import", "visemes", "papagayo", "hello.pgo", "-o", "voices", "--locale", "fr-fr"];
    let guessed = lipz(scene.path(), import);
    assert!(guessed.code == 0 && guessed.stderr.contains("is read as Windows-1252"), "{}", guessed.stderr);
    let named = lipz(scene.path(), [&import[..], &["--encoding", "latin1", "--overwrite"]].concat());
    assert_eq!((named.code, named.stderr.as_str()), (0, ""));
}

#[test]
fn standard_input_goes_to_standard_output() {
    let folder = repository();
    let imported = with_input(&folder, &["import", "visemes", "rhubarb-tsv", "-"], TSV.as_bytes());
    assert!(imported.status.success(), "{imported:?}");
    let exported = with_input(&folder, &["export", "visemes", "rhubarb-tsv", "-"], &imported.stdout);
    assert_eq!(String::from_utf8(exported.stdout).unwrap(), TSV);
}

#[test]
fn maps_are_listed_and_one_is_a_file_to_start_from() {
    let scene = Scene::new();
    let list = lipz(scene.path(), ["print", "maps"]).stdout;
    assert!(list.lines().any(|line| line.starts_with("papagayo ") && line.ends_with(", lossless")), "{list}");
    let table = lipz(scene.path(), ["print", "maps", "rhubarb"]).stdout;
    scene.write("ours.toml", table.replace("A = \"M\"", "A = \"-\"").replace("\"rhubarb\"", "\"ours\""));
    scene.write("mayor.tsv", TSV);
    let run =
        lipz(scene.path(), ["import", "visemes", "rhubarb-tsv", "mayor.tsv", "-o", "voices", "--map", "ours.toml"]);
    assert!(run.stdout.contains("mapping table ours 1"), "{run:?}");
    let clip = fs::read_to_string(scene.path().join("voices/mayor.lipz")).unwrap();
    assert!(clip.contains("\"------AAAAAA------------\""), "{clip}");
    assert_eq!(lipz(scene.path(), ["print", "maps", "rubarb"]).code, 2);
}
