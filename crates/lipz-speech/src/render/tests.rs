//! Tests of rendering.

use super::*;
use crate::{AlignedPhone, Phone};

/// Returns an alignment of phones with these lengths in milliseconds.
fn alignment(phones: &[(&str, u64)], breaks_ms: &[u64]) -> Alignment {
    let mut now_us = 0;
    let phones = phones.iter().map(|&(name, length_ms)| {
        let start_us = now_us;
        now_us += length_ms * 1_000;
        let phone: Phone = name.parse().unwrap();
        AlignedPhone { phone, start_us, end_us: now_us, word: phone.is_speech().then_some(0), fit: 0.0 }
    });
    let phones = phones.collect();
    let breaks_us = breaks_ms.iter().map(|ms| ms * 1_000).collect();
    Alignment { duration_us: now_us, phones, words: Vec::new(), breaks_us, mismatches: Vec::new() }
}

fn blair(phones: &[(&str, u64)]) -> String {
    let rules = RenderRules { lead_us: 0, ..RenderRules::default() };
    render(&alignment(phones, &[]), Fps::whole(24), VisemeType::Blair, &rules).frames
}

#[test]
fn each_phone_shows_its_shape() {
    assert_eq!(blair(&[("SIL", 250), ("L", 125), ("UW", 125), ("S", 125), ("SIL", 125)]), "------LLLUUUSSS---");
    assert_eq!(blair(&[("OY", 250), ("AY", 250), ("AW", 250), ("OW", 250)]), "OOOOEEAAAAEEAAAAOOOOOOUU");
    assert_eq!(blair(&[("HH", 125), ("IY", 125), ("HH", 125), ("OW", 80)]), "EEEEEEOOOOU");
}

#[test]
fn closed_lips_take_time_from_the_sound_before_them() {
    assert_eq!(blair(&[("AA", 250), ("B", 30), ("AA", 250)]), "AAAAAMMAAAAAA");
    assert_eq!(blair(&[("SIL", 250), ("P", 30), ("AA", 250)]), "-----MMAAAAAA");
    // Even if the lead cuts them off.
    let phones = alignment(&[("B", 30), ("AA", 250)], &[]);
    let mouth = render(&phones, Fps::whole(24), VisemeType::Blair, &RenderRules::default());
    assert_eq!(mouth.frames, "MMAAAA-");
    // If there is nothing before them, or nothing to spare, time comes from the phone after them.
    assert_eq!(blair(&[("B", 30), ("AA", 250)]), "MMAAAAA");
    assert_eq!(blair(&[("B", 83), ("F", 30), ("AA", 250)]), "MMFFAAAAA");
}

#[test]
fn a_short_vowel_is_visible_between_closed_lips() {
    assert_eq!(blair(&[("AA", 250), ("B", 60), ("IH", 60), ("M", 60), ("IY", 250)]), "AAAAAMMEMMEEEEEE-");
    // Unless closed lips would not be.
    assert_eq!(blair(&[("B", 60), ("IH", 60), ("M", 60), ("SIL", 20)]), "MMMM-");
}

#[test]
fn other_consonants_stay_as_long_if_that_is_wanted() {
    let held = |phones: &[(&str, u64)]| {
        let rules = RenderRules { lead_us: 0, hold_consonants: true, ..RenderRules::default() };
        render(&alignment(phones, &[]), Fps::whole(24), VisemeType::Blair, &rules).frames
    };
    let phones = [("AA", 250), ("T", 30), ("AA", 250), ("L", 42), ("IY", 250)];
    assert_eq!(blair(&phones), "AAAAAASAAAAAALEEEEEE");
    assert_eq!(held(&phones), "AAAAASSAAAAALLEEEEEE");
    // Vowels keep some time, and closed lips have priority.
    let phones = [("T", 30), ("IY", 120), ("T", 30), ("B", 30), ("AA", 250)];
    let frames = held(&phones);
    assert!(frames.contains("MM") && frames.contains('S') && frames.contains('E'), "{frames}");
}

#[test]
fn closed_lips_last_two_frames_in_the_fastest_speech() {
    for length_ms in 55..120 {
        let phones: Vec<(&str, u64)> = ["T", "AH", "B", "AH", "L", "V", "IY", "M", "IH", "S", "P", "AH", "D"]
            .into_iter()
            .map(|name| (name, length_ms))
            .collect();
        let frames = blair(&phones);
        let runs: Vec<&[u8]> = frames.as_bytes().chunk_by(|a, b| a == b).collect();
        let closed: Vec<_> = runs.iter().filter(|run| matches!(run[0], b'M' | b'F')).collect();
        assert_eq!(closed.len(), 4, "{length_ms}: {frames}");
        assert!(closed.iter().all(|run| run.len() >= 2), "{length_ms}: {frames}");
    }
}

#[test]
fn a_vowel_shorter_than_a_frame_does_not_open_the_mouth_wide() {
    assert!(!blair(&[("T", 100), ("AE", 40), ("T", 100), ("AY", 40), ("T", 100)]).contains('A'));
}

#[test]
fn the_mouth_leads_and_segments_start_with_their_word() {
    let phones = [("SIL", 500), ("AA", 500), ("SIL", 500), ("IY", 500)];
    let mouth = render(&alignment(&phones, &[1_500]), Fps::whole(24), VisemeType::Blair, &RenderRules::default());
    assert_eq!(mouth.frames, format!("{}{}{}{}", "-".repeat(11), "A".repeat(12), "-".repeat(12), "E".repeat(12)) + "-");
    assert_eq!(mouth.segment_starts, [0, 35]);
    assert_eq!(mouth.visemes().find('|'), Some(35));
    assert_eq!(mouth.visemes().replace('|', ""), mouth.frames);
}

#[test]
fn breaks_at_the_ends_and_in_one_place_make_empty_segments() {
    let mouth = render(
        &alignment(&[("AA", 250)], &[0, 0, 9_000, 9_000]),
        Fps::whole(24),
        VisemeType::Blair,
        &RenderRules { lead_us: 0, ..RenderRules::default() },
    );
    assert_eq!(mouth.visemes(), "||AAAAAA||");
}

#[test]
fn every_shape_has_a_code_in_every_type() {
    let phones: Vec<(&str, u64)> = Phone::ALL.iter().map(|phone| (phone.name(), 200)).collect();
    for viseme_type in VisemeType::ALL {
        for fps in [Fps::whole(1), Fps::whole(12), Fps::whole(24), Fps::whole(60), Fps::whole(1000)] {
            let mouth = render(&alignment(&phones, &[]), fps, viseme_type, &RenderRules::default());
            assert!(viseme_type.contains_all(mouth.frames.as_bytes()));
            assert_eq!(mouth.frames.len(), frames::count(phones.len() as u64 * 200_000, fps));
        }
    }
}
