//! Commands that change source files: `fmt`, `check --fix`, `convert`.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use support::{Comparison, Scene, files, lipz, repository, tree, with_input};

const ROUGH: &str = "{\"text_en-us\":\"Aye. |No.\",\"visemes\":\"MAEO-|SO\"}";
const NEAT: &str = "{\n  \"visemes\" :    \"MAEO-|SO\",\n  \"text_en-us\" : \"Aye. |No.\"\n}\n";

#[test]
fn formatted_files() {
    let mut comparison = Comparison::default();
    for file in files("fixtures/format", "lipz") {
        let expected = file.replace(".lipz", ".formatted");
        comparison.compare(&expected, &through_standard_input(&fs::read(repository().join(&file)).unwrap()));
    }
    comparison.finish(4);
}

/// Returns the output of `lipz fmt -` for a file.
fn through_standard_input(bytes: &[u8]) -> String {
    String::from_utf8(with_input(&repository(), &["fmt", "-"], bytes).stdout).unwrap()
}

#[test]
fn standard_input_goes_to_standard_output() {
    let diff = with_input(&repository(), &["fmt", "--diff", "-"], ROUGH.as_bytes());
    assert!(diff.stdout.starts_with(b"--- <stdin>\n+++ <stdin>\n@@ "), "{diff:?}");
    let to_toonboom = ["convert", "-", "--viseme-type", "toonboom"];
    let blair = "{ \"visemes\": \"MAEO-\", \"viseme_type\": \"blair\" }";
    let toonboom = "{ \"visemes\": \"ADCE-\", \"viseme_type\": \"toonboom\" }";
    for before in [blair, toonboom] {
        let converted = with_input(&repository(), &to_toonboom, before.as_bytes());
        assert_eq!((converted.status.code(), converted.stdout.as_slice()), (Some(0), toonboom.as_bytes()));
        assert!(converted.stderr.is_empty(), "{converted:?}");
    }
    for (command, before) in [
        (&["fmt", "-"][..], ROUGH),
        (&to_toonboom, blair),
        (&["convert", "-", "--write-curves"], r#"{ "fps": 24, "visemes": "MAEO", "events": "feels joy" }"#),
    ] {
        let shown = |option: &str| {
            let shown = with_input(&repository(), &[command, &[option, "--quiet"]].concat(), before.as_bytes());
            assert_eq!((shown.status.code(), shown.stderr.as_slice()), (Some(1), &b""[..]), "{command:?} {option}");
            String::from_utf8(shown.stdout).unwrap()
        };
        assert_eq!(shown("--check"), "<stdin>\n", "{command:?}");
        assert!(shown("--diff").starts_with("--- <stdin>\n+++ <stdin>\n@@ "), "{command:?}");
    }
    let loud = with_input(&repository(), &to_toonboom, b"{ \"visemes\": \"12\" }");
    assert_eq!((loud.status.code(), loud.stdout.is_empty()), (Some(1), true), "{loud:?}");
    assert!(loud.stderr.starts_with(b"error[LZ0405]"), "{loud:?}");
}

#[test]
fn standard_input_is_no_file_that_can_be_changed() {
    let scene = Scene::new();
    scene.write("a.lipz", ROUGH);
    let refused: [(&[&str], &str); 6] = [
        (&["fmt", "-", "a.lipz"], "standard input cannot be rewritten together with files"),
        (&["check", "--fix", "-"], "standard input cannot be fixed in place"),
        (&["convert", "a.lipz", "-", "--viseme-type", "blair", "--in-place"], "together with files"),
        (&["convert", "-", "--viseme-type", "blair", "--in-place"], "is converted to standard output"),
        (&["convert", "-", "--write-curves", "--in-place"], "is converted to standard output"),
        (&["convert", "a.lipz", "--viseme-type", "blair"], "no output is named for the converted files"),
    ];
    for (arguments, why) in refused {
        let outcome = lipz(scene.path(), arguments);
        assert_eq!((outcome.code, outcome.stdout.as_str()), (2, ""), "{outcome:?}");
        assert!(outcome.stderr.contains(why) && outcome.stderr.contains("\n = help: "), "{outcome:?}");
    }
    assert_eq!(fs::read_to_string(scene.path().join("a.lipz")).unwrap(), ROUGH);
}

#[test]
fn what_animators_aligned_by_hand_stays_but_for_the_order() {
    let mut aligned = 0;
    for act in ["act1", "act2", "act3"] {
        for file in files(&format!("fixtures/drama/{act}"), "lipz") {
            let before = fs::read_to_string(repository().join(&file)).unwrap();
            if !before.contains("\n  \"fps\" :         2") || before.contains("\\u") {
                continue;
            }
            aligned += 1;
            let after = through_standard_input(before.as_bytes());
            let sorted = |text: &str| {
                let mut lines: Vec<String> = text.lines().map(|line| line.trim_end_matches(',').to_owned()).collect();
                lines.sort();
                lines
            };
            assert_eq!(sorted(&before), sorted(&after), "{file}");
        }
    }
    assert!(aligned >= 5, "{aligned}");
}

#[test]
fn fmt_writes_and_check_does_not() {
    let scene = Scene::new();
    scene.write("voices/a.lipz", ROUGH);
    scene.write("voices/b.lipz", NEAT);
    let read = |name: &str| fs::read_to_string(scene.path().join(name)).unwrap();

    let check = lipz(scene.path(), ["fmt", "--check", "voices"]);
    assert_eq!((check.code, check.stdout.as_str()), (1, "voices/a.lipz\n"));
    assert_eq!(check.stderr, "1 file would change, 1 unchanged\n");
    let diff = lipz(scene.path(), ["fmt", "--diff", "voices", "--quiet"]);
    assert_eq!((diff.code, diff.stderr.as_str()), (1, ""), "as with --check");
    assert!(diff.stdout.starts_with("--- voices/a.lipz\n+++ voices/a.lipz\n@@ "), "{}", diff.stdout);
    assert_eq!(read("voices/a.lipz"), ROUGH);

    let fmt = lipz(scene.path(), ["fmt", "voices"]);
    assert_eq!((fmt.code, fmt.stdout.as_str(), fmt.stderr.as_str()), (0, "1 file formatted, 1 unchanged\n", ""));
    assert_eq!((read("voices/a.lipz"), read("voices/b.lipz")), (NEAT.into(), NEAT.into()));
    assert_eq!(lipz(scene.path(), ["fmt", "--check", "voices"]).code, 0);
    for command in [&["fmt"][..], &["convert", "--viseme-type", "blair"], &["convert", "--write-curves"]] {
        let both = lipz(scene.path(), [command, &["voices", "--check", "--diff"]].concat());
        assert_eq!((both.code, both.stdout.as_str()), (2, ""), "{command:?}: {}", both.stderr);
        assert!(both.stderr.contains("'--check' cannot be used with '--diff'"), "{command:?}: {}", both.stderr);
    }
    assert_eq!(tree(scene.path()), ["voices", "voices/a.lipz", "voices/b.lipz"]);
}

#[test]
fn files_that_cannot_be_read_are_left_alone() {
    let scene = Scene::new();
    scene.write("voices/a.lipz", ROUGH);
    scene.write("voices/bad.lipz", "{\"visemes\": \"MA\"");
    let outcome = lipz(scene.path(), ["fmt", "voices"]);
    assert_eq!((outcome.code, outcome.stdout.as_str()), (1, "1 file formatted, 0 unchanged\n"));
    assert!(outcome.stderr.starts_with("error[LZ0108]"), "{}", outcome.stderr);
    assert_eq!(fs::read_to_string(scene.path().join("voices/bad.lipz")).unwrap(), "{\"visemes\": \"MA\"");
    assert_eq!(lipz(scene.path(), ["fmt", "nowhere"]).code, 2);
}

#[test]
fn fixes_are_made_and_the_rest_is_reported() {
    let scene = Scene::new();
    let bad =
        "\u{FEFF}{\r\n\t\"text-en_us\": \"Aye|No\",\r\n\t\"visemes\": \"MA EO-|l\",\r\n\t\"fps\": \"24\",\r\n}\r\n";
    scene.write("a.lipz", bad);
    let read = || fs::read_to_string(scene.path().join("a.lipz")).unwrap();

    let diff = lipz(scene.path(), ["check", "--diff", "a.lipz"]);
    assert_eq!(lipz(scene.path(), ["check", "--fix", "--diff", "a.lipz"]).stdout, diff.stdout);
    assert_eq!(read(), bad);
    assert!(diff.stdout.contains("\n-\t\"fps\": \"24\",\r\n+\t\"fps\": 24\r\n"), "{}", diff.stdout);
    assert_eq!(diff.code, 1);

    let fix = lipz(scene.path(), ["check", "--fix", "a.lipz"]);
    assert_eq!(fix.stderr, diff.stderr, "what remains is the same");
    assert_eq!((fix.code, fix.stdout.as_str()), (1, "a.lipz: 4 diagnostics (LZ0005, LZ0102, LZ0202, LZ0501) fixed\n"));
    let expected = "{\r\n\t\"text_en-us\": \"Aye|No\",\r\n\t\"visemes\": \"MA EO-|l\",\r\n\t\"fps\": 24\r\n}\r\n";
    assert_eq!(read(), expected);
    let remaining: Vec<&str> = fix.stderr.lines().filter(|line| line.contains("[LZ")).map(|line| &line[..15]).collect();
    assert_eq!(remaining, ["warning[LZ0402]", "error[LZ0401]: "], "{}", fix.stderr);

    scene.write("a.lipz", bad.replace("|l", "|L"));
    let fix = lipz(scene.path(), ["check", "--fix", "a.lipz"]);
    assert_eq!((fix.code, fix.stderr.as_str()), (0, ""));
    assert_eq!(fix.stdout, "a.lipz: 5 diagnostics (LZ0005, LZ0102, LZ0202, LZ0402, LZ0501) fixed\n1 file checked\n");
    assert_eq!(read(), expected.replace("MA EO-|l", "MAEO-|L"));
    assert_eq!(lipz(scene.path(), ["check", "--fix", "a.lipz"]).stdout, "1 file checked\n");
}

#[test]
fn what_converting_reports() {
    let mut scene = Scene::new();
    let in_place =
        |name: &'static str, to: &'static str| ["convert", name, "--viseme-type", to, "--in-place", "--quiet"];
    scene.write("loss.lipz", "{\n  \"visemes\": \"SEEL|UU-\",\n  \"viseme_type\": \"blair\"\n}\n");
    scene.expect("LZ0404-conversion-loss", &in_place("loss.lipz", "toonboom"));
    scene.write("loud.lipz", "{ \"visemes\": \"0257-\", \"viseme_type\": \"rms\" }\n");
    scene.expect("LZ0405-not-convertible-from-rms", &in_place("loud.lipz", "blair"));
    scene.write("blair.lipz", "{ \"visemes\": \"MAEO-\" }\n");
    scene.expect("LZ0405-not-convertible-to-rms", &in_place("blair.lipz", "rms"));
    scene.write("either.lipz", "{ \"visemes\": \"FAEA-\" }\n");
    scene.expect("LZ0405-not-convertible-either", &in_place("either.lipz", "blair"));
    scene.write("out/blair.lipz", "mine");
    scene
        .expect("LZ0906-would-overwrite-convert", &["convert", "blair.lipz", "--viseme-type", "toonboom", "-o", "out"]);
    let read = |name: &str| fs::read_to_string(scene.path().join(name)).unwrap();
    assert_eq!(read("loss.lipz"), "{\n  \"visemes\": \"BCCB|FF-\",\n  \"viseme_type\": \"toonboom\"\n}\n");
    assert_eq!(read("loud.lipz"), "{ \"visemes\": \"0257-\", \"viseme_type\": \"rms\" }\n");
    assert_eq!(read("out/blair.lipz"), "mine");
    scene.finish(5);
}

#[test]
fn converting_into_a_folder_writes_all_files_under_their_keys() {
    let scene = Scene::new();
    let toonboom = "{ \"visemes\": \"ADCE-\", \"viseme_type\": \"toonboom\" }";
    scene.write("voices/act1/a.lipz", toonboom.replace("ADCE", "MAEO").replace("toonboom", "blair"));
    scene.write("voices/b.lipz", toonboom);
    let outcome = lipz(scene.path(), ["convert", "voices", "--viseme-type", "toonboom", "-o", "out"]);
    assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""));
    assert_eq!(outcome.stdout, "1 file converted to toonboom, 1 unchanged\n");
    scene.write("voices/loud.lipz", "{ \"visemes\": \"12\" }");
    let one_of_three = lipz(scene.path(), ["convert", "voices", "--viseme-type", "toonboom", "-o", "other"]);
    assert!(one_of_three.stderr.ends_with("\n1 error in 1 file\n"), "{}", one_of_three.stderr);
    assert_eq!(one_of_three.code, 1);
    assert_eq!(tree(&scene.path().join("other")), ["act1", "act1/a.lipz", "b.lipz"]);
    for name in ["out/act1/a.lipz", "out/b.lipz"] {
        assert_eq!(fs::read_to_string(scene.path().join(name)).unwrap(), toonboom, "{name}");
    }
    assert!(fs::read_to_string(scene.path().join("voices/act1/a.lipz")).unwrap().contains("MAEO"));
}

#[test]
fn converting_is_shown_before_anything_is_written() {
    let scene = Scene::new();
    let blair = "{\n  \"visemes\": \"MAEO-\",\n  \"viseme_type\": \"blair\"\n}\n";
    scene.write("voices/a.lipz", blair);
    scene.write("voices/b.lipz", "{ \"visemes\": \"ADCE-\", \"viseme_type\": \"toonboom\" }");
    let convert = |arguments: &[&str]| {
        let run = lipz(scene.path(), [&["convert", "voices", "--viseme-type", "toonboom"], arguments].concat());
        (run.code, run.stdout, run.stderr)
    };
    let remark = "1 file would be converted to toonboom, 1 unchanged\n";
    assert_eq!(convert(&["--check"]), (1, "voices/a.lipz\n".into(), remark.into()));
    let (code, diff, said) = convert(&["--diff"]);
    assert!(diff.starts_with("--- voices/a.lipz\n+++ voices/a.lipz\n@@ "), "{diff}");
    assert!(
        diff.contains("\n-  \"visemes\": \"MAEO-\",\n") && diff.contains("\n+  \"visemes\": \"ADCE-\",\n"),
        "{diff}"
    );
    assert_eq!((code, said.as_str()), (1, remark));
    assert_eq!(convert(&["--diff", "--quiet"]), (1, diff, String::new()));
    assert_eq!(fs::read_to_string(scene.path().join("voices/a.lipz")).unwrap(), blair);
    for other in [&["--check", "--in-place"][..], &["--diff", "-o", "out"]] {
        assert_eq!(convert(other).0, 2, "{other:?}");
    }
    let in_place = (0, "1 file converted to toonboom, 1 unchanged\n".into(), String::new());
    assert_eq!(convert(&["--in-place"]), in_place);
    assert_eq!(convert(&["--check", "--quiet"]), (0, String::new(), String::new()));
}

#[test]
fn files_that_are_locked_stay() {
    let mut scene = Scene::new();
    scene.write("a.lipz", ROUGH);
    let path = scene.path().join("a.lipz");
    let mut permissions = path.metadata().unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&path, permissions).unwrap();
    scene.expect("LZ0904-output-failed-read-only", &["fmt", "a.lipz", "--quiet"]);
    assert_eq!(fs::read_to_string(path).unwrap(), ROUGH);
    scene.finish(1);
}

/// GitHub reads each line that starts with `::` as a command, and `patch` reads each header line as a header.
#[cfg(unix)]
#[test]
fn a_name_with_line_breaks_stays_in_its_line() {
    let scene = Scene::new();
    scene.write("b\n::error file=x::no.lipz", r#"{"text_en-us": "Aye."}"#);
    for command in [&["fmt", ".", "--diff"][..], &["check", ".", "--fix", "--diff"]] {
        for format in ["human", "github"] {
            let outcome = lipz(scene.path(), command.iter().chain(&["--output-format", format]));
            for line in outcome.stdout.lines().chain(outcome.stderr.lines()) {
                let is_about_it = line.starts_with("::error file=./b%0A");
                assert!(is_about_it || !line.starts_with("::error"), "{command:?} {format}: {line}");
            }
        }
    }
    let diff = lipz(scene.path(), ["fmt", ".", "--diff"]).stdout;
    assert!(diff.starts_with("--- ./b\\n::error file=x::no.lipz\n+++ ./b\\n"), "{diff}");
}
