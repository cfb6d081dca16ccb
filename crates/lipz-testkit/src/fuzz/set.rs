//! Indices of sets forged with knowledge of the format, with matching or other banks.

use super::forged_bank::Forgery;
use crate::dialogues::places;
use crate::forge;
use crate::golden::reseal;
use crate::stacked::every_query_of_index;
use arbitrary::{Arbitrary, Unstructured};
use lipz_bank::{Bank, ClipId, Dialogue};
use lipz_compiler::shard::{shard_of, shard_of_key};
use lipz_compiler::{Compiler, Input, Options, Voices};
use lipz_layout::{SET_MAGIC, SetBankRecord, Tag, U16, U64, set_fingerprint};
use std::num::NonZero;
use std::sync::LazyLock;
use zerocopy::IntoBytes;

const SHARDS: NonZero<u16> = NonZero::new(3).expect("not 0");

/// The index of a set, and its banks. Some clips are dubs in the bank of their original.
static FILES: LazyLock<(Vec<u8>, Vec<Vec<u8>>)> = LazyLock::new(|| {
    let voices = Voices::new("en-us").expect("a voice").dub("de-de", "de/{key}").expect("a voice");
    let file = r#"{ "fps": 24, "visemes": "MA|EO", "text_en-us": "Aye.|No", "events": "|amy points door" }"#;
    let keys = ["a", "b", "c", "d", "de/a", "de/b", "de/d"];
    let mut moved: Vec<(ClipId, u16)> = Vec::new();
    let banks = (0..SHARDS.get()).map(|shard| {
        let own: Vec<&str> = keys.into_iter().filter(|key| shard_of_key(key, &voices, SHARDS) == shard).collect();
        let ids = own.iter().map(|key| ClipId::from_key(key)).filter(|id| shard_of(*id, SHARDS) != shard);
        moved.extend(ids.map(|id| (id, shard)));
        let inputs: Vec<Input> = own.iter().map(|key| Input::from_bytes(*key, file)).collect();
        let options =
            Options::new().strip(true).default_locale("en-us").expect("a locale").voices(voices.clone()).threads(1);
        Compiler::new(options).compile(&inputs).into_bank().expect("files without errors")
    });
    let banks: Vec<Vec<u8>> = banks.collect();
    moved.sort_unstable();
    assert!(!moved.is_empty(), "a dub is elsewhere");
    (index(&banks, &moved), banks)
});

/// Returns the index of these banks, as specified in docs/reference/bank-format.md.
fn index(banks: &[Vec<u8>], moved: &[(ClipId, u16)]) -> Vec<u8> {
    let (mut records, mut names) = (Vec::new(), String::new());
    for (number, bytes) in banks.iter().enumerate() {
        let (bank, name) = (Bank::open(bytes).expect("a bank"), format!("{number}.lipzbank"));
        records.push(SetBankRecord {
            checksum: bank.checksum().into(),
            fingerprint: bank.fingerprint().into(),
            length_bytes: (bytes.len() as u32).into(),
            clip_count: (bank.clip_count() as u32).into(),
            name_offset_bytes: (names.len() as u32).into(),
            name_length_bytes: (name.len() as u32).into(),
        });
        names.push_str(&name);
    }
    let ids: Vec<U64> = moved.iter().map(|(id, _)| U64::new(id.get())).collect();
    let homes: Vec<U16> = moved.iter().map(|(_, home)| U16::new(*home)).collect();
    let contents = [records.as_bytes(), ids.as_bytes(), homes.as_bytes(), names.as_bytes()];
    let sections = Tag::SET.iter().zip(contents).map(|(&(tag, entry), contents)| (tag, entry as u16, contents));
    sealed(forge::file(&sections.collect::<Vec<_>>(), set_fingerprint(&records), 0))
}

fn sealed(mut index: Vec<u8>) -> Vec<u8> {
    index[..SET_MAGIC.len()].copy_from_slice(&SET_MAGIC);
    reseal(&mut index);
    index
}

/// Makes the changes encoded in the bytes in an index, and every query of it and its banks. Names lead to no other
/// folder, and an index that passes `verify` with its banks finds each clip.
pub fn set(bytes: &[u8]) {
    let Ok(forgery) = Forgery::arbitrary_take_rest(Unstructured::new(bytes)) else { return };
    let (index, files) = &*FILES;
    let forged = sealed(forgery.apply_to(index));
    assert!(Bank::open(&forged).is_err(), "an index is no bank");
    let banks: Vec<&[u8]> = files.iter().map(Vec::as_slice).collect();
    let Some(verified) = every_query_of_index(&forged, &banks) else { return };
    let mut places = places(banks.len() + 1);
    let contents = [forged.as_slice()].into_iter().chain(banks.iter().copied());
    let Ok(set) = Dialogue::open(&mut places, contents) else { return };
    for (number, bank) in banks.iter().enumerate() {
        for clip in Bank::open(bank).expect("a bank").clips() {
            assert_eq!(set.clip(clip.id()).map(|found| found.key()), Some(clip.key()));
            assert_eq!(verified.bank_of(clip.id()), number);
        }
    }
}
