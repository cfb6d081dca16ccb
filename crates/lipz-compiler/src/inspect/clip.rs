//! One clip, in a line of a list or in full.

use lipz_bank::curve::Curve;
use lipz_bank::{Clip, ClipId, Dialogue, Event, EventName, Fps, Locale, Recording, Segment, VisemeType};
use std::borrow::Cow;

/// A clip in a list.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
#[non_exhaustive]
pub struct ClipSummary<'d> {
    /// Its key.
    pub key: &'d str,
    /// Its id.
    #[cfg_attr(feature = "json", serde(serialize_with = "digits"))]
    pub id: ClipId,
    /// How many frames it has.
    pub frames: u32,
    /// How many segments it has.
    pub segments: u32,
    /// Its time in microseconds; `None` without a frame rate.
    pub duration_us: Option<u64>,
}

impl<'d> From<&Clip<'d>> for ClipSummary<'d> {
    fn from(clip: &Clip<'d>) -> Self {
        ClipSummary {
            key: clip.key(),
            id: clip.id(),
            frames: clip.frame_count(),
            segments: clip.segment_count(),
            duration_us: clip.duration_us(),
        }
    }
}

/// Everything that a program reads of a clip.
///
/// ```
/// use lipz_bank::files::DialogueFile;
/// use lipz_bank::{Dialogue, Locale};
/// use lipz_compiler::{Compiler, Input, inspect::ClipDetails};
/// let file = r#"{ "fps": 10, "visemes": "AA|M", "text_en-us": "Aye.|Aye!", "events": "|amy points door" }"#;
/// let bytes = Compiler::default().compile(&[Input::from_bytes("aye", file)]).into_bank()?;
/// let mut files = [DialogueFile::ABSENT];
/// let dialogue = Dialogue::open(&mut files, [bytes.as_slice()])?;
/// let locales: Vec<Locale> = dialogue.locales().collect();
/// let clip = ClipDetails::new(&dialogue, &dialogue.clip_by_key("aye").ok_or("no clip")?, &locales);
/// assert_eq!((clip.frames.as_str(), clip.segments[1].texts[0].text), ("AAM", "Aye!"));
/// assert_eq!(clip.segments[1].events[0].character, Some("amy"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
#[non_exhaustive]
pub struct ClipDetails<'d> {
    /// Its key.
    pub key: &'d str,
    /// Its id.
    #[cfg_attr(feature = "json", serde(serialize_with = "digits"))]
    pub id: ClipId,
    /// Its frame rate; `None` for "unspecified".
    #[cfg_attr(feature = "json", serde(serialize_with = "crate::json::fps"))]
    pub fps: Option<Fps>,
    /// Its viseme type; `None` for "unspecified".
    #[cfg_attr(feature = "json", serde(serialize_with = "crate::json::viseme_type"))]
    pub viseme_type: Option<VisemeType>,
    /// Its time in microseconds; `None` without a frame rate.
    pub duration_us: Option<u64>,
    /// Whether it has mouth shapes, be it none.
    pub has_visemes: bool,
    /// One code per frame, without `|`.
    pub frames: String,
    /// Its segments.
    pub segments: Vec<SegmentDetails<'d>>,
    /// Its curves, in the order of their names.
    pub curves: Vec<CurveDetails<'d>>,
    /// The recording that it was made for; `None` if the bank says nothing about it.
    #[cfg_attr(feature = "json", serde(serialize_with = "crate::json::recording"))]
    pub recording: Option<Recording>,
    /// The locale of the voice that it is spoken in; `None` in a bank without dubs.
    pub voice: Option<&'d str>,
    /// The key of the clip of which it is a dub.
    pub original: Option<&'d str>,
}

/// A curve with its keys.
#[derive(Clone, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
#[non_exhaustive]
pub struct CurveDetails<'d> {
    /// Its name.
    pub name: &'d str,
    /// Its keys, in the order of their frames.
    pub keys: Vec<KeyDetails>,
}

/// A key of a curve.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
#[non_exhaustive]
pub struct KeyDetails {
    /// The frame.
    pub frame: u32,
    /// The value in thousandths.
    pub thousandths: i32,
}

impl<'d> From<&Curve<'d>> for CurveDetails<'d> {
    fn from(curve: &Curve<'d>) -> Self {
        let keys = curve.keys().map(|key| KeyDetails { frame: key.frame, thousandths: key.value.thousandths() });
        CurveDetails { name: curve.name().as_str(), keys: keys.collect() }
    }
}

/// Everything that a program reads of a segment.
#[derive(Clone, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
#[non_exhaustive]
pub struct SegmentDetails<'d> {
    /// Its first frame.
    pub start_frame: u32,
    /// The frame after its last one.
    pub end_frame: u32,
    /// When it starts, in microseconds; `None` without a frame rate.
    pub start_us: Option<u64>,
    /// When it ends, in microseconds; `None` without a frame rate.
    pub end_us: Option<u64>,
    /// The event string; `None` if the clip has no events.
    pub event: Option<&'d str>,
    /// What it says, if it is Character Event Syntax.
    pub events: Vec<SegmentEvent<'d>>,
    /// Its texts, in the order of the locales that were asked for.
    pub texts: Vec<SegmentText<'d>>,
}

/// One event of Character Event Syntax.
#[derive(Clone, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
#[non_exhaustive]
pub struct SegmentEvent<'d> {
    /// Who acts; `None` for the speaker.
    pub character: Option<&'d str>,
    /// What they do, `points`.
    pub verb: &'static str,
    /// What at, for verbs that have an object; of a gesture its number.
    pub object: Option<Cow<'d, str>>,
}

/// The text that a segment shows in a locale.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
#[non_exhaustive]
pub struct SegmentText<'d> {
    /// The locale.
    pub locale: &'d str,
    /// The display text.
    pub text: &'d str,
    /// Whether it is the text of another locale.
    pub is_fallback: bool,
}

/// Bytes that a key of a curve takes, roughly.
const KEY_BYTES: usize = 24;

/// Bytes that an event takes in [`ClipDetails`] beside its names, roughly.
const EVENT_BYTES: usize = 64;

impl<'d> ClipDetails<'d> {
    /// Whether what the clip shows fits the budget of the files of `dialogue` (docs/reference/bank-format.md, "Source records"). Segments
    /// share events and texts, so that a forged bank of a megabyte can show terabytes: ask before you read or show a
    /// clip of a bank that may be a stranger's. Takes time in proportion to the segments and locales.
    pub fn is_bounded(dialogue: &Dialogue<'_>, clip: &Clip<'_>, locales: &[Locale]) -> bool {
        let mut left = crate::decompile::budget_bytes(dialogue);
        let mut take = |bytes: usize| {
            left = left.checked_sub(bytes as u64)?;
            Some(())
        };
        let fits = |segment: Segment<'_>| {
            take(segment.event().map_or(0, str::len))?;
            take(segment.events().size_hint().1.unwrap_or(usize::MAX).saturating_mul(EVENT_BYTES))?;
            locales.iter().try_for_each(|locale| take(segment.text(*locale).map_or(0, |text| text.len())))
        };
        if clip.segments().try_for_each(fits).is_none() {
            return false;
        }
        let fits_curve = |curve: Curve<'_>| {
            let keys_bytes = (curve.key_count() as usize).saturating_mul(KEY_BYTES);
            take(curve.name().as_str().len().saturating_add(keys_bytes))
        };
        clip.curves().try_for_each(fits_curve).is_some()
    }

    /// Reads the clip of a dialogue, with its texts in these locales.
    pub fn new(dialogue: &Dialogue<'d>, clip: &Clip<'d>, locales: &[Locale]) -> Self {
        let segments = clip.segments().map(|segment| SegmentDetails {
            start_frame: segment.start_frame(),
            end_frame: segment.end_frame(),
            start_us: segment.start_us(),
            end_us: segment.end_us(),
            event: segment.event(),
            events: segment.events().map(SegmentEvent::from).collect(),
            texts: locales
                .iter()
                .filter_map(|locale| Some((dialogue.locale_tag(*locale), segment.text(*locale)?)))
                .map(|(locale, text)| SegmentText { locale, text: text.as_str(), is_fallback: text.is_fallback() })
                .collect(),
        });
        ClipDetails {
            key: clip.key(),
            id: clip.id(),
            fps: clip.fps(),
            viseme_type: clip.viseme_type(),
            duration_us: clip.duration_us(),
            has_visemes: clip.has_visemes(),
            frames: clip.frames().iter().map(|&code| code as char).collect(),
            segments: segments.collect(),
            curves: clip.curves().map(|curve| CurveDetails::from(&curve)).collect(),
            recording: clip.recording(),
            voice: clip.voice().map(|voice| dialogue.voice_tag(voice)),
            original: clip.original().map(|original| original.key()),
        }
    }
}

impl<'d> From<Event<'d>> for SegmentEvent<'d> {
    fn from(event: Event<'d>) -> Self {
        let object = event.command.object().map(|name| Cow::Borrowed(name.as_str()));
        SegmentEvent {
            character: event.character.map(EventName::as_str),
            verb: event.command.verb(),
            object: object.or(event.command.amount().map(|strength| Cow::Owned(strength.to_string()))),
        }
    }
}

/// Sixteen hexadecimal digits: JavaScript has no integers of 64 bits in JSON.
#[cfg(feature = "json")]
fn digits<S: serde::Serializer>(id: &ClipId, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(id)
}
