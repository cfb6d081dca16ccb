//! TextGrids of `lipz sync`: phoneticians get the recognised phones, and their corrections make the visemes.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use support::{Scene, lipz, repository};

const SENTENCE: &str = "Bobby ripped| the ledger.";

/// Returns a project with a recording of the sentence, and its visemes.
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

/// Returns the visemes of the clip.
fn mouth(scene: &Scene) -> String {
    let file = read(scene, "voices/a/b.lipz");
    let line = file.lines().find(|line| line.contains("\"visemes\"")).unwrap();
    line.split('"').nth(3).unwrap().to_owned()
}

/// Returns the first interval of a TextGrid with this label: its times, and the index of its line.
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
    // The visemes are made from the TextGrid, not from the recording, with the same frames.
    scene.write("lines.csv", format!("file,text\na/b,\"{SENTENCE}\"\n"));
    let run = lipz(scene.path(), ["sync", "-o", "others", "rec", "--script", "lines.csv", "--config", "root=rec"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let other = read(&scene, "others/a/b.lipz");
    assert!(other.contains(&before), "{before}\n{other}");
    assert_eq!(read(&scene, "grids/a/b.TextGrid"), grid);
    // It is a regular TextGrid.
    let run = lipz(scene.path(), ["import", "visemes", "textgrid", "grids/a/b.TextGrid", "-o", "imported"]);
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
        (grid.replace("\"JH\"", "\"?!\""), "warning[LZ1710]: `?!` is not a phone, so the TextGrid is not used"),
        (grid.replace("\"phones\"", "\"sounds\""), "the file has no tier called `phones`"),
        (grid[..grid.len() / 2].to_owned(), "error["),
    ] {
        scene.write("grids/a/b.TextGrid", &changed);
        let run = lipz(scene.path(), ["sync", "--discard-edits"]);
        assert!(run.stderr.contains(told), "{told}: {}", run.stderr);
        assert_eq!(mouth(&scene), before, "{told}");
        assert_eq!(read(&scene, "grids/a/b.TextGrid"), changed, "{told}");
    }
}

/// Returns the frames of the clip in a folder, without `|`.
fn frames(scene: &Scene, folder: &str) -> Vec<char> {
    let file = read(scene, &format!("{folder}/a/b.lipz"));
    let line = file.lines().find(|line| line.contains("\"visemes\"")).unwrap();
    line.split('"').nth(3).unwrap().chars().filter(|code| *code != '|').collect()
}

/// Returns the TextGrid with a new label for the first `phone`, and the start and end of that interval in seconds.
fn with_label(grid: &str, phone: &str, label: &str) -> (String, f64, f64) {
    let (start, end, at) = interval(grid, phone);
    let mut lines: Vec<String> = grid.lines().map(str::to_owned).collect();
    lines[at] = format!("text = \"{label}\" ");
    (lines.join("\n") + "\n", start, end)
}

#[test]
fn an_export_has_words_and_phones_and_comes_back_as_the_same_clip() {
    let scene = project();
    scene.write("lipz.toml", read(&scene, "lipz.toml").replace("textgrids = \"grids\"\n", ""));
    lipz(scene.path(), ["sync"]);
    let before = read(&scene, "voices/a/b.lipz");
    let run = lipz(scene.path(), ["export", "visemes", "textgrid", "-o", "tg"]);
    assert!(run.stdout.contains("1 file exported to textgrid in tg; 1 with words, 1 with phones"), "{run:?}");
    let grid = read(&scene, "tg/a/b.TextGrid");
    let names: Vec<&str> = grid.lines().filter_map(|line| line.trim().strip_prefix("name = ")).collect();
    assert_eq!(names, ["\"words\"", "\"phones\"", "\"visemes\"", "\"segments\"", "\"text_en-us\""]);
    interval(&grid, "JH");
    for (folder, arguments) in [("voices", &[][..]), ("new", &["--segments", "phrases"])] {
        let run = lipz(
            scene.path(),
            ["import", "visemes", "textgrid", "tg/a/b.TextGrid", "--root", "tg", "-o", folder].iter().chain(arguments),
        );
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{folder}");
        assert!(!run.stdout.contains("phones"), "nothing was corrected: {}", run.stdout);
        assert_eq!(frames(&scene, folder), frames(&scene, "voices"));
    }
    assert_eq!(read(&scene, "voices/a/b.lipz"), before);
    // `lipz sync` makes the same visemes from the same file, although it ends with a frame.
    let run = lipz(scene.path(), ["sync", "--config", "sync.textgrids=tg"]);
    assert_eq!((run.code, run.stderr.as_str(), frames(&scene, "voices")), (0, "", frames(&scene, "new")));
    // The phones of changed visemes are unknown, but the words are known.
    let changed = read(&scene, "voices/a/b.lipz").replacen("MM", "OO", 1);
    scene.write("voices/a/b.lipz", &changed);
    let run = lipz(scene.path(), ["export", "visemes", "textgrid", "-o", "tg", "--overwrite"]);
    assert!(run.stdout.contains("; 1 with words, 0 with phones"), "{run:?}");
    interval(&read(&scene, "tg/a/b.TextGrid"), "Bobby");
}

#[test]
fn a_corrected_phone_that_is_imported_changes_only_its_place() {
    let scene = project();
    lipz(scene.path(), ["sync"]);
    let before = frames(&scene, "voices");
    let grid = read(&scene, "grids/a/b.TextGrid");
    // A vowel becomes a short p: closed lips for two frames, ahead of the audio.
    let (corrected, start, end) = with_label(&grid, "EH", "P");
    scene.write("grids/a/b.TextGrid", &corrected);
    let import = ["import", "visemes", "textgrid", "grids/a/b.TextGrid", "--root", "grids", "-o"];
    for folder in ["voices", "new"] {
        let run = lipz(scene.path(), import.iter().copied().chain([folder]));
        assert_eq!((run.code, run.stderr.as_str()), (0, ""));
        assert!(run.stdout.contains("1 file: visemes made from the phones, by the rules of [sync]"), "{}", run.stdout);
        let after = frames(&scene, folder);
        assert_eq!(after.len(), before.len());
        let changed: Vec<usize> = (0..before.len()).filter(|&frame| before[frame] != after[frame]).collect();
        let is_near = |frame: &usize| (start - 0.1..end + 0.1).contains(&(*frame as f64 / 24.0));
        assert!(!changed.is_empty() && changed.iter().all(is_near), "{changed:?}");
        assert!(after.windows(2).any(|two| two == ['M', 'M'] && before != after));
    }
    // `lipz sync` makes the same from it.
    let imported = frames(&scene, "voices");
    lipz(scene.path(), ["sync", "--discard-edits"]);
    assert_eq!(frames(&scene, "voices"), imported);
    // Corrected shapes take precedence if the phones still match those of the clip.
    let shapes = corrected.replacen("text = \"W\"", "text = \"U\"", 1).replacen("text = \"L\"", "text = \"O\"", 1);
    assert_ne!(shapes, corrected);
    scene.write("grids/a/b.TextGrid", &shapes);
    lipz(scene.path(), import.iter().copied().chain(["voices"]));
    assert_ne!(frames(&scene, "voices"), imported);
    // A label that is not a phone is reported.
    scene.write("grids/a/b.TextGrid", with_label(&grid, "EH", "?!").0);
    let run = lipz(scene.path(), import.iter().copied().chain(["voices"]));
    assert!(run.stderr.contains("warning[LZ1710]: `?!` is not a phone"), "{}", run.stderr);
    assert_eq!(frames(&scene, "voices"), before);
}

#[test]
fn a_run_without_textgrids_keeps_what_was_corrected() {
    let scene = project();
    lipz(scene.path(), ["sync"]);
    let (heard, grid) = (mouth(&scene), read(&scene, "grids/a/b.TextGrid"));
    let without = read(&scene, "lipz.toml").replace("textgrids = \"grids\"\n", "");
    let with = read(&scene, "lipz.toml");
    // Phones that lipz recognised itself do not count as manual work.
    scene.write("lipz.toml", &without);
    assert!(lipz(scene.path(), ["sync"]).stdout.contains("1 clip synced"));
    scene.write("lipz.toml", &with);
    assert!(lipz(scene.path(), ["sync"]).stdout.contains("1 clip synced"));
    assert!(!read(&scene, "voices/lipz-sync.txt").contains("from:textgrid"));
    scene.write("grids/a/b.TextGrid", with_label(&grid, "EH", "P").0);
    lipz(scene.path(), ["sync"]);
    let corrected = mouth(&scene);
    assert_ne!(corrected, heard);
    assert!(read(&scene, "voices/lipz-sync.txt").contains(" from:textgrid "));
    scene.write("lipz.toml", &without);
    let run = lipz(scene.path(), ["sync"]);
    assert!(run.stdout.contains("a/b  made from a corrected TextGrid"), "{}", run.stdout);
    assert_eq!((mouth(&scene), run.stderr.as_str()), (corrected.clone(), ""));
    // A different text is reported.
    scene.write("voices/a/b.lipz", read(&scene, "voices/a/b.lipz").replace("ledger", "castle"));
    let run = lipz(scene.path(), ["sync"]);
    assert!(run.stderr.contains("warning[LZ1706]: the visemes were made from a corrected TextGrid"), "{}", run.stderr);
    assert_eq!(mouth(&scene), corrected);
    scene.write("voices/a/b.lipz", read(&scene, "voices/a/b.lipz").replace("castle", "ledger"));
    assert!(lipz(scene.path(), ["sync", "--discard-edits"]).stdout.contains("1 clip synced"));
    assert_eq!(mouth(&scene), heard);
}

#[test]
fn a_textgrid_of_another_length_is_told_each_time() {
    let scene = project();
    lipz(scene.path(), ["sync"]);
    let grid = read(&scene, "grids/a/b.TextGrid");
    let last = grid.lines().find_map(|line| line.strip_prefix("xmax = ")).unwrap().trim();
    scene.write("grids/a/b.TextGrid", grid.replace(last, "9.5"));
    for arguments in [&["sync"][..], &["sync"], &["check"], &["check"]] {
        let run = lipz(scene.path(), arguments);
        let told = run.stderr.matches("warning[LZ1703]: the TextGrid lasts 9.500 s, but the recording ").count();
        assert_eq!(told, 1, "{arguments:?}: {}", run.stderr);
    }
}
