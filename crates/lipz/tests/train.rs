//! `lipz sync --train`: models trained on the project's own voices.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use support::sound::{voice, wav};
use support::{Scene, lipz, repository};

const TEXT: &str = "Bobby ripped the ledger. Bobby ripped the ledger. Bobby ripped the ledger.";

/// Returns the recording of a human voice three times, separated by silence, a fifth slower and deeper. Takes differ in
/// their level.
fn three_bobbies(take: i16) -> Vec<u8> {
    let file = fs::read(repository().join("fixtures/speech/bobby.wav")).unwrap();
    let data = file.windows(4).position(|window| window == b"data").unwrap() + 8;
    // Every second sample of 48,000 Hz, as if the rate were 20,000 Hz.
    let samples = file[data..].chunks_exact(2).step_by(2).map(|two| i16::from_le_bytes([two[0], two[1]]));
    let once: Vec<i16> = samples.map(|sample| sample / 20 * (20 - take)).chain([0; 6_000]).collect();
    wav(20_000, &once.repeat(3))
}

/// Returns a project with this number of recordings of that voice.
fn project(recordings: i16) -> Scene {
    let scene = Scene::new();
    for take in 0..recordings {
        scene.write(&format!("rec/{take}.wav"), three_bobbies(take));
        scene.write(&format!("rec/{take}.txt"), TEXT);
    }
    scene
}

/// Runs `lipz sync` on its recordings. Returns the exit code, the lines of the output and the diagnostics.
fn sync(scene: &Scene, output: &str, arguments: &[&str]) -> (i32, Vec<String>, String) {
    let run = lipz(
        scene.path(),
        ["sync", "rec", "-o", output, "--config", "audio.locale=en-us", "--fps", "60"].iter().chain(arguments),
    );
    (run.code, run.stdout.lines().take(2).map(str::to_owned).collect(), run.stderr)
}

#[test]
fn a_model_is_learnt_used_and_kept_while_it_is_current() {
    let mut scene = project(9);
    scene.write("rec/other.wav", three_bobbies(1));
    scene.write("rec/other.txt", "Seven foxes jumped over my old wooden fence, and nobody knew why they did that.");
    let (code, told, found) = sync(&scene, "plain", &[]);
    assert_eq!((code, told[0].as_str()), (0, "10 clips synced, in plain"), "{found}");
    let train = ["--train", "--config", "sync.model=Stimmen der Burg/bobby.lipzmodel", "--allow", "LZ1707"];
    let (code, told, found) = sync(&scene, "voices", &[&train[..], &["--jobs", "1"]].concat());
    assert_eq!((code, found.as_str()), (0, ""));
    let learnt = "model trained on 0.6 minutes of English in 9 recordings (1 left out, because they do not match their \
                  texts), in Stimmen der Burg/bobby.lipzmodel";
    assert_eq!(told, [learnt, "10 clips synced, in voices"]);
    let model = fs::read(scene.path().join("Stimmen der Burg/bobby.lipzmodel")).unwrap();
    let mouth = |folder: &str| -> Vec<String> {
        let read = |take| fs::read_to_string(scene.path().join(format!("{folder}/{take}.lipz"))).unwrap();
        (0..9).map(read).collect()
    };
    assert_ne!(mouth("plain"), mouth("voices"), "the model must change the visemes");
    // Again: nothing to learn or to make. Without --train, the model is still used.
    let told = sync(&scene, "voices", &train).1;
    let current = "the model in Stimmen der Burg/bobby.lipzmodel is up to date: 0.6 minutes of English in 9 recordings";
    assert_eq!(told, [current, "0 clips synced, 10 unchanged, in voices"]);
    let told = sync(&scene, "voices", &train[1..]).1;
    assert_eq!(told[0], "0 clips synced, 10 unchanged, in voices");
    let made = mouth("voices");
    let told = sync(&scene, "voices", &train[3..]).1;
    assert_eq!(told[0], "10 clips synced, in voices", "a different model makes different visemes");
    assert_eq!(mouth("voices"), mouth("plain"));
    // An additional recording changes the model. Without it, the model is the first one again, with any number of
    // threads, and over a damaged file.
    scene.write("rec/9.wav", three_bobbies(9));
    scene.write("rec/9.txt", TEXT);
    assert!(sync(&scene, "voices", &train).1[0].contains("in 10 recordings (1 left out"));
    fs::remove_file(scene.path().join("rec/9.wav")).unwrap();
    scene.write("Stimmen der Burg/bobby.lipzmodel", &model[..model.len() / 2]);
    let told = sync(&scene, "voices", &[&train[..], &["--jobs", "3"]].concat()).1;
    assert_eq!(told, [learnt, "10 clips synced, in voices"]);
    assert!(fs::read(scene.path().join("Stimmen der Burg/bobby.lipzmodel")).unwrap() == model);
    assert_eq!(mouth("voices"), made);
    let italian = ["sync", "rec", "-o", "voci", "--config", "audio.locale=it-it"];
    scene.expect("LZ1718-unusable-model-other-language", &[&italian[..], &train[1..3]].concat());
    scene.finish(1);
}

#[test]
fn what_is_no_model_and_too_little_speech_are_reported() {
    let mut scene = project(2);
    scene.write("rec/buzz.wav", voice(&[(false, 300), (true, 3_000)], 1));
    scene.write("rec/buzz.txt", "Who goes there? Answer me, or I shall call the guards of the city at once.");
    let run = |scene: &mut Scene, name: &str, arguments: &[&str]| {
        scene.expect(name, &[&["sync", "rec", "-o", "voices", "--allow", "LZ1707"][..], arguments].concat());
    };
    let english = ["--config", "audio.locale=en-us", "--config", "sync.model=m.lipzmodel"];
    run(&mut scene, "LZ1719-too-little-speech", &[&english[..], &["--train"]].concat());
    assert!(!scene.path().join("m.lipzmodel").exists() && !scene.path().join("voices").exists());
    scene.write("m.lipzmodel", "my notes");
    run(&mut scene, "LZ1718-unusable-model-other-file", &english);
    run(&mut scene, "LZ1718-unusable-model-not-replaced", &[&english[..], &["--train"]].concat());
    assert_eq!(fs::read(scene.path().join("m.lipzmodel")).unwrap(), b"my notes");
    scene.write("m.lipzmodel", "LIPZ-TM1 and so on");
    run(&mut scene, "LZ1718-unusable-model", &english);
    run(&mut scene, "LZ1601-usage-train-no-model", &["--config", "audio.locale=en-us", "--train"]);
    run(
        &mut scene,
        "LZ1718-unusable-model-missing",
        &["--config", "audio.locale=en-us", "--config", "sync.model=nowhere.lipzmodel"],
    );
    scene.finish(6);
}
