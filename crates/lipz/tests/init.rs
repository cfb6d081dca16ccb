//! `lipz init` and `lipz new`: the files of a new project, and new clips in it.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use support::{Scene, lipz, tree};

#[test]
fn init_writes_a_file_that_works_and_replaces_none() {
    let mut scene = Scene::new();
    scene.write("act1/aye.lipz", "{ \"text_en-us\": \"Aye.\" }");
    scene.prepare(&["init"]);
    assert_eq!(lipz(scene.path(), ["check"]).stdout, "1 file checked\n");
    let written = fs::read_to_string(scene.path().join("lipz.toml")).unwrap();
    scene.write("lipz.toml", "strip = true");
    scene.expect("LZ0906-would-overwrite-init", &["init"]);
    assert_eq!(fs::read_to_string(scene.path().join("lipz.toml")).unwrap(), "strip = true");
    scene.prepare(&["init", "--overwrite"]);
    assert_eq!(fs::read_to_string(scene.path().join("lipz.toml")).unwrap(), written);
    scene.prepare(&["init", "new/project", "--quiet"]);
    let of_new = [".gitattributes", ".gitignore", "lipz.toml", "voices", "voices/hello.lipz"];
    let of_new = of_new.map(|name| format!("new/project/{name}"));
    let old =
        [".gitattributes", ".gitignore", "act1", "act1/aye.lipz", "lipz.toml", "new", "new/project"].map(str::to_owned);
    let mut files: Vec<String> = old.into_iter().chain(of_new).collect();
    files.sort();
    assert_eq!(tree(scene.path()), files);
    scene.finish(1);
}

#[test]
fn a_new_settings_file_is_short_or_shows_every_setting() {
    let scene = Scene::new();
    let init = |more: &[&str]| {
        scene.prepare(&[&["init", "--overwrite", "--quiet"], more].concat());
        fs::read_to_string(scene.path().join("lipz.toml")).unwrap()
    };
    let short = init(&[]);
    assert!(short.lines().count() <= 10 && short.contains("`lipz print settings`"), "{short}");
    fs::remove_dir_all(scene.path().join("voices")).unwrap();
    let full = init(&["--full"]);
    // Both set the same. The additional lines of the long one are those in `print settings`.
    let printed = lipz(scene.path(), ["print", "settings"]);
    assert_eq!((printed.code, printed.stderr.as_str()), (0, ""));
    let set = |text: &str| -> Vec<String> {
        let of_table = text.lines().filter(|line| !line.starts_with(['#', '[']) && !line.is_empty());
        let mut lines: Vec<String> = of_table.map(str::to_owned).collect();
        lines.sort();
        lines
    };
    let expected = [
        "default-locale = \"en-us\"",
        "keys = \"words\"",
        "output = \"dialogue.lipzbank\"",
        "phones = true",
        "sources = [\"voices\"]",
    ];
    assert_eq!(
        (set(&full), set(&short), set(&printed.stdout)),
        (expected.map(str::to_owned).to_vec(), expected.map(str::to_owned).to_vec(), vec![])
    );
    assert!(short.contains("\n[face]\nkeys = ") && full.lines().count() > 100, "{short}");
    let lines = |text: &str| text.lines().count();
    assert_eq!(lines(&full), lines(&printed.stdout));
}

#[test]
fn a_new_project_packs() {
    let scene = Scene::new();
    scene.write(".gitignore", "target");
    scene.prepare(&["init"]);
    assert_eq!(
        fs::read_to_string(scene.path().join(".gitignore")).unwrap(),
        "target\n/dialogue.lipzbank\n.*.lipztmp\n"
    );
    let attributes = || fs::read_to_string(scene.path().join(".gitattributes")).unwrap();
    assert_eq!(attributes(), "lipz-texts.txt merge=union\n*.lipz merge=lipz\n");
    let first = lipz(scene.path(), ["check", "--deny", "warnings"]);
    assert_eq!((first.code, first.stderr.as_str()), (0, ""));
    assert_eq!(lipz(scene.path(), ["fmt", "--check"]).code, 0, "the first clip is in canonical layout");
    scene.prepare(&["new", "act1/mara-hello", "{tired} Good evening, \"Otto\".|Aye."]);
    let written = fs::read_to_string(scene.path().join("voices/act1/mara-hello.lipz")).unwrap();
    assert_eq!(written, "{\n  \"text_en-us\" : \"{tired} Good evening, \\\"Otto\\\".|Aye.\"\n}\n");
    let later = lipz(scene.path(), ["new", "act1/later"]);
    assert_eq!((later.code, later.stderr.as_str()), (0, ""));
    let written = fs::read_to_string(scene.path().join("voices/act1/later.lipz")).unwrap();
    assert_eq!(written, "{\n  \"text_en-us\" : \"\"\n}\n");
    scene.prepare(&["new", "act1/otto", "Ja.", "--locale", "de-de", "--output", "voices"]);
    scene.prepare(&["pack"]);
    let list =
        lipz(scene.path(), ["inspect", "dialogue.lipzbank", "--show", "clips", "--output-format", "json"]).stdout;
    for key in ["hello", "act1/mara-hello", "act1/otto"] {
        assert!(list.contains(&format!("\"{key}\"")), "{list}");
    }
    scene.prepare(&["init", "--overwrite"]);
    assert_eq!(
        fs::read_to_string(scene.path().join(".gitignore")).unwrap(),
        "target\n/dialogue.lipzbank\n.*.lipztmp\n"
    );
    assert_eq!(attributes(), "lipz-texts.txt merge=union\n*.lipz merge=lipz\n");
}

#[test]
fn a_project_of_recordings_begins_with_a_folder_for_them() {
    let scene = Scene::new();
    let begun = lipz(scene.path(), ["init", "game", "--audio", "takes"]);
    assert!(begun.code == 0 && begun.stdout.contains("record a line as game/takes/KEY.wav"), "{begun:?}");
    let expected = [".gitattributes", ".gitignore", "lipz.toml", "takes", "voices"].map(|name| format!("game/{name}"));
    assert_eq!(tree(scene.path()), [vec!["game".to_owned()], expected.to_vec()].concat());
    let game = scene.path().join("game");
    fs::write(game.join("takes/aye.wav"), support::sound::voice(&[(true, 400)], 1)).unwrap();
    assert_eq!(lipz(&game, ["new", "aye", "Aye."]).code, 0);
    assert_eq!(lipz(&game, ["sync", "--quiet"]).code, 0);
    let checked = lipz(&game, ["check"]);
    assert!(checked.code == 0 && !checked.stderr.contains("LZ1701"), "every clip has its recording: {checked:?}");
}

#[test]
fn a_project_whose_folders_cannot_be_created_is_not_begun() {
    let scene = Scene::new();
    scene.write("takes", "");
    scene.write("git/.gitignore/file", "");
    let before = tree(scene.path());
    for (arguments, code, message) in [
        (
            ["init", "game", "--audio", "../takes"],
            "LZ0904",
            "the folder `game/../takes` cannot be created, because `takes` is a file",
        ),
        (
            ["init", "takes/game", "--audio", "takes"],
            "LZ0904",
            "the folder `takes/game/voices` cannot be created, because `takes` is a file",
        ),
        (["init", "git", "--audio", "takes"], "LZ0001", "`git/.gitignore` is a folder"),
    ] {
        let run = lipz(scene.path(), arguments);
        assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{arguments:?}: {}", run.stderr);
        assert!(run.stderr.starts_with(&format!("error[{code}]: {message}")), "{arguments:?}: {}", run.stderr);
        assert_eq!(tree(scene.path()), before, "{arguments:?}");
    }
}

#[test]
fn new_clips_replace_none_and_fit_into_the_project() {
    let scene = Scene::new();
    scene.write("lipz.toml", "sources = [\"voices\"]\n");
    scene.write("voices/aye.lipz", "{ \"text_en-us\": \"Aye.\" }");
    let before = tree(scene.path());
    for (arguments, code, said) in [
        (&["aye", "No.", "--locale", "en-us"][..], 1, "LZ0906"),
        (&["AYE", "No.", "--locale", "en-us"], 1, "LZ0801"),
        (&["../aye", "No.", "--locale", "en-us"], 1, "the key `../aye` cannot be used"),
        (&["aye.lipz", "No.", "--locale", "en-us"], 1, "LZ0906"),
        (&["voices/no", "No.", "--locale", "en-us"], 1, "use the key `no`"),
        (&["no", "No."], 2, "default-locale"),
    ] {
        let run = lipz(scene.path(), [&["new"], arguments].concat());
        assert_eq!(run.code, code, "{arguments:?}: {}", run.stderr);
        assert!(run.stderr.contains(said), "{arguments:?}: {}", run.stderr);
    }
    assert_eq!(tree(scene.path()), before);
}
