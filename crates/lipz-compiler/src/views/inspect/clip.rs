//! One clip, as a line of a list or in full.

use crate::clip::ClipPhones;
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
    /// The number of its frames.
    pub frames: u32,
    /// The number of its segments.
    pub segments: u32,
    /// Its duration in microseconds; `None` without a frame rate.
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

/// The complete contents of a clip, as a program reads them.
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
    #[cfg_attr(feature = "json", serde(serialize_with = "crate::views::json::fps"))]
    pub fps: Option<Fps>,
    /// Its viseme type; `None` for "unspecified".
    #[cfg_attr(feature = "json", serde(serialize_with = "crate::views::json::viseme_type"))]
    pub viseme_type: Option<VisemeType>,
    /// Its duration in microseconds; `None` without a frame rate.
    pub duration_us: Option<u64>,
    /// Whether it has a lip-sync track, which may be empty.
    pub has_visemes: bool,
    /// One code per frame, without `|`.
    pub frames: String,
    /// Its segments.
    pub segments: Vec<SegmentDetails<'d>>,
    /// Its curves, sorted by name.
    pub curves: Vec<CurveDetails<'d>>,
    /// Its phones with their times, as spelled in the file; `None` without phones.
    #[cfg_attr(feature = "json", serde(skip_serializing_if = "Option::is_none"))]
    pub phones: Option<String>,
    /// The recording that it was made for; `None` if the bank has no data about it.
    #[cfg_attr(feature = "json", serde(serialize_with = "crate::views::json::recording"))]
    pub recording: Option<Recording>,
    /// The locale of its voice; `None` in a bank without dubs.
    pub voice: Option<&'d str>,
    /// The key of its original, if it is a dub.
    pub original: Option<&'d str>,
}

/// A curve with its keys.
#[derive(Clone, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
#[non_exhaustive]
pub struct CurveDetails<'d> {
    /// Its name.
    pub name: &'d str,
    /// Its keys, sorted by frame.
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

/// The complete contents of a segment, as a program reads them.
#[derive(Clone, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
#[non_exhaustive]
pub struct SegmentDetails<'d> {
    /// Its first frame.
    pub start_frame: u32,
    /// The frame after its last one.
    pub end_frame: u32,
    /// Its start in microseconds; `None` without a frame rate.
    pub start_us: Option<u64>,
    /// Its end in microseconds; `None` without a frame rate.
    pub end_us: Option<u64>,
    /// The event string; `None` if the clip has no events.
    pub event: Option<&'d str>,
    /// The events in the string, if it is Character Event Syntax.
    pub events: Vec<SegmentEvent<'d>>,
    /// Its texts, in the order of the requested locales.
    pub texts: Vec<SegmentText<'d>>,
}

/// One event of Character Event Syntax.
#[derive(Clone, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
#[non_exhaustive]
pub struct SegmentEvent<'d> {
    /// The acting character; `None` for the speaker.
    pub character: Option<&'d str>,
    /// The action, such as `points`.
    pub verb: &'static str,
    /// The object, for verbs that have one; for a gesture, its number.
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

/// The approximate number of bytes that a phone takes.
const PHONE_BYTES: usize = 12;

/// The approximate number of bytes that a key of a curve takes.
const KEY_BYTES: usize = 24;

/// The approximate number of bytes that an event takes in [`ClipDetails`] besides its names.
const EVENT_BYTES: usize = 64;

impl<'d> ClipDetails<'d> {
    /// Whether the contents of the clip fit the budget of the files of `dialogue` (docs/reference/bank-format.md,
    /// "Source records"). Segments share events and texts, so that a forged bank of a megabyte could expand to
    /// terabytes: check this before you read or show a clip of an untrusted bank. The time is proportional to the
    /// segments and locales.
    pub fn is_bounded(dialogue: &Dialogue<'_>, clip: &Clip<'_>, locales: &[Locale]) -> bool {
        let mut left = crate::bank::decompile::budget_bytes(dialogue);
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
        if take((clip.phones().count() as usize).saturating_mul(PHONE_BYTES)).is_none() {
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
            phones: phones_of(clip),
            recording: clip.recording(),
            voice: clip.voice().map(|voice| dialogue.voice_tag(voice)),
            original: clip.original().map(|original| original.key()),
        }
    }
}

/// Returns the phones of a clip, as spelled in its file.
pub(super) fn phones_of(clip: &Clip<'_>) -> Option<String> {
    let mut phones = ClipPhones::default();
    phones.recall(clip);
    phones.text()
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

/// Writes sixteen hexadecimal digits, because JSON in JavaScript has no 64-bit integers.
#[cfg(feature = "json")]
fn digits<S: serde::Serializer>(id: &ClipId, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(id)
}
