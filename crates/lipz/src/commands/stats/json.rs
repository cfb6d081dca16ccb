//! What `lipz stats --json` prints. Fields are only ever added (docs/VERSIONING.md).

use lipz_compiler::stats::{ClipDuration, Stats};
use serde::Serialize;
use std::collections::BTreeMap;

#[derive(Serialize)]
pub(super) struct StatsJson<'d> {
    clips: usize,
    frames: u64,
    segments: u64,
    duration_us: u64,
    rates: Vec<RateJson>,
    visemes: Vec<VisemesJson>,
    locales: Vec<LocaleJson<'d>>,
    events: usize,
    distinct_events: usize,
    longest: Vec<ClipJson<'d>>,
    shortest: Vec<ClipJson<'d>>,
    bytes: usize,
    texts_bytes: usize,
    sections: Vec<SectionJson>,
}

#[derive(Serialize)]
struct RateJson {
    fps: Option<[u32; 2]>,
    clips: usize,
}

#[derive(Serialize)]
struct VisemesJson {
    viseme_type: Option<&'static str>,
    clips: usize,
    frames: BTreeMap<char, u64>,
}

#[derive(Serialize)]
struct LocaleJson<'d> {
    tag: &'d str,
    is_default: bool,
    texts: usize,
    fallbacks: usize,
    missing: usize,
    characters: u64,
    words: u64,
}

#[derive(Serialize)]
struct ClipJson<'d> {
    key: &'d str,
    duration_us: u64,
}

#[derive(Serialize)]
struct SectionJson {
    tag: String,
    bytes: usize,
}

impl<'d> StatsJson<'d> {
    pub(super) fn of(stats: &Stats<'d>) -> Self {
        let rates = stats
            .rates
            .iter()
            .map(|rate| RateJson { fps: rate.fps.map(|fps| [fps.numerator(), fps.denominator()]), clips: rate.clips });
        let visemes = stats.visemes.iter().map(|counts| VisemesJson {
            viseme_type: counts.viseme_type.map(lipz_bank::VisemeType::name),
            clips: counts.clips,
            frames: counts.frames.iter().copied().collect(),
        });
        let locales = stats.locales.iter().map(|locale| LocaleJson {
            tag: locale.tag,
            is_default: locale.is_default,
            texts: locale.texts,
            fallbacks: locale.fallbacks,
            missing: locale.missing,
            characters: locale.characters,
            words: locale.words,
        });
        let sections = stats.sections.iter();
        let clips = |durations: &[ClipDuration<'d>]| {
            durations.iter().map(|clip| ClipJson { key: clip.key, duration_us: clip.duration_us }).collect()
        };
        StatsJson {
            clips: stats.clips,
            frames: stats.frames,
            segments: stats.segments,
            duration_us: stats.duration_us,
            rates: rates.collect(),
            visemes: visemes.collect(),
            locales: locales.collect(),
            events: stats.events,
            distinct_events: stats.distinct_events,
            longest: clips(&stats.longest),
            shortest: clips(&stats.shortest),
            bytes: stats.length_bytes,
            texts_bytes: stats.texts_bytes,
            sections: sections
                .map(|(tag, bytes)| SectionJson { tag: String::from_utf8_lossy(&tag.0).into_owned(), bytes: *bytes })
                .collect(),
        }
    }
}
