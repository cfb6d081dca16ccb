//! zerovec: sorted keys, vectors of numbers and of strings, like the data of ICU4X.

use crate::Failure;
use crate::corpus::{Corpus, frame_at};
use crate::rival::{File, Reader, Rival};
use serde::{Deserialize, Serialize};
use std::path::Path;
use zerovec::vecs::Index32;
use zerovec::{VarZeroVec, ZeroVec};

/// The vectors, encoded by postcard.
pub(crate) struct ZeroVectors;

/// One vector per element. Data of segments is in the order of the segments of all clips.
#[derive(Serialize, Deserialize)]
pub(crate) struct Vectors<'d> {
    #[serde(borrow)]
    locales: VarZeroVec<'d, str>,
    /// In ascending order, for a binary search.
    #[serde(borrow)]
    keys: VarZeroVec<'d, str, Index32>,
    #[serde(borrow)]
    fps: ZeroVec<'d, u8>,
    #[serde(borrow)]
    viseme_types: ZeroVec<'d, u8>,
    #[serde(borrow)]
    visemes: VarZeroVec<'d, [u8], Index32>,
    /// The first segment of each clip, and the total number.
    #[serde(borrow)]
    first_segments: ZeroVec<'d, u32>,
    #[serde(borrow)]
    starts: ZeroVec<'d, u16>,
    /// For each locale in turn, the text of each segment.
    #[serde(borrow)]
    texts: VarZeroVec<'d, str, Index32>,
    #[serde(borrow)]
    events: VarZeroVec<'d, str, Index32>,
}

impl Rival for ZeroVectors {
    const NAME: &'static str = "zerovec 0.11";
    type Reader = Vectors<'static>;

    fn build(corpus: &Corpus, path: &Path) -> Result<(), Failure> {
        let clips = &corpus.bank.clips;
        let mut first_segments = vec![0];
        let mut events = Vec::new();
        for clip in clips {
            first_segments.push(first_segments[first_segments.len() - 1] + clip.starts.len() as u32);
            events.extend((0..clip.starts.len()).map(|segment| clip.events.get(segment).map_or("", String::as_str)));
        }
        let texts =
            (0..corpus.bank.locales.len()).flat_map(|locale| clips.iter().flat_map(move |clip| &clip.texts[locale]));
        let vectors = Vectors {
            locales: VarZeroVec::from(corpus.bank.locales.as_slice()),
            keys: VarZeroVec::from(clips.iter().map(|clip| clip.key.as_str()).collect::<Vec<_>>().as_slice()),
            fps: clips.iter().map(|clip| clip.fps as u8).collect(),
            viseme_types: clips.iter().map(|clip| clip.viseme_type).collect(),
            visemes: VarZeroVec::from(clips.iter().map(|clip| clip.visemes.as_bytes()).collect::<Vec<_>>().as_slice()),
            first_segments: first_segments.into_iter().collect(),
            starts: clips.iter().flat_map(|clip| &clip.starts).map(|&start| start as u16).collect(),
            texts: VarZeroVec::from(texts.collect::<Vec<_>>().as_slice()),
            events: VarZeroVec::from(events.as_slice()),
        };
        Ok(std::fs::write(path, postcard::to_stdvec(&vectors)?)?)
    }

    /// serde cannot open without validation.
    fn open(file: &'static File) -> Result<Vectors<'static>, Failure> {
        Ok(postcard::from_bytes(&file.map)?)
    }

    fn open_validated(file: &'static File) -> Result<Vectors<'static>, Failure> {
        Self::open(file)
    }
}

impl Reader for Vectors<'static> {
    type Clip<'r> = Clip<'r>;
    type Locale<'r> = usize;

    fn locale(&self, tag: &str) -> Option<usize> {
        let locale = self.locales.iter().position(|locale| locale == tag)?;
        Some(locale * self.starts.len())
    }

    #[inline]
    fn find(&self, key: &str) -> Option<u32> {
        self.keys.binary_search(key).ok().map(|number| number as u32)
    }

    #[inline]
    fn clip(&self, number: u32) -> Option<Clip<'_>> {
        let number = number as usize;
        let (fps, visemes) = (self.fps.get(number)?, self.visemes.get(number)?);
        Some(Clip { fps: fps.into(), visemes, number })
    }

    #[inline]
    fn viseme(&self, clip: Clip<'_>, time_us: u32) -> u8 {
        clip.visemes.get(frame_at(clip.fps, time_us)).copied().unwrap_or(b'-')
    }

    #[inline(always)]
    fn text<T>(&self, clip: Clip<'_>, locale: usize, time_us: u32, then: impl FnOnce(&str) -> T) -> Option<T> {
        Some(then(self.texts.get(locale + self.segment(clip, time_us)?)?))
    }

    #[inline(always)]
    fn event<T>(&self, clip: Clip<'_>, time_us: u32, then: impl FnOnce(&str) -> T) -> Option<T> {
        Some(then(self.events.get(self.segment(clip, time_us)?)?))
    }
}

impl Vectors<'static> {
    /// Returns the segment at a time, counted over all clips.
    #[inline]
    fn segment(&self, clip: Clip<'_>, time_us: u32) -> Option<usize> {
        let frame = frame_at(clip.fps, time_us);
        if frame >= clip.visemes.len() {
            return None;
        }
        let first = self.first_segments.get(clip.number)? as usize;
        let end = self.first_segments.get(clip.number + 1)? as usize;
        let starts = self.starts.as_ule_slice().get(first..end)?;
        Some(first + starts.iter().rposition(|start| usize::from(start.as_unsigned_int()) <= frame)?)
    }
}

/// A clip, as a program stores it.
#[derive(Clone, Copy)]
pub(crate) struct Clip<'v> {
    fps: u32,
    visemes: &'v [u8],
    number: usize,
}
