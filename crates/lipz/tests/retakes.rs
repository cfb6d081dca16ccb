//! Commands that write to an existing Lipz file: manual work stays, or is reported.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use support::{Scene, lipz};

const TSV: &str = "0.00\tX\n0.25\tD\n0.50\tX\n1.00\tA\n1.25\tC\n1.50\tX\n1.75\tX\n";
const CLIP: &str = "{\r\n\t\"text_en-us\": \"Ah! |{sad} Me.\",\r\n\t\"note\":  { \"by\" : \"J\\u00f6rg\" },\r\n\t\"visemes\": \"MA---|MEE\",\r\n\t\"text_de-de\": \"Ah!|Ich.\", \"events\": \"nods|\",\r\n\t\"fps\": 24.0\r\n}\r\n";

fn clip(scene: &Scene) -> String {
    fs::read_to_string(scene.path().join("voices/mayor.lipz")).unwrap()
}

#[test]
fn a_retake_changes_the_mouth_and_nothing_else() {
    let scene = Scene::new();
    scene.write("mayor.tsv", TSV);
    scene.write("voices/mayor.lipz", CLIP);
    for _ in 0..2 {
        let run = lipz(scene.path(), ["import", "visemes", "rhubarb-tsv", "mayor.tsv", "-o", "voices"]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""));
        assert!(run.stdout.ends_with("1 existing file: only its visemes are new\n"), "{}", run.stdout);
        let visemes = "------AAAAAA------------|MMMMMMEEEEEE------";
        let events = "\"events\": \"nods|\"";
        let expected = CLIP.replace("MA---|MEE", visemes);
        assert_eq!(clip(&scene), expected.replace(events, &format!("{events}, \"viseme_type\": \"blair\"")));
    }
    assert_eq!(lipz(scene.path(), ["check", "voices", "--allow", "unknown-element"]).code, 0);
}

#[test]
fn a_clip_keeps_its_rate_and_type_unless_others_are_named() {
    let scene = Scene::new();
    scene.write("mayor.tsv", TSV);
    scene.write("voices/mayor.lipz", r#"{ "fps": 4, "viseme_type": "toonboom", "visemes": "" }"#);
    let import = ["import", "visemes", "rhubarb-tsv", "mayor.tsv", "-o", "voices"];
    scene.prepare(&import);
    assert_eq!(clip(&scene), r#"{ "fps": 4, "viseme_type": "toonboom", "visemes": "-D--AC-" }"#);
    scene.prepare(&[&import[..], &["--fps", "8", "--viseme-type", "blair"]].concat());
    assert_eq!(clip(&scene), r#"{ "fps": 8, "viseme_type": "blair", "visemes": "--AA----MMEE--" }"#);
    let before = fs::metadata(scene.path().join("voices/mayor.lipz")).unwrap().modified().unwrap();
    scene.prepare(&import);
    assert_eq!(fs::metadata(scene.path().join("voices/mayor.lipz")).unwrap().modified().unwrap(), before, "the same");
}

#[test]
fn a_formatted_file_stays_formatted() {
    let scene = Scene::new();
    scene.write("mayor.tsv", TSV);
    scene.write("voices/mayor.lipz", CLIP);
    scene.prepare(&["fmt", "voices", "--quiet"]);
    scene.prepare(&["import", "visemes", "rhubarb-tsv", "mayor.tsv", "-o", "voices"]);
    assert_eq!(lipz(scene.path(), ["fmt", "voices", "--check"]).code, 0, "{}", clip(&scene));
    scene.write("mayor.de-de.srt", "1\n00:00:00,000 --> 00:00:01,000\nDoch!\n");
    scene.prepare(&["import", "subtitles", "mayor.de-de.srt", "-o", "voices"]);
    assert!(clip(&scene).contains("Doch!"), "{}", clip(&scene));
    assert_eq!(lipz(scene.path(), ["fmt", "voices", "--check"]).code, 0, "{}", clip(&scene));
}

#[test]
fn subtitles_change_one_text_and_nothing_else() {
    let mut scene = Scene::new();
    scene.write("voices/mayor.lipz", CLIP);
    scene.write(
        "mayor.de-de.srt",
        "1\n00:00:00,000 --> 00:00:00,200\nDoch!\n\n2\n00:00:00,208 --> 00:00:00,333\nIch.\n",
    );
    let import = |file: &'static str| ["import", "subtitles", file, "-o", "voices", "--quiet"];
    let run = lipz(scene.path(), import("mayor.de-de.srt"));
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    assert_eq!(clip(&scene), CLIP.replace("Ah!|Ich.", "Doch!|Ich."));
    scene.write("mayor.en-us.srt", "1\n00:00:00,208 --> 00:00:00,333\nYou.\n");
    scene.expect("LZ1115-clip-replaced-subtitles", &import("mayor.en-us.srt"));
    scene.finish(1);
}

#[test]
fn what_is_not_taken_and_what_is_lost() {
    let mut scene = Scene::new();
    scene.write("mayor.tsv", TSV);
    scene.write("voices/mayor.lipz", CLIP.replace("\r\n", "\n"));
    let import = ["import", "visemes", "rhubarb-tsv", "mayor.tsv", "-o", "voices", "--quiet"];
    scene.write("mayor.txt", "Oh! Me.");
    let text = [&import[..], &["--script", "mayor.txt", "--locale", "en-us"]].concat();
    scene.expect("LZ1114-import-kept", &text);
    scene.expect("LZ1114-import-kept-denied", &[&text[..], &["--deny", "import-kept"]].concat());
    scene.write("mayor.tsv", "0.00\tD\n0.30\tX\n0.50\tC\n9.00\tX\n");
    scene.expect("LZ1109-segment-guessed-retake", &import);
    let before = clip(&scene);
    let replace = [&import[..], &["--overwrite"]].concat();
    scene.expect("LZ1115-clip-replaced-denied", &[&replace[..], &["--deny", "clip-replaced"]].concat());
    assert_eq!(clip(&scene), before);
    scene.expect("LZ1115-clip-replaced", &replace);
    scene.write("voices/mayor.lipz", "{ \"visemes\": \"AAAA--\", \"fps\": 12, \"phones\": \"AA@0 sil@330\" }");
    scene.expect("LZ1117-phones-removed", &import);
    assert!(!clip(&scene).contains("phones"), "{}", clip(&scene));
    scene.write("voices/mayor.lipz", "{ \"text_en-us\": \"Ah!\", }");
    scene.expect("LZ0102-trailing-comma-retake", &import);
    assert_eq!(clip(&scene), "{ \"text_en-us\": \"Ah!\", }");
    scene.expect("LZ1115-clip-replaced-unreadable", &replace);
    scene.finish(8);
}

#[test]
fn a_bank_that_replaces_newer_files_tells() {
    let mut scene = Scene::new();
    scene.write("voices/mayor.lipz", CLIP);
    scene.prepare(&["pack", "voices", "-o", "voices.lipzbank", "--quiet"]);
    let unpack = ["unpack", "voices.lipzbank", "-o", "voices", "--overwrite", "--quiet"];
    scene.prepare(&unpack);
    let exact = lipz(scene.path(), unpack);
    assert_eq!(exact.stderr, "", "the bank contains everything");
    scene.write("voices/mayor.lipz", CLIP.replace("Ich.", "Icke."));
    scene.expect("LZ1115-clip-replaced-unpack", &unpack);
    scene.finish(1);
}
