//! The answers of a bank to every query, as text that does not depend on its layout.

use lipz_bank::{Bank, Clip, Fps, Micros, Viseme};
use std::fmt::Write;

/// Strings longer than this are shown by their length, their hash and their start.
const LONGEST_BYTES: usize = 400;

/// Everything that `bank` answers, one fact a line, in the order of keys and tags.
pub(crate) fn dump(bank: &Bank<'_>) -> String {
    let mut out = String::new();
    let (major, _) = bank.format_version();
    let _ = writeln!(out, "format {major}, {} clips", bank.clip_count());
    for locale in bank.locales() {
        let _ = writeln!(out, "locale {}{}", locale.tag(), if locale.is_default() { " default" } else { "" });
    }
    for clip in bank.clips() {
        dump_clip(&mut out, bank, &clip);
    }
    out
}

fn dump_clip(out: &mut String, bank: &Bank<'_>, clip: &Clip<'_, '_>) {
    let _ = writeln!(out, "\nclip {} {}", clip.key(), clip.id());
    let _ = writeln!(out, "  rate {}, type {}", or_unknown(clip.fps()), or_unknown(clip.viseme_type()));
    let _ = writeln!(out, "  visemes {}, events {}", clip.has_visemes(), clip.has_events());
    let frames: String = (0..clip.frame_count()).map(|frame| clip.viseme(frame).as_char()).collect();
    let _ = writeln!(out, "  {} frames {frames}, {:?} us", frames.len(), clip.duration_us());
    let _ = writeln!(out, "  at 24 fps, each 50 ms: {}", sampled(&clip.or_fps(Fps::whole(24))));
    for segment in clip.segments() {
        let (start, end) = (segment.start_frame(), segment.end_frame());
        let _ = write!(out, "  segment {} frames {start}..{end}", segment.index());
        let _ = writeln!(out, " us {:?}..{:?}", segment.start_us(), segment.end_us());
        if let Some(event) = segment.event() {
            let _ = writeln!(out, "    event {}", quoted(event));
        }
        for event in segment.events() {
            let _ = writeln!(out, "    typed {}", quoted(&event.to_string()));
        }
        for locale in bank.locales() {
            if let Some(text) = segment.text(locale) {
                let origin = if text.is_fallback() { " (fallback)" } else { "" };
                let _ = writeln!(out, "    {} {}{origin}", locale.tag(), quoted(text.as_str()));
            }
        }
    }
}

/// The viseme and the segment every 50 ms, for at most 200 of them.
fn sampled(clip: &Clip<'_, '_>) -> String {
    let mut out = String::new();
    let mut before = None;
    for time_us in (0..200).map(|step| step * 50_000) {
        let segment = clip.segment_at(Micros(time_us)).map(|segment| segment.index());
        if segment != before {
            let _ = write!(out, "[{}]", segment.map_or("end".into(), |index| index.to_string()));
            before = segment;
        }
        if segment.is_none() {
            assert_eq!(clip.viseme_at(Micros(time_us)), Viseme::REST);
            break;
        }
        out.push(clip.viseme_at(Micros(time_us)).as_char());
    }
    out
}

fn or_unknown(value: Option<impl std::fmt::Debug>) -> String {
    value.map_or("unspecified".into(), |value| format!("{value:?}"))
}

fn quoted(text: &str) -> String {
    if text.len() <= LONGEST_BYTES {
        return format!("\"{}\"", escaped(text));
    }
    // FNV-1a (draft-eastlake-fnv), spelled out: the dump must not change with a hash of the library.
    let hash = text
        .bytes()
        .fold(0xCBF2_9CE4_8422_2325_u64, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3));
    let start: String = text.chars().take(40).collect();
    format!("\"{}\"... {} bytes, fnv {hash:016x}", escaped(&start), text.len())
}

/// Quotes, backslashes, control characters and blanks other than U+0020 as escapes; the rest as it is.
fn escaped(text: &str) -> String {
    let escape = |c: char| c.is_control() || "\"\\\u{A0}\u{200B}\u{202F}".contains(c);
    text.chars().flat_map(|c| if escape(c) { c.escape_unicode().collect::<Vec<_>>() } else { vec![c] }).collect()
}
