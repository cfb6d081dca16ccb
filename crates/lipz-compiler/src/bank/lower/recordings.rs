//! The records about recordings.

use crate::clip::Clip;
use lipz_bank::Recording;
use lipz_layout::{NO_RECORDING, RecordingRecord};
use std::collections::BTreeMap;

/// The longest time that the reader accepts, because its times are signed.
const MAX_US: u64 = i64::MAX as u64;

/// Returns a record for each slot; none if no recordings are known.
pub(super) fn recordings(
    clips: &[Clip<'_>],
    slots: &[u32],
    known: &BTreeMap<String, Recording>,
) -> Vec<RecordingRecord> {
    if known.is_empty() || !clips.iter().any(|clip| known.contains_key(clip.key())) {
        return Vec::new();
    }
    let none = RecordingRecord { length_us: NO_RECORDING.into(), content_hash: 0.into() };
    let mut records = vec![none; clips.len()];
    for (clip, &slot) in std::iter::zip(clips, slots) {
        if let Some(recording) = known.get(clip.key()) {
            let length_us = recording.length_us().min(MAX_US);
            records[slot as usize] =
                RecordingRecord { length_us: length_us.into(), content_hash: recording.content_hash().into() };
        }
    }
    records
}

#[cfg(test)]
mod tests {
    use crate::bank::SplitBank;
    use crate::project::Options;
    use crate::run::Compiler;
    use crate::sources::Input;
    use lipz_bank::{Bank, ClipId, Recording};

    #[test]
    fn recordings_are_found_by_clip_also_in_a_split_bank() {
        let file = r#"{ "visemes": "MA", "text_en-us": "Ma!" }"#;
        let inputs = ["a", "b", "c"].map(|key| Input::from_bytes(key, file));
        let (of_a, of_c) = (Recording::new(1_500_000, 7), Recording::new(0, u64::MAX));
        let options = Options::new().recordings([("a", of_a), ("c", of_c), ("gone", of_a)]);
        let whole = Compiler::new(options).compile(&inputs).into_bank().unwrap();
        let split = SplitBank::from_bytes(&whole).unwrap();
        for bytes in [&whole, &split.base] {
            let bank = Bank::open(bytes).unwrap().verify().unwrap();
            let of = |key| bank.clip(ClipId::from_key(key)).unwrap().recording();
            assert_eq!([of("a"), of("b"), of("c")], [Some(of_a), None, Some(of_c)]);
        }
        let without = Compiler::default().compile(&inputs).into_bank().unwrap();
        let bank = Bank::open(&without).unwrap();
        assert!(bank.sections().all(|(tag, _)| tag != *b"RCRD"), "a section that says nothing");
        assert_eq!(bank.clip_by_key("a").unwrap().recording(), None);
    }

    #[test]
    fn a_length_beyond_all_times_is_the_longest_time() {
        let options = Options::new().recordings([("a", Recording::new(u64::MAX, 1))]);
        let bytes = Compiler::new(options).compile(&[Input::from_bytes("a", "{}")]).into_bank().unwrap();
        let bank = Bank::open(&bytes).unwrap().verify().unwrap();
        let recording = bank.clip_by_key("a").unwrap().recording();
        assert_eq!(recording, Some(Recording::new(i64::MAX as u64, 1)));
    }
}
