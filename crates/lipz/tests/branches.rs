//! Lipz files that two branches have changed, merged by Git with the driver of lipz.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use std::path::Path;
use std::process::Command;
use support::{Scene, lipz};

/// Runs git. Returns whether it succeeded, and its output.
fn git(folder: &Path, arguments: &[&str]) -> (bool, String) {
    let mut git = Command::new("git");
    git.current_dir(folder).args(["-c", "user.name=lipz", "-c", "user.email=lipz@example.com"]);
    git.env("GIT_CONFIG_GLOBAL", "/dev/null").env("GIT_CONFIG_SYSTEM", "/dev/null");
    let output = git.args(arguments).output().unwrap();
    (output.status.success(), String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned())
}

fn done(folder: &Path, arguments: &[&str]) -> String {
    let (is_ok, output) = git(folder, arguments);
    assert!(is_ok, "git {arguments:?}: {output}");
    output
}

/// Creates a project with `init` in a repository whose Git merges with lipz. `clips` are keys and texts of Lipz files.
fn repository(clips: &[(String, String)]) -> Scene {
    let scene = Scene::new();
    let folder = scene.path();
    done(folder, &["init", "-q", "-b", "main"]);
    let init = lipz(folder, ["init"]);
    assert_eq!((init.code, init.stderr.as_str()), (0, ""));
    // The program in this test, as `init` prints it for a program on the path.
    let driver =
        init.stdout.lines().find_map(|line| line.trim().strip_prefix("git config merge.lipz.driver ")).unwrap();
    let program = format!("\"{}\"", env!("CARGO_BIN_EXE_lipz").replace('\\', "/"));
    let driver = driver.trim_matches('\'').replacen("lipz", &program, 1);
    done(folder, &["config", "merge.lipz.driver", &driver]);
    for (name, text) in clips {
        scene.write(name, text);
    }
    scene.prepare(&["fmt", "--quiet"]);
    commit(folder, "base");
    scene
}

fn commit(folder: &Path, subject: &str) {
    done(folder, &["add", "-A"]);
    done(folder, &["commit", "-q", "-m", subject]);
}

fn clip(number: usize) -> (String, String) {
    let text = format!("Good evening, number {number}.|How are you?|Goodbye.");
    (
        format!("voices/line-{number}.lipz"),
        format!(
            "{{ \"visemes\": \"MAEO|EEOO|-\", \"text_en-us\": \"{text}\", \"events\": \"bow||nod\", \"fps\": 24 }}"
        ),
    )
}

/// Exports a locale, translates each text, and imports it.
fn translate(folder: &Path, locale: &str, word: &str) {
    let file = format!("{locale}.csv");
    assert_eq!(lipz(folder, ["export", "texts", "csv", "--locale", locale, "-o", &file]).code, 0);
    let table = fs::read_to_string(folder.join(&file)).unwrap();
    let mut lines = table.lines();
    let head = lines.next().unwrap();
    let column = |wanted: &str| head.split(',').position(|name| name.trim_start_matches('\u{feff}') == wanted).unwrap();
    let (source, translation) = (column("en-us"), column(locale));
    let translated = lines.map(|line| {
        let mut cells: Vec<String> = cells(line);
        let segments: Vec<String> = cells[source].split(" | ").map(|text| format!("{word}: {text}")).collect();
        cells[translation] = segments.join(" | ");
        cells.iter().map(|cell| format!("\"{}\"", cell.replace('"', "\"\""))).collect::<Vec<_>>().join(",")
    });
    let text = std::iter::once(head.to_owned()).chain(translated).collect::<Vec<_>>().join("\n");
    fs::write(folder.join(&file), text + "\n").unwrap();
    let imported = lipz(folder, ["import", "texts", &file]);
    assert_eq!((imported.code, imported.stderr.as_str()), (0, ""));
    fs::remove_file(folder.join(&file)).unwrap();
}

/// Returns the cells of a line of CSV without line feeds in cells.
fn cells(line: &str) -> Vec<String> {
    let (mut cells, mut is_quoted) = (vec![String::new()], false);
    for character in line.chars() {
        match character {
            '"' => is_quoted = !is_quoted,
            ',' if !is_quoted => cells.push(String::new()),
            other => cells.last_mut().unwrap().push(other),
        }
    }
    cells
}

#[test]
fn two_translations_and_a_rewrite_on_three_branches_merge_without_conflict() {
    let clips: Vec<(String, String)> = (0..20).map(clip).collect();
    let scene = repository(&clips);
    let folder = scene.path();
    for (branch, locale, word) in [("german", "de-de", "Hallo"), ("italian", "it-it", "Ciao")] {
        done(folder, &["checkout", "-q", "-b", branch, "main"]);
        translate(folder, locale, word);
        commit(folder, branch);
    }
    done(folder, &["checkout", "-q", "main"]);
    for (name, _) in &clips {
        let text = fs::read_to_string(folder.join(name)).unwrap();
        fs::write(folder.join(name), text.replace("How are you?", "How are you today, my friend?")).unwrap();
    }
    scene.prepare(&["fmt", "--quiet"]);
    commit(folder, "rewrite");
    for branch in ["german", "italian"] {
        let (is_ok, output) = git(folder, &["merge", "-q", "-m", branch, branch]);
        assert!(is_ok, "{output}");
    }
    for (name, _) in &clips {
        let text = fs::read_to_string(folder.join(name)).unwrap();
        for part in ["today, my friend", "text_de-de", "Hallo", "text_it-it", "Ciao"] {
            assert!(text.contains(part), "{text}");
        }
    }
    // The files still have the canonical layout, and the translations of changed texts are known.
    let formatted = lipz(folder, ["fmt", "--check"]);
    assert_eq!(formatted.code, 0, "{formatted:?}");
    let checked = lipz(folder, ["check", "--output-format", "concise"]);
    assert_eq!(checked.stdout.matches("LZ1911").count(), 40, "{}", checked.stdout);
}

#[test]
fn a_segment_that_both_branches_changed_is_a_conflict_with_a_name() {
    let scene = repository(&[clip(1), clip(2)]);
    let folder = scene.path();
    let change = |from: &str, to: &str| {
        let text = fs::read_to_string(folder.join("voices/line-1.lipz")).unwrap();
        scene.write("voices/line-1.lipz", text.replace(from, to));
    };
    done(folder, &["checkout", "-q", "-b", "other"]);
    change("How are you?", "How do you do?");
    change("bow", "wave");
    commit(folder, "other");
    done(folder, &["checkout", "-q", "main"]);
    change("How are you?", "Well?");
    change("Goodbye", "See you");
    commit(folder, "ours");
    let (is_ok, output) = git(folder, &["merge", "other"]);
    assert!(!is_ok && output.contains("both branches have changed `text_en-us`"), "{output}");
    let text = fs::read_to_string(folder.join("voices/line-1.lipz")).unwrap();
    assert_eq!(text.matches("<<<<<<<").count(), 1, "{text}");
    // The other changes of both branches are merged, in both versions of the text.
    assert!(text.contains("wave") && text.matches("See you").count() == 2, "{text}");
    let checked = lipz(folder, ["check", "--output-format", "concise"]);
    assert!(checked.code == 1 && checked.stdout.contains("LZ0109"), "{checked:?}");
}

#[test]
fn a_file_with_errors_is_merged_by_lines() {
    let scene = repository(&[clip(1)]);
    let folder = scene.path();
    let name = "voices/line-1.lipz";
    let lines: Vec<String> = fs::read_to_string(folder.join(name)).unwrap().lines().map(str::to_owned).collect();
    done(folder, &["checkout", "-q", "-b", "other"]);
    let broken = lines.join("\n").replace("\"fps\"", "fps");
    scene.write(name, &(broken + "\n"));
    commit(folder, "other");
    done(folder, &["checkout", "-q", "main"]);
    scene.write(name, &(lines.join("\n").replace("MAEO", "MAAO") + "\n"));
    commit(folder, "ours");
    let output = done(folder, &["merge", "-m", "both", "other"]);
    assert!(output.contains("voices/line-1.lipz is merged by lines"), "{output}");
    let text = fs::read_to_string(folder.join(name)).unwrap();
    assert!(text.contains("MAAO") && text.contains("  fps :"), "{text}");
}

#[test]
fn versions_are_written_whole_and_over_no_other_file() {
    let scene = Scene::new();
    scene.write("base", "{\"fps\":24}");
    scene.write("ours", "{\"fps\":24,\"text_en-us\":\"Hi\"}");
    scene.write("theirs", "{\"fps\":12}");
    let merge = |output: &str| lipz(scene.path(), ["merge", "--versions", "base", "ours", "theirs", "-o", output]);
    assert_eq!(merge("whole.lipz").code, 0);
    assert_eq!(fs::read_to_string(scene.path().join("whole.lipz")).unwrap(), "{\"fps\":12,\"text_en-us\":\"Hi\"}");
    let refused = merge("whole.lipz");
    assert!(refused.code == 1 && refused.stderr.contains("LZ0906"), "{refused:?}");
    assert_eq!(merge("ours").code, 0);
    let missing = lipz(scene.path(), ["merge", "--versions", "base", "no", "theirs", "-o", "new.lipz"]);
    assert!(missing.code == 2 && missing.stderr.contains("`no` does not exist"), "{missing:?}");
}
