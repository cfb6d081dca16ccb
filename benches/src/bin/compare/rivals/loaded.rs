//! Clips in memory: the result of a rival that parses its file.

use crate::corpus::{Clip, Clips, frame_at};
use crate::rival::Reader;
use foldhash::{HashMap, HashMapExt};

/// All clips, and their numbers by key.
pub(crate) struct Loaded {
    clips: Clips,
    numbers: HashMap<String, u32>,
}

impl Loaded {
    /// Stores parsed clips.
    pub(crate) fn new(clips: Clips) -> Loaded {
        let mut numbers = HashMap::with_capacity(clips.clips.len());
        numbers.extend(clips.clips.iter().zip(0..).map(|(clip, number)| (clip.key.clone(), number)));
        Loaded { clips, numbers }
    }
}

impl Reader for Loaded {
    type Clip<'r> = &'r Clip;
    type Locale<'r> = usize;

    fn locale(&self, tag: &str) -> Option<usize> {
        self.clips.locales.iter().position(|locale| locale == tag)
    }

    #[inline]
    fn find(&self, key: &str) -> Option<u32> {
        self.numbers.get(key).copied()
    }

    #[inline]
    fn clip(&self, number: u32) -> Option<&Clip> {
        self.clips.clips.get(number as usize)
    }

    #[inline]
    fn viseme(&self, clip: &Clip, time_us: u32) -> u8 {
        clip.visemes.as_bytes().get(frame_at(clip.fps, time_us)).copied().unwrap_or(b'-')
    }

    #[inline(always)]
    fn text<T>(&self, clip: &Clip, locale: usize, time_us: u32, then: impl FnOnce(&str) -> T) -> Option<T> {
        Some(then(clip.texts.get(locale)?.get(segment(clip, time_us)?)?))
    }

    #[inline(always)]
    fn event<T>(&self, clip: &Clip, time_us: u32, then: impl FnOnce(&str) -> T) -> Option<T> {
        Some(then(clip.events.get(segment(clip, time_us)?).map_or("", String::as_str)))
    }
}

#[inline]
fn segment(clip: &Clip, time_us: u32) -> Option<usize> {
    let frame = frame_at(clip.fps, time_us);
    if frame >= clip.visemes.len() {
        return None;
    }
    clip.starts.partition_point(|&start| start as usize <= frame).checked_sub(1)
}
