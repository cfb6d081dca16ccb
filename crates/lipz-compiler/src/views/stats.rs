//! Statistics of the contents of a dialogue.

use crate::bank::decompile::budget_bytes;
use crate::bank::dialogue::{TaggedLocale, clips_by_key, length_bytes, locales_by_tag, sections, texts_bytes};
use lipz_bank::{Clip, Dialogue, Fps, Locale, Segment, VisemeType, Voice};
use lipz_layout::Tag;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// The number of clips listed as the longest and as the shortest.
const EXTREMES: usize = 3;

/// Counts over a whole dialogue.
#[derive(Clone, PartialEq, Debug, Default)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Stats<'d> {
    /// The number of clips.
    pub clips: usize,
    /// The number of frames of all clips.
    pub frames: u64,
    /// The number of segments of all clips.
    pub segments: u64,
    /// The total duration of all clips with a frame rate, in microseconds.
    pub duration_us: u64,
    /// The number of clips with each frame rate, the lowest first.
    pub rates: Vec<RateCount>,
    /// The number of frames with each code, for each viseme type in use.
    pub visemes: Vec<VisemeCounts>,
    /// The locales, in the order of the bank.
    pub locales: Vec<LocaleStats<'d>>,
    /// The number of segments with events.
    pub events: usize,
    /// The number of different event strings.
    pub distinct_events: usize,
    /// The longest clips, the longest first. Clips without frames or a frame rate are excluded.
    pub longest: Vec<ClipDuration<'d>>,
    /// The shortest clips, the shortest first, without those among the longest.
    pub shortest: Vec<ClipDuration<'d>>,
    /// The number of curves of all clips.
    pub curves: usize,
    /// The number of keys of all curves.
    pub curve_keys: u64,
    /// The number of clips with data about the recording in the bank.
    pub recordings: usize,
    /// The total length of those recordings, in microseconds.
    pub recordings_us: u64,
    /// The voices, with that of the originals first; none in a bank without dubs.
    pub voices: Vec<VoiceStats<'d>>,
    /// The length of the bank, or of all banks, in bytes.
    #[cfg_attr(feature = "json", serde(rename = "bytes"))]
    pub length_bytes: usize,
    /// The length of its text banks in bytes.
    pub texts_bytes: usize,
    /// The length of each section of all banks in bytes, in the order of the first one. The rest consists of header,
    /// directory and the gaps between sections.
    #[cfg_attr(feature = "json", serde(serialize_with = "crate::views::json::sections"))]
    pub sections: Vec<(Tag, usize)>,
}

/// The number of clips with a frame rate.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
pub struct RateCount {
    /// The rate; `None` for "unspecified".
    #[cfg_attr(feature = "json", serde(serialize_with = "crate::views::json::fps"))]
    pub fps: Option<Fps>,
    /// The number of clips.
    pub clips: usize,
}

/// The frequencies of the codes of a viseme type.
#[derive(Clone, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
pub struct VisemeCounts {
    /// The type; `None` for "unspecified".
    #[cfg_attr(feature = "json", serde(serialize_with = "crate::views::json::viseme_type"))]
    pub viseme_type: Option<VisemeType>,
    /// The number of clips of this type.
    pub clips: usize,
    /// The number of frames with each code: every code of the specification in its order or, for an unspecified type,
    /// those in use.
    #[cfg_attr(feature = "json", serde(serialize_with = "by_code"))]
    pub frames: Vec<(char, u64)>,
}

/// The amount of text in a locale, without texts that clips borrow from other locales.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
pub struct LocaleStats<'d> {
    /// The locale.
    pub tag: &'d str,
    /// Whether it is the default one.
    pub is_default: bool,
    /// The number of clips with a text of their own.
    pub texts: usize,
    /// The number of clips that show the text of another locale.
    pub fallbacks: usize,
    /// The number of clips without any text.
    pub missing: usize,
    /// The number of characters (Unicode scalar values) in the display texts.
    pub characters: u64,
    /// The number of words in the display texts, separated by white space. Chinese and Japanese have few of these.
    pub words: u64,
}

/// The amount of recorded dialogue in a voice.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
pub struct VoiceStats<'d> {
    /// The locale of the voice.
    pub tag: &'d str,
    /// Whether it is that of the originals.
    pub is_original: bool,
    /// The number of clips spoken in it: its dubs, or all clips with visemes that are not dubs.
    pub clips: usize,
    /// The total duration of those with a frame rate, in microseconds.
    pub duration_us: u64,
}

/// The duration of a clip.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
pub struct ClipDuration<'d> {
    /// Its key.
    pub key: &'d str,
    /// Its duration in microseconds.
    pub duration_us: u64,
}

impl<'d> Stats<'d> {
    /// Counts the contents of a verified dialogue.
    pub fn from_dialogue(dialogue: &'d Dialogue<'d>) -> Stats<'d> {
        let clips = clips_by_key(dialogue);
        let locales = locales_by_tag(dialogue);
        let mut stats = Stats {
            clips: clips.len(),
            length_bytes: length_bytes(dialogue),
            sections: sections(dialogue),
            rates: rates(&clips),
            visemes: visemes(&clips),
            texts_bytes: texts_bytes(dialogue),
            locales: locales.into_iter().map(|locale| LocaleStats::new(&clips, locale)).collect(),
            voices: voices(dialogue, &clips),
            ..Stats::default()
        };
        let mut events = BTreeSet::new();
        for clip in &clips {
            stats.frames += u64::from(clip.frame_count());
            stats.segments += u64::from(clip.segment_count());
            stats.duration_us += clip.duration_us().unwrap_or(0);
            for curve in clip.curves() {
                stats.curves += 1;
                stats.curve_keys += u64::from(curve.key_count());
            }
            if let Some(recording) = clip.recording() {
                stats.recordings += 1;
                stats.recordings_us = stats.recordings_us.saturating_add(recording.length_us());
            }
            for event in clip.segments().filter_map(|segment| segment.event()).filter(|event| !event.is_empty()) {
                stats.events += 1;
                events.insert(event);
            }
        }
        stats.distinct_events = events.len();
        (stats.longest, stats.shortest) = extremes(&clips);
        stats
    }
}

/// Whether the texts and events of a dialogue fit the budget of its files (docs/reference/bank-format.md, "Source
/// records"). Segments share them, so that a forged bank of a few megabytes could take minutes: check this before you
/// count or compare untrusted banks. The time is proportional to the segments and locales.
pub fn is_bounded(dialogue: &Dialogue<'_>) -> bool {
    let mut left = budget_bytes(dialogue);
    let mut take = |bytes: usize| {
        left = left.checked_sub(bytes as u64)?;
        Some(())
    };
    let locales: Vec<Locale> = dialogue.locales().collect();
    let mut fits = |segment: Segment<'_>| {
        take(segment.event().map_or(0, str::len))?;
        let texts = locales.iter().filter_map(|locale| segment.text(*locale));
        texts.filter(|text| !text.is_fallback()).try_for_each(|text| take(text.len()))
    };
    clips_by_key(dialogue).iter().all(|clip| clip.segments().try_for_each(&mut fits).is_some())
}

/// Writes an object, sorted by code.
#[cfg(feature = "json")]
fn by_code<S: serde::Serializer>(frames: &[(char, u64)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(frames.iter().copied().collect::<BTreeMap<_, _>>())
}

fn voices<'d>(dialogue: &Dialogue<'d>, all: &[Clip<'_>]) -> Vec<VoiceStats<'d>> {
    let of_voice = |voice: Voice| {
        let clips = || all.iter().filter(|clip| clip.frame_count() > 0 && clip.voice() == Some(voice));
        let duration_us = clips().filter_map(Clip::duration_us).fold(0, u64::saturating_add);
        let tag = dialogue.voice_tag(voice);
        VoiceStats { tag, is_original: voice.is_original(), clips: clips().count(), duration_us }
    };
    dialogue.voices().map(of_voice).collect()
}

fn rates(clips: &[Clip<'_>]) -> Vec<RateCount> {
    let mut clips_of: HashMap<Option<Fps>, usize> = HashMap::new();
    for clip in clips {
        *clips_of.entry(clip.fps()).or_default() += 1;
    }
    let mut rates: Vec<RateCount> = clips_of.into_iter().map(|(fps, clips)| RateCount { fps, clips }).collect();
    let value = |rate: &RateCount| rate.fps.map_or(0.0, Fps::to_f64);
    rates.sort_by(|a, b| value(a).total_cmp(&value(b)));
    rates
}

fn visemes(all: &[Clip<'_>]) -> Vec<VisemeCounts> {
    let mut count_of: BTreeMap<Option<VisemeType>, (usize, [u64; 256])> = BTreeMap::new();
    for clip in all.iter().filter(|clip| clip.has_visemes()) {
        let (clips, frames) = count_of.entry(clip.viseme_type()).or_insert((0, [0; 256]));
        *clips += 1;
        for &code in clip.frames() {
            frames[usize::from(code)] += 1;
        }
    }
    let counts = |(viseme_type, (clips, frames)): (Option<VisemeType>, (usize, [u64; 256]))| {
        let frames = match viseme_type {
            Some(kind) => kind.codes().bytes().map(|code| (code as char, frames[usize::from(code)])).collect(),
            None => (0..=u8::MAX).zip(frames).filter(|(_, n)| *n > 0).map(|(code, n)| (code as char, n)).collect(),
        };
        VisemeCounts { viseme_type, clips, frames }
    };
    count_of.into_iter().map(counts).collect()
}

impl<'d> LocaleStats<'d> {
    fn new(clips: &[Clip<'_>], TaggedLocale { tag, locale, is_default }: TaggedLocale<'d>) -> LocaleStats<'d> {
        let mut stats = LocaleStats { tag, is_default, texts: 0, fallbacks: 0, missing: 0, characters: 0, words: 0 };
        for clip in clips {
            match clip.segment(0).and_then(|segment| segment.text(locale)) {
                None => stats.missing += 1,
                Some(text) if text.is_fallback() => stats.fallbacks += 1,
                Some(_) => {
                    stats.texts += 1;
                    for text in clip.segments().filter_map(|segment| segment.text(locale)) {
                        stats.characters += text.chars().count() as u64;
                        stats.words += text.split_whitespace().count() as u64;
                    }
                }
            }
        }
        stats
    }
}

/// Returns the longest and the shortest clips.
fn extremes<'d>(clips: &[Clip<'d>]) -> (Vec<ClipDuration<'d>>, Vec<ClipDuration<'d>>) {
    let timed = |clip: &Clip<'d>| {
        let duration_us = clip.duration_us().filter(|us| *us > 0)?;
        Some(ClipDuration { key: clip.key(), duration_us })
    };
    let mut all: Vec<ClipDuration<'d>> = clips.iter().filter_map(timed).collect();
    all.sort_by(|a, b| b.duration_us.cmp(&a.duration_us).then(a.key.cmp(b.key)));
    let longest: Vec<_> = all.iter().take(EXTREMES).copied().collect();
    let shortest = all.iter().skip(longest.len()).rev().take(EXTREMES).copied().collect();
    (longest, shortest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bank::SplitBank;
    use crate::project::Options;
    use crate::run::Compiler;
    use crate::sources::Input;
    use lipz_testkit::dialogues::places;

    #[test]
    fn everything_is_counted() {
        let inputs = [
            Input::from_bytes(
                "a",
                r#"{ "fps": 10, "viseme_type": "blair", "visemes": "AAM-|-", "text_en-us": "{m} Aye aye.|No.",
                    "events": "points door|points door" }"#,
            ),
            Input::from_bytes("b", r#"{ "fps": 10, "viseme_type": "rms", "visemes": "09", "text_de-de": "Nö" }"#),
            Input::from_bytes("d", r#"{ "text_en-us": "" }"#),
        ];
        let options = Options::new().default_locale("en-us").unwrap();
        let bytes = Compiler::new(options.clone()).compile(&inputs).bank.unwrap();
        let mut files = places(1);
        let dialogue = Dialogue::open(&mut files, [bytes.as_slice()]).unwrap();
        let stats = Stats::from_dialogue(&dialogue);
        assert_eq!((stats.clips, stats.frames, stats.segments, stats.duration_us), (3, 7, 4, 700_000));
        let rates: Vec<_> = stats.rates.iter().map(|rate| (rate.fps.map(Fps::numerator), rate.clips)).collect();
        assert_eq!(rates, [(None, 1), (Some(10), 2)]);
        assert_eq!(stats.visemes.len(), 2);
        let (blair, rms) = (&stats.visemes[0], &stats.visemes[1]);
        assert_eq!(
            (blair.viseme_type, &blair.frames[..3]),
            (Some(VisemeType::Blair), &[('-', 2), ('A', 2), ('M', 1)][..])
        );
        assert_eq!((rms.frames[1], rms.frames[10], rms.frames.len()), (('0', 1), ('9', 1), 11));
        let german = LocaleStats {
            tag: "de-de",
            is_default: false,
            texts: 1,
            fallbacks: 2,
            missing: 0,
            characters: 2,
            words: 1,
        };
        let english = LocaleStats {
            tag: "en-us",
            is_default: true,
            texts: 2,
            fallbacks: 0,
            missing: 1,
            characters: 11,
            words: 3,
        };
        assert_eq!(stats.locales, [german, english]);
        assert_eq!((stats.events, stats.distinct_events), (2, 1));
        let durations =
            [ClipDuration { key: "a", duration_us: 500_000 }, ClipDuration { key: "b", duration_us: 200_000 }];
        assert_eq!((&stats.longest[..], &stats.shortest[..]), (&durations[..], &[][..]));
        let split = SplitBank::from_bytes(&bytes).unwrap();
        let texts = split.texts.iter().map(|(_, texts)| texts.as_slice());
        let mut files = places(1 + texts.len());
        let dialogue = Dialogue::open(&mut files, std::iter::once(split.base.as_slice()).chain(texts)).unwrap();
        let of_split = Stats::from_dialogue(&dialogue);
        assert_eq!((of_split.texts_bytes > 0, stats.texts_bytes, &of_split.locales), (true, 0, &stats.locales));
        assert!(stats.sections.iter().map(|(_, bytes)| bytes).sum::<usize>() < stats.length_bytes);
    }
}
