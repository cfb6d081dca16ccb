//! `lipz convert --write-curves`: generated curves, written into Lipz files.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use lipz_bank::face::{LookAt, Who};
use lipz_bank::{Bank, Micros};
use std::fs;
use support::{Scene, lipz, with_input};

const SETTINGS: &str = "sources = [\"voices\"]\noutput = \"out.lipzbank\"\ndefault-locale = \"en-us\"\nstrip = true\n";
const NEAT: &str = "{\n  \"visemes\"      :    \"MAEOMAEOMAEOMAEOMAEOMAEO\",\n  \"text_en-us\"   : \"Yes. {anger 2} Of course.\",\n  \"viseme_type\"  : \"blair\",\n  \"fps\"          : 24\n}\n";
const ROUGH: &str = "{\"fps\":24,\"visemes\":\"MAEOMAEOMAEOMAEO\",\"events\":\"nods 4\", \"mine\": [1,  2], \"curves\": {\"jawOpen\":\"0:0.10 3:0\"},\"note\":0}";

/// Writes all curves into the files.
const WRITE: [&str; 3] = ["convert", "--write-curves", "--in-place"];

/// Returns the arguments that write some curves into a file.
fn write<'a>(file: &'a str, curves: &'a str) -> [&'a str; 4] {
    ["convert", file, curves, "--in-place"]
}

fn scene(keys: &str) -> Scene {
    let scene = Scene::new();
    scene.write("lipz.toml", format!("{SETTINGS}[face]\nkeys = \"{keys}\"\n"));
    scene.write("voices/neat.lipz", NEAT);
    scene.write("voices/rough.lipz", ROUGH);
    scene.write("voices/still.lipz", r#"{ "text_en-us": "…" }"#);
    scene
}

fn read(scene: &Scene, name: &str) -> String {
    fs::read_to_string(scene.path().join(name)).unwrap()
}

#[test]
fn the_bank_is_the_same_with_curves_in_the_files() {
    let scene = scene("words");
    scene.prepare(&["fmt", "voices/neat.lipz", "--quiet"]);
    let neat = read(&scene, "voices/neat.lipz");
    scene.prepare(&["pack", "--quiet"]);
    let before = fs::read(scene.path().join("out.lipzbank")).unwrap();
    let shown = lipz(scene.path(), ["convert", "--write-curves", "--check"]);
    assert_eq!(
        (shown.code, shown.stdout.replace('\\', "/").as_str()),
        (1, "voices/neat.lipz\nvoices/rough.lipz\n"),
        "{shown:?}"
    );
    let shown = lipz(scene.path(), ["convert", "--write-curves", "--diff"]);
    assert!(shown.code == 1 && shown.stdout.contains("+    \"nod\" "), "{shown:?}");
    assert_eq!(read(&scene, "voices/neat.lipz"), neat, "nothing is written");

    let said = lipz(scene.path(), WRITE);
    assert_eq!(said.code, 0, "{said:?}");
    let summary = said.stderr + &said.stdout;
    assert!(
        summary.contains("2 files with new curves, 1 unchanged") && summary.contains("nod in 2 files"),
        "{summary}"
    );
    let after = read(&scene, "voices/neat.lipz");
    assert!(after.contains("  \"curves\" :      {\n    \"anger\"") && after.contains("\"breath\""), "{after}");
    // In the rough file, the new curves follow its own, and nothing else changes.
    let rough = read(&scene, "voices/rough.lipz");
    let (head, tail) = ROUGH.split_at(ROUGH.find("},\"note\"").unwrap());
    assert!(rough.starts_with(&format!("{head},\"nod\":\"0:5 4:3 ")) && rough.ends_with(tail), "{rough}");

    let checked = lipz(scene.path(), ["check"]);
    assert!(
        checked.code == 0 && !checked.stderr.contains("LZ1811"),
        "a gesture that is written out is not hidden: {checked:?}"
    );
    scene.prepare(&["pack", "--quiet"]);
    assert!(fs::read(scene.path().join("out.lipzbank")).unwrap() == before, "the same bank");
    let again = lipz(scene.path(), ["convert", "--write-curves", "--check"]);
    assert!(again.code == 0 && again.stdout.is_empty(), "{again:?}");
}

#[test]
fn what_an_animator_wrote_stays() {
    let scene = scene("events");
    let own = ROUGH.replace("{\"jawOpen\"", "{\"nod\":\"0:5 2:9 4:5\",\"jawOpen\"");
    scene.write("voices/rough.lipz", &own);
    let said = lipz(scene.path(), ["convert", "--write-curves=nod", "--config", "face.keys=words", "--in-place"]);
    assert_eq!(said.code, 0, "{said:?}");
    assert_eq!(read(&scene, "voices/rough.lipz"), own);
    let neat = read(&scene, "voices/neat.lipz");
    assert!(neat.contains("\"nod\" : ") && !neat.contains("\"anger\"") && !neat.contains("\"breath\""), "{neat}");
}

#[test]
fn line_ends_are_those_of_the_file() {
    let scene = scene("events");
    let lines = "{ \"fps\": 24,\r\n\"visemes\": \"MAEOMAEOMAEOMAEO\", \"events\": \"shakes\" }\r\n";
    scene.write("voices/lines.lipz", lines);
    scene.write("voices/line.lipz", lines.replace("\r\n", ""));
    scene.prepare(&[&WRITE[..], &["--quiet"]].concat());
    let text = read(&scene, "voices/lines.lipz");
    assert!(text.contains("\"shake\"") && text.matches('\n').count() == text.matches("\r\n").count(), "{text}");
    let text = read(&scene, "voices/line.lipz");
    assert!(text.ends_with(" 14:5\" } }") && !text.contains('\n'), "{text}");
}

#[test]
fn standard_input_goes_to_standard_output() {
    let scene = scene("words");
    let made = with_input(scene.path(), &["convert", "-", "--write-curves"], ROUGH.as_bytes());
    let text = String::from_utf8(made.stdout).unwrap();
    assert!(made.status.success() && text.contains("\"nod\":"), "{text}");
    let same = with_input(scene.path(), &["convert", "-", "--write-curves"], text.as_bytes());
    assert_eq!(String::from_utf8(same.stdout).unwrap(), text);
}

#[test]
fn what_cannot_be_done_is_told_and_nothing_is_written() {
    let scene = scene("events");
    let none = lipz(scene.path(), ["convert", "--write-curves=nodd", "--in-place"]);
    assert!(none.code == 2 && none.stderr.contains("a curve `nodd`") && none.stderr.contains("nod"), "{none:?}");
    let little = lipz(scene.path(), write("voices/still.lipz", "--write-curves"));
    let all = little.stderr.clone() + &little.stdout;
    assert!(
        little.code == 0 && all.contains("hint: `--config face.keys=words` also generates gestures from texts"),
        "{little:?}"
    );
    scene.write("voices/bad.lipz", r#"{ "visemes": "M", "fps": 24, "curves": { "nod": "x" } }"#);
    let bad = lipz(scene.path(), WRITE);
    assert!(bad.code == 1 && bad.stderr.contains("LZ1801"), "{bad:?}");
    assert_eq!(read(&scene, "voices/neat.lipz"), NEAT, "nothing is written");
    let missing = lipz(scene.path(), write("nowhere", "--write-curves"));
    assert!(missing.code == 2 && missing.stderr.contains("nowhere"), "{missing:?}");
}

/// Generated curves in a file move the face as before: exactly at each frame, and nearly between frames.
#[test]
fn what_is_generated_can_be_edited() {
    let scene = scene("events");
    let line = format!(
        "{{ \"fps\": 24, \"viseme_type\": \"blair\", \"visemes\": \"{}\", \"curves\": {{ \"lids\": \"0:0 30:1 31:0\", \"eyeYaw\": \"0:3\" }} }}",
        "MAEO".repeat(60)
    );
    scene.write("voices/long.lipz", &line);
    scene.prepare(&["pack", "--quiet"]);
    let before = fs::read(scene.path().join("out.lipzbank")).unwrap();
    let names = ["blink", "headPitch", "headYaw", "headRoll", "eyePitch", "eyeYaw"];
    let curves = format!("--write-curves={}", names.join(","));
    let said = lipz(scene.path(), write("voices/long.lipz", &curves));
    assert!(said.code == 0 && said.stdout.contains("1 file with new curves"), "{said:?}");
    let written = read(&scene, "voices/long.lipz");
    assert!(written.contains("\"eyeYaw\": \"0:3\"") && written.contains("\"blink\""), "{written}");
    scene.prepare(&["pack", "--quiet"]);
    let after = fs::read(scene.path().join("out.lipzbank")).unwrap();
    let banks = [&before, &after].map(|bytes| Bank::open(bytes).unwrap().verify().unwrap());
    let clips = [0, 1].map(|bank: usize| banks[bank].clip_by_key("long").unwrap());
    let keys: u32 = names.iter().filter_map(|name| Some(clips[1].curve(*name)?.key_count())).sum();
    assert!((20..500).contains(&keys), "{keys} keys of 240 frames");
    let mut blinks = 0;
    for frame in 0..240_i64 {
        let shown = |bank: usize| {
            let profile = banks[bank].default_face_profile();
            let face =
                clips[bank].face_at(Micros((frame * 1_000_000 + 23) / 24), Who::Speaker, &profile, LookAt::AHEAD);
            [face.blink, face.head_pitch, face.head_yaw, face.head_roll, face.eye_pitch, face.eye_yaw]
        };
        let (generated, written) = (shown(0), shown(1));
        blinks += i32::from(generated[0].thousandths() > 500);
        for (place, (one, other)) in std::iter::zip(generated, written).enumerate() {
            let most = if place == 0 { 20 } else { 50 };
            assert!(
                one.thousandths().abs_diff(other.thousandths()) <= most,
                "{frame}, {}: {one} {other}",
                names[place]
            );
        }
    }
    assert!(blinks > 1, "the face moves");
    let now = read(&scene, "voices/long.lipz");
    let again = lipz(scene.path(), write("voices/long.lipz", &curves));
    assert!(again.code == 0 && read(&scene, "voices/long.lipz") == now, "{again:?}");
    // The curves of a character that the events name. Curves that are not generated for characters are not valid names.
    scene.write("voices/heard.lipz", line.replace("\"curves\"", "\"events\": \"mara nods\", \"curves\""));
    let said = lipz(scene.path(), write("voices/heard.lipz", "--write-curves=mara.blink,mara.eyeYaw"));
    assert!(said.code == 0 && said.stdout.contains("mara.blink in 1 file"), "{said:?}");
    scene.prepare(&["pack", "--quiet"]);
    let bytes = fs::read(scene.path().join("out.lipzbank")).unwrap();
    let bank = Bank::open(&bytes).unwrap().verify().unwrap();
    let (clip, profile) = (bank.clip_by_key("heard").unwrap(), bank.default_face_profile());
    let mut closed = 0;
    for frame in 0..240_i64 {
        let time = Micros((frame * 1_000_000 + 23) / 24);
        let generated = clip.face_at(time, "mara", &profile.without_curves(), LookAt::AHEAD);
        let shown = clip.face_at(time, "mara", &profile, LookAt::AHEAD);
        assert!(generated.blink.thousandths().abs_diff(shown.blink.thousandths()) <= 20, "{frame}");
        assert!(generated.eye_yaw.thousandths().abs_diff(shown.eye_yaw.thousandths()) <= 50, "{frame}");
        closed += i32::from(shown.blink.thousandths() > 500);
    }
    assert!(closed > 0);
    for (file, name) in
        [("voices/heard.lipz", "mara.headYaw"), ("voices/heard.lipz", "otto.blink"), ("voices/long.lipz", "mara.blink")]
    {
        let said = lipz(scene.path(), write(file, &format!("--write-curves={name}")));
        assert!(said.code == 2 && said.stderr.contains("do not produce a curve"), "{said:?}");
    }
    // Without a frame rate, nothing is generated.
    let said = lipz(scene.path(), write("voices/still.lipz", "--write-curves=blink"));
    assert!(said.code == 2 && said.stderr.contains("do not produce a curve `blink`"), "{said:?}");
}

/// `mara.old` has a `blink`; `mara` has no `old.blink`.
#[test]
fn a_name_may_have_dots() {
    let scene = scene("events");
    let events = "mara nods, mara.old nods";
    let clip = format!(r#"{{ "fps": 24, "visemes": "{}", "events": "{events}" }}"#, "MA".repeat(120));
    scene.write("voices/heard.lipz", clip);
    let said = lipz(scene.path(), write("voices/heard.lipz", "--write-curves=mara.old.blink"));
    assert!(said.code == 0 && said.stdout.contains("mara.old.blink in 1 file"), "{said:?}");
}
