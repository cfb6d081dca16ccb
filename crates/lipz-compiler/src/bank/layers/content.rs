//! The content of a clip, for comparison and for copying into another bank.

use super::links::TextOwner;
use crate::bank::lower::{BankExtras, Layout};
use crate::bank::source_index::SourceIndex;
use crate::clip::{ClipData, Clips};
use crate::locales::dubs::Dubs;
use crate::locales::localise::{LocaleColumn, LocalisedTexts, TextSubstitute};
use lipz_bank::{Bank, Clip, Locale, Text};
use lipz_diagnostics::Report;
use lipz_layout::{Tag, U32};
use zerocopy::FromBytes;

/// The origin of the text that a clip shows in a locale.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum ShownText {
    /// No text.
    Nothing,
    /// The clip has a text in the locale.
    Own,
    /// It shows its text in the locale with this number.
    Fallback(usize),
    /// It shows the text of a locale that the bank lacks.
    Borrowed,
}

/// The texts of a clip in all locales: for each, the origin and the texts of its segments.
pub(super) struct ShownTexts<'d> {
    pub(super) shown: Vec<ShownText>,
    texts: Vec<Vec<&'d [u8]>>,
}

impl<'d> ShownTexts<'d> {
    /// Creates texts from `text` for this number of locales and segments.
    pub(super) fn new(
        locale_count: usize,
        segment_count: u32,
        text: impl Fn(usize, u32) -> Option<Text<'d>>,
    ) -> ShownTexts<'d> {
        let firsts: Vec<_> = (0..locale_count).map(|locale| text(locale, 0)).collect();
        // Texts of a clip in two locales never have the same position, so that the position identifies the owner. An
        // empty text starts where the next one does, so that its end is needed as well.
        let place = |first: &Text<'_>, locale: usize| {
            let last = text(locale, segment_count.saturating_sub(1)).unwrap_or(*first);
            (first.as_str().as_ptr(), last.as_str().as_bytes().as_ptr_range().end)
        };
        let own = firsts.iter().enumerate().filter_map(|(locale, text)| Some((text.as_ref()?, locale)));
        let mut own: Vec<_> =
            own.filter(|(text, _)| !text.is_fallback()).map(|(text, locale)| (place(text, locale), locale)).collect();
        own.sort_unstable();
        let shown = firsts.iter().enumerate().map(|(locale, first)| match first {
            None => ShownText::Nothing,
            Some(first) if !first.is_fallback() => ShownText::Own,
            Some(first) => match own.binary_search_by_key(&place(first, locale), |(place, _)| *place) {
                Ok(found) => ShownText::Fallback(own[found].1),
                Err(_) => ShownText::Borrowed,
            },
        });
        let shown: Vec<ShownText> = shown.collect();
        let texts = shown.iter().enumerate().map(|(locale, shown)| {
            let segments = if matches!(shown, ShownText::Own | ShownText::Borrowed) { segment_count } else { 0 };
            let bytes = |segment| text(locale, segment).map_or(&b""[..], |text| text.as_str().as_bytes());
            (0..segments).map(bytes).collect()
        });
        ShownTexts { texts: texts.collect(), shown }
    }

    /// Returns the texts of a clip in these locales of its bank or dialogue.
    pub(super) fn of(clip: &Clip<'d>, locales: &[Locale]) -> ShownTexts<'d> {
        ShownTexts::new(locales.len(), clip.segment_count(), |locale, segment| {
            clip.segment(segment)?.text(locales[locale])
        })
    }

    /// Turns copies of own texts into fallbacks: a text bank contains copies of borrowed texts.
    pub(super) fn without_copies(mut self) -> ShownTexts<'d> {
        for locale in 0..self.shown.len() {
            let is_same =
                |other: &usize| self.shown[*other] == ShownText::Own && self.texts[*other] == self.texts[locale];
            let of_copy =
                (self.shown[locale] == ShownText::Borrowed).then(|| (0..self.shown.len()).find(is_same)).flatten();
            if let Some(other) = of_copy {
                self.shown[locale] = ShownText::Fallback(other);
                self.texts[locale].clear();
            }
        }
        self
    }

    /// Whether the clip has a text of its own for this locale.
    pub(super) fn has_own(&self, locale: usize) -> bool {
        matches!(self.shown[locale], ShownText::Own | ShownText::Borrowed)
    }

    /// Returns the texts of the segments in a locale, if they are its own.
    pub(super) fn segments(&self, locale: usize) -> &[&'d [u8]] {
        &self.texts[locale]
    }
}

/// Sets `data` to the content of `clip` besides texts or, without a clip, to this number of empty segments.
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
    data.phones.recall(clip);
}

/// Adds to `data` the texts that are neither from a different locale nor from an original. `number` maps the numbers of
/// locales.
pub(super) fn take_texts(
    texts: &ShownTexts<'_>,
    whose: &TextOwner,
    number: impl Fn(usize) -> u32,
    data: &mut ClipData,
) {
    for (locale, shown) in texts.shown.iter().enumerate() {
        if matches!(shown, ShownText::Own | ShownText::Borrowed) && !whose.is_original(locale) {
            let segments = texts.segments(locale).iter().copied();
            data.add_texts(number(locale), segments, *shown == ShownText::Borrowed);
        }
    }
}

/// Whether two clips are equal apart from their texts.
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
        && one.phones() == other.phones()
}

/// The source records of a bank.
pub(crate) struct Records<'d>(Option<(SourceIndex<'d>, &'d [u8])>);

impl<'d> Records<'d> {
    pub(crate) fn of(bank: &Bank<'d>) -> Records<'d> {
        let section = |tag: Tag| bank.sections().find(|(found, _)| *found == tag.0).map(|(_, bytes)| bytes);
        let index = section(Tag::SOURCE_INDEX).and_then(|index| <[U32]>::ref_from_bytes(index).ok());
        let records = index.zip(section(Tag::SOURCES));
        Records(records.map(|(index, records)| (SourceIndex::new(index, 0..records.len()), records)))
    }

    /// Whether the bank has none.
    pub(crate) fn are_stripped(&self) -> bool {
        self.0.is_none()
    }

    /// Returns the record of a clip; empty if the bank has none, or if it is damaged.
    pub(super) fn get(&self, clip: &Clip<'_>) -> &'d [u8] {
        let Some((index, records)) = &self.0 else { return &[] };
        index.record(clip.slot()).and_then(|range| records.get(range)).unwrap_or_default()
    }
}

/// A bank under construction from clips of other banks, which are added in the order of their keys.
pub(super) struct Draft {
    clips: Clips,
    data: ClipData,
    locales: Vec<LocaleColumn>,
    /// The dubs among the clips.
    pub(super) dubs: Dubs,
}

impl Draft {
    /// Creates a bank with these locales, sorted by tag, one of which may be the default.
    pub(super) fn new(locales: Vec<LocaleColumn>) -> Draft {
        let mut clips = Clips::default();
        // In this way, their numbers equal their indexes.
        locales.iter().for_each(|locale| _ = clips.locales.number(&locale.tag, false));
        Draft { clips, data: ClipData::default(), locales, dubs: Dubs::default() }
    }

    /// Adds a clip: its content besides texts, its texts, or both.
    pub(super) fn push(
        &mut self,
        key: &str,
        clip: Option<&Clip<'_>>,
        texts: Option<(&ShownTexts<'_>, &TextOwner)>,
        segment_count: u32,
        record: &[u8],
    ) {
        take_clip(clip, segment_count, &mut self.data);
        if let Some((texts, whose)) = texts {
            take_texts(texts, whose, |locale| locale as u32, &mut self.data);
        }
        for (locale, column) in self.locales.iter_mut().enumerate() {
            let is_original = texts.is_some_and(|(_, whose)| whose.is_original(locale));
            let other = match texts.map_or(ShownText::Nothing, |(texts, _)| texts.shown[locale]) {
                ShownText::Own | ShownText::Borrowed if is_original => Some(TextSubstitute::Original),
                ShownText::Nothing | ShownText::Own | ShownText::Borrowed => None,
                ShownText::Fallback(other) => Some(TextSubstitute::Fallback(other as u32)),
            };
            column.set(self.clips.count(), other);
        }
        self.data.source.extend_from_slice(record);
        self.clips.push(key, &self.data);
    }

    /// Returns the finished bank.
    pub(super) fn bank(self, beside: BankExtras<'_>) -> Result<Vec<u8>, Report> {
        let localised = LocalisedTexts { locales: self.locales };
        let batches = vec![self.clips];
        let layout = Layout::new(&Clips::by_key(&batches), &localised, &self.dubs, beside)?;
        layout.fill(batches)
    }
}
