//! Alignment of a human voice, from the audio file to the lip-sync track.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "tests")]

use lipz_speech::{
    AlignOptions, Aligner, Alignment, Language, MismatchKind, Model, Phone, Pronouncer, RenderRules, Sound, render,
};
use lipz_types::{Fps, VisemeType};

const BOBBY: &[u8] = include_bytes!("../../../fixtures/speech/bobby.wav");
/// The starts and ends of its words, in milliseconds, annotated by a phonetician.
const WORDS_MS: [(u64, u64); 4] = [(65, 412), (412, 658), (658, 741), (741, 1_117)];

fn align(sound: &Sound, text: &str) -> Alignment {
    let script = Pronouncer::new(Language::ENGLISH).script(text);
    Aligner::new(Model::english(), AlignOptions::default()).align(sound, &script)
}

fn bobby() -> Sound {
    Sound::from_bytes(BOBBY, Some("wav")).unwrap()
}

/// Returns the recording three times, with half a second of silence in between.
fn three_bobbies() -> Sound {
    let samples = samples();
    let silence = vec![0.0; 24_000];
    Sound::from_samples(&[&samples[..], &silence, &samples, &silence, &samples].concat(), 48_000).unwrap()
}

/// Returns the samples of the recording, which has 16-bit samples at 48,000 per second.
fn samples() -> Vec<f32> {
    let data = BOBBY.windows(4).position(|window| window == b"data").unwrap() + 8;
    BOBBY[data..].chunks_exact(2).map(|two| f32::from(i16::from_le_bytes([two[0], two[1]])) / 32_768.0).collect()
}

#[test]
fn words_are_where_a_phonetician_hears_them() {
    let alignment = align(&bobby(), "Bobby ripped | the ledger.");
    assert_eq!(alignment.words.len(), 4);
    for (word, (start_ms, end_ms)) in alignment.words.iter().zip(WORDS_MS) {
        assert!(word.start_us.abs_diff(start_ms * 1_000) < 70_000, "{word:?} {start_ms}");
        assert!(word.end_us.abs_diff(end_ms * 1_000) < 80_000, "{word:?} {end_ms}");
        assert!(word.confidence > 0.7, "{word:?}");
    }
    assert_eq!(alignment.breaks_us, [alignment.words[2].start_us]);
    assert!(alignment.mismatches.is_empty());
}

/// A tape that runs slower or faster changes the size of the vocal tract, the pitch and the speed.
#[test]
fn voices_of_giants_and_children_match_their_scripts() {
    for (rate_hz, percent) in [(36_000, 133), (62_000, 77)] {
        let sound = Sound::from_samples(&samples(), rate_hz).unwrap();
        let alignment = align(&sound, "Bobby ripped the ledger.");
        assert_eq!(alignment.mismatches, [], "{rate_hz}");
        for (word, (start_ms, end_ms)) in alignment.words.iter().zip(WORDS_MS) {
            assert!(word.start_us.abs_diff(start_ms * percent * 10) < 90_000, "{rate_hz}: {word:?} {start_ms}");
            assert!(word.end_us.abs_diff(end_ms * percent * 10) < 110_000, "{rate_hz}: {word:?} {end_ms}");
            assert!(word.confidence > 0.5, "{rate_hz}: {word:?}");
        }
    }
}

/// Twenty seconds of silence on either side, or a faint noise, are no part of a line.
#[test]
fn silence_around_a_line_changes_nothing_in_it() {
    // The first 150 milliseconds of silence belong to the line.
    let line = [vec![0.0; 7_200], samples(), vec![0.0; 7_200]].concat();
    let visemes = |seconds: usize, noise: f32| {
        let silence: Vec<f32> =
            (0..seconds * 48_000).map(|at| noise * ((at * 7_919 % 1_013) as f32 / 506.0 - 1.0)).collect();
        let sound = Sound::from_samples(&[&silence[..], &line, &silence].concat(), 48_000).unwrap();
        let alignment = align(&sound, "Bobby ripped the ledger.");
        assert_eq!(alignment.mismatches, []);
        let mouth = render(&alignment, Fps::whole(24), VisemeType::Blair, &RenderRules::default()).frames;
        let (before, rest) = mouth.split_at(seconds * 24);
        let (inside, after) = rest.split_at(rest.len() - seconds * 24);
        assert!(before.bytes().chain(after.bytes()).all(|code| code == b'-'), "{mouth}");
        inside.to_owned()
    };
    let plain = visemes(0, 0.0);
    for (seconds, noise) in [(2, 0.0), (20, 0.0), (2, 0.000_5), (20, 0.000_5)] {
        assert_eq!(visemes(seconds, noise), plain, "{seconds} {noise}");
    }
}

#[test]
fn a_silent_recording_rests_whatever_its_text() {
    let alignment = align(&Sound::from_samples(&[0.0; 48_000], 16_000).unwrap(), "Bobby | ripped the ledger.");
    let mouth = render(&alignment, Fps::whole(24), VisemeType::Blair, &RenderRules::default());
    assert_eq!(mouth.frames, "-".repeat(72));
    assert!(alignment.words.iter().all(|word| word.pronunciation.is_none()));
}

#[test]
fn phones_cover_the_sound_without_gaps() {
    let alignment = align(&bobby(), "Bobby ripped the ledger.");
    let mut end_us = 0;
    for phone in &alignment.phones {
        assert_eq!(phone.start_us, end_us);
        assert!(phone.end_us > phone.start_us && phone.fit <= 0.0, "{phone:?}");
        end_us = phone.end_us;
    }
    assert_eq!(end_us, bobby().duration_us());
    let phones: Vec<Phone> =
        alignment.phones.iter().map(|phone| phone.phone).filter(|phone| phone.is_speech()).collect();
    let names = phones.iter().map(Phone::to_string).collect::<Vec<_>>().join(" ");
    assert!(names.starts_with("B AA B IY R IH P T DH"), "{names}");
}

#[test]
fn the_mouth_closes_for_b_and_p() {
    let alignment = align(&bobby(), "Bobby ripped the ledger.");
    let mouth = render(&alignment, Fps::whole(24), VisemeType::Blair, &RenderRules::default());
    assert_eq!(mouth.frames.len(), 29);
    let closed = mouth.frames.as_bytes().chunk_by(|a, b| a == b).filter(|run| run[0] == b'M');
    let closed: Vec<usize> = closed.map(<[u8]>::len).collect();
    assert_eq!(closed.len(), 3, "{}", mouth.frames);
    assert!(closed.iter().all(|&frames| frames >= 2), "{}", mouth.frames);
}

#[test]
fn the_mouth_moves_for_what_the_script_does_not_say() {
    let alignment = align(&three_bobbies(), "Bobby ripped the ledger. Bobby ripped the ledger.");
    let mouth = render(&alignment, Fps::whole(24), VisemeType::Blair, &RenderRules::default()).frames;
    let length_ms = samples().len() / 48;
    for number in 0..3 {
        let start_ms = number * (length_ms + 500);
        let said = &mouth[start_ms * 24 / 1_000 + 2..(start_ms + length_ms) * 24 / 1_000 - 4];
        let still = said.bytes().filter(|&shape| shape == b'-').count();
        assert!(still == 0 && said.contains("MM"), "{number}: {said}, {mouth}");
    }
    assert_eq!(alignment.mismatches.len(), 1, "it is told all the same: {:?}", alignment.mismatches);
    assert!(alignment.phones.iter().all(|phone| phone.end_us > phone.start_us));
}

#[test]
fn the_volume_makes_no_difference() {
    let quiet: Vec<f32> = samples().iter().map(|sample| sample / 16.0).collect();
    let (loud, quiet) = (align(&bobby(), "Bobby ripped the ledger."), {
        align(&Sound::from_samples(&quiet, 48_000).unwrap(), "Bobby ripped the ledger.")
    });
    for (loud, quiet) in loud.words.iter().zip(&quiet.words) {
        assert!(loud.start_us.abs_diff(quiet.start_us) <= 10_000, "{loud:?} {quiet:?}");
    }
}

#[test]
fn a_sentence_that_is_not_said_is_told_with_its_place() {
    let text = "Bobby ripped the ledger. Seven foxes jumped over my old wooden fence. Bobby ripped the ledger. \
        Bobby ripped the ledger.";
    let [found] = &align(&three_bobbies(), text).mismatches[..] else { panic!("one") };
    assert_eq!(found.kind, MismatchKind::NotSaid);
    assert!((4..=5).contains(&found.words.start) && (11..=13).contains(&found.words.end), "{found:?}");
    assert!((1_000_000..2_000_000).contains(&found.start_us), "{found:?}");
}

#[test]
fn a_sentence_that_is_not_in_the_script_is_told_with_its_time() {
    let [found] = &align(&three_bobbies(), "Bobby ripped the ledger. Bobby ripped the ledger.").mismatches[..] else {
        panic!("one")
    };
    assert_eq!(found.kind, MismatchKind::NotInScript);
    assert!(found.end_us - found.start_us > 700_000, "{found:?}");
}

#[test]
fn another_sentence_is_told() {
    let other = align(&bobby(), "Seven foxes jumped.");
    assert!(!other.mismatches.is_empty());
    assert!(other.words.iter().all(|word| word.confidence < 0.5), "{other:?}");
}

#[test]
fn without_a_script_most_phones_are_found() {
    let aligner = Aligner::new(Model::english(), AlignOptions::default());
    let alignment = aligner.listen(&bobby());
    assert_eq!(alignment.phones.last().unwrap().end_us, bobby().duration_us());
    let scripted = align(&bobby(), "Bobby ripped the ledger.");
    let at = |alignment: &Alignment, time_us| {
        let phone = alignment.phones.iter().find(|phone| phone.end_us > time_us).unwrap().phone;
        if phone.is_vowel() { Phone::Ah } else { phone }
    };
    let times_us = (0..bobby().duration_us()).step_by(10_000);
    let same = times_us.clone().filter(|&time_us| at(&alignment, time_us) == at(&scripted, time_us)).count();
    assert!(same * 2 > times_us.count(), "{same} of the hundredths of a second: {alignment:?}");
    assert!(aligner.listen(&Sound::from_samples(&[0.0; 16_000], 16_000).unwrap()).phones.len() == 1);
}

#[test]
fn nothing_is_too_short_or_too_empty() {
    for samples in [vec![0.0; 1], vec![0.0; 160], vec![0.5; 1_000], vec![0.0; 48_000]] {
        let sound = Sound::from_samples(&samples, 16_000).unwrap();
        for text in ["", "Bobby ripped the ledger.", "|||", "Hm"] {
            let alignment = align(&sound, text);
            assert_eq!(alignment.phones.last().unwrap().end_us, sound.duration_us(), "{text}");
            let mouth = render(&alignment, Fps::whole(30), VisemeType::ToonBoom, &RenderRules::default());
            assert_eq!(mouth.visemes().matches('|').count(), text.matches('|').count());
        }
    }
}

/// The bytes of a lip-sync track must not change by accident on any machine.
#[test]
fn the_bytes_are_the_same_on_every_machine() {
    let alignment = align(&bobby(), "Bobby ripped the ledger.");
    let mouth = render(&alignment, Fps::whole(24), VisemeType::Blair, &RenderRules::default());
    assert_eq!(mouth.visemes(), "MMAAMMEESSSEMMSELLLEESEEEEEE-");
    let starts: Vec<u64> = alignment.phones.iter().map(|phone| phone.start_us / 100).collect();
    assert_eq!(starts, [0, 809, 2342, 2912, 3936, 4936, 5286, 5833, 6320, 6858, 7250, 8386, 9078, 9763]);
    let fits: Vec<u32> = alignment.phones.iter().map(|phone| phone.fit.to_bits()).collect();
    assert_eq!(fits.iter().fold(0_u32, |hash, &bits| hash.rotate_left(5) ^ bits), 2328096761);
}
