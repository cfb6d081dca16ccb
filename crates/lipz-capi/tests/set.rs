//! Sets of banks through the functions of C.
#![allow(clippy::unwrap_used, clippy::incompatible_msrv, unsafe_code)]

use lipz_capi::*;
use lipz_compiler::shard::{Link, Shard, shard_of_key};
use lipz_compiler::{Compiler, Input, Options, Voices};
use std::fs;
use std::mem::MaybeUninit;
use std::num::NonZero;
use std::path::Path;
use std::ptr;

const KEYS: [&str; 8] = ["a", "b", "c", "d", "de/a", "de/b", "de/c", "de/d"];

/// The index of a set of four banks, and the banks.
fn files(folder: &Path) -> (Vec<u8>, Vec<Vec<u8>>) {
    let voices = Voices::new("en-us").dub("de-de", "de/{key}");
    let compiler = Compiler::new(Options::new().voices(voices.clone()));
    let object = |shard: u16| {
        let own = KEYS.into_iter().filter(|key| shard_of_key(key, &voices, NonZero::new(4).unwrap()) == shard);
        let own: Vec<Input> = own.map(|key| Input::from_bytes(key, r#"{ "visemes": "MA" }"#)).collect();
        let path = folder.join(format!("{shard}.lipzobj"));
        fs::write(&path, compiler.object(&own, &Shard::new(shard, 4)).bank.unwrap()).unwrap();
        path
    };
    let objects: Vec<_> = (0..4).map(object).collect();
    let linked = compiler.link_to_set(&Link::open(&objects).unwrap(), &folder.join("d.lipzset")).files.unwrap();
    let banks = linked.banks.iter().map(|bank| fs::read(&bank.path).unwrap()).collect();
    (fs::read(linked.index.path).unwrap(), banks)
}

/// The answer of a function, or its status.
fn ask<T: Copy>(call: impl FnOnce(Option<&mut MaybeUninit<T>>) -> Status) -> Result<T, Status> {
    let mut out = MaybeUninit::uninit();
    let status = call(Some(&mut out));
    // SAFETY: each function writes its answer, an empty one if there is none.
    if status == LIPZ_OK { Ok(unsafe { out.assume_init() }) } else { Err(status) }
}

#[test]
fn a_set_leads_to_the_bank_of_each_clip() {
    let folder = tempfile::tempdir().unwrap();
    let (index, files) = files(folder.path());
    // SAFETY: the contract of the crate: files and structs outlive the calls.
    unsafe {
        let set = ask(|set| lipz_set_open(index.as_ptr(), index.len(), set, None)).unwrap();
        let info: SetInfo = ask(|info| lipz_set_info(Some(&set), info)).unwrap();
        assert_eq!((info.bank_count, info.clip_count), (4, 8));
        assert!(info.moved_count > 0);
        let open = |bytes: &Vec<u8>| ask(|bank| lipz_bank_open(bytes.as_ptr(), bytes.len(), bank, None)).unwrap();
        let banks: Vec<Bank> = files.iter().map(open).collect();
        for (number, bank) in (0..).zip(&banks) {
            let named: SetBank = ask(|named| lipz_set_bank_at(Some(&set), number, named)).unwrap();
            let name = std::slice::from_raw_parts(named.file_name.data.cast::<u8>(), named.file_name.length_bytes);
            assert!(folder.path().join(std::str::from_utf8(name).unwrap()).is_file());
            assert_eq!(named.length_bytes as usize, files[number as usize].len());
            assert_eq!(lipz_set_check_bank(Some(&set), number, Some(bank)), LIPZ_OK);
            assert_eq!(lipz_set_check_bank(Some(&set), (number + 1) % 4, Some(bank)), 44);
        }
        assert_eq!(
            ask(|named: Option<&mut MaybeUninit<SetBank>>| lipz_set_bank_at(Some(&set), 4, named)).err(),
            Some(LIPZ_NONE)
        );
        for key in KEYS {
            let id = ask(|id| lipz_clip_id_of_key(key.as_ptr().cast(), key.len(), id)).unwrap();
            let number = ask(|number| lipz_set_bank_of(Some(&set), id, number)).unwrap();
            assert!(ask::<Clip>(|clip| lipz_clip_by_id(Some(&banks[number as usize]), id, clip)).is_ok(), "{key}");
        }
    }
}

/// Status and place of damage of what is opened as an index.
fn opened(bytes: &[u8]) -> (Status, u32) {
    let (mut set, mut place) = (MaybeUninit::uninit(), MaybeUninit::uninit());
    // SAFETY: as above; the place is written in any case.
    unsafe {
        let status = lipz_set_open(bytes.as_ptr(), bytes.len(), Some(&mut set), Some(&mut place));
        (status, place.assume_init())
    }
}

#[test]
fn what_is_no_set_is_refused_and_any_struct_is_harmless() {
    let folder = tempfile::tempdir().unwrap();
    let (index, files) = files(folder.path());
    // SAFETY: as above.
    unsafe {
        assert_eq!(opened(&files[0]), (42, 0));
        let mut damaged = index.clone();
        damaged[200] ^= 1;
        assert_eq!(opened(&damaged), (12, 8));
        assert_eq!(lipz_set_open(index.as_ptr(), index.len(), None, None), LIPZ_NULL_POINTER);
        for length_bytes in [0, 7, 64, index.len() - 1] {
            let set = Set { data: index.as_ptr(), length_bytes };
            assert!(ask::<SetInfo>(|info| lipz_set_info(Some(&set), info)).is_err());
            assert!(ask(|number| lipz_set_bank_of(Some(&set), 1, number)).is_err());
        }
        let none = Set { data: ptr::null(), length_bytes: 9 };
        assert_eq!(ask::<SetInfo>(|info| lipz_set_info(Some(&none), info)).err(), Some(LIPZ_NULL_POINTER));
        assert_eq!(lipz_set_check_bank(None, 0, None), LIPZ_NULL_POINTER);
        assert_eq!(
            lipz_set_check_bank(Some(&Set { data: index.as_ptr(), length_bytes: index.len() }), 0, None),
            LIPZ_NULL_POINTER
        );
    }
}
