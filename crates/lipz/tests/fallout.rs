//! Fallout 2: `lipz fallout heads`, and LIP files through `lipz import` and `lipz export`.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use support::{Scene, lipz, repository};

/// Returns an FRM file with frames of one pixel.
fn frm(frames: u16) -> Vec<u8> {
    let mut bytes = vec![0; 0x3E];
    bytes[3] = 4;
    bytes[5] = 10;
    bytes[8..10].copy_from_slice(&frames.to_be_bytes());
    for _ in 0..frames {
        bytes.extend_from_slice(&[0, 1, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 7]);
    }
    bytes
}

/// The files of a head with one fidget file per disposition.
const WHOLE: [&str; 10] = ["gp", "np", "bp", "gn", "ng", "nb", "bn", "gf1", "nf1", "bf1"];

fn write_head(scene: &Scene, root: &str) {
    for suffix in WHOLE {
        scene.write(&format!("heads/{root}{suffix}.FRM"), frm(9));
    }
}

#[test]
fn whole_heads_are_listed() {
    let scene = Scene::new();
    write_head(&scene, "ELDER");
    scene.write("heads/HEADS.LST", "elder,1,1,1\r\n");
    for source in ["heads", "heads/HEADS.LST"] {
        let outcome = lipz(scene.path(), ["check", "--fallout-heads", source]);
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{source}");
        assert_eq!(
            outcome.stdout,
            "head   disposition  mouth shapes  fidgets  emotions\n\
             elder  good         yes                 1  happy, amused\n\
             elder  neutral      yes                 1  neutral, confused, thinking\n\
             elder  bad          yes                 1  angry, irritated, sad, suspicious, afraid, evil\n"
        );
    }
}

#[test]
fn what_is_wrong_with_heads() {
    let mut scene = Scene::new();
    write_head(&scene, "elder");
    scene.write("heads/eldergf2.frm", frm(1));
    scene.write("heads/myrongp.frm", frm(9));
    scene.write("heads/heads.lst", "elder,1,3,1\nlynette,2\n");
    scene.expect("LZ1535-head-files", &["check", "--fallout-heads", "heads", "--quiet"]);
    scene.expect("LZ1533-heads-list", &["check", "--fallout-heads", "heads/heads.lst", "--quiet"]);
    scene.write("eldergp.frm", frm(8));
    scene.expect("LZ1532-head-frames", &["check", "--fallout-heads", "eldergp.frm", "--quiet"]);
    scene.write("eldernp.frm", &frm(9)[..120]);
    scene.write("elderbp.frm", "GIF89a");
    scene.expect("LZ1531-frm-refused", &["check", "--fallout-heads", "eldernp.frm", "elderbp.frm", "--quiet"]);
    scene.write("elderxp.frm", frm(9));
    scene.expect("LZ1534-head-name", &["check", "--fallout-heads", "elderxp.frm", "--quiet"]);
    scene.finish(5);
}

#[test]
fn files_that_are_not_there_cannot_be_checked() {
    let scene = Scene::new();
    let outcome = lipz(scene.path(), ["check", "--fallout-heads", "nowhere"]);
    assert_eq!(outcome.code, 2);
    assert!(outcome.stderr.starts_with("error[LZ0001]: `nowhere` does not exist"), "{}", outcome.stderr);
    fs::create_dir(scene.path().join("empty")).unwrap();
    let outcome = lipz(scene.path(), ["check", "--fallout-heads", "empty"]);
    assert_eq!(outcome.code, 2);
    assert!(outcome.stderr.starts_with("error[LZ0805]: no FRM files in `empty`\n"), "{}", outcome.stderr);
}

/// Copies the LIP files of the repository.
fn write_lips(scene: &Scene) {
    for name in ["eld_1.lip", "eld_2.lip", "eld_odd.lip", "eld_cut.lip", "eld_old.lip"] {
        scene.write(name, fs::read(repository().join("fixtures/interop/fallout").join(name)).unwrap());
    }
}

/// Returns a LIP file of the repository with the bytes at an offset replaced.
fn with(bytes: &[u8], at: usize) -> Vec<u8> {
    let mut lip = fs::read(repository().join("fixtures/interop/fallout/eld_2.lip")).unwrap();
    lip.resize(lip.len().max(at + bytes.len()), 0);
    lip[at..at + bytes.len()].copy_from_slice(bytes);
    lip
}

/// Returns the header of an ACM file with this number of samples at 22,050 Hz: magic number and version, samples,
/// channels, rate.
fn acm(samples: u32) -> Vec<u8> {
    [&[0x97, 0x28, 3, 1][..], &samples.to_le_bytes(), &[1, 0, 0x22, 0x56]].concat()
}

#[test]
fn what_is_unusual_in_lip_files() {
    let mut scene = Scene::new();
    write_lips(&scene);
    let import = |name: &'static str| ["import", "visemes", "fallout", name, "-o", "out", "--quiet"];
    scene.expect("LZ1501-lip-version", &import("eld_old.lip"));
    scene.expect("LZ1502-lip-cut-off", &import("eld_cut.lip"));
    scene.expect("LZ1508-lip-phoneme-and-others", &import("eld_odd.lip"));
    scene.write("eld_2.lip", with(&[0, 0, 0, 9], 0x0C));
    scene.expect("LZ1503-lip-header", &["import", "visemes", "fallout", "eld_2.lip", "-o", "header", "--quiet"]);
    scene.write("eld_2.lip", with(&[0, 0, 0x90, 0], 0x10));
    scene.expect("LZ1505-lip-length", &["import", "visemes", "fallout", "eld_2.lip", "-o", "length", "--quiet"]);
    scene.write("eld_2.lip", with(&[0, 0, 0, 7], 0x1C));
    scene.expect("LZ1506-lip-counts", &["import", "visemes", "fallout", "eld_2.lip", "-o", "counts", "--quiet"]);
    scene.write("eld_2.lip", with(&[0, 0, 0, 5], 0x33));
    scene.expect("LZ1509-lip-marker-type", &["import", "visemes", "fallout", "eld_2.lip", "-o", "type", "--quiet"]);
    scene.write("eld_2.lip", with(&[], 0));
    scene.write("eld_2.ACM", acm(3 * 22_050));
    scene.expect("LZ1512-lip-time-base", &["import", "visemes", "fallout", "eld_2.lip", "-o", "base", "--quiet"]);
    fs::remove_file(scene.path().join("eld_2.ACM")).unwrap();
    scene.write("elder.msg", "{100}{}{You see Elder.}\n{101}{eld_1}{Greetings,\nChosen.}\n{102}{eld_2}{Welcome\n");
    scene.expect(
        "LZ1521-msg-syntax",
        &["import", "visemes", "fallout", "eld_2.lip", "-o", "msg", "--script", "elder.msg"],
    );
    scene.write("voices/mara-good-evening.lipz", r#"{ "visemes": "MA", "viseme_type": "blair", "fps": 24 }"#);
    scene.expect("LZ1513-lip-export-name", &["export", "visemes", "fallout", "voices", "-o", "speech"]);
    scene.write("lines/eld_3.lipz", r#"{ "visemes": "MA", "viseme_type": "blair", "fps": 24 }"#);
    scene.expect("LZ1514-lip-few-markers", &["export", "visemes", "fallout", "lines", "-o", "speech", "--quiet"]);
    scene.finish(11);
}

#[test]
fn options_about_lipz_files_do_not_apply_to_heads() {
    let scene = Scene::new();
    scene.write("heads/elderna.frm", "");
    let check = ["check", "--fallout-heads", "heads"];
    for arguments in [
        &["--audio", "recordings"][..],
        &["--baseline", "known.txt"],
        &["--baseline", "known.txt", "--write-baseline"],
        &["--config", "strip=true"],
        &["--no-config"],
        &["--jobs", "2"],
        &["--deny", "warnings"],
        &["--fix"],
    ] {
        let refused = lipz(scene.path(), [&check[..], arguments].concat());
        assert_eq!((refused.code, refused.stdout.as_str()), (2, ""), "{arguments:?}: {}", refused.stderr);
        assert!(refused.stderr.contains("cannot be used with"), "{arguments:?}: {}", refused.stderr);
    }
}

#[test]
fn texts_come_from_scripts() {
    let scene = Scene::new();
    write_lips(&scene);
    scene.write("elder.msg", b"{101}{ELD_1}{Greetings,\nChosen.}\r\n{102}{eld_2}{D\xE9j\xE0 vu.}\r\n");
    let import = [
        "import",
        "visemes",
        "fallout",
        "eld_1.lip",
        "eld_2.lip",
        "-o",
        "voices",
        "--script",
        "elder.msg",
        "--locale",
        "en-us",
    ];
    let outcome = lipz(scene.path(), import);
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("warning[LZ1522]: words run together at a line break"), "{}", outcome.stderr);
    assert_eq!(
        outcome.stdout,
        "2 files imported from fallout into voices, with the mapping table fallout 1\n\
         2 files: 44100 units per second, as in the game\n"
    );
    let read = |name: &str| fs::read_to_string(scene.path().join(name)).unwrap();
    assert!(read("voices/eld_1.lipz").contains("\"Greetings,Chosen.\""), "{}", read("voices/eld_1.lipz"));
    assert!(read("voices/eld_2.lipz").contains("\"Déjà vu.\""), "{}", read("voices/eld_2.lipz"));
}

#[test]
fn the_sound_beside_a_file_chooses_its_unit() {
    let scene = Scene::new();
    write_lips(&scene);
    scene.write("eld_2.ACM", acm(8820));
    let outcome = lipz(scene.path(), ["import", "visemes", "fallout", "eld_2.lip", "-o", "voices"]);
    assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""));
    assert!(outcome.stdout.contains("88200 units per second, the closest to the end of the sound file"), "{outcome:?}");
}

#[test]
fn what_is_exported_comes_back() {
    let scene = Scene::new();
    let clip = r#"{ "visemes": "--MMAA|SEELOOWFF-", "viseme_type": "blair", "fps": 12.5 }"#;
    scene.write("voices/act1/mayor.lipz", clip);
    let exported = lipz(scene.path(), ["export", "visemes", "fallout", "voices", "-o", "speech"]);
    assert_eq!((exported.code, exported.stderr.as_str()), (0, ""));
    assert!(exported.stdout.ends_with("the format cannot store segments\n"), "{}", exported.stdout);
    let imported =
        lipz(scene.path(), ["import", "visemes", "fallout", "speech/act1/mayor.lip", "-o", "back", "--fps", "12.5"]);
    assert_eq!((imported.code, imported.stderr.as_str()), (0, ""));
    let back = fs::read_to_string(scene.path().join("back/mayor.lipz")).unwrap();
    assert!(back.contains("\"--MMAASEELOOWFF-\""), "{back}");
}
