//! Checked clips in flat arrays, so that a hundred thousand of them need no allocation each.

mod view;

#[cfg(feature = "shards")]
use super::on_disk::{ClipFile, SourceOnDisk};
use super::{ClipData, ClipText, Curves, Locales, split_run};
use crate::util::strings::Strings;
use lipz_bank::{Fps, VisemeType};
use lipz_layout::U16;
use std::collections::BTreeSet;
pub(crate) use view::Clip;

/// The most bytes of all texts of a locale in one batch.
#[cfg(not(test))]
const MOST_TEXT_BYTES: usize = lipz_layout::TEXT_OFFSET as usize;
#[cfg(test)]
const MOST_TEXT_BYTES: usize = 1 << 20;

/// Clips, part by part: all frames in one buffer, all texts of a locale in one, and so on. A clip stores the ends of
/// its parts in these. They start at the ends of the clip before it. A text stores its own position.
#[derive(Debug, Default)]
pub(crate) struct Clips {
    /// The locales that texts refer to by number.
    pub(crate) locales: Locales,
    heads: Vec<ClipHead>,
    keys: Strings,
    frames: Vec<u8>,
    starts: Vec<u32>,
    texts: Vec<ClipText>,
    /// The ends of the segments of each text of each clip. The layout of a bank uses these without the texts.
    text_ends: Vec<U16>,
    /// The display texts of each locale, by its number, in the order of the bank.
    displays: Vec<Vec<u8>>,
    /// Their total length in bytes.
    display_bytes: usize,
    /// Whether texts are missing because they did not fit into such a buffer.
    lacks_texts: bool,
    events: Strings,
    curves: Curves,
    /// The data of the section of phones.
    phones: Vec<u8>,
    sources: Vec<u8>,
    /// The source of frames, texts and source records that are not in the buffers.
    #[cfg(feature = "shards")]
    staying: Option<ClipsOnDisk>,
}

/// The file that contains the frames, texts and source records of clips.
#[cfg(feature = "shards")]
#[derive(Debug)]
struct ClipsOnDisk {
    file: ClipFile,
    sources: Vec<SourceOnDisk>,
}

/// The data of a clip outside the buffers, and the ends of its parts.
#[derive(Clone, Copy, Debug)]
struct ClipHead {
    fps: Option<Fps>,
    viseme_type: Option<VisemeType>,
    has_visemes: bool,
    has_events: bool,
    /// The flags of the record of phones.
    phone_flags: u32,
    ends: Ends,
}

#[derive(Clone, Copy, Debug, Default)]
struct Ends {
    frames: usize,
    starts: usize,
    texts: usize,
    text_ends: usize,
    events: usize,
    curves: usize,
    phones: usize,
    source: usize,
}

impl Clips {
    /// Creates an empty list whose texts refer to these locales.
    pub(super) fn of_locales(locales: Locales) -> Clips {
        Clips { locales, ..Clips::default() }
    }

    /// Whether the texts of a clip fit in addition to the others.
    pub(super) fn has_room_for(&self, clip: &ClipData) -> bool {
        self.display_bytes + clip.runs.byte_count() <= MOST_TEXT_BYTES
    }

    /// Adds a clip, whose texts refer to `self.locales`.
    pub(crate) fn push(&mut self, key: &str, clip: &ClipData) {
        self.frames.extend_from_slice(&clip.frames);
        self.push_texts(clip);
        self.sources.extend_from_slice(&clip.source);
        let (frames, source) = (self.frames.len(), self.sources.len());
        self.push_tables(key, clip, Ends { frames, source, ..Ends::default() });
    }

    /// Adds everything but the contents of the large buffers, in which the clip has these ends.
    fn push_tables(&mut self, key: &str, clip: &ClipData, ends: Ends) {
        self.keys.push(key);
        self.starts.extend_from_slice(&clip.starts);
        self.events.append(&clip.events);
        clip.curves.iter().for_each(|(name, keys)| self.curves.push(name, keys.iter().copied()));
        let has_phones = !clip.phones.spans.is_empty();
        let phone_flags = if has_phones { clip.phones.encode(&mut self.phones) } else { 0 };
        self.heads.push(ClipHead {
            fps: clip.fps,
            viseme_type: clip.viseme_type,
            has_visemes: clip.has_visemes,
            has_events: clip.has_events,
            phone_flags,
            ends: Ends {
                starts: self.starts.len(),
                texts: self.texts.len(),
                text_ends: self.text_ends.len(),
                events: self.events.count(),
                curves: self.curves.count(),
                phones: self.phones.len(),
                ..ends
            },
        });
    }

    fn push_texts(&mut self, clip: &ClipData) {
        for text in &clip.texts {
            let (displays, ends) = split_run(clip.whole_run(text), clip.starts.len());
            self.text_ends.extend_from_slice(ends);
            let locale = text.locale as usize;
            if self.displays.len() <= locale {
                self.displays.resize_with(locale + 1, Vec::new);
            }
            let of_locale = &mut self.displays[locale];
            let start = of_locale.len();
            if start + displays.len() > MOST_TEXT_BYTES {
                self.lacks_texts = true;
            } else {
                of_locale.extend_from_slice(displays);
                self.display_bytes += displays.len();
            }
            self.texts.push(text.at(start..of_locale.len()));
        }
    }

    /// Creates clips whose frames, texts and source records stay in a file.
    #[cfg(feature = "shards")]
    pub(crate) fn staying_in(file: ClipFile) -> Clips {
        Clips { staying: Some(ClipsOnDisk { file, sources: Vec::new() }), ..Clips::default() }
    }

    /// Adds a text of the clip that is [pushed next](Self::push_staying), which refers to `self.locales`.
    #[cfg(feature = "shards")]
    pub(crate) fn push_staying_text(&mut self, text: ClipText, ends: impl Iterator<Item = U16>) {
        self.texts.push(text);
        self.text_ends.extend(ends);
    }

    /// Adds a clip with this number of frames, which follow those of the clip before it in the file.
    #[cfg(feature = "shards")]
    pub(crate) fn push_staying(&mut self, key: &str, clip: &ClipData, frame_count: usize, source: SourceOnDisk) {
        self.staying.iter_mut().for_each(|staying| staying.sources.push(source));
        let frames = self.heads.last().map_or(0, |last| last.ends.frames) + frame_count;
        self.push_tables(key, clip, Ends { frames, ..Ends::default() });
    }

    /// Frees the space reserved for more clips.
    #[cfg(feature = "shards")]
    pub(crate) fn shrink(&mut self) {
        self.heads.shrink_to_fit();
        self.keys.shrink();
        self.starts.shrink_to_fit();
        self.texts.shrink_to_fit();
        self.text_ends.shrink_to_fit();
        self.events.shrink();
        self.staying.iter_mut().for_each(|staying| staying.sources.shrink_to_fit());
    }

    /// Whether the file that contains data of the clips is unchanged.
    #[cfg(feature = "shards")]
    pub(crate) fn is_as_it_was(&self) -> bool {
        self.staying.as_ref().is_none_or(|staying| staying.file.is_as_it_was())
    }

    /// Returns the number of clips.
    pub(crate) fn count(&self) -> usize {
        self.heads.len()
    }

    /// Frees the memory of keys, events, curves and phones, which must not be used afterwards.
    pub(crate) fn drop_names(&mut self) {
        self.keys = Strings::default();
        self.events = Strings::default();
        self.curves = Curves::default();
        self.phones = Vec::new();
    }

    /// Frees the memory of all but the first `count` clips.
    pub(crate) fn keep_first(&mut self, count: usize) {
        let ends = count.checked_sub(1).map_or(Ends::default(), |last| self.heads[last].ends);
        for text in &self.texts[ends.texts..] {
            if let Some(of_locale) = self.displays.get_mut(text.locale as usize) {
                of_locale.truncate(text.place().start);
            }
        }
        self.displays.iter_mut().for_each(Vec::shrink_to_fit);
        cut(&mut self.heads, count);
        cut(&mut self.frames, ends.frames);
        cut(&mut self.starts, ends.starts);
        cut(&mut self.texts, ends.texts);
        cut(&mut self.text_ends, ends.text_ends);
        cut(&mut self.sources, ends.source);
    }

    /// Returns the clips in the order in which they were added, as the first batch.
    pub(crate) fn iter(&self) -> impl Iterator<Item = Clip<'_>> {
        (0..self.heads.len() as u32).map(|index| Clip { clips: self, batch: 0, index })
    }

    /// Returns the clip with this index, in the order in which they were added.
    pub(crate) fn clip(&self, index: u32) -> Clip<'_> {
        Clip { clips: self, batch: 0, index }
    }

    /// Returns the clips of all `batches`, sorted by key.
    pub(crate) fn by_key(batches: &[Clips]) -> Vec<Clip<'_>> {
        let mut clips: Vec<Clip<'_>> = Vec::with_capacity(batches.iter().map(|clips| clips.heads.len()).sum());
        for (batch, of_batch) in (0..).zip(batches) {
            clips.extend(of_batch.iter().map(|clip| Clip { batch, ..clip }));
        }
        // Sources are sorted by path, so that this stable sort costs little more than a comparison of neighbours.
        clips.sort_by(|a, b| a.key().cmp(b.key()));
        clips
    }

    /// Returns the sorted tags of the locales of all texts in `batches`. Afterwards, the texts refer to these.
    pub(crate) fn join_locales(batches: &mut [Clips]) -> Vec<Box<str>> {
        let mut used = BTreeSet::new();
        for clips in &*batches {
            let mut is_used = vec![false; clips.locales.tags().len()];
            clips.texts.iter().for_each(|text| is_used[text.locale as usize] = true);
            used.extend(
                std::iter::zip(clips.locales.tags(), is_used).filter(|(_, is_used)| *is_used).map(|(tag, _)| tag),
            );
        }
        let tags: Vec<Box<str>> = used.into_iter().cloned().collect();
        batches.iter_mut().for_each(|clips| clips.refer_to(&tags));
        tags
    }

    /// Makes the texts refer to `tags`, which are sorted and contain all of their locales.
    pub(crate) fn refer_to(&mut self, tags: &[Box<str>]) {
        let locales = std::mem::take(&mut self.locales);
        // Unused locales are never looked up.
        let number = |tag| tags.binary_search(tag).map_or(u32::MAX, |number| number as u32);
        let numbers: Vec<u32> = locales.tags().iter().map(number).collect();
        self.texts.iter_mut().for_each(|text| text.locale = numbers[text.locale as usize]);
        let displays = std::mem::take(&mut self.displays);
        self.displays.resize_with(tags.len(), Vec::new);
        for (number, of_locale) in std::iter::zip(numbers, displays) {
            if let Some(place) = self.displays.get_mut(number as usize) {
                *place = of_locale;
            }
        }
    }
}

/// Truncates to `length` items, and frees the rest of the allocation.
fn cut<T>(items: &mut Vec<T>, length: usize) {
    items.truncate(length);
    items.shrink_to_fit();
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clip::Batches;

    /// Adds a clip with this number of frames, and texts that name their locale.
    fn push(clips: &mut Clips, key: &str, frames: usize, tags: &[&str]) {
        let mut clip = ClipData { frames: vec![b'-'; frames], starts: vec![0], ..ClipData::default() };
        for tag in tags {
            clip.displays.clear();
            clip.displays.push(tag);
            clip.add_displays(clips.locales.number(tag, true));
        }
        clips.push(key, &clip);
    }

    #[test]
    fn batches_become_one_list_with_common_locales() {
        let (mut first, mut second) = (Clips::default(), Clips::default());
        push(&mut first, "c", 3, &["de-de", "fr-fr"]);
        first.locales.number("it-it", true);
        push(&mut first, "a", 1, &[]);
        push(&mut second, "b", 2, &["en-us", "fr-fr"]);
        let mut batches = [first, second];
        assert_eq!(Clips::join_locales(&mut batches), ["de-de", "en-us", "fr-fr"].map(Box::from));
        let clips = Clips::by_key(&batches);
        let seen: Vec<_> = clips.iter().map(|clip| (clip.key(), clip.frame_count(), clip.place())).collect();
        assert_eq!(seen, [("a", 1, (0, 1)), ("b", 2, (1, 0)), ("c", 3, (0, 0))]);
        let run = |clip: &Clip<'_>, locale| clip.text_in(locale).map(|index| clip.displays(index).bytes().to_vec());
        let texts: Vec<_> = clips.iter().map(|clip| [0, 1, 2].map(|locale| run(clip, locale))).collect();
        let [de, en, fr] = ["de-de", "en-us", "fr-fr"].map(|tag| Some(tag.into()));
        assert_eq!(texts, [[None, None, None], [None, en, fr.clone()], [de, None, fr]]);
    }

    #[test]
    fn more_texts_than_a_batch_has_room_for_come_into_another_one() {
        let mut batches = Batches::default();
        let half = "x".repeat(MOST_TEXT_BYTES / 2 - 8);
        for tag in ["en-us", "de-de", "en-us", "en-us", "de-de"] {
            let mut clip = ClipData { starts: vec![0], ..ClipData::default() };
            clip.displays.push(&half);
            clip.add_displays(batches.locales().number(tag, true));
            batches.push(tag, &clip);
        }
        let mut batches = batches.into_all();
        assert_eq!(batches.iter().map(Clips::count).collect::<Vec<_>>(), [2, 2, 1]);
        assert_eq!(Clips::join_locales(&mut batches), ["de-de", "en-us"].map(Box::from));
        for clip in Clips::by_key(&batches) {
            let text = clip.text_in(u32::from(clip.key() == "en-us")).unwrap();
            assert!(*clip.displays(text).bytes() == *half.as_bytes() && !clip.lacks_texts());
        }
    }

    #[test]
    fn who_fills_one_batch_alone_is_told_that_texts_are_missing() {
        let mut clips = Clips::default();
        let half = "x".repeat(MOST_TEXT_BYTES / 2);
        for tag in ["de-de", "en-us", "en-us", "en-us"] {
            assert!(!clips.lacks_texts);
            let mut clip = ClipData { starts: vec![0], ..ClipData::default() };
            clip.displays.push(&half);
            clip.add_displays(clips.locales.number(tag, true));
            clips.push("", &clip);
        }
        let lengths: Vec<usize> = clips.iter().map(|clip| clip.displays(0).length()).collect();
        assert!(lengths == [half.len(), half.len(), half.len(), 0] && clips.iter().all(|clip| clip.lacks_texts()));
        clips.keep_first(1);
        assert_eq!(clips.displays.iter().map(Vec::len).collect::<Vec<_>>(), [half.len(), 0]);
    }
}
