//! Statistics as tables for people, at most 80 columns wide except for long keys.

use crate::console::{counted, grouped};
use lipz_bank::VisemeType;
use lipz_compiler::inspect::short_fps;
use lipz_compiler::stats::{ClipDuration, LocaleStats, Stats, VisemeCounts, VoiceStats};
use lipz_diagnostics::escape;
use lipz_sync::RecordingCounts;
use std::fmt::Write;
use unicode_width::UnicodeWidthStr;

/// The width of the longest bar in columns.
const BAR_COLUMNS: u64 = 40;
/// The width of names before numbers in columns.
const NAME_COLUMNS: usize = 12;

pub(super) fn text(name: &str, stats: &Stats<'_>, recorded: Option<&RecordingCounts>) -> String {
    let mut out = format!("{name}\n");
    let _ = writeln!(
        out,
        "  {}, {}, {}, {}",
        counted(stats.clips, "clip"),
        counted(number(stats.segments), "segment"),
        counted(number(stats.frames), "frame"),
        time(stats.duration_us),
    );
    let distinct = grouped(stats.distinct_events);
    let _ = writeln!(out, "  {} ({distinct} distinct)", counted(stats.events, "event"));
    if stats.curves > 0 {
        let _ = writeln!(out, "  {}, {}", counted(stats.curves, "curve"), counted(number(stats.curve_keys), "key"));
    }
    if stats.recordings > 0 {
        let _ = writeln!(out, "  {}, {}", counted(stats.recordings, "recording"), time(stats.recordings_us));
    }
    if let Some(recorded) = recorded {
        recordings(&mut out, recorded);
    }
    locales(&mut out, &stats.locales);
    voices(&mut out, &stats.voices);
    rates(&mut out, stats);
    for counts in &stats.visemes {
        visemes(&mut out, counts);
    }
    clips(&mut out, "longest clips", &stats.longest);
    clips(&mut out, "shortest clips", &stats.shortest);
    sections(&mut out, stats);
    out
}

fn number(number: u64) -> usize {
    usize::try_from(number).unwrap_or(usize::MAX)
}

/// Formats a time as `1:02:03.4`, without unneeded hours or minutes: `3.4 s`.
fn time(us: u64) -> String {
    let tenths = us / 100_000;
    let (seconds, tenth) = (tenths / 10, tenths % 10);
    let (hours, minutes, rest) = (seconds / 3600, seconds / 60 % 60, seconds % 60);
    match (hours, minutes) {
        (0, 0) => format!("{seconds}.{tenth} s"),
        (0, _) => format!("{minutes}:{rest:02}.{tenth} min"),
        _ => format!("{hours}:{minutes:02}:{rest:02} h"),
    }
}

/// Returns a name, padded to the column of the numbers.
fn padded(name: &str) -> String {
    let name = escape::text(name);
    format!("  {name}{}", " ".repeat(NAME_COLUMNS.saturating_sub(name.width())))
}

/// Returns the percentage of a whole: ` 12.5 %`.
fn percent(part: u64, whole: u64) -> String {
    format!("{:5.1} %", part as f64 * 100.0 / whole.max(1) as f64)
}

/// Returns a bar that is full for `longest`. Values above 0 are always visible.
fn bar(part: u64, longest: u64) -> String {
    let columns = (part * BAR_COLUMNS).div_ceil(longest.max(1));
    "#".repeat(number(columns))
}

/// Adds the recordings of a project, which its bank does not contain.
fn recordings(out: &mut String, recorded: &RecordingCounts) {
    let RecordingCounts { clips, missing, unused, synced, doubtful_words, .. } = *recorded;
    let _ = writeln!(
        out,
        "  {} of {}, {}; {} without a recording, {} unused",
        counted(recorded.recordings, "recording"),
        counted(clips, "clip"),
        time(recorded.length_us),
        counted(missing, "clip"),
        grouped(unused)
    );
    if synced > 0 {
        let _ = writeln!(
            out,
            "  {} synced by lipz sync, {}",
            counted(synced, "clip"),
            counted(doubtful_words, "uncertain word")
        );
    }
}

fn locales(out: &mut String, locales: &[LocaleStats<'_>]) {
    if locales.is_empty() {
        return;
    }
    let _ = writeln!(
        out,
        "\n{} {:>8} {:>9} {:>8} {:>11} {:>9}",
        padded("locale"),
        "texts",
        "fallback",
        "missing",
        "characters",
        "words"
    );
    for locale in locales {
        let _ = writeln!(
            out,
            "{} {:>8} {:>9} {:>8} {:>11} {:>9}{}",
            padded(locale.tag),
            grouped(locale.texts),
            grouped(locale.fallbacks),
            grouped(locale.missing),
            grouped(number(locale.characters)),
            grouped(number(locale.words)),
            if locale.is_default { "  default" } else { "" }
        );
    }
}

fn voices(out: &mut String, voices: &[VoiceStats<'_>]) {
    if voices.is_empty() {
        return;
    }
    let _ = writeln!(out, "\n{} {:>8} {:>12}", padded("voice"), "clips", "time");
    for voice in voices {
        let original = if voice.is_original { "  original" } else { "" };
        let (clips, time) = (grouped(voice.clips), time(voice.duration_us));
        let _ = writeln!(out, "{} {clips:>8} {time:>12}{original}", padded(voice.tag));
    }
}

fn rates(out: &mut String, stats: &Stats<'_>) {
    let _ = writeln!(out, "\n{} {:>8}", padded("frame rate"), "clips");
    let longest = stats.rates.iter().map(|rate| rate.clips as u64).max().unwrap_or(0);
    for rate in &stats.rates {
        let name = rate.fps.map_or("unspecified".into(), short_fps);
        let bar = bar(rate.clips as u64, longest);
        let _ = writeln!(out, "{} {:>8}          {bar}", padded(&name), grouped(rate.clips));
    }
}

fn visemes(out: &mut String, counts: &VisemeCounts) {
    let name = counts.viseme_type.map_or("unspecified", VisemeType::name);
    let _ = writeln!(out, "\n{} {:>8}  in {}", padded(name), "frames", counted(counts.clips, "clip"));
    let whole = counts.frames.iter().map(|(_, frames)| frames).sum();
    let longest = counts.frames.iter().map(|(_, frames)| *frames).max().unwrap_or(0);
    for &(code, frames) in &counts.frames {
        let (count, share) = (grouped(number(frames)), percent(frames, whole));
        let row = format!("{} {count:>8} {share}  {}", padded(&code.to_string()), bar(frames, longest));
        let _ = writeln!(out, "{}", row.trim_end());
    }
}

fn clips(out: &mut String, heading: &str, clips: &[ClipDuration<'_>]) {
    if clips.is_empty() {
        return;
    }
    let _ = writeln!(out, "\n  {heading}");
    for clip in clips {
        let _ = writeln!(out, "  {:>10}  {}", time(clip.duration_us), escape::text(clip.key));
    }
}

fn sections(out: &mut String, stats: &Stats<'_>) {
    let _ = writeln!(out, "\n{} {:>13}", padded("section"), "bytes");
    let whole = stats.length_bytes as u64;
    let mut row = |name: &str, bytes: usize| {
        let _ = writeln!(out, "{} {:>13} {}", padded(name), grouped(bytes), percent(bytes as u64, whole));
    };
    for (tag, bytes) in &stats.sections {
        row(&String::from_utf8_lossy(&tag.0), *bytes);
    }
    let in_sections: usize = stats.sections.iter().map(|(_, bytes)| bytes).sum();
    row("other", stats.length_bytes.saturating_sub(in_sections));
    row("whole bank", stats.length_bytes);
    if stats.texts_bytes > 0 {
        let _ = writeln!(out, "{} {:>13}", padded("text banks"), grouped(stats.texts_bytes));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_in_the_units_that_suit_them() {
        let shown = [(0, "0.0 s"), (59_990_000, "59.9 s"), (61_500_000, "1:01.5 min"), (3_600_000_000, "1:00:00 h")];
        for (us, expected) in shown {
            assert_eq!(time(us), expected);
        }
    }

    #[test]
    fn bars_show_whatever_is_there() {
        assert_eq!((bar(0, 0).len(), bar(0, 9).len(), bar(1, 1_000_000).len()), (0, 0, 1));
        assert_eq!(bar(7, 7).len() as u64, BAR_COLUMNS);
    }
}
