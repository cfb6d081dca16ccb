//! `cargo xtask corpus`: packing, reading and unpacking held to files whose contents are known.
//!
//! The folder has sub-folders with Lipz files, and `expected.jsonl` with a row per file that says
//! what a correct reader reports. The corpus is not part of this project: name the folder that it
//! is in.

mod compare;
mod differences;
mod row;
mod trips;

use crate::{Failure, place};
use clap::Args;
use differences::Differences;
use lipz::Level;
use lipz_bank::Bank;
use lipz_compiler::{Content, Input, Options, check_all, compile, discover};
use row::Row;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// What `corpus` is asked for.
#[derive(Args, Debug)]
pub(crate) struct Settings {
    /// The folder with `expected.jsonl` and the sub-folders
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,
}

pub(crate) fn run(settings: &Settings) -> Result<(), Failure> {
    let mut differences = Differences::default();
    for (name, rows) in row::read(&settings.folder.join("expected.jsonl"))? {
        let before = differences.count();
        let seen = sub_folder(&settings.folder.join(&name), &rows, &mut differences)?;
        println!("{name}: {seen}, {} differences", differences.count() - before);
    }
    differences.conclude()
}

/// What a check went through, for the summary: a check that saw nothing proves nothing.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
struct Seen {
    rows: usize,
    clips: usize,
    segments: usize,
    frames: usize,
    texts: usize,
    events: usize,
    typed_events: usize,
    times: usize,
    warnings: usize,
    bank_bytes: usize,
    identical_banks: usize,
}

impl std::fmt::Display for Seen {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "{} rows, {} clips, {} segments, {} frames, {} texts, {} events, {} typed, {} times, {} warnings, {:.2} MB, {} identical banks",
            self.rows,
            self.clips,
            self.segments,
            self.frames,
            self.texts,
            self.events,
            self.typed_events,
            self.times,
            self.warnings,
            self.bank_bytes as f64 / 1e6,
            self.identical_banks
        )
    }
}

fn sub_folder(folder: &Path, rows: &BTreeMap<String, Row>, differences: &mut Differences) -> Result<Seen, Failure> {
    let mut seen = Seen { rows: rows.len(), ..Seen::default() };
    let files = files(folder, rows, differences, &mut seen)?;
    let whole = bank_of(&files.inputs, &Options::default())?;
    let stripped = bank_of(&files.inputs, &Options { strip: true, ..Options::default() })?;
    seen.bank_bytes = whole.len();
    for bytes in [&whole, &stripped] {
        let bank = Bank::open(bytes).and_then(Bank::verify).map_err(|error| error.to_string())?;
        compare::bank(&bank, rows, &files, differences, &mut seen);
    }
    let temporary = place::temporary_folder()?;
    let there_and_back =
        trips::Trips { files: &files, whole: &whole, stripped: &stripped, temporary: temporary.path() };
    there_and_back.run(differences, &mut seen)?;
    Ok(seen)
}

/// The files of a sub-folder without those that cannot be packed.
struct Files {
    inputs: Vec<Input>,
    /// Contents by key.
    contents: BTreeMap<String, Vec<u8>>,
}

/// Reads the files, checks them against the rows' hashes, and sorts out those with errors: each is
/// a difference, and the others can still be compared.
fn files(
    folder: &Path,
    rows: &BTreeMap<String, Row>,
    differences: &mut Differences,
    seen: &mut Seen,
) -> Result<Files, Failure> {
    let (mut inputs, mut reports) = discover(&[folder.to_owned()], None);
    reports.extend(check_all(&inputs, &Options::default(), &|_| {}).reports);
    for report in &reports {
        for finding in report.diagnostics.iter().filter(|finding| finding.level == Level::Error) {
            differences.add(|| format!("{}: {} {}", report.source.path, finding.code.number(), finding.headline));
        }
        if report.diagnostics.iter().any(|finding| finding.level == Level::Error) {
            inputs.retain(|input| input.name() != report.source.path);
        }
    }
    seen.warnings = lipz_compiler::count(&reports, Level::Warning);
    let mut contents = BTreeMap::new();
    for input in &inputs {
        let Content::File(path) = &input.content else { continue };
        let bytes = std::fs::read(path).map_err(|error| format!("`{}`: {error}", path.display()))?;
        match rows.get(&input.key) {
            None => differences.add(|| format!("{}: no row", input.name())),
            Some(row) if row.is_stale(&bytes) => {
                differences.add(|| format!("{}: stale row: the file has changed since", input.name()));
            }
            Some(_) => {}
        }
        contents.insert(input.key.clone(), bytes);
    }
    for key in rows.keys().filter(|key| !contents.contains_key(*key)) {
        differences.add(|| format!("{key}: there is a row, but no file that can be packed"));
    }
    Ok(Files { inputs, contents })
}

/// The bank of `inputs`, which have no errors.
fn bank_of(inputs: &[Input], options: &Options) -> Result<Vec<u8>, Failure> {
    let compiled = compile(inputs, options, &|_| {});
    let errors = || compiled.reports.iter().flat_map(|report| &report.diagnostics).find(|f| f.level == Level::Error);
    compiled.bank.ok_or_else(|| {
        errors().map_or_else(|| "no bank, and no error either".into(), |error| format!("no bank: {}", error.headline))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    /// A corpus of one file, with a row that is right or not.
    fn corpus(change: impl Fn(String) -> String) -> (Seen, Differences) {
        let folder = place::temporary_folder().unwrap();
        let file = br#"{ "fps": 23.976, "visemes": "MA-|EO", "viseme_type": "blair", "note": 1,
            "text_en-us": " Mayor {sighs}| Oh", "events": "feels sad|" }"#;
        fs::create_dir(folder.path().join("one")).unwrap();
        fs::write(folder.path().join("one/mayor.lipz"), file).unwrap();
        let row = format!(
            r#"{{"path": "one/mayor.lipz", "key": "mayor", "sha256": "{}", "bytes": {}, "fps": 23.976, "fps_external": null,
            "viseme_type": "blair", "viseme_type_external": null, "frames": 5, "segments": 2, "seg_start_frames": [0, 3],
            "events": ["feels sad", ""], "locales": ["en-us"], "display": {{"en-us": ["Mayor", "Oh"]}} }}"#,
            row::sha256(file),
            file.len()
        );
        fs::write(folder.path().join("expected.jsonl"), change(row).replace('\n', " ")).unwrap();
        let mut differences = Differences::default();
        let rows = row::read(&folder.path().join("expected.jsonl")).unwrap();
        let seen = sub_folder(&folder.path().join("one"), &rows["one"], &mut differences).unwrap();
        (seen, differences)
    }

    #[test]
    fn a_right_row_has_no_differences() {
        let (seen, differences) = corpus(|row| row);
        assert_eq!(differences.count(), 0, "{differences:?}");
        // Each bank, with and without source section, is compared.
        assert_eq!((seen.rows, seen.clips, seen.segments, seen.texts, seen.events), (1, 2, 4, 4, 4));
        assert_eq!(seen.typed_events, 2);
        assert!(seen.times > 0 && seen.identical_banks == 11, "{seen}");
    }

    #[test]
    fn every_wrong_field_is_a_difference() {
        let changes = [
            (r#""frames": 5"#, r#""frames": 6"#),
            (r#""segments": 2"#, r#""segments": 3"#),
            ("[0, 3]", "[0, 2]"),
            (r#""fps": 23.976"#, r#""fps": 23.9760001"#),
            (r#""fps": 23.976, "fps_external": null"#, r#""fps": null, "fps_external": 24"#),
            (r#""viseme_type": "blair""#, r#""viseme_type": "rms""#),
            (r#""feels sad", """#, r#""feels sad", "x""#),
            (r#"["feels sad", ""]"#, "null"),
            (r#"["en-us"]"#, r#"["en-us", "de-de"]"#),
            (r#"["en-us"]"#, "[]"),
            (r#""Oh""#, r#""Oh ""#),
            (r#""bytes": "#, r#""bytes": 1"#),
            (r#""sha256": ""#, r#""sha256": "0"#),
            (r#""mayor""#, r#""mayors""#),
        ];
        for (from, to) in changes {
            let (_, differences) = corpus(|row| {
                assert!(row.contains(from), "{from}");
                row.replace(from, to)
            });
            assert!(differences.count() > 0, "{to} is not noticed");
        }
    }
}
