//! A set is opened with all of its banks, or not at all.
#![allow(clippy::unwrap_used, clippy::incompatible_msrv)]
#![allow(unsafe_code, reason = "nobody changes the banks")]

use lipz_bank::{BankSetError, ClipId, ErrorKind};
use lipz_compiler::shard::{Link, Shard, shard_of};
use lipz_compiler::{Compiler, Input};
use lipz_host::{OpenError, OwnedSet};
use std::fs;
use std::num::NonZero;
use std::path::Path;

const KEYS: [&str; 6] = ["a", "b", "c", "d", "e", "f"];

/// Links a set of so many banks, whose clips say `text`.
fn link(folder: &Path, shards: u16, text: &str) {
    let (compiler, count) = (Compiler::default(), NonZero::new(shards).unwrap());
    let object = |shard: u16| {
        let own = KEYS.into_iter().filter(|key| shard_of(ClipId::from_key(key), count) == shard);
        let own: Vec<Input> =
            own.map(|key| Input::from_bytes(key, format!(r#"{{ "text_en-us": "{text}" }}"#))).collect();
        let path = folder.join(format!("{shard}-of-{shards}.lipzobj"));
        fs::write(&path, compiler.object(&own, &Shard::new(shard, shards)).bank.unwrap()).unwrap();
        path
    };
    let objects: Vec<_> = (0..shards).map(object).collect();
    let linked = compiler.link_to_set(&Link::open(&objects).unwrap(), &folder.join("d.lipzset"));
    assert!(linked.files.is_some(), "{:?}", linked.reports);
}

fn texts(owned: &OwnedSet) -> Vec<String> {
    let set = owned.set();
    let english = set.locale("en-us").unwrap();
    let text = |key: &&str| {
        let clip = set.clip_by_key(key).unwrap();
        clip.segment(0).unwrap().text(english.of(&clip).unwrap()).unwrap().as_str().to_owned()
    };
    KEYS.iter().map(text).collect()
}

#[test]
fn a_set_is_read_or_mapped_and_outlives_its_successor() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("d.lipzset");
    link(folder.path(), 3, "Aye.");
    let read = OwnedSet::open(&path).unwrap().verify().unwrap();
    // SAFETY: nobody writes to the banks: those of a new set have other names.
    let mapped = unsafe { OwnedSet::open_mapped(&path) }.unwrap().verify().unwrap();
    assert_eq!((read.index().bank_count(), read.set().clip_count()), (3, KEYS.len()));
    link(folder.path(), 2, "Nay.");
    for set in [&read, &mapped] {
        assert_eq!(texts(set), ["Aye."; KEYS.len()]);
    }
    assert_eq!(texts(&OwnedSet::open(&path).unwrap()), ["Nay."; KEYS.len()]);
}

#[test]
fn what_is_no_set_names_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("d.lipzset");
    link(folder.path(), 3, "Aye.");
    let banks: Vec<_> = {
        let set = OwnedSet::open(&path).unwrap();
        set.index().banks().map(|bank| folder.path().join(bank.file_name)).collect()
    };
    let whole: Vec<Vec<u8>> = banks.iter().map(|bank| fs::read(bank).unwrap()).collect();
    // A bank that is none is found when it is opened, damage when it is verified.
    let mut damaged = whole[1].clone();
    *damaged.last_mut().unwrap() ^= 1;
    fs::write(&banks[1], &damaged).unwrap();
    let error = OwnedSet::open(&path).unwrap().verify().unwrap_err();
    assert!(matches!(error.error(), OpenError::Bank(error) if error.kind() == ErrorKind::Checksum), "{error}");
    assert_eq!(error.path(), banks[1]);
    fs::write(&banks[1], &whole[2]).unwrap();
    let error = OwnedSet::open(&path).unwrap_err();
    assert!(matches!(error.error(), OpenError::Set(BankSetError::OtherBank { bank: 1 })), "{error}");
    fs::remove_file(&banks[1]).unwrap();
    let error = OwnedSet::open(&path).unwrap_err();
    assert!(matches!(error.error(), OpenError::File(_)) && error.path() == banks[1], "{error}");
    let error = OwnedSet::open(&banks[0]).unwrap_err();
    assert!(matches!(error.error(), OpenError::Bank(error) if error.kind() == ErrorKind::NotASet), "{error}");
}
