//! The limit: flat arrays in the map, made for these clips only, with no checks except of bounds. Numbers are as short
//! as these clips allow, equal event strings are shared, and keys are found by a minimal perfect hash that stores only
//! pilots. The key itself is compared.

use crate::Failure;
use crate::corpus::{Corpus, frame_at};
use crate::rival::{File, Reader, Rival};
use lipz_bank::ClipId;
use lipz_layout::{DIRECT_SLOT, bucket_of, slot_of, spread};
use std::collections::HashMap;
use std::path::Path;
use zerocopy::little_endian::{U16, U32};
use zerocopy::{FromBytes, FromZeros, Immutable, IntoBytes, KnownLayout, Unaligned};

/// Flat arrays.
pub(crate) struct Limit;

#[derive(FromBytes, IntoBytes, Immutable, KnownLayout, Unaligned, Clone, Copy)]
#[repr(C)]
pub(crate) struct Record {
    key_offset: U32,
    key_length: U16,
    fps: u8,
    viseme_type: u8,
    frames_offset: U32,
    frame_count: U16,
    segment_count: U16,
    /// Its first segment, counted over all clips.
    segments_first: U32,
}

/// The arrays of the file. Each is preceded by its length in bytes.
#[derive(Clone, Copy)]
pub(crate) struct Arrays {
    pilots: &'static [U32],
    /// Ordered by number, as in the index.
    records: &'static [Record],
    /// First frames of all segments.
    starts: &'static [U16],
    keys: &'static [u8],
    frames: &'static [u8],
    /// For each locale, the end of each segment's text, for all clips.
    text_ends: &'static [U32],
    texts: &'static [u8],
    /// For each segment, the number of its event string; 0 is the empty one.
    event_numbers: &'static [U16],
    event_ends: &'static [U32],
    events: &'static [u8],
    tags: &'static [u8],
}

impl Rival for Limit {
    const NAME: &'static str = "limit: flat arrays";
    type Reader = Arrays;

    fn build(corpus: &Corpus, path: &Path) -> Result<(), Failure> {
        let clips = &corpus.bank.clips;
        let ids: Vec<u64> = clips.iter().map(|clip| ClipId::from_key(&clip.key).get()).collect();
        let (pilots, numbers) = index(&ids);
        let mut records = vec![Record::new_zeroed(); clips.len()];
        let (mut starts, mut keys, mut frames) = (Vec::new(), String::new(), String::new());
        let (mut event_numbers, mut event_ends, mut events) = (Vec::new(), vec![U32::new(0)], String::new());
        let mut known = HashMap::from([("", 0)]);
        for (clip, number) in clips.iter().zip(numbers) {
            records[number] = Record {
                key_offset: (keys.len() as u32).into(),
                key_length: (clip.key.len() as u16).into(),
                fps: clip.fps as u8,
                viseme_type: clip.viseme_type,
                frames_offset: (frames.len() as u32).into(),
                frame_count: (clip.visemes.len() as u16).into(),
                segment_count: (clip.starts.len() as u16).into(),
                segments_first: (starts.len() as u32).into(),
            };
            keys.push_str(&clip.key);
            frames.push_str(&clip.visemes);
            starts.extend(clip.starts.iter().map(|&start| U16::new(start as u16)));
            for segment in 0..clip.starts.len() {
                let event = clip.events.get(segment).map_or("", String::as_str);
                let number = *known.entry(event).or_insert_with(|| {
                    events.push_str(event);
                    event_ends.push(U32::new(events.len() as u32));
                    event_ends.len() as u16 - 1
                });
                event_numbers.push(U16::new(number));
            }
        }
        let (mut text_ends, mut texts) = (Vec::new(), String::new());
        for locale in 0..corpus.bank.locales.len() {
            for text in clips.iter().flat_map(|clip| &clip.texts[locale]) {
                texts.push_str(text);
                text_ends.push(U32::new(texts.len() as u32));
            }
        }
        let tags = corpus.bank.locales.join(" ");
        let arrays = [
            pilots.as_bytes(),
            records.as_bytes(),
            starts.as_bytes(),
            keys.as_bytes(),
            frames.as_bytes(),
            text_ends.as_bytes(),
            texts.as_bytes(),
            event_numbers.as_bytes(),
            event_ends.as_bytes(),
            events.as_bytes(),
            tags.as_bytes(),
        ];
        let mut file = Vec::new();
        for array in arrays {
            file.extend((array.len() as u32).to_le_bytes());
            file.extend(array);
        }
        Ok(std::fs::write(path, file)?)
    }

    fn open(file: &'static File) -> Result<Arrays, Failure> {
        Arrays::from_bytes(&file.map).ok_or_else(|| "the file is cut off".into())
    }

    /// Checks the conditions for unchecked strings, and the references between arrays.
    fn open_validated(file: &'static File) -> Result<Arrays, Failure> {
        let arrays = Self::open(file)?;
        if arrays.is_valid() { Ok(arrays) } else { Err("the file is damaged".into()) }
    }
}

impl Arrays {
    fn from_bytes(mut bytes: &'static [u8]) -> Option<Arrays> {
        let mut next = || {
            let (length, rest) = U32::read_from_prefix(bytes).ok()?;
            let (array, rest) = rest.split_at_checked(length.get() as usize)?;
            bytes = rest;
            Some(array)
        };
        Some(Arrays {
            pilots: <[U32]>::ref_from_bytes(next()?).ok()?,
            records: <[Record]>::ref_from_bytes(next()?).ok()?,
            starts: <[U16]>::ref_from_bytes(next()?).ok()?,
            keys: next()?,
            frames: next()?,
            text_ends: <[U32]>::ref_from_bytes(next()?).ok()?,
            texts: next()?,
            event_numbers: <[U16]>::ref_from_bytes(next()?).ok()?,
            event_ends: <[U32]>::ref_from_bytes(next()?).ok()?,
            events: next()?,
            tags: next()?,
        })
    }

    fn is_valid(&self) -> bool {
        let (Ok(keys), Ok(texts), Ok(events), Ok(_), true) = (
            std::str::from_utf8(self.keys),
            std::str::from_utf8(self.texts),
            std::str::from_utf8(self.events),
            std::str::from_utf8(self.tags),
            self.frames.is_ascii(),
        ) else {
            return false;
        };
        let range = |offset: U32, length: u32| offset.get() as usize..offset.get() as usize + length as usize;
        ends_are_valid(self.text_ends, texts)
            && ends_are_valid(self.event_ends, events)
            && self.event_numbers.iter().all(|number| usize::from(number.get()) < self.event_ends.len())
            && self.records.iter().all(|record| {
                keys.get(range(record.key_offset, record.key_length.get().into())).is_some()
                    && self.frames.get(range(record.frames_offset, record.frame_count.get().into())).is_some()
                    && self.starts.get(range(record.segments_first, record.segment_count.get().into())).is_some()
            })
    }
}

/// Whether ends ascend and are between characters.
fn ends_are_valid(ends: &[U32], pool: &str) -> bool {
    let mut before = 0;
    ends.iter().all(|end| {
        let ascends = before <= end.get();
        before = end.get();
        ascends && pool.is_char_boundary(before as usize)
    })
}

impl Reader for Arrays {
    type Clip<'r> = &'r Record;
    /// The index of the end before the locale's first text.
    type Locale<'r> = usize;

    fn locale(&self, tag: &str) -> Option<usize> {
        let locale = std::str::from_utf8(self.tags).ok()?.split(' ').position(|known| known == tag)?;
        Some(locale * self.starts.len())
    }

    #[inline]
    fn find(&self, key: &str) -> Option<u32> {
        let spread = spread(ClipId::from_key(key).get(), 0);
        let pilot = self.pilots.get(bucket_of(spread, self.pilots.len() as u32) as usize)?.get();
        let number = slot_of(spread, pilot, self.records.len() as u32);
        let record = self.records.get(number as usize)?;
        let start = record.key_offset.get() as usize;
        let found = self.keys.get(start..start + usize::from(record.key_length.get()))?;
        (found == key.as_bytes()).then_some(number)
    }

    #[inline]
    fn clip(&self, number: u32) -> Option<&Record> {
        self.records.get(number as usize)
    }

    #[inline]
    fn viseme(&self, clip: &Record, time_us: u32) -> u8 {
        let frame = frame_at(clip.fps.into(), time_us);
        if frame >= clip.frame_count.get() as usize {
            return b'-';
        }
        self.frames.get(clip.frames_offset.get() as usize + frame).copied().unwrap_or(b'-')
    }

    #[inline(always)]
    fn text<T>(&self, clip: &Record, locale: usize, time_us: u32, then: impl FnOnce(&str) -> T) -> Option<T> {
        let at = locale + self.segment(clip, time_us)?;
        let end = self.text_ends.get(at)?.get() as usize;
        let start = at.checked_sub(1).map_or(Some(0), |before| Some(self.text_ends.get(before)?.get() as usize))?;
        // SAFETY: `build` wrote the file, or it was validated.
        Some(then(unsafe { std::str::from_utf8_unchecked(self.texts.get(start..end)?) }))
    }

    #[inline(always)]
    fn event<T>(&self, clip: &Record, time_us: u32, then: impl FnOnce(&str) -> T) -> Option<T> {
        let number = usize::from(self.event_numbers.get(self.segment(clip, time_us)?)?.get());
        let end = self.event_ends.get(number)?.get() as usize;
        let start = if number == 0 { 0 } else { self.event_ends.get(number - 1)?.get() as usize };
        // SAFETY: `build` wrote the file, or it was validated.
        Some(then(unsafe { std::str::from_utf8_unchecked(self.events.get(start..end)?) }))
    }
}

impl Arrays {
    /// Returns the segment at a time, counted over all clips.
    #[inline]
    fn segment(&self, clip: &Record, time_us: u32) -> Option<usize> {
        let frame = frame_at(clip.fps.into(), time_us);
        if frame >= clip.frame_count.get() as usize {
            return None;
        }
        let first = clip.segments_first.get() as usize;
        let starts = self.starts.get(first..first + clip.segment_count.get() as usize)?;
        Some(first + starts.iter().rposition(|start| usize::from(start.get()) <= frame)?)
    }
}

/// Returns the pilots of a minimal perfect hash ("hash, displace"), and the number of each id.
fn index(ids: &[u64]) -> (Vec<U32>, Vec<usize>) {
    let count = ids.len() as u32;
    let mut buckets = vec![Vec::new(); ids.len().div_ceil(3)];
    let bucket_count = buckets.len() as u32;
    for (at, id) in ids.iter().enumerate() {
        let spread = spread(*id, 0);
        buckets[bucket_of(spread, bucket_count) as usize].push((at, spread));
    }
    let mut order: Vec<usize> = (0..buckets.len()).collect();
    order.sort_by_key(|&bucket| std::cmp::Reverse(buckets[bucket].len()));
    let (mut pilots, mut numbers) = (vec![U32::new(0); buckets.len()], vec![0; ids.len()]);
    let (mut taken, mut lowest) = (vec![false; ids.len()], 0);
    for bucket in order {
        let ids = &buckets[bucket];
        let pilot = match ids.len() {
            0 => 0,
            1 => {
                lowest += taken[lowest..].iter().take_while(|taken| **taken).count();
                DIRECT_SLOT | lowest as u32
            }
            _ => (0..DIRECT_SLOT)
                .find(|&pilot| {
                    let slots: Vec<u32> = ids.iter().map(|(_, spread)| slot_of(*spread, pilot, count)).collect();
                    let is_new = |(at, slot): (usize, &u32)| !taken[*slot as usize] && !slots[..at].contains(slot);
                    slots.iter().enumerate().all(is_new)
                })
                .expect("a pilot for distinct ids"),
        };
        pilots[bucket] = pilot.into();
        for (at, spread) in ids {
            let slot = slot_of(*spread, pilot, count) as usize;
            (taken[slot], numbers[*at]) = (true, slot);
        }
    }
    (pilots, numbers)
}
