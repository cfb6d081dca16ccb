//! What a clip of a bank says, compared and put into another bank.

use super::links::Whose;
use crate::clip::{ClipData, Clips};
use crate::dubs::Dubs;
use crate::localise::{LocaleColumn, Localised, Other};
use crate::lower::{Beside, Layout};
use crate::source_index::SourceIndex;
use lipz_bank::{Bank, Clip, Locale, Text};
use lipz_diagnostics::Report;
use lipz_layout::{Tag, U32};
use zerocopy::FromBytes;

/// Where the text is that a clip shows in a locale.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Shown {
    /// There is none.
    Nothing,
    /// The clip has a text in the locale.
    Own,
    /// It shows its text in the locale with this number.
    Fallback(usize),
    /// It shows that of a locale which the bank does not have.
    Borrowed,
}

/// The texts of a clip in all locales: for each what is shown, and the texts of its segments.
pub(super) struct Texts<'d> {
    pub(super) shown: Vec<Shown>,
    texts: Vec<Vec<&'d [u8]>>,
}

impl<'d> Texts<'d> {
    /// The texts that `text` gives for so many locales and segments.
    pub(super) fn new(
        locale_count: usize,
        segment_count: u32,
        text: impl Fn(usize, u32) -> Option<Text<'d>>,
    ) -> Texts<'d> {
        let firsts: Vec<_> = (0..locale_count).map(|locale| text(locale, 0)).collect();
        // Texts of a clip in two locales never have one place, so the place says whose text it is. An empty text is where the
        // next one starts, so that its end counts, too.
        let place = |first: &Text<'_>, locale: usize| {
            let last = text(locale, segment_count.saturating_sub(1)).unwrap_or(*first);
            (first.as_str().as_ptr(), last.as_str().as_bytes().as_ptr_range().end)
        };
        let own = firsts.iter().enumerate().filter_map(|(locale, text)| Some((text.as_ref()?, locale)));
        let mut own: Vec<_> =
            own.filter(|(text, _)| !text.is_fallback()).map(|(text, locale)| (place(text, locale), locale)).collect();
        own.sort_unstable();
        let shown = firsts.iter().enumerate().map(|(locale, first)| match first {
            None => Shown::Nothing,
            Some(first) if !first.is_fallback() => Shown::Own,
            Some(first) => match own.binary_search_by_key(&place(first, locale), |(place, _)| *place) {
                Ok(found) => Shown::Fallback(own[found].1),
                Err(_) => Shown::Borrowed,
            },
        });
        let shown: Vec<Shown> = shown.collect();
        let texts = shown.iter().enumerate().map(|(locale, shown)| {
            let segments = if matches!(shown, Shown::Own | Shown::Borrowed) { segment_count } else { 0 };
            let bytes = |segment| text(locale, segment).map_or(&b""[..], |text| text.as_str().as_bytes());
            (0..segments).map(bytes).collect()
        });
        Texts { texts: texts.collect(), shown }
    }

    /// The texts of a clip in these locales of its bank or dialogue.
    pub(super) fn of(clip: &Clip<'d>, locales: &[Locale]) -> Texts<'d> {
        Texts::new(locales.len(), clip.segment_count(), |locale, segment| clip.segment(segment)?.text(locales[locale]))
    }

    /// Makes copies of own texts fallbacks: a text bank contains the text of a different locale again.
    pub(super) fn without_copies(mut self) -> Texts<'d> {
        for locale in 0..self.shown.len() {
            let is_same = |other: &usize| self.shown[*other] == Shown::Own && self.texts[*other] == self.texts[locale];
            let of_copy =
                (self.shown[locale] == Shown::Borrowed).then(|| (0..self.shown.len()).find(is_same)).flatten();
            if let Some(other) = of_copy {
                self.shown[locale] = Shown::Fallback(other);
                self.texts[locale].clear();
            }
        }
        self
    }

    /// Whether the clip has a text for this locale and no other one.
    pub(super) fn has_own(&self, locale: usize) -> bool {
        matches!(self.shown[locale], Shown::Own | Shown::Borrowed)
    }

    /// The texts of the segments in a locale, if they are not those of another one.
    pub(super) fn segments(&self, locale: usize) -> &[&'d [u8]] {
        &self.texts[locale]
    }
}

/// Makes `data` a clip with what `clip` has beside texts, or, without one, with so many segments of nothing.
pub(super) fn take_clip(clip: Option<&Clip<'_>>, segment_count: u32, data: &mut ClipData) {
    data.clear();
    let Some(clip) = clip else {
        data.starts.resize(segment_count as usize, 0);
        return;
    };
    data.fps = clip.fps();
    data.viseme_type = clip.viseme_type();
    data.has_visemes = clip.has_visemes();
    data.frames.extend_from_slice(clip.frames());
    data.starts.extend(clip.segments().map(|segment| segment.start_frame()));
    data.has_events = clip.has_events();
    clip.segments().filter_map(|segment| segment.event()).for_each(|event| data.events.push(event));
    for curve in clip.curves() {
        data.curves.push(curve.name().as_str(), curve.keys().map(|key| (key.frame, key.value)));
    }
}

/// Gives `data` the texts that are not those of other locales, whose numbers are those of `texts`.
/// Nor those that are an original's.
pub(super) fn take_texts(texts: &Texts<'_>, whose: &Whose, number: impl Fn(usize) -> u32, data: &mut ClipData) {
    for (locale, shown) in texts.shown.iter().enumerate() {
        if matches!(shown, Shown::Own | Shown::Borrowed) && !whose.is_original(locale) {
            let segments = texts.segments(locale).iter().copied();
            data.add_texts(number(locale), segments, *shown == Shown::Borrowed);
        }
    }
}

/// Whether two clips are the same but for their texts.
pub(super) fn are_equal(one: &Clip<'_>, other: &Clip<'_>) -> bool {
    let about = |clip: &Clip<'_>| {
        (clip.fps(), clip.viseme_type(), clip.has_visemes(), clip.has_events(), clip.recording(), clip.segment_count())
    };
    let segments = || std::iter::zip(one.segments(), other.segments());
    about(one) == about(other)
        && one.frames() == other.frames()
        && segments().all(|(one, other)| one.start_frame() == other.start_frame() && one.event() == other.event())
        && one.curves().map(|curve| curve.name().as_str()).eq(other.curves().map(|curve| curve.name().as_str()))
        && std::iter::zip(one.curves(), other.curves()).all(|(one, other)| one.keys().eq(other.keys()))
}

/// The source records of a bank.
pub(super) struct Records<'d>(Option<(SourceIndex<'d>, &'d [u8])>);

impl<'d> Records<'d> {
    pub(super) fn of(bank: &Bank<'d>) -> Records<'d> {
        let section = |tag: Tag| bank.sections().find(|(found, _)| *found == tag.0).map(|(_, bytes)| bytes);
        let index = section(Tag::SOURCE_INDEX).and_then(|index| <[U32]>::ref_from_bytes(index).ok());
        let records = index.zip(section(Tag::SOURCES));
        Records(records.map(|(index, records)| (SourceIndex::new(index, 0..records.len()), records)))
    }

    /// Whether the bank has none.
    pub(super) fn are_stripped(&self) -> bool {
        self.0.is_none()
    }

    /// The record of a clip; empty if the bank has none, or it is damaged.
    pub(super) fn get(&self, clip: &Clip<'_>) -> &'d [u8] {
        let Some((index, records)) = &self.0 else { return &[] };
        index.record(clip.slot()).and_then(|range| records.get(range)).unwrap_or_default()
    }
}

/// A bank to be made of clips of others, added in the order of their keys.
pub(super) struct Draft {
    clips: Clips,
    data: ClipData,
    locales: Vec<LocaleColumn>,
    /// The dubs among the clips.
    pub(super) dubs: Dubs,
}

impl Draft {
    /// A bank with these locales in the order of their tags, one of them perhaps the default.
    pub(super) fn new(locales: Vec<LocaleColumn>) -> Draft {
        let mut clips = Clips::default();
        // So their numbers are their places.
        locales.iter().for_each(|locale| _ = clips.locales.number(&locale.tag, false));
        Draft { clips, data: ClipData::default(), locales, dubs: Dubs::default() }
    }

    /// Adds a clip: what it has beside texts, its texts, or both.
    pub(super) fn push(
        &mut self,
        key: &str,
        clip: Option<&Clip<'_>>,
        texts: Option<(&Texts<'_>, &Whose)>,
        segment_count: u32,
        record: &[u8],
    ) {
        take_clip(clip, segment_count, &mut self.data);
        if let Some((texts, whose)) = texts {
            take_texts(texts, whose, |locale| locale as u32, &mut self.data);
        }
        for (locale, column) in self.locales.iter_mut().enumerate() {
            let is_original = texts.is_some_and(|(_, whose)| whose.is_original(locale));
            let other = match texts.map_or(Shown::Nothing, |(texts, _)| texts.shown[locale]) {
                Shown::Own | Shown::Borrowed if is_original => Some(Other::Original),
                Shown::Nothing | Shown::Own | Shown::Borrowed => None,
                Shown::Fallback(other) => Some(Other::Fallback(other as u32)),
            };
            column.set(self.clips.count(), other);
        }
        self.data.source.extend_from_slice(record);
        self.clips.push(key, &self.data);
    }

    /// The bank.
    pub(super) fn bank(self, beside: Beside<'_>) -> Result<Vec<u8>, Report> {
        let localised = Localised { locales: self.locales };
        let batches = vec![self.clips];
        let layout = Layout::new(&Clips::by_key(&batches), &localised, &self.dubs, beside)?;
        layout.fill(batches)
    }
}
