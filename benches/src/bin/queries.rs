//! The program whose instructions `cargo xtask instructions` counts: makes a number of queries of the same kind in a
//! bank of the generator's clips.
//!
//! `queries BANK QUESTION TIMES`. Next to the bank are: patches on top of it, with the extensions `patch` and `mod`;
//! its clips as a set, whose index has the extension `lipzset` and whose banks have `shard0`, `shard1` and so on; and a
//! bank with faces, with the extension `faces`. A query of the bank is also made in a dialogue: of the bank alone (`one
//! bank: …`), of the bank and its patches (`stack: …`), and of the set (`set: …`).

use lipz_bank::curve::{CurveCursor, CurveValue};
use lipz_bank::face::{Emotions, Face, LookAt, Who};
use lipz_bank::files::DialogueFile;
use lipz_bank::{Bank, Clip, ClipId, Cursor, Dialogue, Locale, Micros, Seconds};
use lipz_benches::{DEFAULT_SEED, RIG, Random, clip_key};
use std::hint::black_box;
use std::path::Path;

/// The microseconds between two frames of a display.
const TICK_US: usize = 16_667;
/// The number of random places and times that are used in turn.
const DRAWN: usize = 10_000;
/// The generator's clips are not longer.
const LONGEST_US: usize = 12_000_000;

type Failure = Box<dyn std::error::Error>;

fn main() -> Result<(), Failure> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [path, question, times] = arguments.as_slice() else {
        return Err("usage: queries BANK QUESTION TIMES".into());
    };
    let bytes = std::fs::read(path)?;
    let times = times.parse()?;
    // All files are read for each query, so that reading cancels out.
    let beside = |name: &str| std::fs::read(Path::new(path).with_extension(name)).unwrap_or_default();
    let shards = (0..).map(|shard: usize| beside(&format!("shard{shard}"))).take_while(|shard| !shard.is_empty());
    let set: Vec<Vec<u8>> = [beside("lipzset")].into_iter().chain(shards).collect();
    let stack = [bytes, beside("patch"), beside("mod")];
    let (of, question) = question.split_once(": ").unwrap_or(("", question));
    match of {
        "" => ask_bank(&stack[0], question, times),
        "face" => ask_faces(&beside("faces"), question, times),
        "mouth" => ask_mouths(&beside("mouths"), question, times),
        "one bank" => ask_dialogue(&stack[..1], question, times),
        "stack" => ask_dialogue(&stack, question, times),
        "set" => ask_dialogue(&set, question, times),
        _ => Err(format!("no such question: {of}").into()),
    }
}

/// Queries about curves, in lines with seven of them.
fn ask_faces(bytes: &[u8], question: &str, times: usize) -> Result<(), Failure> {
    let bank = Bank::open(bytes)?.verify()?;
    let clips: Vec<Clip<'_>> = bank.clips().collect();
    let jaws: Vec<_> = clips.iter().filter_map(|clip| clip.curve("jawOpen")).collect();
    let (name, profile) = (bank.event_name("jawOpen").ok_or("no jaw")?, bank.default_face_profile());
    let mut random = Random::new(DEFAULT_SEED, 0);
    let drawn: Vec<(usize, i64)> =
        (0..DRAWN).map(|_| (random.between(0, clips.len() - 1), random.between(0, LONGEST_US) as i64)).collect();
    let asked = drawn.into_iter().cycle().take(times);
    match question {
        "find a curve" => asked.for_each(|(at, _)| _ = black_box(clips[at].curve(name))),
        "a curve at a time" => asked.for_each(|(at, time_us)| _ = black_box(jaws[at].value_at(Micros(time_us)))),
        "a tick of a curve" => {
            let mut cursor = CurveCursor::new();
            let time = |tick: usize| Micros((tick * TICK_US % LONGEST_US) as i64);
            (0..times).for_each(|tick| _ = black_box(cursor.value_at(&jaws[0], time(tick))));
        }
        "emotions" => {
            asked.for_each(|(at, time_us)| _ = black_box(clips[at].emotions_at(Micros(time_us), Who::Speaker)));
        }
        "whole" => asked.for_each(|(at, time_us)| {
            black_box(clips[at].face_at(Micros(time_us), Who::Speaker, &profile, LookAt::AHEAD));
        }),
        _ => return Err(format!("no such question: {question}").into()),
    }
    Ok(())
}

/// Queries about articulation, in lines of which every second one has phones.
fn ask_mouths(bytes: &[u8], question: &str, times: usize) -> Result<(), Failure> {
    let bank = Bank::open(bytes)?.verify()?;
    let has_phones = |clip: &Clip<'_>| !clip.phones().is_empty();
    let with_phones: Vec<Clip<'_>> = bank.clips().filter(has_phones).collect();
    let with_visemes: Vec<Clip<'_>> = bank.clips().filter(|clip| !has_phones(clip)).collect();
    let (profile, rig) = (bank.default_articulation(), bank.rig(RIG).ok_or("no rig")?);
    let mut random = Random::new(DEFAULT_SEED, 0);
    let most = with_phones.len().min(with_visemes.len()) - 1;
    let drawn: Vec<(usize, i64)> =
        (0..DRAWN).map(|_| (random.between(0, most), random.between(0, LONGEST_US) as i64)).collect();
    let asked = drawn.into_iter().cycle().take(times);
    match question {
        "articulation" => asked.for_each(|(at, time_us)| {
            black_box(with_phones[at].articulation_at(Micros(time_us), &profile));
        }),
        "articulation from visemes" => asked.for_each(|(at, time_us)| {
            black_box(with_visemes[at].articulation_at(Micros(time_us), &profile));
        }),
        "weights of a rig" => {
            let mouth = with_phones[0].articulation_at(Micros(LONGEST_US as i64 / 2), &profile);
            let mut weights = [CurveValue::default(); 64];
            asked.for_each(|_| {
                rig.weights(black_box(&mouth), &Emotions::default(), &Face::default(), &mut weights);
                black_box(&weights);
            });
        }
        _ => return Err(format!("no such question: {question}").into()),
    }
    Ok(())
}

/// Queries of a bank only, then those that a dialogue has as well.
fn ask_bank(bytes: &[u8], question: &str, times: usize) -> Result<(), Failure> {
    match question {
        "open" => (0..times).for_each(|_| _ = black_box(Bank::open(black_box(bytes)))),
        "verify with simdutf8" => {
            let utf8 = |bytes| simdutf8::basic::from_utf8(bytes).ok();
            (0..times)
                .for_each(|_| _ = black_box(Bank::open(black_box(bytes)).and_then(|bank| bank.verify_with(utf8))));
        }
        "verify" => (0..times).for_each(|_| _ = black_box(Bank::open(black_box(bytes)).and_then(Bank::verify))),
        _ => {
            let bank = Bank::open(bytes)?.verify()?;
            let locale = bank.locale("de-de").ok_or("the bank has no German")?;
            return ask(&bank, bank.clip_count(), locale, question, times);
        }
    }
    Ok(())
}

/// The same queries of a dialogue of these files.
fn ask_dialogue(contents: &[Vec<u8>], question: &str, times: usize) -> Result<(), Failure> {
    let mut files = vec![DialogueFile::ABSENT; contents.len()];
    let dialogue = Dialogue::open(&mut files, contents.iter().map(Vec::as_slice))?;
    let locale = dialogue.locale("de-de").ok_or("the dialogue has no German")?;
    ask(&dialogue, dialogue.clip_count(), locale, question, times)
}

/// The queries of a bank or a dialogue.
trait Asked {
    fn clip(&self, id: ClipId) -> Option<Clip<'_>>;
    fn clip_by_key(&self, key: &str) -> Option<Clip<'_>>;
}

impl Asked for Bank<'_> {
    #[inline(always)]
    fn clip(&self, id: ClipId) -> Option<Clip<'_>> {
        Bank::clip(self, id)
    }

    #[inline(always)]
    fn clip_by_key(&self, key: &str) -> Option<Clip<'_>> {
        Bank::clip_by_key(self, key)
    }
}

impl Asked for Dialogue<'_> {
    #[inline(always)]
    fn clip(&self, id: ClipId) -> Option<Clip<'_>> {
        Dialogue::clip(self, id)
    }

    #[inline(always)]
    fn clip_by_key(&self, key: &str) -> Option<Clip<'_>> {
        Dialogue::clip_by_key(self, key)
    }
}

fn ask(asked: &impl Asked, clip_count: usize, locale: Locale, question: &str, times: usize) -> Result<(), Failure> {
    let keys: Vec<String> = (0..clip_count).map(clip_key).collect();
    let ids: Vec<ClipId> = keys.iter().map(|key| ClipId::from_key(key)).collect();
    let clips: Vec<Clip<'_>> = ids.iter().filter_map(|id| asked.clip(*id)).collect();
    let mut random = Random::new(DEFAULT_SEED, 0);
    // The same number of places and times for any number of queries, so that drawing cancels out.
    let drawn: Vec<(usize, i64)> =
        (0..DRAWN).map(|_| (random.between(0, clips.len() - 1), random.between(0, LONGEST_US) as i64)).collect();
    let drawn = drawn.into_iter().cycle().take(times);
    match question {
        "find by id" => drawn.for_each(|(at, _)| _ = black_box(asked.clip(ids[at]))),
        "find by key" => drawn.for_each(|(at, _)| _ = black_box(asked.clip_by_key(&keys[at]))),
        "find nothing" => {
            drawn.for_each(|(at, _)| _ = black_box(asked.clip(ClipId::from_u64(ids[at].get() ^ 1))));
        }
        "frame" => drawn.for_each(|(at, time_us)| _ = black_box(clips[at].viseme_at(Micros(time_us)))),
        "segment and text" => drawn.for_each(|(at, time_us)| {
            let segment = clips[at].segment_at(Micros(time_us));
            black_box(segment.and_then(|segment| segment.text(locale)));
        }),
        "frame by seconds" => {
            drawn.for_each(|(at, time_us)| _ = black_box(clips[at].viseme_at(Seconds(time_us as f64 * 1e-6))));
        }
        // Also for the stack, a clip of the bank: patches change every hundredth clip.
        _ => return follow(&clips[1], locale, question, times),
    }
    Ok(())
}

/// Queries of a game that plays a clip, for each rendered frame.
fn follow(clip: &Clip<'_>, locale: Locale, question: &str, times: usize) -> Result<(), Failure> {
    match question {
        "tick" => {
            (0..times).for_each(|tick| _ = black_box(clip.viseme_at(Micros((tick * TICK_US % LONGEST_US) as i64))));
        }
        // The same with the segment, and with its text and events on each change: a game without a cursor.
        "tick with segment, text and event on change" => {
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
        // The same with a cursor: events, viseme and text.
        "cursor" => {
            let length_us = usize::try_from(clip.duration_us().ok_or("the clip has no frame rate")?)?;
            let mut cursor = Cursor::new(clip).ok_or("the clip has no frame rate")?;
            for tick in 0..times {
                let time = Micros((tick * TICK_US % length_us) as i64);
                if tick * TICK_US % length_us < TICK_US {
                    cursor.seek(clip, time);
                }
                for event in cursor.advance_to(clip, time).events() {
                    black_box(event);
                }
                black_box(cursor.viseme(clip));
            }
        }
        _ => return Err(format!("no such question: {question}").into()),
    }
    Ok(())
}
