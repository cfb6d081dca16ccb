//! The command line: help, usage errors, exit codes. A failed run does not change anything.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use support::{Scene, commands, lipz, repository, tree, write};

#[test]
fn no_output_replaces_a_lipz_file() {
    let scene = Scene::new();
    scene.write("voices/a.lipz", "{ \"visemes\": \"MAEO-\" }");
    let over: [&[&str]; 3] = [
        &["pack", "voices", "-o", "voices/a.lipz"],
        &["pack", "voices", "-o", "b.lipzbank", "--depfile", "voices/a.LIPZ"],
        &["ids", "voices", "--lang", "c", "-o", "voices/a.lipz"],
    ];
    for arguments in over {
        let outcome = lipz(scene.path(), arguments);
        assert_eq!((outcome.code, outcome.stdout.as_str()), (2, ""), "{outcome:?}");
        assert!(outcome.stderr.contains("is the name of a Lipz file"), "{outcome:?}");
    }
    assert_eq!(tree(scene.path()), ["voices", "voices/a.lipz"]);
    assert!(fs::read_to_string(scene.path().join("voices/a.lipz")).unwrap().contains("MAEO"));
}

#[test]
fn standard_output_is_named_on_the_command_line_only() {
    let scene = Scene::new();
    scene.write("voices/a.lipz", "{ \"visemes\": \"MAEO-\" }");
    scene.write("lipz.toml", "output = \"-\"\n");
    let outcome = lipz(scene.path(), ["pack"]);
    assert_eq!((outcome.code, outcome.stdout.as_str()), (2, ""), "{outcome:?}");
    assert!(outcome.stderr.contains("only `--output -`"), "{outcome:?}");
}

#[test]
fn every_file_of_commands_is_a_command() {
    let folder = repository().join("crates/lipz/src/commands");
    let names = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<String> = names.map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned()).collect();
    files.retain(|name| name != "mod");
    files.sort();
    let mut listed = commands();
    listed.sort();
    assert_eq!(
        files, listed,
        "a new command is a file or folder in `commands`, a `mod` and a line of `commands!` in commands/mod.rs; move \
         other code to `shared`, or into the folder of the command that uses it"
    );
}

#[test]
fn help_of_each_command_shows_an_example() {
    let repository = repository();
    for command in commands() {
        let help = lipz(&repository, [command.as_str(), "--help"]);
        assert_eq!((help.code, help.stderr.as_str()), (0, ""), "{command}");
        assert!(help.stdout.contains("Example"), "{command}: {}", help.stdout);
        let example = format!("\n  lipz {command}");
        assert!([" ", "\n"].iter().any(|end| help.stdout.contains(&(example.clone() + end))), "{}", help.stdout);
        assert!(help.stdout.lines().all(|line| line.chars().count() <= 100), "{command}: {}", help.stdout);
    }
}

#[test]
fn help_lists_every_command_and_the_exit_codes() {
    let help = lipz(&repository(), ["--help"]);
    assert_eq!(help.code, 0);
    for command in commands() {
        assert!(help.stdout.lines().any(|line| line.trim_start().starts_with(&command)), "{command}: {}", help.stdout);
    }
    assert!(help.stdout.contains("Exit codes: 0"), "{}", help.stdout);
    let version = lipz(&repository(), ["--version"]);
    assert_eq!((version.code, version.stdout), (0, format!("lipz {}\n", env!("CARGO_PKG_VERSION"))));
}

#[test]
fn usage_errors_exit_with_2() {
    // Without a command, lipz prints its help instead of a diagnostic.
    let usage_errors: &[(&[&str], &str)] = &[
        (&[], ""),
        (&["pakc", "fixtures/drama"], "LZ1601"),
        (&["check"], "LZ1601"),
        (&["check", "fixtures/drama", "--fps", "24"], "LZ1601"),
        (&["check", "fixtures/drama", "--config", "default-fps=0"], "LZ1004"),
        (&["check", "fixtures/drama", "--config", "default-fps=1000.5"], "LZ1004"),
        (&["check", "fixtures/drama", "--config", "default-viseme-type=Blair"], "LZ1004"),
        (&["check", "fixtures/drama", "--config", "default-locale=english-us"], "LZ1004"),
        (&["pack", "fixtures/drama", "-o", "drama.lipzbank", "--config", "default-locale=es-419"], "LZ1004"),
        (&["check", "fixtures/drama", "--jobs", "0"], "LZ1601"),
        (&["pack", "fixtures/spec/repaired"], "LZ1601"),
        (&["unpack", "drama.lipzbank"], "LZ1601"),
        (&["inspect", "drama.lipzbank", "act1/otto-aye", "act1", "--show", "clips"], "LZ1601"),
        (&["diff", "drama.lipzbank"], "LZ1601"),
        (
            &["diff", "fixtures/banks/v1/drama.lipzbank", "fixtures/drama", "--config", "default-locale=es-419"],
            "LZ1004",
        ),
        (&["inspect", "--show", "stats", "fixtures/drama", "--config", "default-locale=es-419"], "LZ1004"),
        (&["print", "man"], "LZ1601"),
        (&["print"], ""),
        (&["shard", "plan", "--shards", "2", "-o", "plan.json"], "LZ1601"),
        (&["check", "fixtures/drama", "--color", "red"], "LZ1601"),
        (&["check", "fixtures/drama", "--output-format", "xml"], "LZ1601"),
        (&["explain", "LZ0401", "LZ0402"], "LZ1601"),
        (&["check", "fixtures/drama", "--diff", "--show", "stats"], "LZ1601"),
        (&["check", "fixtures/drama", "--json"], "LZ1601"),
        (&["fmt"], "LZ1601"),
        (&["convert", "fixtures/drama", "--viseme-type", "toonboom"], "LZ1601"),
        (&["convert", "fixtures/drama", "-o", "out", "--in-place", "--viseme-type", "toonboom"], "LZ1601"),
    ];
    for &(arguments, code) in usage_errors {
        let outcome = lipz(&repository(), arguments);
        assert_eq!((outcome.code, outcome.stdout.as_str()), (2, ""), "{arguments:?}: {}", outcome.stderr);
        let start = if code.is_empty() { String::new() } else { format!("error[{code}]: ") };
        assert!(outcome.stderr.len() > start.len(), "{arguments:?}");
        assert!(outcome.stderr.starts_with(&start), "{arguments:?}: {}", outcome.stderr);
    }
}

/// Scripts and habits contain the names of earlier versions. The error names the current equivalent of each.
#[test]
fn names_of_earlier_versions_are_answered_with_the_new_ones() {
    let scene = Scene::new();
    scene.write("voices/a.lipz", r#"{ "text_en-us": "Aye." }"#);
    scene.prepare(&["pack", "voices", "-o", "b.lipzbank", "--quiet"]);
    let before = tree(scene.path());
    let old: [(&[&str], &str); 21] = [
        (&["stats", "b.lipzbank"], "`lipz inspect --show stats`"),
        (&["accept", "--all"], "`lipz approve`"),
        (&["face", "voices"], "`lipz convert --write-curves`"),
        (&["fallout", "heads", "art"], "`lipz check --fallout-heads`"),
        (&["link", "a.lipzobj", "-o", "c.lipzbank"], "`lipz shard link`"),
        (&["schema"], "`lipz print schema`"),
        (&["import", "rhubarb-tsv", "a.tsv", "-o", "voices"], "`lipz import visemes rhubarb-tsv`"),
        (&["import", "po", "a.po"], "`lipz import texts FILE`"),
        (&["export", "po", "-o", "a.po"], "`lipz export texts po`"),
        (&["export", "unity", "voices"], "`lipz export texts unity`"),
        (&["texts", "import", "a.po"], "`lipz import texts`"),
        (&["check", "voices", "--format", "json"], "`--output-format`"),
        (&["check", "voices", "--threads", "2"], "`--jobs`"),
        (&["inspect", "b.lipzbank", "--json"], "`--output-format json`"),
        (&["inspect", "b.lipzbank", "--list"], "`lipz inspect --show clips`"),
        (&["pack", "voices", "-o", "c.lipzbank", "--strip"], "`--config strip=VALUE`"),
        (&["pack", "voices", "-o", "c.lipzbank", "--max-lines=2"], "`--config text.lines=VALUE`"),
        (&["coverage", "voices", "--missing", "de-de"], "`--show missing --locale LOCALE`"),
        (
            &["diff", "b.lipzbank", "b.lipzbank", "--new-texts", "b.de-de.lipztexts"],
            "add the texts to the bank: NEW+TEXTS",
        ),
        (&["unpack", "b.lipzbank", "-o", "out", "--force"], "`--overwrite`"),
        (&["pack", "voices", "-o", "c.lipzbank", "--no-cache"], "delete the file of `--cache`; lipz creates it again"),
    ];
    for (arguments, new) in old {
        let outcome = lipz(scene.path(), arguments);
        assert_eq!((outcome.code, outcome.stdout.as_str()), (2, ""), "{arguments:?}: {}", outcome.stderr);
        let help = outcome.stderr.lines().find(|line| line.contains("= help: ")).unwrap_or_default();
        assert!(help.contains(new), "{arguments:?}: {}", outcome.stderr);
        let json = lipz(scene.path(), [&["--output-format", "json"], arguments].concat());
        assert!(json.stdout.contains(new) || json.stderr.contains(new), "{json:?}");
    }
    assert_eq!(tree(scene.path()), before, "nothing is done under an old name");
}

#[test]
fn a_default_locale_of_another_shape_needs_its_setting() {
    let arguments = ["check", "fixtures/drama", "--config", "default-locale=es-419"];
    let refused = lipz(&repository(), arguments);
    assert_eq!((refused.code, refused.stdout.as_str()), (2, ""));
    assert!(refused.stderr.contains("`es-419` is not a locale of the form ll-cc"), "{}", refused.stderr);
    assert!(refused.stderr.contains("extended-locales = true"), "{}", refused.stderr);
    assert_eq!(lipz(&repository(), arguments.iter().chain(&["--config", "extended-locales=true"])).code, 0);
}

#[test]
fn warnings_do_not_stop_a_bank_and_errors_do() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    write(folder, "voices/aye.lipz", r#"{ "text-en_us": "Aye." }"#);
    let packed = lipz(folder, ["pack", "voices", "-o", "voices.lipzbank"]);
    assert_eq!(packed.code, 0, "{}", packed.stderr);
    assert!(packed.stderr.contains("warning[LZ0501]"), "{}", packed.stderr);
    let before = fs::read(folder.join("voices.lipzbank")).unwrap();

    write(folder, "voices/no.lipz", r#"{ "viseme_type": "blair", "visemes": "N" }"#);
    let failed = lipz(folder, ["pack", "voices", "-o", "voices.lipzbank"]);
    assert_eq!((failed.code, failed.stdout.as_str()), (1, ""), "{}", failed.stderr);
    assert!(failed.stderr.contains("\n1 error and 1 warning in 2 files; 1 fixable\n"), "{}", failed.stderr);
    assert_eq!(fs::read(folder.join("voices.lipzbank")).unwrap(), before, "the old bank is untouched");
    let files = ["voices", "voices.lipzbank", "voices/aye.lipz", "voices/no.lipz"];
    assert_eq!(tree(folder), files, "no temporary file is left");

    let none = lipz(folder, ["pack", "voices", "-o", "new.lipzbank"]);
    assert_eq!(none.code, 1);
    assert_eq!(tree(folder), files, "a bank is not created");
}

#[test]
fn quiet_runs_print_diagnostics_only() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    write(folder, "voices/aye.lipz", r#"{ "text_en-us": "Aye." }"#);
    for arguments in [
        &["check", "voices", "--quiet"][..],
        &["pack", "voices", "-o", "b.lipzbank", "--quiet"],
        &["verify", "b.lipzbank", "--quiet"],
        &["unpack", "b.lipzbank", "-o", "out", "--quiet"],
        &["ids", "b.lipzbank", "--lang", "c", "-o", "ids.h", "--quiet"],
    ] {
        let outcome = lipz(folder, arguments);
        assert_eq!((outcome.code, outcome.stdout.as_str(), outcome.stderr.as_str()), (0, "", ""), "{arguments:?}");
    }
    write(folder, "voices/aye.lipz", r#"{ "text_en-us": "" }"#);
    let outcome = lipz(folder, ["check", "voices", "--quiet"]);
    assert_eq!((outcome.code, outcome.stdout.as_str()), (0, ""));
    assert!(outcome.stderr.contains("warning[LZ0507]"), "{}", outcome.stderr);
}

#[test]
fn a_misspelt_key_gets_the_one_that_was_meant() {
    let bank = "fixtures/banks/v1/drama.lipzbank";
    let asked = [
        ("nell-helo", "did you mean `act1/nell-hello`?"),
        ("act1/mara-god-evening", "did you mean `act1/mara-good-evening`?"),
        ("good-evening.lipz", "did you mean `act1/mara-good-evening`?"),
        ("quite-another", "list the clips of the bank with `--show clips`"),
    ];
    for (key, help) in asked {
        let run = lipz(&repository(), ["inspect", bank, key]);
        assert_eq!((run.code, run.stdout.as_str()), (2, ""));
        assert!(run.stderr.contains(help), "{key}: {}", run.stderr);
    }
}

#[test]
fn lipz_files_and_folders_are_shown_as_the_bank_that_they_become() {
    let (folder, file) = ("fixtures/drama", "fixtures/drama/act1/mara-good-evening.lipz");
    let shown = |arguments: &[&str]| {
        let run = lipz(&repository(), [&["inspect"], arguments].concat());
        assert_eq!(run.code, 0, "{run:?}");
        run.stdout
    };
    let clip = shown(&[folder, "act1/mara-good-evening"]);
    assert!(clip.contains("  |0---------------------------------|1-----------------|2---"), "{clip}");
    assert!(
        clip.contains("\n  Good evening, Otto.                You are late,      and the fog is early.\n"),
        "{clip}"
    );
    assert!(clip.contains("\n  ▸feels neutral                     ▸sees otto         ▸points fog\n"), "{clip}");
    assert_eq!(shown(&[file]), clip, "a file that is named alone");
    let german = shown(&[file, "--locale", "de-de"]);
    assert!(german.contains("\n  Guten Abend, Otto.                 Du bist spät dran, und der Nebel ist zu früh.\n"));
    assert!(shown(&[folder]).contains("48 clips, 4,107 frames"));
    assert_eq!(shown(&[folder, "act1/mara-g", "--show", "clips"]).lines().count(), 1);
    assert!(!clip.contains('\u{1b}'), "no colours where there is no terminal");
    let coloured = std::process::Command::new(env!("CARGO_BIN_EXE_lipz"))
        .args(["--color", "always", "inspect", file])
        .current_dir(repository())
        .output()
        .unwrap();
    assert!(String::from_utf8(coloured.stdout).unwrap().contains("\u{1b}[35m|1-----------------\u{1b}[0m"));
}

#[test]
fn rules_are_found_by_their_numbers() {
    let page = lipz(&repository(), ["explain", "LZ0401"]);
    for text in ["401", "0401", "lz401", "error[LZ0401]:", "foreign-code"] {
        assert_eq!(lipz(&repository(), ["explain", text]).stdout, page.stdout, "{text}");
    }
}
