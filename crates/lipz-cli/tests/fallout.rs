//! Fallout 2: `lipz fallout heads`, and LIP files through `lipz import` and `lipz export`.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use support::{Scene, lipz};

/// An FRM file with frames of one pixel.
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

/// The files of a head with one fidget file for each disposition.
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
        let outcome = lipz(scene.path(), ["fallout", "heads", source]);
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
    scene.expect("LZ1535-head-files", &["fallout", "heads", "heads", "--quiet"]);
    scene.expect("LZ1533-heads-list", &["fallout", "heads", "heads/heads.lst", "--quiet"]);
    scene.write("eldergp.frm", frm(8));
    scene.expect("LZ1532-head-frames", &["fallout", "heads", "eldergp.frm", "--quiet"]);
    scene.write("eldernp.frm", &frm(9)[..120]);
    scene.write("elderbp.frm", "GIF89a");
    scene.expect("LZ1531-frm-refused", &["fallout", "heads", "eldernp.frm", "elderbp.frm", "--quiet"]);
    scene.write("elderxp.frm", frm(9));
    scene.expect("LZ1534-head-name", &["fallout", "heads", "elderxp.frm", "--quiet"]);
    scene.finish(5);
}

#[test]
fn files_that_are_not_there_cannot_be_checked() {
    let scene = Scene::new();
    let outcome = lipz(scene.path(), ["fallout", "heads", "nowhere"]);
    assert_eq!(outcome.code, 2);
    assert!(outcome.stderr.starts_with("error[LZ0001]: `nowhere` cannot be read: "), "{}", outcome.stderr);
    fs::create_dir(scene.path().join("empty")).unwrap();
    let outcome = lipz(scene.path(), ["fallout", "heads", "empty"]);
    assert_eq!(outcome.code, 1);
    assert!(outcome.stderr.starts_with("error[LZ0805]: no FRM files in `empty`\n"), "{}", outcome.stderr);
}
