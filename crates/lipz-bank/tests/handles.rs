//! Handles belong to their bank. In a different bank, they lead to nothing: neither to a wrong text nor to a panic.
// Tests run with the workspace's compiler, not with the oldest one that the reader supports.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(clippy::incompatible_msrv)]

use lipz_bank::{Bank, Clip, Command, Cursor, ErrorKind, EventName, Locale, Segment};
use lipz_testkit::golden::{DRAMA, SMALL, changed, put, verified};
use lipz_testkit::texts::{with_texts, with_texts_unverified};
use std::collections::HashSet;

static BASE: &[u8] = include_bytes!("../../../fixtures/banks/v1/split.lipzbank");
static GERMAN: &[u8] = include_bytes!("../../../fixtures/banks/v1/split.de-de.lipztexts");

/// Returns the bank as another writer would have made it: the same clips in different bytes.
fn newer(bytes: &[u8]) -> Vec<u8> {
    changed(bytes, |bank| put(bank, 22, [9, 0])) // minor version
}

fn open(bytes: &[u8]) -> Bank<'_> {
    Bank::open(bytes).and_then(Bank::verify).expect("a bank")
}

fn german(bank: &Bank<'_>) -> Locale {
    bank.locale("de-de").expect("German")
}

fn first<'a>(bank: &'a Bank<'_>) -> Segment<'a> {
    bank.clips().next().and_then(|clip| clip.segment(0)).expect("a segment")
}

#[test]
fn a_locale_of_another_bank_has_no_text() {
    let newer = newer(DRAMA);
    let (bank, newer, small) = (verified(DRAMA), open(&newer), verified(SMALL));
    for (own, other) in [(&bank, &newer), (&newer, &bank), (&bank, &small), (&small, &bank)] {
        let (segment, locale) = (first(own), german(other));
        assert_eq!((own.locale_tag(locale), other.locale_tag(locale)), ("", "de-de"));
        assert!(segment.text(locale).is_none() && segment.text_bytes(locale).is_none());
        assert!(!segment.has_own_text(locale));
        assert!(segment.text(german(own)).is_some());
    }
}

/// Equal bytes are the same bank, at any address, verified or not.
#[test]
fn a_copy_is_the_same_bank() {
    let copy = DRAMA.to_vec();
    let (bank, copy) = (verified(DRAMA), Bank::open(&copy).expect("a bank"));
    assert_eq!(first(&bank).text(german(&copy)), first(&bank).text(german(&bank)));
    assert_eq!(bank.event_name("mara"), copy.event_name("mara"));
    assert_eq!(german(&bank), german(&copy));
    assert!(bank.clips().eq(copy.clips()));
}

#[test]
fn a_text_bank_is_for_its_bank() {
    let newer = newer(BASE);
    let (bank, newer) = (open(BASE), open(&newer));
    let [own, moved] = [bank, newer].map(|bank| with_texts(&bank, GERMAN).expect("texts of these clips"));
    for (with_texts, other) in [(&own, &moved), (&moved, &own)] {
        let locale = german(with_texts);
        assert!(first(with_texts).text(locale).is_some() && first(other).text(locale).is_none());
    }
    assert!(first(&bank).text(german(&own)).is_none(), "the bank itself has no texts");
}

#[test]
fn names_are_equal_if_they_are_spelled_alike() {
    let newer = newer(DRAMA);
    let (bank, newer) = (verified(DRAMA), open(&newer));
    let (mara, otto) = (bank.event_name("mara").expect("a name"), bank.event_name("otto").expect("a name"));
    let other = newer.event_name("mara").expect("a name");
    assert!(mara == other && mara == "mara" && mara != "otto" && mara != otto);
    assert!(mara < otto && other < otto && mara.cmp(&other).is_eq());
    let distinct: HashSet<EventName<'_>> = [mara, other, mara, otto].into_iter().collect();
    assert_eq!(distinct.len(), 2);
    let events = newer.clips().flat_map(|clip| clip.segments().collect::<Vec<_>>());
    let events = events.flat_map(|segment| segment.events().collect::<Vec<_>>());
    let all: Vec<_> = events.filter_map(|event| event.character.or(event.command.object())).collect();
    assert!(all.contains(&mara) && all.contains(&other));
}

#[test]
fn a_character_is_the_same_in_every_bank() {
    let newer = newer(DRAMA);
    let (bank, newer) = (verified(DRAMA), open(&newer));
    let clip = bank.clip_by_key("act1/otto-twenty-years").expect("a clip");
    let mut cursor = Cursor::new(&clip).expect("a frame rate");
    assert!(cursor.finish(&clip).events().any(|event| matches!(event.command, Command::Feels(_))));
    let states = [&bank, &newer].map(|bank| cursor.state(&clip, bank.event_name("mara")));
    assert!(states[0] == states[1] && states[0].emotion.is_some());
    // A cursor stores a name as numbers, which are valid only in their own bank.
    let mut cursor = cursor.with_speaker(newer.event_name("otto"));
    cursor.seek(&clip, lipz_bank::Micros(0));
    assert!(cursor.finish(&clip).events().all(|event| event.character.map_or(true, |name| name != "otto")));
}

#[test]
fn equal_are_the_same_things() {
    let bank = verified(DRAMA);
    let clips: Vec<Clip<'_>> = bank.clips().collect();
    assert!(clips[0] == bank.clip(clips[0].id()).expect("a clip") && clips[0] != clips[1]);
    let open = verified(SMALL);
    let open = open.clip_by_key("act2/unspecified").expect("a clip");
    assert!(open != open.or_fps(lipz_bank::Fps::whole(24)), "it answers otherwise");
    assert_eq!(clips[0].segment(0), clips[0].segments().next());
    assert_ne!(clips[0].segment(0), clips[0].segment(1));
    let locales: Vec<Locale> = bank.locales().collect();
    assert!(locales[0] == locales[0] && locales[0] != locales[1]);
    let text = first(&bank).text(german(&bank)).expect("a text");
    assert_eq!(AsRef::<str>::as_ref(&text), text.as_str());
}

#[test]
fn texts_are_verified_against_verified_banks_only() {
    let bank = Bank::open(BASE).expect("a bank");
    assert!(!bank.is_verified());
    assert!(with_texts_unverified(&bank, GERMAN).is_ok());
    let error = with_texts(&bank, GERMAN).expect_err("whether the clips are right is not known");
    assert_eq!((error.kind(), error.offset_bytes()), (ErrorKind::BankNotVerified, 0));
    let bank = bank.verify().expect("a golden bank");
    assert!(bank.is_verified() && with_texts(&bank, GERMAN).is_ok());
    let damaged = changed(BASE, |bytes| {
        let last = bytes.len() - 1;
        bytes[last] = 0xFF; // the last byte of the last string
    });
    let bank = Bank::open(&damaged).expect("a directory without fault");
    assert!(bank.verify().is_err() && !bank.is_verified());
}
