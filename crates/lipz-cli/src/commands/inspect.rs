//! `lipz inspect`: what is in a bank.

use crate::args::Inspect;
use crate::bank_file::BankFile;
use crate::timeline::timeline;
use crate::{Outcome, console};
use lipz_bank::layout::Tag;
use lipz_bank::{Bank, Clip, Locale};
use serde::Serialize;
use std::fmt::Write;

pub(crate) fn run(arguments: &Inspect) -> Outcome {
    let file = match BankFile::map(&arguments.bank) {
        Ok(file) => file,
        Err(outcome) => return outcome,
    };
    let bank = match file.verified() {
        Ok(bank) => bank,
        Err(outcome) => return outcome,
    };
    match (&arguments.key, &arguments.list) {
        (Some(key), _) => clip(&bank, key, arguments),
        (None, Some(prefix)) => list(&bank, prefix, arguments.json),
        (None, None) => summary(&bank, file.path(), arguments.json),
    }
}

fn clip(bank: &Bank<'_>, key: &str, arguments: &Inspect) -> Outcome {
    let Some(clip) = bank.clip_by_key(key) else {
        console::remark(&format!("error: no clip `{key}` in the bank\n"));
        let near = near_keys(bank, key);
        if !near.is_empty() {
            console::remark(&format!("help: did you mean {}?\n", near.join(", ")));
        }
        return Outcome::Failed;
    };
    let mut locales: Vec<Locale<'_>> = Vec::new();
    for tag in &arguments.locale {
        match bank.locale(tag) {
            Some(locale) => locales.push(locale),
            None => {
                let known: Vec<&str> = bank.locales().map(|locale| locale.tag()).collect();
                console::remark(&format!("error: no locale `{tag}` in the bank\nhelp: it has {}\n", known.join(", ")));
                return Outcome::Failed;
            }
        }
    }
    if locales.is_empty() {
        locales.extend(bank.locales());
    }
    if arguments.json {
        return print_json(&ClipJson::of(&clip, &locales));
    }
    console::print(&timeline(&clip, &locales, console::width()));
    Outcome::Clean
}

/// Keys that end or start like the one asked for.
fn near_keys(bank: &Bank<'_>, key: &str) -> Vec<String> {
    let wanted = key.rsplit('/').next().unwrap_or(key).trim_end_matches(".lipz");
    let fits = |clip: &Clip<'_, '_>| !wanted.is_empty() && clip.key().contains(wanted);
    bank.clips().filter(fits).take(3).map(|clip| format!("`{}`", clip.key())).collect()
}

fn list(bank: &Bank<'_>, prefix: &str, json: bool) -> Outcome {
    let clips: Vec<ListedJson<'_>> = bank.clips_under(prefix).map(|clip| ListedJson::of(&clip)).collect();
    if json {
        return print_json(&clips);
    }
    let width = clips.iter().map(|clip| clip.key.len()).max().unwrap_or(0);
    let mut text = String::new();
    for clip in &clips {
        let seconds = clip.duration_us.map_or("      ?".into(), |us| format!("{:7.2}", us as f64 / 1e6));
        let _ = writeln!(
            text,
            "{:<width$}  {} s  {:>5} frames  {:>2} segments",
            clip.key, seconds, clip.frames, clip.segments
        );
    }
    console::print(&text);
    Outcome::Clean
}

fn summary(bank: &Bank<'_>, path: &str, json: bool) -> Outcome {
    let summary = SummaryJson::of(bank);
    if json {
        return print_json(&summary);
    }
    let mut text = String::new();
    let (major, minor) = bank.format_version();
    let _ = writeln!(
        text,
        "{path}: lipz bank, format {major}.{minor}, {} bytes, no fault",
        console::grouped(summary.bytes)
    );
    let _ = writeln!(
        text,
        "  {}, {}, {}, {:.1} s of speech{}",
        console::counted(summary.clips, "clip"),
        console::counted(summary.frames, "frame"),
        console::counted(summary.segments, "segment"),
        summary.seconds,
        match summary.clips_without_fps {
            0 => String::new(),
            count => format!(" (and {} without a frame rate)", console::counted(count, "clip")),
        }
    );
    let _ = writeln!(text, "  fingerprint {}\n", summary.fingerprint);
    let _ = writeln!(text, "  {:<12} {:>8} {:>9} {:>8}", "locale", "texts", "fallback", "missing");
    for locale in &summary.locales {
        let default = if locale.is_default { "  default" } else { "" };
        let _ = writeln!(
            text,
            "  {:<12} {:>8} {:>9} {:>8}{default}",
            locale.tag, locale.texts, locale.fallbacks, locale.missing
        );
    }
    let _ = writeln!(text, "\n  {:<12} {:>12}", "section", "bytes");
    for section in &summary.sections {
        let _ = writeln!(text, "  {:<12} {:>12}", section.tag, console::grouped(section.bytes));
    }
    console::print(&text);
    Outcome::Clean
}

fn print_json<T: Serialize>(value: &T) -> Outcome {
    match serde_json::to_string_pretty(value) {
        Ok(json) => {
            console::print(&(json + "\n"));
            Outcome::Clean
        }
        Err(error) => {
            console::remark(&format!("error: {error}\n"));
            Outcome::Failed
        }
    }
}

/// The summary of a bank.
#[derive(Serialize)]
struct SummaryJson<'d> {
    format: String,
    bytes: usize,
    fingerprint: String,
    clips: usize,
    clips_without_fps: usize,
    frames: usize,
    segments: usize,
    seconds: f64,
    has_sources: bool,
    locales: Vec<LocaleJson<'d>>,
    sections: Vec<SectionJson>,
}

#[derive(Serialize)]
struct LocaleJson<'d> {
    tag: &'d str,
    is_default: bool,
    texts: usize,
    fallbacks: usize,
    missing: usize,
}

#[derive(Serialize)]
struct SectionJson {
    tag: String,
    bytes: usize,
}

impl<'d> SummaryJson<'d> {
    fn of(bank: &Bank<'d>) -> Self {
        let (major, minor) = bank.format_version();
        let sections = bank
            .sections()
            .map(|(tag, bytes)| SectionJson { tag: String::from_utf8_lossy(&tag.0).into_owned(), bytes: bytes.len() });
        SummaryJson {
            format: format!("{major}.{minor}"),
            bytes: bank.length_bytes(),
            fingerprint: format!("{:016x}", bank.fingerprint()),
            clips: bank.clip_count(),
            clips_without_fps: bank.clips().filter(|clip| clip.fps().is_none()).count(),
            frames: bank.clips().map(|clip| clip.frame_count() as usize).sum(),
            segments: bank.clips().map(|clip| clip.segment_count() as usize).sum(),
            seconds: bank.clips().filter_map(|clip| clip.duration_us()).map(|us| us as f64 / 1e6).sum(),
            has_sources: bank.sections().any(|(tag, _)| tag == Tag::SOURCES),
            locales: bank.locales().map(|locale| LocaleJson::of(bank, locale)).collect(),
            sections: sections.collect(),
        }
    }
}

impl<'d> LocaleJson<'d> {
    fn of(bank: &Bank<'d>, locale: Locale<'d>) -> Self {
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
struct ListedJson<'d> {
    key: &'d str,
    id: String,
    frames: u32,
    segments: u32,
    duration_us: Option<u64>,
}

impl<'d> ListedJson<'d> {
    fn of(clip: &Clip<'d, '_>) -> Self {
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
struct ClipJson<'d> {
    key: &'d str,
    id: String,
    fps: Option<[u32; 2]>,
    viseme_type: Option<&'static str>,
    duration_us: Option<u64>,
    visemes: String,
    segments: Vec<SegmentJson<'d>>,
}

#[derive(Serialize)]
struct SegmentJson<'d> {
    start_frame: u32,
    end_frame: u32,
    start_us: Option<u64>,
    end_us: Option<u64>,
    event: Option<&'d str>,
    texts: Vec<TextJson<'d>>,
}

#[derive(Serialize)]
struct TextJson<'d> {
    locale: &'d str,
    text: &'d str,
    is_fallback: bool,
}

impl<'d> ClipJson<'d> {
    fn of(clip: &Clip<'d, '_>, locales: &[Locale<'d>]) -> Self {
        let segments = clip.segments().map(|segment| SegmentJson {
            start_frame: segment.start_frame(),
            end_frame: segment.end_frame(),
            start_us: segment.start_us(),
            end_us: segment.end_us(),
            event: segment.event(),
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
            visemes: clip.frames().iter().map(|&code| code as char).collect(),
            segments: segments.collect(),
        }
    }
}
