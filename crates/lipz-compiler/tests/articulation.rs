//! Phones and articulation: from the element of a file to the mouth at a time.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_bank::articulation::{Articulation, Articulator};
use lipz_bank::{Bank, Clip, Micros, Samples, Seconds};
use lipz_compiler::{Compiler, Documents, Input};
use lipz_testkit::dialogue;

/// Returns the bank of one clip, `a`, with this content.
fn bank(content: &str) -> Vec<u8> {
    Compiler::default().compile(&[Input::from_bytes("a", content)]).into_bank().unwrap()
}

/// Calls `test` with the clip of a bank.
fn with<R>(bank: &[u8], test: impl FnOnce(&Bank<'_>, Clip<'_>) -> R) -> R {
    let bank = Bank::open(bank).unwrap().verify().unwrap();
    test(&bank, bank.clip_by_key("a").unwrap())
}

fn at(bank: &Bank<'_>, clip: &Clip<'_>, ms: i64) -> Articulation {
    clip.articulation_at(Micros(ms * 1000), &bank.default_articulation())
}

const MAMA: &str = r#"{ "fps": 24, "visemes": "------------------------", "phones":
    "sil@0 M@200 AA@280 M@420 AA@500 sil@700" }"#;

#[test]
fn closed_lips_close_and_vowels_open() {
    with(&bank(MAMA), |bank, clip| {
        for m in [200, 230, 259, 420, 450, 479] {
            let mouth = at(bank, &clip, m);
            assert_eq!(mouth.thousandths(Articulator::Opening), 0, "{m} ms: {mouth:?}");
            assert_eq!(mouth.thousandths(Articulator::Closure), 1000, "{m} ms: {mouth:?}");
            // The jaw stays open behind closed lips.
            assert!(mouth.thousandths(Articulator::Jaw) > 200, "{m} ms: {mouth:?}");
        }
        for vowel in [350, 620] {
            let mouth = at(bank, &clip, vowel);
            assert!(mouth.thousandths(Articulator::Opening) > 500, "{vowel} ms: {mouth:?}");
            assert_eq!(mouth.thousandths(Articulator::Closure), 0, "{vowel} ms: {mouth:?}");
        }
    });
}

#[test]
fn the_mouth_rests_outside_of_speech() {
    with(&bank(MAMA), |bank, clip| {
        let rest = at(bank, &clip, -5000);
        for ms in [-1, 0, 30, 900, 1_000_000] {
            assert_eq!(at(bank, &clip, ms), rest, "{ms} ms");
        }
        assert!(rest.thousandths(Articulator::Jaw) < 100 && rest.thousandths(Articulator::Closure) == 0);
    });
}

#[test]
fn nothing_jumps() {
    with(&bank(MAMA), |bank, clip| {
        let mut before = at(bank, &clip, -200);
        for ms in -199..1200 {
            let now = at(bank, &clip, ms);
            for (old, new) in before.values().iter().zip(now.values()) {
                // The fastest ramp takes 45 ms.
                assert!(old.abs_diff(*new) <= 45, "{ms} ms: {before:?} {now:?}");
            }
            before = now;
        }
    });
}

#[test]
fn every_unit_of_time_leads_to_the_same_mouth() {
    with(&bank(MAMA), |bank, clip| {
        let profile = bank.default_articulation();
        for ms in (0..800).step_by(25) {
            let expected = clip.articulation_at(Micros(ms * 1000), &profile);
            let samples = Samples { position: ms * 48, rate_hz: 48_000 };
            assert_eq!(clip.articulation_at(samples, &profile), expected, "{ms} ms");
            assert_eq!(clip.articulation_at(Seconds(ms as f64 / 1000.0), &profile), expected, "{ms} ms");
        }
    });
}

#[test]
fn late_times_take_five_bytes_and_change_nothing() {
    let visemes = "-".repeat(24 * 80);
    let late = |offset: u32, first: &str| {
        let phones = format!("{first}M@{} AA@{} sil@{}", 200 + offset, 280 + offset, 420 + offset);
        bank(&format!(r#"{{ "fps": 24, "visemes": "{visemes}", "phones": "{phones}" }}"#))
    };
    let (early, late) = (late(0, "sil@0 "), late(70_000, "sil@0 "));
    let values = |bank: &[u8], offset: i64| {
        with(bank, |bank, clip| (0..600).map(|ms| at(bank, &clip, ms + offset)).collect::<Vec<_>>())
    };
    assert_eq!(values(&early, 0), values(&late, 70_000));
}

#[test]
fn guessed_phones_are_blended_and_not_enforced() {
    let guessed = MAMA.replace("sil@0", "guessed sil@0");
    with(&bank(&guessed), |bank, clip| {
        assert!(!clip.phones().are_certain());
        let mouth = at(bank, &clip, 450);
        assert!(mouth.thousandths(Articulator::Opening) > 0 && mouth.thousandths(Articulator::Closure) < 1000);
    });
}

#[test]
fn louder_lines_open_wider() {
    let opening = |level: &str| {
        let content = MAMA.replace("sil@0", &format!("{level}sil@0"));
        with(&bank(&content), |bank, clip| at(bank, &clip, 350).thousandths(Articulator::Opening))
    };
    let [soft, usual, none, loud] = ["-30dB ", "-20dB ", "", "-16dB "].map(opening);
    assert!(soft < usual && usual == none && usual < loud, "{soft} {usual} {none} {loud}");
}

#[test]
fn a_curve_replaces_what_is_computed() {
    let content = MAMA.replace("\"phones\"", "\"curves\": { \"jaw\": \"0:0.25 23:0.25\" }, \"phones\"");
    with(&bank(&content), |bank, clip| {
        for ms in [0, 230, 350, 900] {
            assert_eq!(at(bank, &clip, ms).thousandths(Articulator::Jaw), 250, "{ms} ms");
        }
    });
}

#[test]
fn clips_without_phones_answer_from_their_shapes() {
    for (viseme_type, visemes, [closed, open]) in [("blair", "--MMAAAA--", [2, 5]), ("toonboom", "--AADDDD--", [2, 5])]
    {
        let content = format!(r#"{{ "fps": 24, "viseme_type": "{viseme_type}", "visemes": "{visemes}" }}"#);
        with(&bank(&content), |bank, clip| {
            assert!(clip.phones().is_empty());
            let at_frame = |frame: i64| at(bank, &clip, frame * 1000 / 24 + 21);
            assert_eq!(at_frame(closed).thousandths(Articulator::Closure), 1000, "{viseme_type}");
            assert!(at_frame(open).thousandths(Articulator::Opening) > 500, "{viseme_type}");
        });
    }
    let content = r#"{ "fps": 24, "viseme_type": "rms", "visemes": "--999999--" }"#;
    with(&bank(content), |bank, clip| {
        assert!(at(bank, &clip, 200).thousandths(Articulator::Jaw) > 600);
    });
}

#[test]
fn phones_survive_a_round_trip_as_written() {
    for phones in ["sil@0 DH@191 AH@232", "guessed -21dB sil@0 y@70 ɛ̃@90", "  sil@0   b@5  ", "SIL@0 ð@70000"] {
        let content = format!("{{ \"fps\": 24, \"visemes\": \"{}\", \"phones\": \"{phones}\" }}", "-".repeat(2400));
        let packed = bank(&content);
        dialogue!(restored = &packed);
        let documents = Documents::from_dialogue(&restored).unwrap();
        let (_, document) = documents.iter().next().unwrap().unwrap();
        assert_eq!(document.string("phones"), Some(phones));
    }
}

#[test]
fn a_profile_has_its_own_targets() {
    let settings =
        "[articulation.phones]\nM = \"jaw 0\"\n[articulation.otto.phones]\nAA = \"opening 20, rounding 80\"\n";
    let settings = lipz_compiler::settings::Settings::parse(settings, "", "").unwrap();
    let packed = Compiler::new(settings.options).compile(&[Input::from_bytes("a", MAMA)]).into_bank().unwrap();
    with(&packed, |own, clip| {
        let of = |profile: &str, ms: i64, articulator| {
            let profile = own.articulation(profile).unwrap_or(own.default_articulation());
            clip.articulation_at(Micros(ms * 1000), &profile).thousandths(articulator)
        };
        let vowel = |name, articulator| of(name, 620, articulator);
        assert!(vowel("otto", Articulator::Opening) < 300 && vowel("default", Articulator::Opening) > 700);
        assert!(vowel("otto", Articulator::Rounding) > 600 && vowel("default", Articulator::Rounding) < 200);
        assert_eq!(vowel("otto", Articulator::Jaw), vowel("default", Articulator::Jaw), "what it does not set");
        with(&bank(MAMA), |usual, clip| {
            let jaw = clip.articulation_at(Micros(450_000), &usual.default_articulation());
            assert!(of("otto", 450, Articulator::Jaw) < jaw.thousandths(Articulator::Jaw), "the project's own");
        });
    });
}
