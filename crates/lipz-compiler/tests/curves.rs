//! Curves: a program reads the values of the file at each frame and time, and unpacking restores them.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_bank::curve::{Curve, CurveCursor};
use lipz_bank::{Bank, Error, ErrorKind, Fps, Micros};
use lipz_compiler::{Compiler, Documents, Input, Options, SplitBank};
use lipz_layout::Tag;
use lipz_testkit::dialogue;
use lipz_testkit::golden::{CURVES, changed, entry_of, put, refusal, section};
use proptest::prelude::*;
use std::collections::BTreeMap;

/// Frames and thousandths of a curve.
type Keys = BTreeMap<u32, i32>;

fn pack(file: &str, options: Options) -> Vec<u8> {
    Compiler::new(options).compile(&[Input::from_bytes("a", file)]).into_bank().unwrap()
}

/// Returns a clip without visemes, at 24 frames per second, with one curve.
fn bank_of(keys: &Keys) -> Vec<u8> {
    let number = |thousandths: &i32| {
        let sign = if *thousandths < 0 { "-" } else { "" };
        format!("{sign}{}.{:03}", thousandths.unsigned_abs() / 1000, thousandths.unsigned_abs() % 1000)
    };
    let keys: Vec<String> = keys.iter().map(|(frame, value)| format!("{frame}:{}", number(value))).collect();
    pack(&format!(r#"{{ "fps": 24, "curves": {{ "k": "{}" }} }}"#, keys.join("  ")), Options::new())
}

/// Returns the value at `position`, in 65,536ths of frames, with integers that cannot overflow.
fn exact(keys: &Keys, position: u64) -> i32 {
    let at = |frame: u32| i128::from(frame) << 16;
    let position = i128::from(position);
    let before = keys.iter().rev().find(|(frame, _)| at(**frame) <= position);
    let after = keys.iter().find(|(frame, _)| at(**frame) > position);
    let (Some((from, old)), Some((to, new))) = (before, after) else { return *before.or(after).unwrap().1 };
    let (done, whole) = (position - at(*from), at(*to) - at(*from));
    let distance = i128::from(*new) - i128::from(*old);
    let part = (2 * distance.abs() * done + whole) / (2 * whole);
    i32::try_from(i128::from(*old) + part * distance.signum()).unwrap()
}

/// Frames near each other, around the largest that fits a narrow key, and far apart.
fn frame() -> impl Strategy<Value = u32> {
    prop_oneof![4 => 0_u32..60, 1 => 65_530_u32..65_540, 1 => any::<u32>()]
}

fn thousandths() -> impl Strategy<Value = i32> {
    prop_oneof![4 => -12_000..12_000, 1 => 32_760..32_775, 1 => any::<i32>()]
}

fn keys() -> impl Strategy<Value = Keys> {
    proptest::collection::btree_map(frame(), thousandths(), 1..40)
}

fn with_curve<T>(bytes: &[u8], look: impl FnOnce(Curve<'_>) -> T) -> T {
    let bank = Bank::open(bytes).unwrap().verify().unwrap();
    let clip = bank.clip_by_key("a").unwrap();
    look(clip.curve("k").unwrap())
}

proptest! {
    /// A cursor returns the same values as a search, regardless of its previous position, and both equal exact
    /// arithmetic.
    #[test]
    fn a_cursor_is_a_search_is_exact(
        keys in keys(),
        times in proptest::collection::vec((0_i64..3_000_000, any::<bool>()), 1..60),
    ) {
        let bytes = bank_of(&keys);
        with_curve(&bytes, |curve| {
            prop_assert_eq!(curve.key_count() as usize, keys.len());
            let (mut cursor, mut now) = (CurveCursor::new(), 0);
            let by_frame = keys.keys().flat_map(|frame| [frame.saturating_sub(1), *frame, frame.saturating_add(1)]);
            for frame in by_frame {
                let expected = exact(&keys, u64::from(frame) << 16);
                prop_assert_eq!(curve.value(frame).thousandths(), expected);
                prop_assert_eq!(cursor.value(&curve, frame).thousandths(), expected);
            }
            for (time, jumps) in times {
                now = if jumps { time } else { now + time % 40_000 };
                let expected = exact(&keys, u64::try_from(now).unwrap() * 24 * 65_536 / 1_000_000);
                prop_assert_eq!(curve.value_at(Micros(now)).unwrap().thousandths(), expected);
                prop_assert_eq!(cursor.value_at(&curve, Micros(now)).unwrap().thousandths(), expected);
            }
            Ok(())
        })?;
    }
}

#[test]
fn values_are_held_outside_of_the_keys() {
    let bytes = bank_of(&Keys::from([(5, 1000), (6, -3)]));
    with_curve(&bytes, |curve| {
        let at = |us| curve.value_at(Micros(us)).unwrap().thousandths();
        assert_eq!([i64::MIN, -1, 0, 5_000_000, i64::MAX].map(at), [1000, 1000, 1000, -3, -3]);
        // Half of 1003 from 1000 is 498.5, which is rounded away from the previous key.
        assert_eq!(at(5_500_000 / 24 + 1), 498);
    });
}

#[test]
fn without_a_frame_rate_only_frames_have_values() {
    let bytes = pack(r#"{ "visemes": "MA", "curves": { "k": "0:0 2:1" } }"#, Options::new());
    let bank = Bank::open(&bytes).unwrap().verify().unwrap();
    let clip = bank.clip_by_key("a").unwrap();
    let curve = clip.curve("k").unwrap();
    assert_eq!((curve.value_at(Micros(0)), curve.value(1).thousandths()), (None, 500));
    let given = clip.or_fps(Fps::whole(10)).curve("k").unwrap();
    assert_eq!(given.value_at(Micros(150_000)).unwrap().thousandths(), 750);
    assert_eq!((clip.curve("K"), clip.curves().count()), (None, 1));
}

/// The element is restored regardless of its layout; from a stripped bank, its values are restored.
#[test]
fn unpacking_gives_the_element_back() {
    let canonical = "{\n    \"anger\" : \"0:0 2:2.2\",\n    \"é \\\"\"  : \"1:-0.05\"\n  }";
    let others = ["{}", "{\"b\":\"0:1.0\",\"a\":\" 0:00.50  1:1\"}", "{ \"\\u0061\" : \"0:1\\n1:2\" }"];
    let mut sizes = Vec::new();
    for value in [canonical].into_iter().chain(others) {
        let file = format!(r#"{{"visemes":"MA","curves":{value}}}"#);
        let bytes = pack(&file, Options::new());
        dialogue!(bank = &bytes);
        let documents = Documents::from_dialogue(&bank).unwrap();
        let (_, document) = documents.iter().next().unwrap().unwrap();
        assert_eq!(document, lipz_file::parse(file.as_bytes()).document.unwrap());
        sizes.push(section(&bytes, Tag::SOURCES).len());
        let stripped = pack(&file, Options::new().strip(true));
        dialogue!(stripped_bank = &stripped);
        let documents = Documents::from_dialogue(&stripped_bank).unwrap();
        let (_, displayed) = documents.iter().next().unwrap().unwrap();
        let again = pack(&lipz_file::write(&displayed), Options::new().strip(true));
        assert_eq!(again, stripped, "{value}");
    }
    assert!(sizes[0] < 16, "the contents of the bank are not stored twice: {sizes:?}");
}

#[test]
fn curves_survive_splitting_and_caches_and_cost_nothing_without() {
    let split = SplitBank::from_bytes(CURVES).unwrap();
    let (whole, base) = (Bank::open(CURVES).unwrap(), Bank::open(&split.base).unwrap().verify().unwrap());
    let shown = |bank: &Bank<'_>| -> Vec<String> {
        bank.clips().flat_map(|clip| clip.curves()).map(|curve| format!("{} {curve}", curve.name())).collect()
    };
    assert_eq!((shown(&whole), shown(&whole).len()), (shown(&base), 7));
    let without = pack(r#"{ "visemes": "MA" }"#, Options::new());
    let empty = pack(r#"{ "visemes": "MA", "curves": {} }"#, Options::new().strip(true));
    assert_eq!(empty, pack(r#"{ "visemes": "MA" }"#, Options::new().strip(true)));
    for bytes in [&without, &empty] {
        assert!(Bank::open(bytes).unwrap().sections().all(|(tag, _)| !tag.starts_with(b"CRV") && tag != *b"CURV"));
    }
}

/// Changes a section of a bank with two curves in a clip of four frames, and a clip with a wide curve. Returns the
/// error.
fn refused(tag: Tag, change: impl FnOnce(&mut [u8])) -> Option<(ErrorKind, usize)> {
    let files = [
        ("a", r#"{ "visemes": "MAAE", "curves": { "anger": "0:0 2:1", "joy": "1:1 4:2" } }"#),
        ("b", r#"{ "visemes": "MAAE", "curves": { "joy": "0:0 1:40" } }"#),
    ];
    let inputs = files.map(|(key, file)| Input::from_bytes(key, file));
    let bytes = Compiler::new(Options::new().strip(true)).compile(&inputs).into_bank().unwrap();
    let place = section(&bytes, tag);
    let error = refusal(&changed(&bytes, |bank| change(&mut bank[place.clone()])))?;
    Some((error.kind(), (error.offset_bytes() as usize).wrapping_sub(place.start)))
}

#[test]
fn damage_of_each_kind_is_found_where_it_is() {
    let curve = |at: usize| Some((ErrorKind::Curve, at));
    assert_eq!(refused(Tag::CURVE_CLIPS, |_| ()), None);
    assert_eq!(refused(Tag::CURVE_CLIPS, |clips| clips[8] = 2), curve(8), "no such slot");
    assert_eq!(refused(Tag::CURVE_CLIPS, |clips| clips[8] = 0), curve(8), "a slot twice");
    assert_eq!(refused(Tag::CURVE_CLIPS, |clips| clips[4] = 1), curve(0), "a curve without a clip");
    assert_eq!(refused(Tag::CURVE_CLIPS, |clips| clips[12] = 0), curve(0), "a clip without curves");
    assert!(refused(Tag::CURVE_CLIPS, |clips| clips[12] = 3).is_some(), "no curves left");
    assert_eq!(refused(Tag::CURVE_CLIPS, |clips| clips[12] = 9), curve(0), "more curves than the section has");
    assert_eq!(refused(Tag::CURVES, |curves| curves[4] = 2), curve(0), "no such name");
    assert_eq!(refused(Tag::CURVES, |curves| curves[7] ^= 0x40), curve(0), "no such name either");
    assert!(refused(Tag::CURVES, |curves| curves[0] = 1).is_some(), "keys without a curve");
    assert!(refused(Tag::CURVES, |curves| curves[8] = 200).is_some(), "keys past the end");
    assert!(refused(Tag::CURVES, |curves| curves[8] = 0).is_some(), "a curve without keys");
    assert!(refused(Tag::CURVES, |curves| curves[23] ^= 0x80).is_some(), "a different width");
    for names in [[1, 1], [1, 0]] {
        let damage = |curves: &mut [u8]| {
            let of_two = if curves[12] == 0 { 8 } else { 0 };
            (curves[of_two + 4], curves[of_two + 12]) = (names[0], names[1]);
        };
        assert!(refused(Tag::CURVES, damage).is_some(), "names in this order: {names:?}");
    }
    assert!(refused(Tag::CURVE_KEYS, |keys| keys.fill(0)).is_some(), "frames that do not ascend");
    assert!(
        refused(Tag::CURVE_KEYS, |keys| keys.chunks_mut(4).for_each(|key| key[0] += 3)).is_some(),
        "behind the clip"
    );
}

#[test]
fn all_sections_of_curves_or_none() {
    for tag in [Tag::CURVE_CLIPS, Tag::CURVES, Tag::CURVE_KEYS] {
        let without = changed(CURVES, |bank| put(bank, entry_of(CURVES, tag), b"NEWS"));
        assert_eq!(refusal(&without).map(Error::kind), Some(ErrorKind::SectionMissing));
        let wrong = changed(CURVES, |bank| bank[entry_of(CURVES, tag) + 12] ^= 3);
        assert_eq!(refusal(&wrong).map(Error::kind), Some(ErrorKind::SectionShape));
    }
}
