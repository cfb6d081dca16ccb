//! Tests of diagnostics about clips and recordings that do not match.

use super::*;
use std::fs;
use std::path::Path;
use std::path::PathBuf;

/// Writes a WAV file with audio that changes as often as speech.
fn voice(path: &Path, rate_hz: u32, samples: u32) {
    let spec = hound::WavSpec {
        channels: 1,
        sample_rate: rate_hz,
        bits_per_sample: 16,
        sample_format: hound::SampleFormat::Int,
    };
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    let mut writer = hound::WavWriter::create(path, spec).unwrap();
    let wave = |at: u32| {
        let period = [40, 7, 90, 3][(at * 12 / rate_hz) as usize % 4];
        i16::try_from(at % period * 4_000 / period).unwrap()
    };
    (0..samples).for_each(|at| writer.write_sample(wave(at)).unwrap());
    writer.finalize().unwrap();
}

struct TestProject {
    folder: tempfile::TempDir,
    settings: Settings,
}

impl TestProject {
    fn new(settings: &str) -> TestProject {
        let folder = tempfile::tempdir().unwrap();
        let text = format!("default-fps = 24\n[audio]\nfolder = \"sounds\"\n{settings}");
        let settings = Settings::parse(text, "lipz.toml", folder.path()).unwrap();
        TestProject { folder, settings }
    }

    fn sound(&self, name: &str, rate_hz: u32, samples: u32) -> PathBuf {
        let path = self.folder.path().join("sounds").join(name);
        voice(&path, rate_hz, samples);
        path
    }

    fn check(&self, files: &[(&str, &str)]) -> Vec<String> {
        let inputs: Vec<Input> = files.iter().map(|(key, text)| Input::from_bytes(*key, *text)).collect();
        let reports = check(&self.settings, &inputs, &|| ());
        reports.iter().flat_map(|report| &report.diagnostics).map(|found| found.message.clone()).collect()
    }
}

const HALF_A_SECOND: &str = r#"{ "visemes": "MA--|EO------" }"#;

#[test]
fn a_frame_of_difference_is_none() {
    let project = TestProject::new("");
    project.sound("a.wav", 48_000, 24_000);
    assert_eq!(project.check(&[("a", HALF_A_SECOND)]), [""; 0]);
    project.sound("a.wav", 48_000, 26_000); // a frame longer
    assert_eq!(project.check(&[("a", HALF_A_SECOND)]), [""; 0]);
    project.sound("a.wav", 48_000, 26_002);
    let longer = "the visemes last 0.500 s, but the recording lasts 0.542 s";
    assert_eq!(project.check(&[("a", HALF_A_SECOND)]), [longer]);
    project.sound("a.wav", 8_000, 3_000);
    let shorter = "the visemes last 0.500 s, but the recording lasts 0.375 s";
    assert_eq!(project.check(&[("a", HALF_A_SECOND)]), [shorter]);
}

#[test]
fn a_tolerance_takes_the_place_of_the_frame() {
    let project = TestProject::new("tolerance-ms = 125");
    project.sound("a.wav", 8_000, 3_000);
    assert_eq!(project.check(&[("a", HALF_A_SECOND)]), [""; 0]);
    project.sound("a.wav", 8_000, 2_999);
    assert_eq!(project.check(&[("a", HALF_A_SECOND)]).len(), 1);
}

#[test]
fn what_has_no_counterpart_is_reported() {
    let project = TestProject::new("pattern = \"en/{key}\"");
    project.sound("en/a.wav", 8_000, 4_000);
    let lonely = project.sound("de/a.wav", 8_000, 4_000);
    let found = project.check(&[("a", HALF_A_SECOND), ("b", HALF_A_SECOND), ("text", r#"{ "text_en-us": "Aye." }"#)]);
    let without_clip = format!("the recording `{}` does not belong to a clip", lonely.display());
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(found.contains(&without_clip), "{found:?}");
    assert!(found.contains(&"the clip has visemes, but no recording".to_owned()), "{found:?}");
}

#[test]
fn sounds_that_are_none_are_reported_and_all_others_checked() {
    let project = TestProject::new("");
    project.sound("b.wav", 8_000, 8_000);
    fs::write(project.folder.path().join("sounds/a.wav"), "RIFF").unwrap();
    let found = project.check(&[("a", HALF_A_SECOND), ("b", HALF_A_SECOND)]);
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(found.iter().any(|message| message.starts_with("the recording cannot be used: ")), "{found:?}");
}

#[test]
fn levels_of_the_project_hold() {
    let project = TestProject::new("[lints]\nrecording-length = \"deny\"\n");
    project.sound("a.wav", 8_000, 8_000);
    let inputs = [Input::from_bytes("a", HALF_A_SECOND)];
    assert!(check(&project.settings, &inputs, &|| ())[0].has_errors());
    let none = Settings::default();
    assert_eq!(check(&none, &inputs, &|| ()), [], "no folder of recordings");
}

#[test]
fn recordings_that_nobody_can_use_are_told_without_a_run_that_makes_mouths() {
    let project = TestProject::new("cache = \"sounds.cache\"\n[voices]\nde-de = \"de/{key}\"\n");
    let half = HALF_A_SECOND;
    project.sound("a.wav", 8_000, 4_000);
    let silent = project.sound("de/a.wav", 8_000, 4_000);
    let mut bytes = fs::read(&silent).unwrap();
    bytes[44..].fill(0);
    fs::write(&silent, &bytes).unwrap();
    project.sound("b.wav", 8_000, 4_000);
    let cut = project.sound("de/b.wav", 8_000, 4_000);
    let bytes = fs::read(&cut).unwrap();
    fs::write(&cut, &bytes[..bytes.len() - 101]).unwrap();
    let loud = project.sound("c.wav", 8_000, 4_000);
    let mut bytes = fs::read(&loud).unwrap();
    bytes[4044..4084].copy_from_slice(&[0xff, 0x7f].repeat(20));
    fs::write(&loud, &bytes).unwrap();
    let told = [
        "the recording is clipped at full scale at 0.25 s",
        "the recording is silent",
        "the recording ends in the middle of its data",
        "the clip has no recording in `de-de`",
    ];
    for run in ["first", "from the cache"] {
        let mut found = project.check(&[("a", half), ("b", half), ("c", half)]);
        found.sort_by_key(|message| told.iter().position(|known| known == message));
        assert_eq!(found, told, "{run}");
    }
    let cache = fs::read_to_string(project.folder.path().join("sounds.cache")).unwrap();
    assert_eq!(cache.lines().count(), 5, "{cache}");
}

#[test]
fn the_voice_of_a_clip_decides_which_text_is_spoken() {
    let project = TestProject::new("[voices]\nen-us = \"en/{key}\"\nde-de = \"de/{key}\"\n");
    project.sound("en/a.wav", 8_000, 4_000);
    project.sound("de/a.wav", 8_000, 4_000);
    assert_eq!(project.check(&[("en/a", HALF_A_SECOND), ("de/a", HALF_A_SECOND)]), [""; 0], "each its own");
    let found = project.check(&[("a", HALF_A_SECOND)]);
    assert_eq!(found, ["the clip has visemes, but no recording"], "no spoken locale is named: dubs only");
    let mut project = project;
    project.settings.options = project.settings.options.default_locale("en-us").unwrap();
    assert_eq!(project.check(&[("a", HALF_A_SECOND)]), [""; 0], "one mouth, two recordings");
    project.settings.audio.voices.insert("fr-fr".to_owned(), "fr/{key}".to_owned());
    assert_eq!(project.check(&[("a", HALF_A_SECOND)]), ["the clip has no recording in `fr-fr`"]);
}
