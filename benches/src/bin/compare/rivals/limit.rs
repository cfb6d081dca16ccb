//! The limit: flat arrays over the map, written for these very clips, with no checks but of bounds.

use crate::Failure;
use crate::corpus::{Corpus, frame_at};
use crate::rival::{File, Reader, Rival};
use lipz_bank::ClipId;
use std::path::Path;
use zerocopy::little_endian::{U16, U32};
use zerocopy::{FromBytes, Immutable, IntoBytes, KnownLayout, Unaligned};

/// Flat arrays.
pub(crate) struct Limit;

/// Place of the hash table that no clip has.
const FREE: u32 = u32::MAX;

#[derive(FromBytes, IntoBytes, Immutable, KnownLayout, Unaligned, Clone, Copy)]
#[repr(C)]
struct Place {
    /// The upper half of the key's hash.
    hash: U32,
    /// Number of the clip, or [`FREE`].
    number: U32,
}

#[derive(FromBytes, IntoBytes, Immutable, KnownLayout, Unaligned, Clone, Copy)]
#[repr(C)]
pub(crate) struct Record {
    key_offset: U32,
    key_length: U16,
    fps: u8,
    viseme_type: u8,
    frames_offset: U32,
    frame_count: U32,
    /// The first of its segments, counted over all clips.
    segments_first: U32,
    segment_count: U32,
}

/// The arrays of the file. Before each array stands its length in bytes.
#[derive(Clone, Copy)]
pub(crate) struct Arrays {
    places: &'static [Place],
    records: &'static [Record],
    /// First frames of all segments.
    starts: &'static [U16],
    keys: &'static [u8],
    frames: &'static [u8],
    /// For each locale, where the text of each segment of all clips ends.
    text_ends: &'static [U32],
    texts: &'static [u8],
    event_ends: &'static [U32],
    events: &'static [u8],
    tags: &'static [u8],
}

impl Rival for Limit {
    const NAME: &'static str = "limit: flat arrays";
    type Reader = Arrays;

    fn build(corpus: &Corpus, path: &Path) -> Result<(), Failure> {
        let clips = &corpus.bank.clips;
        let free = Place { hash: 0.into(), number: FREE.into() };
        let mut places = vec![free; (clips.len() * 3 / 2 + 1).next_power_of_two()];
        let mut records = Vec::new();
        let (mut starts, mut keys, mut frames) = (Vec::new(), String::new(), String::new());
        let (mut event_ends, mut events) = (Vec::new(), String::new());
        for (clip, number) in clips.iter().zip(0_u32..) {
            let hash = ClipId::from_key(&clip.key).get();
            let mut place = hash as usize & (places.len() - 1);
            while places[place].number.get() != FREE {
                place = (place + 1) & (places.len() - 1);
            }
            places[place] = Place { hash: ((hash >> 32) as u32).into(), number: number.into() };
            records.push(Record {
                key_offset: (keys.len() as u32).into(),
                key_length: (clip.key.len() as u16).into(),
                fps: clip.fps as u8,
                viseme_type: clip.viseme_type,
                frames_offset: (frames.len() as u32).into(),
                frame_count: (clip.visemes.len() as u32).into(),
                segments_first: (starts.len() as u32).into(),
                segment_count: (clip.starts.len() as u32).into(),
            });
            keys.push_str(&clip.key);
            frames.push_str(&clip.visemes);
            starts.extend(clip.starts.iter().map(|&start| U16::new(start as u16)));
            for segment in 0..clip.starts.len() {
                events.push_str(clip.events.get(segment).map_or("", String::as_str));
                event_ends.push(U32::new(events.len() as u32));
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
            places.as_bytes(),
            records.as_bytes(),
            starts.as_bytes(),
            keys.as_bytes(),
            frames.as_bytes(),
            text_ends.as_bytes(),
            texts.as_bytes(),
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

    /// Checks what the unchecked strings rely on, and that the arrays refer to each other.
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
            places: <[Place]>::ref_from_bytes(next()?).ok()?,
            records: <[Record]>::ref_from_bytes(next()?).ok()?,
            starts: <[U16]>::ref_from_bytes(next()?).ok()?,
            keys: next()?,
            frames: next()?,
            text_ends: <[U32]>::ref_from_bytes(next()?).ok()?,
            texts: next()?,
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
        self.places.len().is_power_of_two()
            && ends_are_valid(self.text_ends, texts)
            && ends_are_valid(self.event_ends, events)
            && self.places.iter().any(|place| place.number.get() == FREE)
            && self.records.iter().all(|record| {
                keys.get(range(record.key_offset, record.key_length.get().into())).is_some()
                    && self.frames.get(range(record.frames_offset, record.frame_count.get())).is_some()
                    && self.starts.get(range(record.segments_first, record.segment_count.get())).is_some()
            })
    }
}

/// Ends ascend, and stand between characters.
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
    /// The ends of the texts of the locale: from the one before its first text.
    type Locale<'r> = usize;

    fn locale(&self, tag: &str) -> Option<usize> {
        let locale = std::str::from_utf8(self.tags).ok()?.split(' ').position(|known| known == tag)?;
        Some(locale * self.starts.len())
    }

    #[inline]
    fn find(&self, key: &str) -> Option<u32> {
        let hash = ClipId::from_key(key).get();
        let mut place = hash as usize;
        loop {
            let found = self.places.get(place & (self.places.len() - 1))?;
            if found.number.get() == FREE {
                return None;
            }
            if u64::from(found.hash.get()) == hash >> 32 {
                let record = self.records.get(found.number.get() as usize)?;
                let start = record.key_offset.get() as usize;
                if self.keys.get(start..start + usize::from(record.key_length.get()))? == key.as_bytes() {
                    return Some(found.number.get());
                }
            }
            place += 1;
        }
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

    #[inline]
    fn text<T>(&self, clip: &Record, locale: usize, time_us: u32, then: impl FnOnce(&str) -> T) -> Option<T> {
        let frame = frame_at(clip.fps.into(), time_us);
        if frame >= clip.frame_count.get() as usize {
            return None;
        }
        let first = clip.segments_first.get() as usize;
        let starts = self.starts.get(first..first + clip.segment_count.get() as usize)?;
        let segment = starts.iter().rposition(|start| usize::from(start.get()) <= frame)?;
        let at = locale + first + segment;
        let end = self.text_ends.get(at)?.get() as usize;
        let start = at.checked_sub(1).map_or(Some(0), |before| Some(self.text_ends.get(before)?.get() as usize))?;
        // SAFETY: the file is what `build` wrote, or was validated.
        Some(then(unsafe { std::str::from_utf8_unchecked(self.texts.get(start..end)?) }))
    }
}
