//! Hums and held vowels: the mouth keeps the shape of the sound for as long as it lasts, and only texts without a
//! drawn-out word are reported.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::f64::consts::PI;
use std::fs;
use support::sound::wav;
use support::{Scene, lipz};

const RATE: u32 = 16_000;

/// Returns a sound of a second and a half between pauses: the pulses of a voice, through the resonances of a vocal tract,
/// each a frequency and a bandwidth in hertz (source and filter: G. Fant, "Acoustic theory of speech production", 1960).
fn held(voice_hz: f64, resonances: &[(f64, f64)]) -> Vec<i16> {
    let rate = f64::from(RATE);
    let count = 24_000;
    let mut samples = vec![0.0; count];
    let mut phase = 0.0;
    let mut tilt = 0.0;
    for (at, sample) in samples.iter_mut().enumerate() {
        // A voice is never perfectly even.
        phase += voice_hz * (1.0 + 0.01 * (at as f64 / 700.0).sin()) / rate;
        let pulse = if phase >= 1.0 { 1.0 } else { 0.0 };
        phase -= pulse;
        tilt = 0.95 * tilt + pulse;
        *sample = tilt;
    }
    for (frequency, bandwidth) in resonances {
        let radius = (-PI * bandwidth / rate).exp();
        let turn = 2.0 * radius * (2.0 * PI * frequency / rate).cos();
        let mut last = [0.0; 2];
        for sample in &mut samples {
            let now = (1.0 - turn + radius * radius) * *sample + turn * last[0] - radius * radius * last[1];
            (*sample, last) = (now, [now, last[0]]);
        }
    }
    let most = samples.iter().fold(0.0, |most: f64, sample| most.max(sample.abs()));
    let mut noise = 1_u32;
    let mut faint = || {
        noise = noise.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(noise >> 16) / 65_536.0 * 20.0 - 10.0
    };
    let pause = vec![0.0; 6_400];
    let voiced = samples.iter().enumerate().map(|(at, sample)| {
        let edge = at.min(count - at) as f64 / 800.0;
        sample / most * 9_000.0 * edge.min(1.0)
    });
    let all = pause.iter().copied().chain(voiced).chain(pause.iter().copied());
    #[allow(clippy::cast_possible_truncation, reason = "within 16 bits")]
    all.map(|sample| (sample + faint()) as i16).collect()
}

/// The resonances of sounds. Vowels: G. Peterson and H. Barney, "Control methods used in a study of the vowels", 1952.
const NASAL: [(f64, f64); 3] = [(250.0, 60.0), (1100.0, 300.0), (2200.0, 400.0)];
const OOH: [(f64, f64); 3] = [(300.0, 60.0), (870.0, 90.0), (2240.0, 150.0)];
const AAH: [(f64, f64); 3] = [(730.0, 90.0), (1090.0, 110.0), (2440.0, 160.0)];

const SETTINGS: &str = "sources = [\"voices\"]\nroot = \"voices\"\ndefault-locale = \"en-us\"\ndefault-fps = 24\n\n[audio]\nfolder = \"rec\"\n";

#[test]
fn mouths_hold_the_shape_of_a_drawn_out_sound() {
    let scene = Scene::new();
    scene.write("lipz.toml", SETTINGS);
    let sounds = [
        ("hum", "Mmmm.", 'M', held(120.0, &NASAL)),
        ("ooh", "Ooooh!", 'U', held(200.0, &OOH)),
        ("aah", "Aaaah!", 'A', held(140.0, &AAH)),
    ];
    for (name, text, ..) in &sounds {
        scene.write(&format!("voices/{name}.lipz"), format!("{{ \"text_en-us\": \"{text}\" }}"));
    }
    for (name, _, _, samples) in &sounds {
        scene.write(&format!("rec/{name}.wav"), wav(RATE, samples));
    }
    let synced = lipz(scene.path(), ["sync"]);
    assert_eq!((synced.code, synced.stderr.as_str()), (0, ""));
    assert_eq!(lipz(scene.path(), ["check", "--quiet"]).stderr, "");
    for (name, _, code, _) in sounds {
        let file = fs::read_to_string(scene.path().join(format!("voices/{name}.lipz"))).unwrap();
        let document = lipz_file::parse(file.as_bytes()).document.unwrap();
        let visemes = document.string("visemes").unwrap().to_owned();
        let held = visemes.chars().filter(|found| *found == code).count();
        assert!(held >= 33 && visemes.trim_matches('-').chars().all(|found| found == code), "{name}: {visemes}");
    }
}

/// The tolerance applies only to drawn-out words. Three equal letters do not always make one.
#[test]
fn words_that_are_not_drawn_out_do_not_fit_a_held_sound() {
    let scene = Scene::new();
    scene.write("lipz.toml", SETTINGS);
    let texts = [("words", "Good evening, everyone."), ("numeral", "VIII."), ("compound", "Schifffahrt!")];
    for (name, text) in texts {
        scene.write(&format!("voices/{name}.lipz"), format!("{{ \"text_en-us\": \"{text}\" }}"));
        scene.write(&format!("rec/{name}.wav"), wav(RATE, &held(140.0, &AAH)));
    }
    let synced = lipz(scene.path(), ["sync"]);
    for (name, _) in texts {
        let is_reported = synced.stderr.contains(&format!(" --> voices/{name}.lipz"));
        assert!(is_reported && synced.stderr.contains("LZ1707"), "{name}: {}", synced.stderr);
    }
}

/// A limit of the lip sync (docs/inside/lip-sync-log.md): the fit of a held sound does not show whether it is the wrong
/// one. If it ever does, expect LZ1707 here.
#[test]
fn a_wrong_held_sound_is_not_detected() {
    let scene = Scene::new();
    scene.write("lipz.toml", SETTINGS);
    scene.write("voices/hum.lipz", r#"{ "text_en-us": "Mmmm." }"#);
    scene.write("rec/hum.wav", wav(RATE, &held(140.0, &AAH)));
    let synced = lipz(scene.path(), ["sync"]);
    assert_eq!((synced.code, synced.stderr.as_str()), (0, ""));
}
