//! The babble section: its content from settings, and detection of damage.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_bank::babble::{Babble, VoiceLevel};
use lipz_bank::playback::Lead;
use lipz_bank::{Bank, ErrorKind, Fps, Micros};
use lipz_compiler::settings::Settings;
use lipz_compiler::{Compiler, Input};
use lipz_layout::{CHECKED_FROM, Tag, checksum};

const FILE: &str = r#"{ "text_en-us": "Hello." }"#;

/// Returns a bank of one clip with the profiles of these settings.
fn bank(settings: &str) -> Vec<u8> {
    let settings = Settings::parse(settings, "lipz.toml", "").unwrap();
    Compiler::new(settings.options.clone()).compile(&[Input::from_bytes("hello", FILE)]).bank.unwrap()
}

#[test]
fn a_named_profile_takes_from_the_projects_own_and_that_from_the_viewers() {
    let bytes =
        bank("[babble]\nrate = 30\nooh = \"12\"\n[babble.robot]\nooh = \"34\"\n[babble.\"größer\"]\naah = \"5\"\n");
    let bank = Bank::open(&bytes).unwrap().verify().unwrap();
    assert!(bank.babbles().map(|babble| babble.name()).eq(["default", "größer", "robot"]));
    let (own, robot) = (bank.default_babble(), bank.babble("robot").unwrap());
    assert_eq!((own.ooh(), robot.ooh(), bank.babble("größer").unwrap().ooh()), (&b"12"[..], &b"34"[..], &b"12"[..]));
    assert_eq!((robot.rate(), robot.aah()), (own.rate(), Babble::DEFAULT.aah()));
    assert_eq!(bank.babble("rob"), None);
}

#[test]
fn without_profiles_a_bank_is_as_it_was() {
    let plain = Compiler::default().compile(&[Input::from_bytes("hello", FILE)]).bank.unwrap();
    assert_eq!(bank("[babble]\n"), plain);
    let bank = Bank::open(&plain).unwrap();
    assert!(bank.sections().all(|(tag, _)| tag != Tag::BABBLE.0));
    assert_eq!(bank.default_babble(), Babble::DEFAULT);
}

#[test]
fn a_project_that_repeats_the_viewer_has_its_profile() {
    let bytes = bank("[babble]\nrate = 24\n");
    assert_eq!(Bank::open(&bytes).unwrap().default_babble(), Babble::DEFAULT);
}

/// Changes every byte of the section to every value, which must be detected or produce a valid profile. Before
/// `verify`, no query may panic.
#[test]
fn every_change_is_found_or_valid() {
    let whole = bank("babble.a = { ooh = \"12\", aah = \"3\", rate = 12.5 }\nbabble.b.aah = \"45\"\n");
    let contents = Bank::open(&whole).unwrap().sections().find(|(tag, _)| *tag == Tag::BABBLE.0).unwrap().1;
    let start = contents.as_ptr() as usize - whole.as_ptr() as usize;
    let mut refused = 0;
    for at in start..start + contents.len() {
        for value in 0..=u8::MAX {
            let mut bytes = whole.clone();
            bytes[at] = value;
            let sum = checksum(&bytes[CHECKED_FROM..]);
            bytes[8..16].copy_from_slice(&sum.to_le_bytes());
            let bank = Bank::open(&bytes).unwrap();
            for babble in bank.babbles() {
                babble.at(Micros(1_000_000), VoiceLevel::UNMEASURED);
                babble.name();
                // A damaged rate is never a valid one.
                let rate = babble.rate();
                assert_eq!(Fps::new(rate.numerator(), rate.denominator()), Some(rate));
                assert!(Lead::one_frame(rate) > Lead::NONE);
            }
            match bank.verify() {
                Ok(bank) => {
                    let is_digits = |digits: &[u8]| !digits.is_empty() && digits.iter().all(u8::is_ascii_digit);
                    assert!(bank.babbles().all(|babble| is_digits(babble.ooh()) && is_digits(babble.aah())));
                    assert!(bank.babbles().count() > 0);
                }
                Err(error) => {
                    assert_eq!(error.kind(), ErrorKind::Babble);
                    assert!((start..start + contents.len()).contains(&(error.offset_bytes() as usize)));
                    refused += 1;
                }
            }
        }
    }
    assert!(refused > contents.len() * 100, "{refused}");
}
