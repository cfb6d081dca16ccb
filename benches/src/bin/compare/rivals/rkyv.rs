//! rkyv: the structures themselves, used in place.

use crate::Failure;
use crate::corpus::{ArchivedClip, ArchivedClips, Clips, Corpus, frame_at};
use crate::rival::{File, Reader, Rival};
use rkyv::rancor::Error;
use rkyv::ser::writer::IoWriter;
use std::collections::HashMap;
use std::path::Path;

/// The clips and a map from keys to their numbers.
pub(crate) struct Rkyv;

/// The file.
#[derive(rkyv::Archive, rkyv::Serialize)]
pub(crate) struct Bank<'c> {
    #[rkyv(with = rkyv::with::Inline)]
    clips: &'c Clips,
    numbers: HashMap<String, u32>,
}

impl Rival for Rkyv {
    const NAME: &'static str = "rkyv 0.8";
    type Reader = &'static ArchivedBank<'static>;

    fn build(corpus: &Corpus, path: &Path) -> Result<(), Failure> {
        let numbers = corpus.bank.clips.iter().zip(0..).map(|(clip, number)| (clip.key.clone(), number));
        let bank = Bank { clips: &corpus.bank, numbers: numbers.collect() };
        rkyv::api::high::to_bytes_in::<_, Error>(&bank, IoWriter::new(std::fs::File::create(path)?))?;
        Ok(())
    }

    fn open(file: &'static File) -> Result<Self::Reader, Failure> {
        // SAFETY: `build` wrote the file.
        Ok(unsafe { rkyv::access_unchecked::<ArchivedBank<'static>>(&file.map) })
    }

    fn open_validated(file: &'static File) -> Result<Self::Reader, Failure> {
        Ok(rkyv::access::<ArchivedBank<'static>, Error>(&file.map)?)
    }
}

impl Reader for &'static ArchivedBank<'static> {
    type Clip<'r> = &'r ArchivedClip;
    type Locale<'r> = usize;

    fn locale(&self, tag: &str) -> Option<usize> {
        let clips: &ArchivedClips = &self.clips;
        clips.locales.iter().position(|locale| locale == tag)
    }

    #[inline]
    fn find(&self, key: &str) -> Option<u32> {
        self.numbers.get(key).map(|number| number.to_native())
    }

    #[inline]
    fn clip(&self, number: u32) -> Option<&ArchivedClip> {
        self.clips.clips.get(number as usize)
    }

    #[inline]
    fn viseme(&self, clip: &ArchivedClip, time_us: u32) -> u8 {
        clip.visemes.as_bytes().get(frame_at(clip.fps.to_native(), time_us)).copied().unwrap_or(b'-')
    }

    #[inline(always)]
    fn text<T>(&self, clip: &ArchivedClip, locale: usize, time_us: u32, then: impl FnOnce(&str) -> T) -> Option<T> {
        Some(then(clip.texts.get(locale)?.get(segment(clip, time_us)?)?))
    }

    #[inline(always)]
    fn event<T>(&self, clip: &ArchivedClip, time_us: u32, then: impl FnOnce(&str) -> T) -> Option<T> {
        Some(then(clip.events.get(segment(clip, time_us)?).map_or("", |event| event.as_str())))
    }
}

#[inline]
fn segment(clip: &ArchivedClip, time_us: u32) -> Option<usize> {
    let frame = frame_at(clip.fps.to_native(), time_us);
    if frame >= clip.visemes.len() {
        return None;
    }
    clip.starts.partition_point(|start| start.to_native() as usize <= frame).checked_sub(1)
}
