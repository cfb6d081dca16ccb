//! TextGrids of `lipz sync`: what is heard goes to phoneticians, and what they correct makes the mouth.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use support::{Scene, lipz, repository};

const SENTENCE: &str = "Bobby ripped| the ledger.";

/// A project with a recording of the sentence, and its mouth.
fn project() -> Scene {
    let scene = Scene::new();
    let settings = "sources = [\"voices\"]\nroot = \"voices\"\ndefault-locale = \"en-us\"\n[audio]\nfolder = \"rec\"\n\
                    [sync]\ntextgrids = \"grids\"\n";
    scene.write("lipz.toml", settings);
    scene.write("rec/a/b.wav", fs::read(repository().join("fixtures/speech/bobby.wav")).unwrap());
    scene.write("voices/a/b.lipz", format!("{{ \"text_en-us\": \"{SENTENCE}\" }}"));
    scene
}

fn read(scene: &Scene, name: &str) -> String {
    fs::read_to_string(scene.path().join(name)).unwrap()
}

/// The mouth of the clip.
fn mouth(scene: &Scene) -> String {
    let file = read(scene, "voices/a/b.lipz");
    let line = file.lines().find(|line| line.contains("\"visemes\"")).unwrap();
    line.split('"').nth(3).unwrap().to_owned()
}

/// The lines of a TextGrid with the times and the label of the first interval with this label.
fn interval(grid: &str, label: &str) -> (f64, f64, usize) {
    let lines: Vec<&str> = grid.lines().collect();
    let at = lines.iter().position(|line| line.trim() == format!("text = \"{label}\"")).unwrap();
    let number = |line: &str| line.rsplit("= ").next().unwrap().trim().parse::<f64>().unwrap();
    (number(lines[at - 2]), number(lines[at - 1]), at)
}

#[test]
fn what_is_written_makes_the_same_mouth() {
    let scene = project();
    assert_eq!(lipz(scene.path(), ["sync"]).code, 0);
    let (before, grid) = (mouth(&scene), read(&scene, "grids/a/b.TextGrid"));
    for label in ["Bobby", "ledger", "B", "IY", "JH", "M"] {
        interval(&grid, label);
    }
    let again = lipz(scene.path(), ["sync"]);
    assert!(again.stdout.contains("1 unchanged") && again.stderr.is_empty(), "{again:?}");
    // The mouth is made of it, not of the recording: the same to the last frame.
    scene.write("lines.csv", format!("file,text\na/b,\"{SENTENCE}\"\n"));
    let run = lipz(scene.path(), ["sync", "-o", "others", "rec", "--script", "lines.csv", "--root", "rec"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let other = read(&scene, "others/a/b.lipz");
    assert!(other.contains(&before), "{before}\n{other}");
    assert_eq!(read(&scene, "grids/a/b.TextGrid"), grid);
    // It is a TextGrid like any other.
    let run = lipz(scene.path(), ["import", "textgrid", "grids/a/b.TextGrid", "-o", "imported"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
}

#[test]
fn a_boundary_that_is_moved_changes_the_frames_around_it() {
    let scene = project();
    lipz(scene.path(), ["sync"]);
    let (before, grid) = (mouth(&scene), read(&scene, "grids/a/b.TextGrid"));
    // The vowel of "ledger" starts an eighth of a second later.
    let (start, end, at) = interval(&grid, "EH");
    assert!(end - start < 0.2);
    let mut lines: Vec<String> = grid.lines().map(str::to_owned).collect();
    let later = start + 0.8 * (end - start);
    let (own, before_it) = (at - 2, at - 5);
    assert!(lines[before_it].trim_start().starts_with("xmax"), "{}", lines[before_it]);
    for line in [own, before_it] {
        let (name, _) = lines[line].split_once('=').unwrap();
        lines[line] = format!("{name}= {later} ");
    }
    scene.write("grids/a/b.TextGrid", lines.join("\n"));
    let run = lipz(scene.path(), ["sync"]);
    assert!(run.stdout.contains("1 clip synced"), "{run:?}");
    let after = mouth(&scene);
    assert_ne!(after, before);
    let frames = |mouth: &str| mouth.chars().filter(|code| *code != '|').collect::<Vec<char>>();
    let (before, after) = (frames(&before), frames(&after));
    assert_eq!(before.len(), after.len());
    let changed: Vec<f64> =
        (0..before.len()).filter(|&frame| before[frame] != after[frame]).map(|frame| frame as f64 / 24.0).collect();
    assert!(changed.iter().all(|second| (start - 0.1..later + 0.1).contains(second)), "{changed:?}");
}

#[test]
fn a_textgrid_of_something_else_is_told_and_not_used() {
    let scene = project();
    lipz(scene.path(), ["sync"]);
    let (before, grid) = (mouth(&scene), read(&scene, "grids/a/b.TextGrid"));
    let last =
        grid.lines().find(|line| line.starts_with("xmax")).unwrap().split("= ").nth(1).unwrap().trim().to_owned();
    for (changed, told) in [
        (grid.replace(&last, "9.5"), "warning[LZ1703]: the TextGrid lasts 9.500 s, but the recording "),
        (grid.replace("\"ledger\"", "\"castle\""), "warning[LZ1707]: the word `castle` is not in the text"),
        (grid.replace("\"JH\"", "\"?!\""), "warning[LZ1710]: `?!` is no phone: the TextGrid is not used"),
        (grid.replace("\"phones\"", "\"sounds\""), "no tier is called `phones`"),
        (grid[..grid.len() / 2].to_owned(), "error["),
    ] {
        scene.write("grids/a/b.TextGrid", &changed);
        let run = lipz(scene.path(), ["sync", "--force"]);
        assert!(run.stderr.contains(told), "{told}: {}", run.stderr);
        assert_eq!(mouth(&scene), before, "{told}");
        assert_eq!(read(&scene, "grids/a/b.TextGrid"), changed, "{told}");
    }
}
