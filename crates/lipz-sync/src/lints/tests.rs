use super::*;
use std::path::PathBuf;

/// A WAV file of zeros.
fn silence(path: &Path, rate_hz: u32, samples: u32) {
    let spec = hound::WavSpec {
        channels: 1,
        sample_rate: rate_hz,
        bits_per_sample: 16,
        sample_format: hound::SampleFormat::Int,
    };
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    let mut writer = hound::WavWriter::create(path, spec).unwrap();
    (0..samples).for_each(|_| writer.write_sample(0_i16).unwrap());
    writer.finalize().unwrap();
}

struct Project {
    folder: tempfile::TempDir,
    settings: Settings,
}

impl Project {
    fn new(settings: &str) -> Project {
        let folder = tempfile::tempdir().unwrap();
        let text = format!("default-fps = 24\n[audio]\nfolder = \"sounds\"\n{settings}");
        let (settings, report) = Settings::parse(text.as_bytes(), "lipz.toml", folder.path());
        assert_eq!(report.diagnostics, []);
        Project { folder, settings }
    }

    fn sound(&self, name: &str, rate_hz: u32, samples: u32) -> PathBuf {
        let path = self.folder.path().join("sounds").join(name);
        silence(&path, rate_hz, samples);
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
    let project = Project::new("");
    project.sound("a.wav", 48_000, 24_000);
    assert_eq!(project.check(&[("a", HALF_A_SECOND)]), [""; 0]);
    project.sound("a.wav", 48_000, 26_000); // a frame longer
    assert_eq!(project.check(&[("a", HALF_A_SECOND)]), [""; 0]);
    project.sound("a.wav", 48_000, 26_002);
    let longer = "the mouth moves for 0.500 s, but the recording lasts 0.542 s";
    assert_eq!(project.check(&[("a", HALF_A_SECOND)]), [longer]);
    project.sound("a.wav", 8_000, 3_000);
    let shorter = "the mouth moves for 0.500 s, but the recording lasts 0.375 s";
    assert_eq!(project.check(&[("a", HALF_A_SECOND)]), [shorter]);
}

#[test]
fn a_tolerance_takes_the_place_of_the_frame() {
    let project = Project::new("tolerance-ms = 125");
    project.sound("a.wav", 8_000, 3_000);
    assert_eq!(project.check(&[("a", HALF_A_SECOND)]), [""; 0]);
    project.sound("a.wav", 8_000, 2_999);
    assert_eq!(project.check(&[("a", HALF_A_SECOND)]).len(), 1);
}

#[test]
fn what_has_no_counterpart_is_reported() {
    let project = Project::new("pattern = \"en/{key}\"");
    project.sound("en/a.wav", 8_000, 4_000);
    let lonely = project.sound("de/a.wav", 8_000, 4_000);
    let found = project.check(&[("a", HALF_A_SECOND), ("b", HALF_A_SECOND), ("text", r#"{ "text_en-us": "Aye." }"#)]);
    let without_clip = format!("no clip has the recording `{}`", lonely.display());
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(found.contains(&without_clip), "{found:?}");
    assert!(found.contains(&"the clip has mouth shapes, but no recording".to_owned()), "{found:?}");
}

#[test]
fn sounds_that_are_none_are_reported_and_all_others_checked() {
    let project = Project::new("");
    project.sound("b.wav", 8_000, 8_000);
    fs::write(project.folder.path().join("sounds/a.wav"), "RIFF").unwrap();
    let found = project.check(&[("a", HALF_A_SECOND), ("b", HALF_A_SECOND)]);
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(found.iter().any(|message| message.starts_with("the recording cannot be used: ")), "{found:?}");
}

#[test]
fn levels_of_the_project_hold() {
    let project = Project::new("[lints]\nrecording-length = \"deny\"\n");
    project.sound("a.wav", 8_000, 8_000);
    let inputs = [Input::from_bytes("a", HALF_A_SECOND)];
    assert!(check(&project.settings, &inputs, &|| ())[0].has_errors());
    let none = Settings::default();
    assert_eq!(check(&none, &inputs, &|| ()), [], "no folder of recordings");
}
