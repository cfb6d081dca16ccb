//! Handles know their bank: with another one, they lead to nothing, never to another text.
// Tests and their helpers: they run with the workspace's compiler, not with the oldest one of the reader.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(clippy::incompatible_msrv)]

use lipz_bank::{Bank, Clip, Command, Cursor, ErrorKind, EventName, Locale, Segment};
use lipz_testkit::golden::{DRAMA, SMALL, changed, put, verified};
use std::collections::HashSet;
use std::panic::{AssertUnwindSafe, catch_unwind};

static BASE: &[u8] = include_bytes!("../../../fixtures/banks/v1/split.lipzbank");
static GERMAN: &[u8] = include_bytes!("../../../fixtures/banks/v1/split.de-de.lipztexts");

/// The bank as another writer would have made it: the same clips in other bytes.
fn newer(bytes: &[u8]) -> Vec<u8> {
    changed(bytes, |bank| put(bank, 22, [9, 0])) // minor version
}

fn open(bytes: &[u8]) -> Bank<'_> {
    Bank::open(bytes).and_then(Bank::verify).expect("a bank")
}

fn german<'data>(bank: &Bank<'data>) -> Locale<'data> {
    bank.locale("de-de").expect("German")
}

fn first<'data, 'bank>(bank: &'bank Bank<'data>) -> Segment<'data, 'bank> {
    bank.clips().next().and_then(|clip| clip.segment(0)).expect("a segment")
}

/// A mistake: an assertion where these are on, nothing where they are off.
fn leads_to_nothing<T>(query: impl FnOnce() -> Option<T>) {
    let answer = catch_unwind(AssertUnwindSafe(query));
    assert_eq!(answer.is_err(), cfg!(debug_assertions));
    assert!(answer.map_or(true, |answer| answer.is_none()));
}

#[test]
fn a_locale_of_another_bank_has_no_text() {
    let newer = newer(DRAMA);
    let (bank, newer, small) = (verified(DRAMA), open(&newer), verified(SMALL));
    for (own, other) in [(&bank, &newer), (&newer, &bank), (&bank, &small), (&small, &bank)] {
        let (segment, locale) = (first(own), german(other));
        assert!(!locale.is_of(own) && locale.is_of(other));
        leads_to_nothing(|| segment.text(locale));
        leads_to_nothing(|| segment.text_bytes(locale));
        assert!(segment.text(german(own)).is_some());
    }
}

/// The same bytes are the same bank, wherever they are, verified or not.
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
    let texts = bank.open_texts(GERMAN).expect("texts of these clips");
    let locale = texts.locale("de-de").expect("German");
    assert!(locale.is_of(&bank) && !locale.is_of(&newer));
    assert!(first(&bank).text(locale).is_some());
    leads_to_nothing(|| first(&newer).text(locale));
    // Verified against the new version of the bank, the texts are for that one.
    let moved = texts.verify(&newer).expect("the same clips");
    let locale = moved.locale("de-de").expect("German");
    assert!(locale.is_of(&newer) && first(&newer).text(locale).is_some());
    leads_to_nothing(|| first(&bank).text(locale));
}

#[test]
fn names_of_two_banks_are_never_equal() {
    let newer = newer(DRAMA);
    let (bank, newer) = (verified(DRAMA), open(&newer));
    let name = |bank: &Bank<'static>, name| bank.event_name(name).expect("a name");
    let other = newer.event_name("mara").expect("a name");
    let (mara, otto) = (name(&bank, "mara"), name(&bank, "otto"));
    assert!(mara != other && mara.id() == other.id() && mara.as_str() == other.as_str());
    assert!(mara.is_of(&bank) && !mara.is_of(&newer));
    assert!(mara < otto && mara.cmp(&other) == other.cmp(&mara).reverse() && mara.cmp(&other).is_ne());
    let distinct: HashSet<EventName<'_>> = [mara, other, mara, otto].into_iter().collect();
    assert_eq!(distinct.len(), 3);
    let events = newer.clips().flat_map(|clip| clip.segments()).flat_map(|segment| segment.events());
    let all: Vec<_> = events.filter_map(|event| event.character.or(event.command.object())).collect();
    assert!(!all.contains(&mara) && all.contains(&other));
}

#[test]
fn a_character_of_another_bank_has_no_state() {
    let newer = newer(DRAMA);
    let (bank, newer) = (verified(DRAMA), open(&newer));
    let clip = bank.clip_by_key("act1/otto-twenty-years").expect("a clip");
    let mut cursor = Cursor::new(&clip).expect("a frame rate");
    assert!(cursor.finish(&clip).events().any(|event| matches!(event.command, Command::Feels(_))));
    let mara = newer.event_name("mara");
    leads_to_nothing(|| cursor.state(&clip, mara).emotion);
    assert!(cursor.state(&clip, bank.event_name("mara")).emotion.is_some());
}

#[test]
fn equal_are_the_same_things() {
    let bank = verified(DRAMA);
    let clips: Vec<Clip<'_, '_>> = bank.clips().collect();
    assert!(clips[0] == bank.clip(clips[0].id()).expect("a clip") && clips[0] != clips[1]);
    let open = verified(SMALL);
    let open = open.clip_by_key("act2/unspecified").expect("a clip");
    assert!(open != open.or_fps(lipz_bank::Fps::whole(24)), "it answers otherwise");
    assert_eq!(clips[0].segment(0), clips[0].segments().next());
    assert_ne!(clips[0].segment(0), clips[0].segment(1));
    let locales: Vec<Locale<'_>> = bank.locales().collect();
    assert!(locales[0] == locales[0] && locales[0] != locales[1]);
    let text = first(&bank).text(german(&bank)).expect("a text");
    assert_eq!(AsRef::<str>::as_ref(&text), text.as_str());
}

#[test]
fn texts_are_verified_against_verified_banks_only() {
    let bank = Bank::open(BASE).expect("a bank");
    assert!(!bank.is_verified());
    let texts = bank.open_texts(GERMAN).expect("texts of these clips");
    let error = texts.verify(&bank).expect_err("nobody knows whether the clips are right");
    assert_eq!((error.kind(), error.offset_bytes()), (ErrorKind::BankNotVerified, 0));
    let bank = bank.verify().expect("a golden bank");
    assert!(bank.is_verified() && texts.verify(&bank).is_ok());
    let damaged = changed(BASE, |bytes| {
        let last = bytes.len() - 1;
        bytes[last] = 0xFF; // of the last string
    });
    let bank = Bank::open(&damaged).expect("a directory without fault");
    assert!(bank.verify().is_err() && !bank.is_verified());
}
