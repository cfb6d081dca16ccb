//! The program whose instructions `cargo xtask instructions` counts: asks a bank of the generator's
//! clips the same kind of question a number of times.
//!
//! `queries BANK QUESTION TIMES`; beside the bank lie layers over it, with the extensions `patch` and `mod`, its clips as
//! a set, with the extensions `shard0`, `shard1` and so on, and a bank about faces, with `faces`.

use lipz_bank::{Bank, BankSet, Clip, ClipId, Cursor, CurveCursor, Layers, LookAt, Micros, Seconds};
use lipz_benches::{DEFAULT_SEED, Random, clip_key};
use std::hint::black_box;

/// Microseconds between two frames of a display.
const TICK_US: usize = 16_667;
/// Places and times that are asked for in turn.
const DRAWN: usize = 10_000;
/// No clip of the generator is longer.
const LONGEST_US: usize = 12_000_000;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [path, question, times] = arguments.as_slice() else {
        return Err("usage: queries BANK QUESTION TIMES".into());
    };
    let bytes = std::fs::read(path)?;
    let times = times.parse()?;
    // The layers over the bank and the banks of the set, made before: that does not count.
    let beside = |name: &str| std::fs::read(std::path::Path::new(path).with_extension(name)).unwrap_or_default();
    if let Some(question) = question.strip_prefix("face: ") {
        return ask_faces(&beside("faces"), question, times);
    }
    let shards = (0..).map(|shard: usize| beside(&format!("shard{shard}")));
    let shards: Vec<Vec<u8>> = shards.take_while(|shard| !shard.is_empty()).collect();
    ask([&bytes, &beside("patch"), &beside("mod")], &shards, question, times)
}

/// Questions about curves, of lines with seven of them.
fn ask_faces(bytes: &[u8], question: &str, times: usize) -> Result<(), Box<dyn std::error::Error>> {
    let bank = Bank::open(bytes)?.verify()?;
    let clips: Vec<Clip<'_, '_>> = bank.clips().collect();
    let jaws: Vec<_> = clips.iter().filter_map(|clip| clip.curve("jawOpen")).collect();
    let (name, profile) = (bank.event_name("jawOpen").ok_or("no jaw")?, bank.default_face_profile());
    let mut random = Random::new(DEFAULT_SEED, 0);
    let drawn: Vec<(usize, i64)> =
        (0..DRAWN).map(|_| (random.between(0, clips.len() - 1), random.between(0, LONGEST_US) as i64)).collect();
    let asked = drawn.into_iter().cycle().take(times);
    match question {
        "find a curve" => asked.for_each(|(at, _)| _ = black_box(clips[at].curve_named(name))),
        "a curve at a time" => asked.for_each(|(at, time_us)| _ = black_box(jaws[at].value_at(Micros(time_us)))),
        "a tick of a curve" => {
            let mut cursor = CurveCursor::new();
            let time = |tick: usize| Micros((tick * TICK_US % LONGEST_US) as i64);
            (0..times).for_each(|tick| _ = black_box(cursor.value_at(&jaws[0], time(tick))));
        }
        "emotions" => asked.for_each(|(at, time_us)| _ = black_box(clips[at].emotions_at(Micros(time_us)))),
        "whole" => asked.for_each(|(at, time_us)| {
            black_box(clips[at].face_at(Micros(time_us), &profile, LookAt::AHEAD));
        }),
        _ => return Err(format!("no such question: {question}").into()),
    }
    Ok(())
}

fn ask(
    [bytes, patch, addition]: [&[u8]; 3],
    shards: &[Vec<u8>],
    question: &str,
    times: usize,
) -> Result<(), Box<dyn std::error::Error>> {
    let bank = Bank::open(bytes)?.verify()?;
    let locale = bank.locale("de-de").ok_or("the bank has no German")?;
    let keys: Vec<String> = (0..bank.clip_count()).map(clip_key).collect();
    let ids: Vec<ClipId> = keys.iter().map(|key| ClipId::from_key(key)).collect();
    let clips: Vec<Clip<'_, '_>> = ids.iter().filter_map(|id| bank.clip(*id)).collect();
    let mut random = Random::new(DEFAULT_SEED, 0);
    // Where and when: as many for any number of questions, so that drawing does not count.
    let drawn: Vec<(usize, i64)> =
        (0..DRAWN).map(|_| (random.between(0, clips.len() - 1), random.between(0, LONGEST_US) as i64)).collect();
    let asked = drawn.into_iter().cycle().take(times);
    match question {
        "open" => (0..times).for_each(|_| _ = black_box(Bank::open(black_box(bytes)))),
        "verify" => (0..times).for_each(|_| _ = black_box(Bank::open(black_box(bytes)).and_then(Bank::verify))),
        "find by id" => asked.for_each(|(at, _)| _ = black_box(bank.clip(ids[at]))),
        "find by key" => asked.for_each(|(at, _)| _ = black_box(bank.clip_by_key(&keys[at]))),
        "find nothing" => {
            asked.for_each(|(at, _)| _ = black_box(bank.clip(ClipId::from_u64(ids[at].get() ^ 1))));
        }
        "find by id in a set" | "find by key in a set" => {
            let banks: Vec<Bank<'_>> = shards.iter().map(|shard| Bank::open(shard)).collect::<Result<_, _>>()?;
            let set = BankSet::new(&banks)?.verify()?;
            match question {
                "find by id in a set" => asked.for_each(|(at, _)| _ = black_box(set.clip(ids[at]))),
                _ => asked.for_each(|(at, _)| _ = black_box(set.clip_by_key(&keys[at]))),
            }
        }
        // A base with a patch of every hundredth clip and a mod of every thousandth over it.
        "find in three layers" | "text in three layers" => {
            let banks = [bank, Bank::open(patch)?.verify()?, Bank::open(addition)?.verify()?];
            let layers = Layers::new(banks)?;
            let german = layers.locale("de-de").ok_or("the stack has no German")?;
            if question == "find in three layers" {
                asked.for_each(|(at, _)| _ = black_box(layers.clip(ids[at])));
            } else {
                let clips: Vec<_> = ids.iter().filter_map(|id| layers.clip(*id)).collect();
                asked.for_each(|(at, time_us)| {
                    let segment = clips[at].segment_at(Micros(time_us));
                    black_box(segment.and_then(|segment| clips[at].text(segment.index(), &german)));
                });
            }
        }
        "frame" => asked.for_each(|(at, time_us)| _ = black_box(clips[at].viseme_at(Micros(time_us)))),
        "segment and text" => asked.for_each(|(at, time_us)| {
            let segment = clips[at].segment_at(Micros(time_us));
            black_box(segment.and_then(|segment| segment.text(locale)));
        }),
        "tick" => {
            let clip = clips[0];
            (0..times).for_each(|tick| _ = black_box(clip.viseme_at(Micros((tick * TICK_US % LONGEST_US) as i64))));
        }
        // The same with the segment, and its text and its events when it has changed: a game without a cursor.
        "tick with segment, text and event on change" => {
            let clip = clips[0];
            let mut shown = None;
            for tick in 0..times {
                let time = Micros((tick * TICK_US % LONGEST_US) as i64);
                black_box(clip.viseme_at(time));
                let segment = clip.segment_at(time);
                let index = segment.map(|segment| segment.index());
                if index != shown {
                    shown = index;
                    if let Some(segment) = segment {
                        black_box((segment.text(locale), segment.event()));
                    }
                }
            }
        }
        // The same with what a game does for each picture: events, mouth and text.
        "cursor" => {
            let clip = clips[0];
            let length_us = usize::try_from(clip.duration_us().ok_or("the clip has no frame rate")?)?;
            let mut cursor = Cursor::new(&clip).ok_or("the clip has no frame rate")?;
            for tick in 0..times {
                let time = Micros((tick * TICK_US % length_us) as i64);
                if tick * TICK_US % length_us < TICK_US {
                    cursor.seek(&clip, time);
                }
                for event in cursor.advance_to(&clip, time).events() {
                    black_box(event);
                }
                black_box(cursor.viseme(&clip));
            }
        }
        "frame by seconds" => {
            asked.for_each(|(at, time_us)| _ = black_box(clips[at].viseme_at(Seconds(time_us as f64 * 1e-6))));
        }
        _ => return Err(format!("no such question: {question}").into()),
    }
    Ok(())
}
