//! A comparison as text for people.

use super::words::{marked, only_new, only_old};
use crate::console::{counted, grouped};
use crate::shared::locales::locale_name;
use lipz_bank::{Fps, VisemeType};
use lipz_compiler::diff::{BabbleChange, Change, ClipChange, Difference, DubChange, FaceChange};
use lipz_compiler::face;
use lipz_compiler::inspect::{short_fps, short_recording};
use lipz_diagnostics::escape;
use std::collections::BTreeSet;
use std::fmt::Write;
use std::iter::zip;
use unicode_width::UnicodeWidthStr;

/// The most clips of one kind that are shown without `--all`.
const SHOWN_CLIPS: usize = 50;
/// The most texts and events of one clip that are shown without `--all`.
const SHOWN_IN_CLIP: usize = 20;

/// Returns the differences, grouped by kind, and a closing summary. `names` are those of the two sides.
pub(super) fn text(difference: &Difference<'_>, names: (&str, &str), all: bool) -> String {
    let (shown_clips, shown_in_clip) = if all { (usize::MAX, usize::MAX) } else { (SHOWN_CLIPS, SHOWN_IN_CLIP) };
    let mut out = format!("{} -> {}\n", names.0, names.1);
    if difference.is_empty() {
        let _ = writeln!(out, "no differences in {}", counted(difference.same, "clip"));
        return out;
    }
    out.push('\n');
    locales(&mut out, difference);
    difference.babble.iter().for_each(|change| babble(&mut out, change));
    difference.faces.iter().for_each(|change| face(&mut out, change));
    for name in &difference.articulation {
        let _ = writeln!(out, "~ articulation profile `{}`", escape::text(name));
    }
    for name in &difference.rigs {
        let _ = writeln!(out, "~ rig `{}`", escape::text(name));
    }
    voices(&mut out, difference);
    let list = |out: &mut String, what: &str, lines: &mut dyn ExactSizeIterator<Item = String>| {
        let count = lines.len();
        for line in lines.take(shown_clips) {
            let _ = writeln!(out, "{line}");
        }
        more(out, "", count, shown_clips, what);
    };
    list(&mut out, "changed dub", &mut difference.dubs.iter().map(dub));
    list(&mut out, "removed clip", &mut difference.removed.iter().map(|key| format!("- {}", only_old(key))));
    list(&mut out, "added clip", &mut difference.added.iter().map(|key| format!("+ {}", only_new(key))));
    let renamed = |pair: &lipz_compiler::diff::RenamedClip<'_>| {
        format!("= {} -> {} (renamed)", only_old(pair.old), only_new(pair.new))
    };
    list(&mut out, "renamed clip", &mut difference.renamed.iter().map(renamed));
    list(&mut out, "changed clip", &mut difference.changed.iter().map(|change| clip(change, shown_in_clip)));
    summary(&mut out, difference);
    out
}

/// Adds `… and 12 more changed clips` if there are more than `shown`.
fn more(out: &mut String, margin: &str, count: usize, shown: usize, what: &str) {
    if let Some(hidden) = count.checked_sub(shown).filter(|hidden| *hidden > 0) {
        let _ = writeln!(out, "{margin}… and {} (--all shows them)", counted(hidden, &format!("more {what}")));
    }
}

fn locales(out: &mut String, difference: &Difference<'_>) {
    for tag in &difference.removed_locales {
        let _ = writeln!(out, "- locale {}", only_old(tag));
    }
    for tag in &difference.added_locales {
        let _ = writeln!(out, "+ locale {}", only_new(tag));
    }
    for change in &difference.fallbacks {
        let tags = |tags: &BTreeSet<String>| match tags.len() {
            0 => "none".to_owned(),
            _ => tags.iter().map(|tag| locale_name(tag)).collect::<Vec<_>>().join(", "),
        };
        let from = arrow(Change { old: &change.from.old, new: &change.from.new }, tags);
        let _ = writeln!(out, "~ locale {} falls back to  {from}", escape::text(change.locale));
    }
    if let Some(change) = difference.default_locale {
        let tag = |tag: Option<&str>| tag.map_or("none".into(), |tag| escape::text(tag).into_owned());
        let _ = writeln!(out, "~ default locale  {}", arrow(change, tag));
    }
}

fn voices(out: &mut String, difference: &Difference<'_>) {
    if let Some(change) = &difference.voices {
        let tags = |tags: &Vec<&str>| match tags.len() {
            0 => "none".to_owned(),
            _ => tags.iter().map(|tag| escape::text(tag).into_owned()).collect::<Vec<_>>().join(", "),
        };
        let _ = writeln!(out, "~ voices  {}", arrow(Change { old: &change.old, new: &change.new }, tags));
    }
}

/// Returns the clip that plays instead of an original, before and after.
fn dub(change: &DubChange<'_>) -> String {
    let clip = |key: Option<&str>| key.map_or("the original".to_owned(), |key| escape::text(key).into_owned());
    let (key, voice) = (escape::text(change.key), escape::text(change.voice));
    format!("~ {key} in {voice}  {}", arrow(change.clip, clip))
}

/// Names a profile and returns it from both banks; notes if only one of them has it.
fn of_both<P>(out: &mut String, name: &str, profile: Change<Option<P>>) -> Option<(P, P)> {
    let (line, both) = match profile {
        Change { old: Some(old), new: Some(new) } => (format!("~ {}", escape::text(name)), Some((old, new))),
        Change { new: None, .. } => (format!("- {}", only_old(name)), None),
        Change { new: Some(_), .. } => (format!("+ {}", only_new(name)), None),
    };
    let _ = writeln!(out, "{line}");
    both
}

/// Adds the changed parts of a babble profile, or that one bank lacks it.
fn babble(out: &mut String, change: &BabbleChange<'_>) {
    let Some((old, new)) = of_both(out, &format!("babble profile {}", change.name), change.profile) else { return };
    if old.rate() != new.rate() {
        let _ = writeln!(out, "    {:<13}{}", "rate", arrow(Change { old: old.rate(), new: new.rate() }, short_fps));
    }
    let strings = [
        ("ooh", old.ooh(), new.ooh()),
        ("aah", old.aah(), new.aah()),
        ("ooh power", old.ooh_power_transfer(), new.ooh_power_transfer()),
        ("aah power", old.aah_power_transfer(), new.aah_power_transfer()),
    ];
    for (name, old, new) in strings {
        let (old, new) = (String::from_utf8_lossy(old), String::from_utf8_lossy(new));
        if old != new {
            both(out, name, Change { old: Some(&old), new: Some(&new) });
        }
    }
}

/// Adds the changed settings of a face profile, or that one bank lacks it.
fn face(out: &mut String, change: &FaceChange<'_>) {
    let Some((old, new)) = of_both(out, &format!("face profile {}", change.name), change.profile) else { return };
    for (setting, (old, new)) in zip(face::SETTINGS, zip(face::numbers(&old), face::numbers(&new))) {
        if old != new {
            let shown = |number| setting.shown(number).to_string();
            let _ = writeln!(out, "    {:<13}{}", setting.name, arrow(Change { old, new }, shown));
        }
    }
}

/// Returns `old -> new`.
fn arrow<T>(change: Change<T>, shown: impl Fn(T) -> String) -> String {
    format!("{} -> {}", shown(change.old), shown(change.new))
}

/// Returns the clip with all its changes, without a line break at the end.
fn clip(clip: &ClipChange<'_>, shown: usize) -> String {
    let mut out = format!("~ {}\n", escape::text(clip.key));
    let unspecified = || "unspecified".to_owned();
    let mut fact = |name: &str, value: String| {
        let _ = writeln!(out, "    {name:<13}{value}");
    };
    if let Some(change) = clip.fps {
        fact("fps", arrow(change, |fps: Option<Fps>| fps.map_or_else(unspecified, short_fps)));
    }
    if let Some(change) = clip.viseme_type {
        let name = |kind: Option<VisemeType>| kind.map_or_else(unspecified, |kind| kind.name().to_owned());
        fact("viseme type", arrow(change, name));
    }
    if let Some(frames) = clip.frames {
        let count = |count: Option<u32>| count.map_or("no visemes".into(), |count| grouped(count as usize));
        let counts = match frames.counts {
            Change { old: Some(old), new: Some(new) } if old == new => format!("of {} differ", grouped(old as usize)),
            counts => format!("differ ({})", arrow(counts, count)),
        };
        let first = frames.first.map_or(String::new(), |first| format!(", first at frame {first}"));
        fact("frames", format!("{} {counts}{first}", grouped(frames.differing as usize)));
    }
    if let Some(starts) = &clip.segment_starts {
        fact("segments", segments(starts));
    }
    if let Some(change) = clip.recording {
        fact("recording", arrow(change, |recording| recording.map_or("none".to_owned(), short_recording)));
    }
    for text in clip.texts.iter().take(shown) {
        let fallback = if text.is_fallback { " (fallback)" } else { "" };
        let name = format!("{} {}{fallback}", escape::text(text.locale), text.segment);
        both(&mut out, &name, text.text);
    }
    more(&mut out, "    ", clip.texts.len(), shown, "changed text");
    for event in clip.events.iter().take(shown) {
        both(&mut out, &format!("event {}", event.segment), event.event);
    }
    more(&mut out, "    ", clip.events.len(), shown, "changed event");
    for curve in clip.curves.iter().take(shown) {
        let keys = Change { old: curve.keys.old.as_deref(), new: curve.keys.new.as_deref() };
        both(&mut out, &format!("curve {}", escape::text(curve.name)), keys);
    }
    more(&mut out, "    ", clip.curves.len(), shown, "changed curve");
    if let Some(change) = &clip.phones {
        both(&mut out, "phones", Change { old: change.old.as_deref(), new: change.new.as_deref() });
    }
    out.truncate(out.trim_end_matches('\n').len());
    out
}

/// Returns the change in the number of segments, or the first segment with a different start.
fn segments(starts: &Change<Vec<u32>>) -> String {
    let in_both = starts.old.iter().zip(&starts.new);
    let moved = in_both.clone().filter(|(old, new)| old != new).count();
    let first = in_both.enumerate().find(|(_, (old, new))| old != new);
    let mut parts = Vec::new();
    if starts.old.len() != starts.new.len() {
        parts.push(format!("{} -> {}", grouped(starts.old.len()), grouped(starts.new.len())));
    }
    if let Some((segment, (old, new))) = first {
        let starts_at = format!("segment {segment} starts at frame {old} -> {new}");
        parts.push(if moved > 1 { format!("{} moved, {starts_at}", grouped(moved)) } else { starts_at });
    }
    parts.join(", ")
}

/// Adds the old and the new string of a segment, one below the other.
fn both(out: &mut String, name: &str, change: Change<Option<&str>>) {
    let (old, new) = match (change.old, change.new) {
        (Some(old), Some(new)) => {
            let (old, new) = marked(old, new);
            (Some(old), Some(new))
        }
        (old, new) => (old.map(only_old), new.map(only_new)),
    };
    let mut name = format!("    {name}{}", " ".repeat(13_usize.saturating_sub(name.width())));
    for (sign, side) in [('-', old), ('+', new)] {
        if let Some(side) = side {
            let _ = writeln!(out, "{name}{sign} {side}");
            name = " ".repeat(name.width());
        }
    }
}

fn summary(out: &mut String, difference: &Difference<'_>) {
    let counts = [
        (difference.removed.len(), "removed"),
        (difference.added.len(), "added"),
        (difference.renamed.len(), "renamed"),
        (difference.changed.len(), "changed"),
        (difference.same, "unchanged"),
    ];
    let parts: Vec<_> = counts
        .into_iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, what)| format!("{} {what}", grouped(count)))
        .collect();
    let _ = writeln!(out, "\nclips: {}", parts.join(", "));
}
