//! A year of deliveries: a file of a translator lives on while writers change the source texts, and other tools edit it.
//! Nothing is lost, and no translation wrongly counts as current.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use serde_json::{Map, Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::process::Command;
use support::{Scene, lipz, repository};

const SETTINGS: &str = "sources = [\"voices\"]\nroot = \"voices\"\ndefault-locale = \"en-us\"\n
[voices]\nen-us = \"{key}\"\nde-de = \"de/{key}\"\n";

/// The deliveries of a year.
const DELIVERIES: usize = 12;

/// Deliveries for which the file is exported again.
const NEW_EXPORTS: [usize; 3] = [0, 4, 8];

/// The delivery that brings a German recording of a clip.
const DUB: usize = 3;

/// The elements of a dub, which uses the texts of its original.
const DUB_ELEMENTS: &str = r#"{"visemes": "MA|EO"}"#;

/// The delivery of two translators at once, each with a copy of the file.
const TWO_TRANSLATORS: usize = 5;

/// A clip as it should be in the project.
#[derive(Clone, Default)]
struct ExpectedClip {
    source: String,
    translation: String,
    /// Whether the translation is older than the source, or was rejected.
    is_open: bool,
    comments: Vec<String>,
    has_dub: bool,
    /// The source and the translation in the translator's file, and whether it is marked for review there.
    in_file: Option<(String, String, bool)>,
}

/// Numbers that depend on a seed (xorshift64, Marsaglia 2003).
struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        usize::try_from(self.0 % bound as u64).unwrap()
    }
}

struct Year<'s> {
    scene: &'s Scene,
    format: &'static str,
    file: String,
    clips: BTreeMap<String, ExpectedClip>,
    random: Random,
}

impl Year<'_> {
    fn write_clip(&self, key: &str) {
        let ExpectedClip { source, translation, .. } = &self.clips[key];
        let plain = |text: &str| text.replace(" | ", "|");
        let mut elements = Map::new();
        elements.insert("visemes".into(), json!("MA|EO"));
        elements.insert("text_en-us".into(), json!(plain(source)));
        if !translation.is_empty() {
            elements.insert("text_de-de".into(), json!(plain(translation)));
        }
        self.scene.write(&format!("voices/{key}.lipz"), Value::Object(elements).to_string());
    }

    fn any_key(&mut self) -> String {
        let at = self.random.below(self.clips.len());
        self.clips.keys().nth(at).unwrap().clone()
    }

    /// A writer changes a source text.
    fn change_source(&mut self, number: usize) {
        let key = self.any_key();
        let clip = self.clips.get_mut(&key).unwrap();
        clip.source = format!("Source {number}. | Part two.");
        clip.is_open |= !clip.translation.is_empty();
        self.write_clip(&key);
    }

    /// A clip gets a different name.
    fn rename(&mut self, number: usize) {
        let key = self.any_key();
        let new = format!("renamed-{number}");
        let clip = self.clips.remove(&key).unwrap();
        let folders = if clip.has_dub { vec!["voices", "voices/de"] } else { vec!["voices"] };
        for folder in folders.into_iter().map(|folder| self.scene.path().join(folder)) {
            fs::rename(folder.join(format!("{key}.lipz")), folder.join(format!("{new}.lipz"))).unwrap();
        }
        self.clips.insert(new, clip);
    }

    /// A studio delivers the dub of a clip.
    fn dub(&mut self) {
        let key = self.any_key();
        self.clips.get_mut(&key).unwrap().has_dub = true;
        self.scene.write(&format!("voices/de/{key}.lipz"), DUB_ELEMENTS);
    }

    fn export(&mut self) {
        let _ = fs::remove_file(self.scene.path().join(&self.file));
        let arguments = ["export", "texts", self.format, "--locale", "de-de", "-o", &self.file];
        let exported = lipz(self.scene.path(), arguments);
        assert_eq!((exported.code, exported.stderr.as_str()), (0, ""));
        for clip in self.clips.values_mut() {
            let is_fuzzy = clip.is_open && !clip.translation.is_empty();
            clip.in_file = Some((clip.source.clone(), clip.translation.clone(), is_fuzzy));
        }
    }

    /// Whether the format states that a text needs review.
    fn has_states(&self) -> bool {
        matches!(self.format, "po" | "xliff-1.2")
    }

    /// A translator changes entries of a file: new texts, rejections, comments. Each entry changes at most once.
    fn edit(&mut self, file: &str, number: usize, taken: &mut BTreeSet<String>) -> bool {
        let mut edits = Map::new();
        for part in 0..4 {
            let key = self.any_key();
            if !taken.insert(key.clone()) {
                continue;
            }
            let has_states = self.has_states();
            let is_rejection = has_states && self.random.below(4) == 0;
            let has_comment = self.random.below(3) == 0;
            let clip = self.clips.get_mut(&key).unwrap();
            let in_file = clip.in_file.as_mut().unwrap();
            let mut edit = Map::new();
            if is_rejection && !in_file.1.is_empty() {
                in_file.2 = true;
                edit.insert("fuzzy".into(), json!(true));
            } else {
                (in_file.1, in_file.2) = (format!("Text {number}.{part}. | Zwei {number}."), false);
                edit.insert("text".into(), json!(in_file.1));
                if has_states {
                    edit.insert("fuzzy".into(), json!(false));
                }
            }
            if has_comment {
                let comment = format!("question {number}.{part}");
                edit.insert("comment".into(), json!(comment));
                clip.comments.push(comment);
            }
            edits.insert(key, Value::Object(edit));
        }
        let count = edits.len();
        let script = repository().join("crates/lipz/tests/support/deliver_texts.py");
        let mut python = Command::new("python3");
        python.arg(script).arg(file).arg(Value::Object(edits).to_string()).current_dir(self.scene.path());
        let output = python.env("PYTHONPATH", repository().join("target/tools")).output();
        let Some(output) = output.ok().filter(|output| output.status.success()) else {
            let is_required = std::env::var_os("LIPZ_TOOLS").is_some();
            assert!(!is_required, "`deliver_texts.py` needs libraries of Python, which `.ci/install` brings");
            return false;
        };
        assert_eq!(String::from_utf8_lossy(&output.stdout).trim(), count.to_string());
        true
    }

    /// Imports files, and changes the expectation accordingly.
    fn import(&mut self, files: &[&str], number: usize) {
        let imported = lipz(self.scene.path(), ["import", "texts"].iter().chain(files));
        // Two texts made from an older source conflict, although neither is imported.
        let is_one = files.len() == 1;
        assert!(!(is_one && imported.stderr.contains("LZ1905")), "{}, {number}: {}", self.format, imported.stderr);
        for clip in self.clips.values_mut() {
            let Some((source, text, is_fuzzy)) = clip.in_file.clone() else { continue };
            let is_current = source == clip.source;
            match (is_fuzzy, text == clip.translation) {
                // A rejected text stays open. The source that has changed since keeps it open anyway.
                (true, true) => clip.is_open |= is_current && !text.is_empty(),
                (true, false) => {}
                (false, false) if is_current => (clip.translation, clip.is_open) = (text, false),
                // Made from an older source (LZ1904), or unchanged.
                (false, _) => {}
            }
        }
    }

    /// Compares the project with the expectation.
    fn compare(&self, number: usize) {
        let place = format!("{}, delivery {number}", self.format);
        for (key, clip) in &self.clips {
            let text = fs::read_to_string(self.scene.path().join(format!("voices/{key}.lipz"))).unwrap();
            let document: Value = serde_json::from_str(&text).unwrap();
            let found = document.get("text_de-de").and_then(Value::as_str).unwrap_or_default();
            assert_eq!(found.replace('|', " | "), clip.translation, "{place}: {key}");
            let dub = self.scene.path().join(format!("voices/de/{key}.lipz"));
            assert_eq!(fs::read_to_string(dub).ok().as_deref(), clip.has_dub.then_some(DUB_ELEMENTS), "{place}: {key}");
            assert_eq!(document["text_en-us"].as_str().unwrap().replace('|', " | "), clip.source, "{place}: {key}");
        }
        let checked = lipz(self.scene.path(), ["check", "--output-format", "concise"]);
        let open: BTreeSet<&str> = checked.stdout.lines().filter(|line| line.contains("LZ1911")).collect();
        let open: BTreeSet<&str> =
            open.iter().filter_map(|line| line.split('.').next()?.strip_prefix("voices/")).collect();
        let expected: BTreeSet<&str> =
            self.clips.iter().filter(|(_, clip)| clip.is_open).map(|(key, _)| key.as_str()).collect();
        assert_eq!(open, expected, "{place}: {}", checked.stdout);
        let record = fs::read_to_string(self.scene.path().join("lipz-texts.txt")).unwrap_or_default();
        let comments: BTreeSet<&str> = record
            .lines()
            .filter(|line| line.contains("\tcomment\t"))
            .filter_map(|line| line.rsplit('\t').next())
            .collect();
        let expected: BTreeSet<&str> =
            self.clips.values().flat_map(|clip| &clip.comments).map(String::as_str).collect();
        assert_eq!(comments, expected, "{place}");
    }
}

fn play(format: &'static str, extension: &str, seed: u64) -> bool {
    let scene = Scene::new();
    scene.write("lipz.toml", SETTINGS);
    let clip = |number: usize| ExpectedClip { source: format!("Line {number}. | And two."), ..ExpectedClip::default() };
    let clips = (0..10).map(|number| (format!("line-{number}"), clip(number))).collect();
    let mut year = Year { scene: &scene, format, file: format!("de.{extension}"), clips, random: Random(seed) };
    year.clips.keys().cloned().collect::<Vec<_>>().iter().for_each(|key| year.write_clip(key));
    for number in 0..DELIVERIES {
        if NEW_EXPORTS.contains(&number) {
            if number > 0 {
                year.rename(number);
            }
            year.export();
        }
        if number == DUB {
            year.dub();
        }
        year.change_source(number);
        let file = year.file.clone();
        let mut taken = BTreeSet::new();
        let second = format!("second.{extension}");
        if number == TWO_TRANSLATORS {
            fs::copy(scene.path().join(&file), scene.path().join(&second)).unwrap();
        }
        if !year.edit(&file, number, &mut taken) {
            return false;
        }
        if number == TWO_TRANSLATORS {
            year.edit(&second, number + 100, &mut taken);
            year.import(&[&file, &second], number);
            year.compare(number);
            // From now on, the first translator has the texts of both.
            year.export();
        } else {
            year.import(&[&file], number);
            year.compare(number);
        }
    }
    true
}

#[test]
fn nothing_is_lost_in_a_year_of_deliveries() {
    for (format, extension) in [("po", "po"), ("csv", "csv"), ("xlsx", "xlsx"), ("xliff-1.2", "xlf")] {
        for seed in 1..=3 {
            if !play(format, extension, 0x9E37_79B9_7F4A_7C15 ^ seed) {
                eprintln!("skipped: the libraries of Python are not on this machine");
                return;
            }
        }
    }
}
