//! Standard input and output in place of files, and the conditions for colours.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use std::process::{Command, Output};
use support::{Scene, lipz, repository, with_input};

fn printed(output: &Output) -> (i32, String, String) {
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
    (output.status.code().unwrap(), text(&output.stdout), text(&output.stderr))
}

#[test]
fn a_lipz_file_is_checked_from_standard_input() {
    let folder = repository();
    let clean = with_input(&folder, &["check", "-"], br#"{ "text_en-us": "Aye." }"#);
    assert_eq!(printed(&clean), (0, "1 file checked\n".into(), String::new()));
    let (code, stdout, stderr) = printed(&with_input(&folder, &["check", "-"], br#"{ "fps": 0 }"#));
    assert_eq!((code, stdout.as_str()), (1, ""));
    assert!(stderr.contains("error[LZ0301]") && stderr.contains("--> <stdin>:1:10"), "{stderr}");
    let beside = with_input(&folder, &["check", "fixtures/drama", "-"], b"{ \"fps\": 24 }");
    assert!(printed(&beside).1.starts_with("49 files checked\n"));
}

#[test]
fn banks_go_through_pipes() {
    let folder = repository();
    let packed = with_input(&folder, &["pack", "fixtures/drama", "--config", "default-locale=en-us", "-o", "-"], b"");
    let summary = String::from_utf8(packed.stderr.clone()).unwrap();
    assert!(summary.contains("\n48 clips packed into standard output ("), "{summary}");
    let file = tempfile::tempdir().unwrap();
    let path = file.path().join("drama.lipzbank");
    let arguments = ["pack", "fixtures/drama", "--config", "default-locale=en-us", "-q", "-o", path.to_str().unwrap()];
    let (code, stdout, _) = printed(&with_input(&folder, &arguments, b""));
    assert_eq!((code, stdout.as_str()), (0, ""));
    assert!(fs::read(&path).unwrap() == packed.stdout, "the same bank, and nothing else");

    let (code, verified, _) = printed(&with_input(&folder, &["verify", "-"], &packed.stdout));
    assert_eq!((code, verified.starts_with("<stdin>: no fault (48 clips, ")), (0, true), "{verified}");
    let (code, listed, _) = printed(&with_input(&folder, &["inspect", "-", "--show", "clips"], &packed.stdout));
    assert_eq!((code, listed.lines().count()), (0, 48));
    let (code, _, refused) = printed(&with_input(&folder, &["verify", "-"], b"no bank"));
    assert_eq!((code, refused.contains("error[LZ0902]")), (1, true), "{refused}");
}

#[test]
fn nothing_is_packed_into_standard_output_with_errors() {
    let packed = with_input(&repository(), &["pack", "-", "-o", "-"], b"{ \"fps\": 0 }");
    assert_eq!((packed.status.code(), packed.stdout.as_slice()), (Some(1), &b""[..]));
}

#[test]
fn colours_are_asked_for_or_not() {
    let has_colours = |arguments: &[&str], variables: &[(&str, &str)]| {
        let output = Command::new(env!("CARGO_BIN_EXE_lipz"))
            .args(["check", "fixtures/bad/LZ0303-unknown-viseme-type.lipz"])
            .args(arguments)
            .current_dir(repository())
            .env_remove("NO_COLOR")
            .env_remove("CLICOLOR_FORCE")
            .envs(variables.iter().copied())
            .output()
            .unwrap();
        output.stderr.contains(&b'\x1b')
    };
    assert!(!has_colours(&[], &[]), "there is no terminal");
    assert!(has_colours(&[], &[("CLICOLOR_FORCE", "1")]));
    assert!(!has_colours(&[], &[("NO_COLOR", "1")]));
    assert!(has_colours(&["--color", "always"], &[("NO_COLOR", "1")]));
    assert!(!has_colours(&["--color", "never"], &[("CLICOLOR_FORCE", "1")]));
    assert!(!has_colours(&["--color", "auto"], &[]));
}

/// An editor's unsaved text of a file is checked like the file: with its settings, its name and its key.
#[test]
fn standard_input_is_the_text_of_a_file() {
    let scene = Scene::new();
    scene.write(
        "project/lipz.toml",
        "sources = [\"voices\"]\ndefault-locale = \"de-de\"\nlints.unknown-element = \"deny\"\n",
    );
    let text = r#"{ "text_en-us": "Aye.", "text_de-de": "Ja.", "note": 1 }"#;
    let file = ["--stdin-filename", "project/voices/act1/aye.lipz"];
    let with_text =
        |arguments: &[&str]| printed(&with_input(scene.path(), &[arguments, &file].concat(), text.as_bytes()));
    let checked = with_text(&["check", "-"]);
    assert!(checked.2.contains("error[LZ0203]"), "{}", checked.2);
    assert!(checked.2.contains("--> project/voices/act1/aye.lipz:1:"), "{}", checked.2);
    let packed = with_text(&["pack", "-", "-o", "one.lipzbank", "--allow", "LZ0203"]);
    assert_eq!(packed.0, 0, "{}", packed.2);
    assert!(lipz(scene.path(), ["inspect", "one.lipzbank", "--show", "clips"]).stdout.contains("act1/aye"));
    let formatted = with_text(&["fmt", "-"]);
    assert!(formatted.1.find("text_de-de") < formatted.1.find("text_en-us"), "{}", formatted.1);
    let different = with_text(&["fmt", "-", "--diff"]);
    assert!(different.1.contains("project/voices/act1/aye.lipz"), "{}", different.1);
    // The settings of the current folder do not apply to the file, and the name does not affect other files.
    let alone = printed(&with_input(scene.path(), &["check", "-"], text.as_bytes()));
    assert!(alone.2.contains("--> <stdin>:1:") && alone.0 == 0, "{}", alone.2);
    let unread = lipz(scene.path(), ["check", "project/voices", "--stdin-filename", "a.lipz"]);
    assert_eq!(unread.code, 2);
    assert!(unread.stderr.contains("needs standard input, which is not read"), "{}", unread.stderr);
}

#[test]
fn only_commands_that_read_standard_input_as_a_file_name_it() {
    let is_listed = |command: &str| {
        let arguments = command.split(' ').chain(["--help"]);
        lipz(&repository(), arguments).stdout.contains("--stdin-filename")
    };
    for command in
        ["approve", "check", "convert", "export texts", "fmt", "ids", "import texts", "import visemes", "pack"]
    {
        assert!(is_listed(command), "{command}");
    }
    for command in [
        "coverage",
        "diff",
        "import subtitles",
        "inspect",
        "new",
        "preview",
        "print schema",
        "shard plan",
        "sync",
        "watch",
    ] {
        assert!(!is_listed(command), "{command}");
    }
    let scene = Scene::new();
    scene.write("voices/a.lipz", "{}");
    for (command, message) in [
        (&["preview", "-"][..], "standard input cannot be previewed"),
        (&["sync", "--audio", "voices", "-"], "visemes cannot be made from standard input"),
        (&["watch", "-o", "b.lipzbank", "-"], "standard input and output cannot be watched"),
    ] {
        let refused = with_input(scene.path(), command, b"{}");
        assert_eq!(refused.status.code(), Some(2), "{command:?}: {refused:?}");
        assert!(String::from_utf8_lossy(&refused.stderr).contains(message), "{command:?}: {refused:?}");
    }
}
