//! What `lipz inspect --json` prints. Fields are only ever added (docs/VERSIONING.md).

use crate::shared::babble_json::BabbleJson;
use lipz_bank::{Bank, Clip, Event, EventName, Locale};
use lipz_layout::Tag;
use serde::Serialize;

/// The summary of a bank.
#[derive(Serialize)]
pub(super) struct SummaryJson<'d> {
    pub(super) format: String,
    pub(super) bytes: usize,
    pub(super) fingerprint: String,
    pub(super) clips: usize,
    pub(super) clips_without_fps: usize,
    pub(super) frames: usize,
    pub(super) segments: usize,
    pub(super) seconds: f64,
    pub(super) has_sources: bool,
    pub(super) locales: Vec<LocaleJson<'d>>,
    pub(super) sections: Vec<SectionJson>,
    pub(super) babble: Vec<BabbleJson<'d>>,
}

#[derive(Serialize)]
pub(super) struct LocaleJson<'d> {
    pub(super) tag: &'d str,
    pub(super) is_default: bool,
    pub(super) texts: usize,
    pub(super) fallbacks: usize,
    pub(super) missing: usize,
}

#[derive(Serialize)]
pub(super) struct SectionJson {
    pub(super) tag: String,
    pub(super) bytes: usize,
}

impl<'d> SummaryJson<'d> {
    pub(super) fn of(bank: &Bank<'d>, locales: &[Locale<'d>]) -> Self {
        let (major, minor) = bank.format_version();
        let sections = bank
            .sections()
            .map(|(tag, bytes)| SectionJson { tag: String::from_utf8_lossy(&tag).into_owned(), bytes: bytes.len() });
        SummaryJson {
            format: format!("{major}.{minor}"),
            bytes: bank.length_bytes(),
            fingerprint: format!("{:016x}", bank.fingerprint()),
            clips: bank.clip_count(),
            clips_without_fps: bank.clips().filter(|clip| clip.fps().is_none()).count(),
            frames: bank.clips().map(|clip| clip.frame_count() as usize).sum(),
            segments: bank.clips().map(|clip| clip.segment_count() as usize).sum(),
            seconds: bank.clips().filter_map(|clip| clip.duration_us()).fold(0.0, |sum, us| sum + us as f64 / 1e6),
            has_sources: bank.sections().any(|(tag, _)| tag == Tag::SOURCES.0),
            locales: locales.iter().map(|locale| LocaleJson::of(bank, *locale)).collect(),
            sections: sections.collect(),
            babble: bank.babbles().map(BabbleJson::of).collect(),
        }
    }
}

impl<'d> LocaleJson<'d> {
    pub(super) fn of(bank: &Bank<'_>, locale: Locale<'d>) -> Self {
        let mut json =
            LocaleJson { tag: locale.tag(), is_default: locale.is_default(), texts: 0, fallbacks: 0, missing: 0 };
        for clip in bank.clips() {
            match clip.segment(0).and_then(|segment| segment.text(locale)) {
                Some(text) if text.is_fallback() => json.fallbacks += 1,
                Some(_) => json.texts += 1,
                None => json.missing += 1,
            }
        }
        json
    }
}

/// A clip in a list.
#[derive(Serialize)]
pub(super) struct ListedJson<'d> {
    pub(super) key: &'d str,
    pub(super) id: String,
    pub(super) frames: u32,
    pub(super) segments: u32,
    pub(super) duration_us: Option<u64>,
}

impl<'d> ListedJson<'d> {
    pub(super) fn of(clip: &Clip<'d, '_>) -> Self {
        ListedJson {
            key: clip.key(),
            id: clip.id().to_string(),
            frames: clip.frame_count(),
            segments: clip.segment_count(),
            duration_us: clip.duration_us(),
        }
    }
}

/// A clip in full.
#[derive(Serialize)]
pub(super) struct ClipJson<'d> {
    pub(super) key: &'d str,
    pub(super) id: String,
    pub(super) fps: Option<[u32; 2]>,
    pub(super) viseme_type: Option<&'static str>,
    pub(super) duration_us: Option<u64>,
    pub(super) has_visemes: bool,
    /// One code per frame, without `|`.
    pub(super) frames: String,
    pub(super) segments: Vec<SegmentJson<'d>>,
}

#[derive(Serialize)]
pub(super) struct SegmentJson<'d> {
    pub(super) start_frame: u32,
    pub(super) end_frame: u32,
    pub(super) start_us: Option<u64>,
    pub(super) end_us: Option<u64>,
    /// The event string.
    pub(super) event: Option<&'d str>,
    /// What it says, if it is Character Event Syntax.
    pub(super) events: Vec<EventJson<'d>>,
    pub(super) texts: Vec<TextJson<'d>>,
}

#[derive(Serialize)]
pub(super) struct EventJson<'d> {
    pub(super) character: Option<&'d str>,
    pub(super) verb: &'static str,
    pub(super) object: Option<&'d str>,
}

impl<'d> EventJson<'d> {
    fn of(event: Event<'d>) -> Self {
        EventJson {
            character: event.character.map(EventName::as_str),
            verb: event.command.verb(),
            object: event.command.object().map(EventName::as_str),
        }
    }
}

#[derive(Serialize)]
pub(super) struct TextJson<'d> {
    pub(super) locale: &'d str,
    pub(super) text: &'d str,
    pub(super) is_fallback: bool,
}

impl<'d> ClipJson<'d> {
    pub(super) fn of(clip: &Clip<'d, '_>, locales: &[Locale<'d>]) -> Self {
        let segments = clip.segments().map(|segment| SegmentJson {
            start_frame: segment.start_frame(),
            end_frame: segment.end_frame(),
            start_us: segment.start_us(),
            end_us: segment.end_us(),
            event: segment.event(),
            events: segment.events().map(EventJson::of).collect(),
            texts: locales
                .iter()
                .filter_map(|locale| Some((locale.tag(), segment.text(*locale)?)))
                .map(|(locale, text)| TextJson { locale, text: text.as_str(), is_fallback: text.is_fallback() })
                .collect(),
        });
        ClipJson {
            key: clip.key(),
            id: clip.id().to_string(),
            fps: clip.fps().map(|fps| [fps.numerator(), fps.denominator()]),
            viseme_type: clip.viseme_type().map(lipz_bank::VisemeType::name),
            duration_us: clip.duration_us(),
            has_visemes: clip.has_visemes(),
            frames: clip.frames().iter().map(|&code| code as char).collect(),
            segments: segments.collect(),
        }
    }
}
