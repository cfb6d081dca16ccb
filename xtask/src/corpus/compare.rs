//! A bank against the rows: everything that a row says, asked from the reader.

use super::row::{Row, ratio};
use super::{Differences, Files, Seen};
use lipz_bank::{Bank, Clip, Fps, Micros, Text, VisemeType};
use std::collections::{BTreeMap, BTreeSet};

pub(super) fn bank(
    bank: &Bank<'_>,
    rows: &BTreeMap<String, Row>,
    files: &Files,
    differences: &mut Differences,
    seen: &mut Seen,
) {
    let keys: BTreeSet<&str> = bank.clips().map(|clip| clip.key()).collect();
    let packed: BTreeSet<&str> = files.contents.keys().map(String::as_str).collect();
    differences.equal("the bank", "its set of keys", &keys, &packed);
    for (key, contents) in &files.contents {
        let (Some(row), Some(clip)) = (rows.get(key), bank.clip_by_key(key)) else { continue };
        if row.is_stale(contents) {
            continue;
        }
        seen.clips += 1;
        differences.equal(key, "the key", clip.key(), key);
        rates_and_types(&clip, row, key, differences, seen);
        frames(&clip, row, contents, key, differences, seen);
        texts(bank, &clip, row, key, differences, seen);
        events(&clip, row, key, differences, seen);
    }
}

/// The event strings, and the typed events of each.
fn events(clip: &Clip<'_, '_>, row: &Row, key: &str, differences: &mut Differences, seen: &mut Seen) {
    let events: Option<Vec<&str>> =
        if clip.has_events() { clip.segments().map(|segment| segment.event()).collect() } else { None };
    seen.events += events.as_ref().map_or(0, Vec::len);
    let expected: Option<Vec<&str>> = row.events.as_ref().map(|events| events.iter().map(String::as_str).collect());
    differences.equal(key, "the list of events", events, expected);
    for (segment, string) in std::iter::zip(clip.segments(), row.events.iter().flatten()) {
        let typed: Vec<String> = segment.events().map(|event| event.to_string()).collect();
        seen.typed_events += typed.len();
        differences.equal(key, &format!("the typed events of `{string}`"), typed, typed_events(string));
    }
}

/// The events that a string says, with one blank between words; none if a part of it is no event.
/// Done here by long hand, so that it does not agree with the parser under test by sharing its mistakes.
fn typed_events(string: &str) -> Vec<String> {
    let event = |part: &str| {
        let words: Vec<&str> = part.split(|c| " \t\r\n".contains(c)).filter(|word| !word.is_empty()).collect();
        let ([verb, object] | [_, verb, object]) = words[..] else { return None };
        let is_event = match verb {
            "stops" => object == "staring" || object == "pointing",
            verb => ["feels", "sees", "stares", "points", "does"].contains(&verb),
        };
        is_event.then(|| words.join(" "))
    };
    string.split(',').map(event).collect::<Option<_>>().unwrap_or_default()
}

/// The bank's own frame rate and viseme type, those supplied at run time, and frames by time.
fn rates_and_types(clip: &Clip<'_, '_>, row: &Row, key: &str, differences: &mut Differences, seen: &mut Seen) {
    let parts = |fps: Option<Fps>| fps.map(|fps| (fps.numerator(), fps.denominator()));
    differences.equal(key, "fps", parts(clip.fps()), row.fps.as_ref().and_then(ratio));
    let external = row.fps_external.as_ref().and_then(ratio);
    // A clip with a rate of its own must keep it, whatever is supplied.
    let supplied = external.and_then(|(numerator, denominator)| Fps::new(numerator, denominator));
    let clip_in_time = clip.or_fps(supplied.unwrap_or(Fps::whole(7)));
    let expected = row.fps.as_ref().and_then(ratio).or(external).or(Some((7, 1)));
    differences.equal(key, "fps with one supplied", parts(clip_in_time.fps()), expected);
    times(&clip_in_time, expected, key, differences, seen);

    let name = |viseme_type: Option<VisemeType>| viseme_type.map(VisemeType::name);
    differences.equal(key, "the viseme type", name(clip.viseme_type()), row.viseme_type.as_deref());
    let supplied = row.viseme_type_external.as_deref();
    let with_type = clip.or_viseme_type(supplied.and_then(VisemeType::from_name).unwrap_or(VisemeType::Rms));
    let expected = row.viseme_type.as_deref().or(supplied).or(Some("rms"));
    differences.equal(key, "the viseme type with one supplied", name(with_type.viseme_type()), expected);
}

/// The first and the last microsecond of every segment, in exact arithmetic.
fn times(clip: &Clip<'_, '_>, fps: Option<(u32, u32)>, key: &str, differences: &mut Differences, seen: &mut Seen) {
    let Some((numerator, denominator)) = fps else { return };
    // Frames of a file and the denominator of a decimal are small: the product fits.
    let start_us = |frame: u32| (u64::from(frame) * u64::from(denominator) * 1_000_000).div_ceil(u64::from(numerator));
    for segment in clip.segments() {
        let (start, end) = (segment.start_frame(), segment.end_frame());
        differences.equal(key, "the start of a segment in µs", segment.start_us(), Some(start_us(start)));
        differences.equal(key, "the end of a segment in µs", segment.end_us(), Some(start_us(end)));
        if start == end {
            continue;
        }
        seen.times += 2;
        let found = [start_us(start), start_us(end) - 1].map(|time_us| {
            let time = Micros(time_us as i64);
            let segment = clip.segment_at(time).map(|segment| segment.index());
            (clip.frame_at(time), segment)
        });
        let index = Some(segment.index());
        differences.equal(key, "frame and segment at both ends", found, [(Some(start), index), (Some(end - 1), index)]);
    }
    let end = Micros(start_us(clip.frame_count()) as i64);
    differences.equal(key, "the frame at the end", clip.frame_at(end), None);
}

/// Frame codes, their number, and where the segments start.
fn frames(clip: &Clip<'_, '_>, row: &Row, contents: &[u8], key: &str, differences: &mut Differences, seen: &mut Seen) {
    seen.frames += clip.frames().len();
    seen.segments += clip.segment_count() as usize;
    differences.equal(key, "the number of frames", clip.frame_count() as usize, row.frames);
    differences.equal(key, "the number of segments", clip.segment_count() as usize, row.segments);
    let starts: Vec<u32> = clip.segments().map(|segment| segment.start_frame()).collect();
    differences.equal(key, "the list of segment starts", &starts, &row.seg_start_frames);
    let json = super::trips::json(contents);
    let codes = json.as_ref().and_then(|json| json.get("visemes")).and_then(|visemes| visemes.as_str());
    let codes: Option<String> = codes.map(|codes| codes.chars().filter(|c| !"| \t\r\n".contains(*c)).collect());
    differences.equal(key, "whether it has visemes", clip.has_visemes(), codes.is_some());
    let found = std::str::from_utf8(clip.frames()).ok();
    differences.equal(key, "the string of visemes", found, Some(codes.as_deref().unwrap_or("")));
    let by_frame: String = (0..clip.frame_count()).map(|index| clip.viseme(index).as_char()).collect();
    differences.equal(key, "the visemes frame by frame", Some(by_frame.as_str()), found);
}

/// The clip's own texts: those of the row, and no others.
fn texts(bank: &Bank<'_>, clip: &Clip<'_, '_>, row: &Row, key: &str, differences: &mut Differences, seen: &mut Seen) {
    let mut found: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for locale in bank.locales() {
        let own: Vec<Option<Text<'_>>> =
            clip.segments().map(|segment| segment.text(locale).filter(|text| !text.is_fallback())).collect();
        let is_partial = own.iter().any(Option::is_some);
        let own: Option<Vec<Text<'_>>> = own.into_iter().collect();
        match own {
            Some(own) => {
                seen.texts += own.len();
                found.insert(locale.tag(), own.iter().map(|text| text.as_str()).collect());
            }
            None if is_partial => {
                differences.add(|| format!("{key}: some segments have a text in {}, others do not", locale.tag()));
            }
            None => {}
        }
    }
    let locales: BTreeSet<&str> = found.keys().copied().collect();
    let expected: BTreeSet<&str> = row.locales.iter().map(String::as_str).collect();
    differences.equal(key, "the set of locales", locales, expected);
    for (locale, texts) in &row.display {
        let expected: Vec<&str> = texts.iter().map(String::as_str).collect();
        differences.equal(key, &format!("the text in {locale}"), found.get(locale.as_str()), Some(&expected));
    }
}
