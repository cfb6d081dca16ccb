//! One generated clip as JSON.

use crate::random::Random;
use crate::texts::{self, LOCALES};
use lipz_bank::VisemeType;

/// Weights of 1, 2, … 6 segments.
const SEGMENT_WEIGHTS: [usize; 6] = [34, 29, 17, 10, 6, 4];
/// Percentage of segments with an event.
const EVENT_PERCENT: usize = 30;
/// Percentage of segments whose texts start with `{meta}`.
const META_PERCENT: usize = 3;

const FPS: [usize; 3] = [24, 25, 30];
const METAS: [&str; 5] = ["{whispering} ", "{shouting} ", "{off screen} ", "{to amy} ", "{take 2} "];
const NAMES: [&str; 8] = ["amy", "samson", "mara", "ivo", "nell", "otto", "rob", "the_admiral"];
const EMOTIONS: [&str; 10] =
    ["neutral", "amused", "happy", "sad", "irritated", "angry", "suspicious", "confused", "afraid", "thinking"];
const PROPS: [&str; 8] = ["door", "letter", "window", "lamp", "map", "sword", "boat", "key"];
const ACTIONS: [&str; 8] = ["nod", "shrug", "wave", "bow", "sigh", "laugh", "step_back", "cross_arms"];

/// Returns clip number `index` of `seed`, with the first `locales` of the locales.
pub(crate) fn json(seed: u64, index: usize, locales: usize) -> String {
    let mut random = Random::new(seed, index as u64);
    let fps = FPS[random.weighted(&[50, 30, 20])];
    let duration_ms = random.between(1000, 12_000);
    let frame_count = duration_ms * fps / 1000;
    let lengths = segment_lengths(&mut random, frame_count, duration_ms);
    let viseme_type = [VisemeType::Blair, VisemeType::ToonBoom, VisemeType::Rms][random.weighted(&[70, 20, 10])];

    let mut json = String::with_capacity(256 + frame_count + 160 * locales);
    json.push_str("{\n  \"fps\": ");
    json.push_str(&fps.to_string());
    json.push_str(",\n  \"viseme_type\": \"");
    json.push_str(viseme_type.name());
    json.push_str("\",\n  \"visemes\": \"");
    for (segment, &length) in lengths.iter().enumerate() {
        delimit(&mut json, segment);
        visemes(&mut random, &mut json, length, viseme_type);
    }
    // The same segments have meta in every language, because translators keep it.
    let metas: Vec<&str> =
        lengths.iter().map(|_| if random.chance(META_PERCENT) { random.one_of(&METAS) } else { "" }).collect();
    for locale in LOCALES.iter().take(locales) {
        json.push_str("\",\n  \"text_");
        json.push_str(locale.tag);
        json.push_str("\": \"");
        for (segment, (length, meta)) in std::iter::zip(&lengths, &metas).enumerate() {
            delimit(&mut json, segment);
            json.push_str(meta);
            texts::sentences(&mut random, &mut json, locale, length * 1000 / fps);
        }
    }
    let events: Vec<String> =
        lengths.iter().map(|_| if random.chance(EVENT_PERCENT) { event(&mut random) } else { String::new() }).collect();
    if events.iter().any(|event| !event.is_empty()) {
        json.push_str("\",\n  \"events\": \"");
        json.push_str(&events.join("|"));
    }
    json.push_str("\"\n}\n");
    json
}

fn delimit(json: &mut String, segment: usize) {
    if segment > 0 {
        json.push('|');
    }
}

/// Returns the number of frames of each segment, at least about half a second.
fn segment_lengths(random: &mut Random, frame_count: usize, duration_ms: usize) -> Vec<usize> {
    let count = (random.weighted(&SEGMENT_WEIGHTS) + 1).min(duration_ms / 1000);
    let shares: Vec<usize> = (0..count).map(|_| random.between(50, 150)).collect();
    let total: usize = shares.iter().sum();
    let mut lengths: Vec<usize> = shares.iter().map(|share| frame_count * share / total).collect();
    let rest = frame_count - lengths.iter().sum::<usize>();
    if let Some(last) = lengths.last_mut() {
        *last += rest;
    }
    lengths
}

/// Writes the codes of one segment: mouth shapes held for one to four frames, sometimes a pause, and rest at both ends.
fn visemes(random: &mut Random, json: &mut String, length: usize, viseme_type: VisemeType) {
    let shapes = viseme_type.codes().trim_start_matches('-').as_bytes();
    let end_rest = random.between(2, 10).min(length / 3);
    let mut left = length - end_rest;
    let mut hold = |code: u8, count: usize, left: &mut usize| {
        let count = count.min(*left);
        json.extend(std::iter::repeat_n(char::from(code), count));
        *left -= count;
    };
    hold(b'-', random.between(0, 3), &mut left);
    while left > 0 {
        if random.chance(6) {
            hold(b'-', random.between(2, 8), &mut left);
        } else {
            hold(random.one_of(shapes), random.between(1, 4), &mut left);
        }
    }
    json.extend(std::iter::repeat_n('-', end_rest));
}

/// Returns Character Event Syntax, sometimes with two events.
fn event(random: &mut Random) -> String {
    let mut event = one_event(random);
    if random.chance(10) {
        event.push(',');
        event.push_str(&one_event(random));
    }
    event
}

fn one_event(random: &mut Random) -> String {
    let mut event = String::new();
    if random.chance(35) {
        event.push_str(random.one_of(&NAMES));
        event.push(' ');
    }
    let target = if random.chance(50) { random.one_of(&NAMES) } else { random.one_of(&PROPS) };
    match random.weighted(&[40, 15, 10, 5, 8, 4, 18]) {
        0 => {
            event.push_str("feels ");
            event.push_str(random.one_of(&EMOTIONS));
        }
        1 => event.push_str(&format!("sees {target}")),
        2 => event.push_str(&format!("stares {target}")),
        3 => event.push_str("stops staring"),
        4 => event.push_str(&format!("points {target}")),
        5 => event.push_str("stops pointing"),
        _ => {
            event.push_str("does ");
            event.push_str(random.one_of(&ACTIONS));
        }
    }
    event
}
