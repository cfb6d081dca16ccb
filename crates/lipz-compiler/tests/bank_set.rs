//! The banks of shards, as a set, answer what the one bank of all clips answers.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]
#![cfg(feature = "shards")]

mod support;

use lipz_bank::{Bank, BankSet, BankSetError, Clip, ClipId, Locale};
use lipz_compiler::shard::shard_of;
use lipz_compiler::{Compiler, Input, Options};
use lipz_testkit::stacked::every_set_query;
use std::num::NonZero;

const LOCALES: [&str; 4] = ["de-de", "en-us", "fr-fr", "xx"];

fn drama() -> Vec<Input> {
    support::files("drama").into_iter().map(|(key, bytes)| Input::from_bytes(key, bytes)).collect()
}

fn compiler() -> Compiler<'static> {
    Compiler::new(Options::new().default_locale("en-us"))
}

/// A bank for each shard.
fn banks(inputs: &[Input], shards: u16) -> Vec<Vec<u8>> {
    let count = NonZero::new(shards).unwrap();
    let of_shard = |shard: u16| {
        let is_own = |input: &&Input| shard_of(ClipId::from_key(&input.key), count) == shard;
        let own: Vec<Input> = inputs.iter().filter(is_own).cloned().collect();
        compiler().compile(&own).bank.unwrap()
    };
    (0..shards).map(of_shard).collect()
}

fn opened(banks: &[Vec<u8>]) -> Vec<Bank<'_>> {
    banks.iter().map(|bytes| Bank::open(bytes).unwrap().verify().unwrap()).collect()
}

/// All that a clip says, with its own texts in these locales. What stands in for a text is the project's.
fn said(clip: &Clip<'_, '_>, locales: &[Option<Locale<'_>>]) -> Vec<String> {
    let mut lines = vec![format!("{} {} {:?} {:?}", clip.key(), clip.id(), clip.fps(), clip.viseme_type())];
    lines.push(format!("{:?} {:?}", clip.frames(), clip.duration_us()));
    for segment in clip.segments() {
        let events: Vec<String> = segment.events().map(|event| event.to_string()).collect();
        lines.push(format!("{} {} {events:?}", segment.start_frame(), segment.end_frame()));
        for locale in locales {
            let text = locale.and_then(|locale| segment.text(locale)).filter(|text| !text.is_fallback());
            lines.push(format!("{:?}", text.map(|text| text.as_str().to_owned())));
        }
    }
    lines.extend(clip.curves().map(|curve| format!("{} {curve}", curve.name().as_str())));
    lines
}

#[test]
fn a_set_answers_as_the_bank_of_all() {
    let inputs = drama();
    let whole = compiler().compile(&inputs).bank.unwrap();
    let whole = Bank::open(&whole).unwrap().verify().unwrap();
    assert!(whole.clip_count() > 10 && whole.locales().count() > 1);
    let of_whole = LOCALES.map(|tag| whole.locale(tag));
    for shards in [1, 2, 3, 7, 64, 200] {
        let files = banks(&inputs, shards);
        let banks = opened(&files);
        let set = BankSet::new(&banks).and_then(BankSet::verify).unwrap();
        assert_eq!(set.clip_count(), whole.clip_count());
        let locales = LOCALES.map(|tag| set.locale(tag));
        assert_eq!(locales.map(|locale| locale.is_some()), of_whole.map(|locale| locale.is_some()));
        assert_eq!(set.default_locale().map(|locale| locale.tag()), whole.default_locale().map(|locale| locale.tag()));
        for clip in whole.clips() {
            let found = set.clip(clip.id()).unwrap();
            assert_eq!(set.clip_by_key(clip.key()), Some(found));
            assert_eq!(set.bank_of(clip.id()).map(Bank::checksum), found_in(&banks, clip.id()));
            let own = locales.map(|locale| locale.and_then(|locale| locale.of(&found)));
            assert_eq!(said(&found, &own), said(&clip, &of_whole), "{shards} shards");
            for name in ["amy", "mara", "samson", "nobody"] {
                let own = set.event_name(name).and_then(|name| name.of(&found));
                assert!(own.is_none() || whole.event_name(name).is_some());
                let mentions = |clip: &Clip<'_, '_>| {
                    clip.segments().any(|segment| segment.events().any(|event| event.to_string().contains(name)))
                };
                assert!(own.is_some() || whole.event_name(name).is_none() || !mentions(&found), "{name}");
            }
        }
        for prefix in ["", "act", "zz"] {
            let mut keys: Vec<&str> = set.clips_under(prefix).map(|clip| clip.key()).collect();
            keys.sort_unstable();
            assert_eq!(keys, whole.clips_under(prefix).map(|clip| clip.key()).collect::<Vec<_>>());
        }
        assert_eq!(set.clips().count(), whole.clip_count());
        assert!(set.clip(ClipId::from_key("nobody")).is_none() && set.clip_by_key("nobody").is_none());
        assert!(every_set_query(&banks));
    }
}

fn found_in(banks: &[Bank<'_>], id: ClipId) -> Option<u64> {
    banks.iter().find(|bank| bank.clip(id).is_some()).map(Bank::checksum)
}

#[test]
fn banks_in_another_order_are_refused_and_lead_to_nothing_wrong() {
    let inputs = drama();
    let files = banks(&inputs, 4);
    let mut banks = opened(&files);
    assert!(banks.iter().all(|bank| bank.clip_count() > 0));
    banks.swap(1, 3);
    let set = BankSet::new(&banks).unwrap();
    assert_eq!(set.verify().unwrap_err(), BankSetError::OtherShard { bank: 1 });
    assert!(!every_set_query(&banks));
    let lost = set.clips().filter(|clip| set.clip(clip.id()).is_none()).count();
    assert_eq!(lost, banks[1].clip_count() + banks[3].clip_count());
    banks.swap(1, 3);
    banks.pop();
    assert!(matches!(BankSet::new(&banks).unwrap().verify(), Err(BankSetError::OtherShard { .. })));
    assert_eq!(BankSet::new(&[]).unwrap_err(), BankSetError::Count);
    assert_eq!(BankSet::new(&vec![banks[0]; 4097]).unwrap_err(), BankSetError::Count);
    assert!(BankSet::new(&vec![banks[0]; 4096]).is_ok());
}
