//! The readings of Chinese characters in pinyin, without tones: `data/pinyin/readings.bin`.
//!
//! The test of this file writes the data from the crate `pinyin`, whose own tables are five times as large, because they
//! contain the tones and have two entries for each code point.
//!
//! The data begins with all syllables, one a line, up to an empty line. Little-endian 16-bit numbers follow: the number
//! of ranges; the first code point (two numbers, the lower half first) and the length of each range; and for each code
//! point of each range its entry. An entry below the number of syllables is the only reading. [`NONE`] is a character
//! without one. Any other entry, minus the number of syllables, is the position of a list among the numbers after the
//! entries: a count, and as many syllables.

use std::sync::LazyLock;

static BYTES: &[u8] = include_bytes!("../../data/pinyin/readings.bin");

/// The entry of a character without a reading.
const NONE: u16 = u16::MAX;

static READINGS: LazyLock<Readings> = LazyLock::new(|| Readings::new(BYTES).unwrap_or_default());

/// Returns all readings of a Chinese character, or `None` if they are unknown.
pub(super) fn of(c: char) -> Option<impl Iterator<Item = &'static str>> {
    let readings = &*READINGS;
    let single = |entry: &u16| readings.syllables.get(usize::from(*entry)).copied();
    Some(readings.entries(c)?.iter().filter_map(single))
}

#[derive(Default)]
struct Readings {
    syllables: Vec<&'static str>,
    /// The first code point, the length, and the position of the first entry of each range.
    ranges: Vec<(u32, u32, usize)>,
    entries: Vec<u16>,
    lists: Vec<u16>,
}

impl Readings {
    /// Returns `None` for data that ends too early.
    fn new(bytes: &'static [u8]) -> Option<Readings> {
        let end = bytes.windows(2).position(|two| two == b"\n\n")?;
        let syllables: Vec<&str> = std::str::from_utf8(&bytes[..end]).ok()?.split('\n').collect();
        let numbers: Vec<u16> =
            bytes[end + 2..].as_chunks::<2>().0.iter().map(|two| u16::from_le_bytes(*two)).collect();
        let (count, numbers) = numbers.split_first()?;
        let (ranges, numbers) = numbers.split_at_checked(usize::from(*count) * 3)?;
        let mut entry_count = 0;
        let ranges = ranges.as_chunks::<3>().0.iter().map(|[low, high, length]| {
            let first = entry_count;
            entry_count += usize::from(*length);
            (u32::from(*low) | u32::from(*high) << 16, u32::from(*length), first)
        });
        let ranges = ranges.collect();
        let (entries, lists) = numbers.split_at_checked(entry_count)?;
        Some(Readings { syllables, ranges, entries: entries.to_vec(), lists: lists.to_vec() })
    }

    /// Returns the numbers of the syllables of a character.
    fn entries(&self, c: char) -> Option<&[u16]> {
        let (first, _, start) =
            self.ranges.iter().find(|(first, length, _)| (*first..first + length).contains(&u32::from(c)))?;
        let place = start + usize::try_from(u32::from(c) - first).ok()?;
        let entry = self.entries.get(place).filter(|entry| **entry != NONE)?;
        match usize::from(*entry).checked_sub(self.syllables.len()) {
            None => self.entries.get(place..=place),
            Some(list) => self.lists.get(list + 1..)?.get(..usize::from(*self.lists.get(list)?)),
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use pinyin::{Pinyin, ToPinyinMulti};
    use std::collections::BTreeMap;

    /// A gap of characters without readings that begins a new range. A range has three numbers.
    const GAP: u32 = 4;

    /// Returns the different readings of a character, in the order of the crate.
    fn expected(c: char) -> Option<Vec<&'static str>> {
        let mut readings = Vec::new();
        for plain in c.to_pinyin_multi()?.into_iter().map(Pinyin::plain) {
            if !readings.contains(&plain) {
                readings.push(plain);
            }
        }
        Some(readings)
    }

    /// Returns the data.
    fn data() -> Vec<u8> {
        let all: Vec<(u32, Vec<&str>)> =
            ('\0'..=char::MAX).filter_map(|c| Some((u32::from(c), expected(c)?))).collect();
        let mut syllables: Vec<&str> = all.iter().flat_map(|(_, readings)| readings).copied().collect();
        syllables.sort_unstable();
        syllables.dedup();
        let number = |syllable: &&str| u16::try_from(syllables.binary_search(syllable).unwrap()).unwrap();
        let (mut ranges, mut entries, mut lists): (Vec<(u32, u16)>, _, Vec<u16>) = (Vec::new(), Vec::new(), Vec::new());
        let mut places: BTreeMap<Vec<u16>, u16> = BTreeMap::new();
        for (code, readings) in all {
            let numbers: Vec<u16> = readings.iter().map(number).collect();
            let entry = match numbers.as_slice() {
                [single] => *single,
                _ => *places.entry(numbers.clone()).or_insert_with(|| {
                    let place = u16::try_from(syllables.len() + lists.len()).unwrap();
                    lists.push(u16::try_from(numbers.len()).unwrap());
                    lists.extend(&numbers);
                    place
                }),
            };
            match ranges.last_mut() {
                Some((first, length)) if code - (*first + u32::from(*length)) < GAP => {
                    let missing = code - (*first + u32::from(*length));
                    entries.extend((0..missing).map(|_| NONE));
                    *length += u16::try_from(missing).unwrap() + 1;
                }
                _ => ranges.push((code, 1)),
            }
            entries.push(entry);
        }
        let mut numbers = vec![u16::try_from(ranges.len()).unwrap()];
        for (first, length) in ranges {
            numbers.extend([(first & 0xffff) as u16, (first >> 16) as u16, length]);
        }
        assert!(syllables.len() + lists.len() < usize::from(NONE));
        numbers.extend(entries.into_iter().chain(lists));
        let text = syllables.join("\n") + "\n\n";
        text.into_bytes().into_iter().chain(numbers.into_iter().flat_map(u16::to_le_bytes)).collect()
    }

    #[test]
    fn the_data_is_that_of_the_crate() {
        let data = data();
        if std::env::var_os("LIPZ_BLESS").is_some_and(|value| value == "1") {
            let path = concat!(env!("CARGO_MANIFEST_DIR"), "/data/pinyin/readings.bin");
            return std::fs::write(path, data).unwrap();
        }
        assert!(data == BYTES, "run this test with LIPZ_BLESS=1");
    }

    #[test]
    fn every_character_has_the_readings_of_the_crate() {
        for c in '\0'..=char::MAX {
            assert_eq!(of(c).map(Iterator::collect), expected(c), "{c}");
        }
    }

    #[test]
    fn damaged_data_has_no_readings() {
        for length in [0, 10, 3_000] {
            assert!(Readings::new(&BYTES[..length]).is_none_or(|readings| readings.entries('好').is_none()));
        }
    }
}
