//! `lipz import`, `lipz export`, `lipz maps`: what they write, and what they print about files of other tools.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use support::{Scene, lipz, repository, tree, with_input};

const TSV: &str = "0.00\tX\n0.25\tD\n0.50\tA\n0.75\tX\n1.00\tX\n";

/// A table with Papagayo's names but for one, and a code that is none.
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
        scene.expect(name, &["import", format, file, "-o", "voices", "--quiet", "--force"]);
    }
    let text = ["--text", "One? Two and three and four.", "--locale", "en-us", "--segments", "sentences"];
    scene.write("mayor.tsv", TSV);
    let import = ["import", "rhubarb-tsv", "mayor.tsv", "-o", "voices", "--quiet", "--replace"];
    scene.expect("LZ1109-segment-guessed", &[import.as_slice(), &text].concat());
    fs::remove_file(scene.path().join("voices/mayor.lipz")).unwrap();
    scene.expect("LZ1110-text-left-out", &[import.as_slice(), &["--text", "Aye."]].concat());
    scene.write("our-rig.toml", BAD_MAP);
    scene.expect("LZ1111-map-refused", &[import.as_slice(), &["--map", "our-rig.toml"]].concat());
    scene.expect("LZ1111-map-refused-unknown", &[import.as_slice(), &["--map", "papagaya"]].concat());
    scene.finish(14);
}

#[test]
fn what_other_tools_cannot_hold() {
    let mut scene = Scene::new();
    scene.write("voices/mayor.lipz", "{ \"visemes\": \"MAE-\", \"viseme_type\": \"blair\" }");
    let export = ["export", "rhubarb-tsv", "voices", "-o", "out", "--quiet"];
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
        let arguments = [&["import", "rhubarb-tsv", "recorded/mayor.tsv", "-o", "voices"], more].concat();
        lipz(scene.path(), arguments)
    };
    let first = import(&["--report", "report.json"]);
    let said = "1 file imported from rhubarb-tsv into voices, by the mapping table rhubarb 1\n";
    assert_eq!((first.code, first.stdout.as_str(), first.stderr.as_str()), (0, said, ""));
    let clip = fs::read_to_string(scene.path().join("voices/mayor.lipz")).unwrap();
    assert!(clip.contains("\"------AAAAAAMMMMMM------\""), "{clip}");
    assert!(fs::read_to_string(scene.path().join("report.json")).unwrap().contains("\"map\": \"rhubarb 1\""));
    let same = import(&["recorded/act1/mayor.tsv"]);
    assert!(same.code == 1 && same.stderr.contains("error[LZ0802]"), "{}", same.stderr);
    assert_eq!(import(&["--viseme-type", "toonboom"]).code, 0);
    let clip = fs::read_to_string(scene.path().join("voices/mayor.lipz")).unwrap();
    assert!(clip.contains("\"------DDDDDDAAAAAA------\""), "{clip}");
    assert_eq!(lipz(scene.path(), ["check", "voices"]).code, 0);
    assert_eq!(tree(&scene.path().join("voices")), ["mayor.lipz"]);
    let by_pattern = lipz(scene.path(), ["import", "rhubarb-tsv", "recorded/*/*.tsv", "-o", "more"]);
    assert_eq!((by_pattern.code, tree(&scene.path().join("more"))), (0, vec!["mayor.lipz".to_owned()]));
    let nothing = lipz(scene.path(), ["import", "rhubarb-tsv", "recorded/*.tvs", "-o", "more"]);
    assert!(nothing.code == 2 && nothing.stderr.contains("`recorded/*.tvs` does not exist"), "{}", nothing.stderr);
}

#[test]
fn standard_input_goes_to_standard_output() {
    let folder = repository();
    let imported = with_input(&folder, &["import", "rhubarb-tsv", "-"], TSV.as_bytes());
    assert!(imported.status.success(), "{imported:?}");
    let exported = with_input(&folder, &["export", "rhubarb-tsv", "-"], &imported.stdout);
    assert_eq!(String::from_utf8(exported.stdout).unwrap(), TSV);
}

#[test]
fn maps_are_listed_and_one_is_a_file_to_start_from() {
    let scene = Scene::new();
    let list = lipz(scene.path(), ["maps"]).stdout;
    assert!(list.lines().any(|line| line.starts_with("papagayo ") && line.ends_with(", lossless")), "{list}");
    let table = lipz(scene.path(), ["maps", "rhubarb"]).stdout;
    scene.write("ours.toml", table.replace("A = \"M\"", "A = \"-\"").replace("\"rhubarb\"", "\"ours\""));
    scene.write("mayor.tsv", TSV);
    let run = lipz(scene.path(), ["import", "rhubarb-tsv", "mayor.tsv", "-o", "voices", "--map", "ours.toml"]);
    assert!(run.stdout.contains("mapping table ours 1"), "{run:?}");
    let clip = fs::read_to_string(scene.path().join("voices/mayor.lipz")).unwrap();
    assert!(clip.contains("\"------AAAAAA------------\""), "{clip}");
    assert_eq!(lipz(scene.path(), ["maps", "rubarb"]).code, 2);
}
