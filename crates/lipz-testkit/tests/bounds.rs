//! The worst cost of a query on a hostile bank, as stated in docs/reference/bank-format.md. Counted in instructions,
//! because time proves nothing on a shared machine. Needs valgrind, under which it runs itself.
#![allow(clippy::unwrap_used, clippy::panic, clippy::cast_possible_truncation, reason = "tests")]
#![allow(clippy::expect_used, clippy::unnecessary_map_or, reason = "helpers of the reader's tests")]

use lipz_bank::curve::CurveCursor;
use lipz_bank::face::{LookAt, Who};
use lipz_bank::{Bank, Fps, Micros, Samples, Seconds};
use lipz_layout::{
    CurveClipRecord, CurveKeyRecord, CurveRecord, EventNameRecord, EventRecord, FaceRecord, Tag, TypedEventRecord, U32,
    VERB_DOES,
};
use lipz_testkit::forge::{self, ForgedClip};
use lipz_testkit::golden::{directory, section};
use std::hint::black_box;
use std::process::Command;
use zerocopy::IntoBytes;

/// The number of entries of every table, in the small bank and in the large one.
const ENTRIES: [usize; 2] = [1 << 9, 1 << 15];
/// The variable that passes the number of entries to this program.
const VARIABLE: &str = "LIPZ_BOUNDS_ENTRIES";

/// The growth of a query's cost with the bank.
#[derive(Clone, Copy, PartialEq)]
enum Growth {
    /// Not at all.
    Constant,
    /// One step of a binary search per doubling of the bank.
    Logarithmic,
    /// At most in proportion.
    Linear,
}

/// The only name: of a curve that is queried with all others.
const EMOTION: &[u8] = b"joy";
/// The difference in instructions that a query of constant cost may have: different branches, but no loop.
const NO_LOOP: u64 = 100;
/// The instructions of one step of a binary search over names.
const SEARCH_STEP: u64 = 200;

/// The queries, each in a separate function for callgrind.
macro_rules! queries {
    ($($name:ident: $growth:ident = |$bank:ident| $query:expr;)*) => {
        mod queries {
            use super::*;
            $(#[inline(never)]
            pub(super) fn $name(bank: &Bank<'_>) {
                let $bank = black_box(bank);
                black_box($query);
            })*
        }
        const QUERIES: &[(&str, Growth, fn(&Bank<'_>))] =
            &[$((stringify!($name), Growth::$growth, queries::$name)),*];
    };
}

queries! {
    clip: Constant = |bank| bank.clip(lipz_bank::ClipId::from_key("k")).is_some();
    clip_by_key: Constant = |bank| bank.clip_by_key("k").is_some();
    clips_under: Logarithmic = |bank| bank.clips_under("k").size_hint();
    all_clips: Linear = |bank| bank.clips().count();
    locale: Linear = |bank| bank.locale("none").is_some();
    default_locale: Linear = |bank| bank.default_locale().is_some();
    event_name: Logarithmic = |bank| bank.event_name("zz").is_some();
    frame_at_micros: Constant = |bank| the(bank).frame_at(Micros(i64::MAX));
    frame_at_samples: Constant = |bank| the(bank).frame_at(Samples { position: i64::MAX, rate_hz: 1 });
    frame_at_seconds: Constant = |bank| the(bank).frame_at(Seconds(f64::MAX));
    viseme: Constant = |bank| the(bank).viseme_at(Micros(1));
    frames: Constant = |bank| the(bank).frames().len();
    segment_count: Constant = |bank| the(bank).segment_count();
    segment_of_frame: Logarithmic = |bank| the(bank).segment_of_frame(1).is_some();
    segment_at: Logarithmic = |bank| the(bank).segment_at(Micros(0)).is_some();
    segment_frames: Constant = |bank| last(bank).frames().len();
    text: Constant = |bank| last(bank).text(bank.locales().next().unwrap()).is_some();
    text_bytes: Constant = |bank| last(bank).text_bytes(bank.locales().next().unwrap()).is_some();
    event: Constant = |bank| last(bank).event().is_some();
    first_event: Constant = |bank| last(bank).events().next().is_some();
    events: Linear = |bank| last(bank).events().count();
    segments: Linear = |bank| the(bank).segments().count();
    curves: Linear = |bank| the(bank).curves().count();
    curve: Logarithmic = |bank| the(bank).curve("zz").is_some();
    curve_in_place: Constant = |bank| the(bank).curve_in_place(1).is_some();
    nth_curve: Logarithmic = |bank| the(bank).curves().nth(7).is_some();
    curve_tick: Constant = |bank| CurveCursor::from_word(5).value_at(&first(bank), Micros(250_000));
    curve_value: Logarithmic = |bank| longest(bank).value_at(Micros(i64::MAX));
    emotions_at: Linear = |bank| the(bank).emotions_at(Micros(1), Who::Speaker);
    emotions_of: Linear = |bank| the(bank).emotions_at(Micros(1), "amy");
    face_profile: Linear = |bank| bank.face_profile("zz").is_some();
    face_at: Linear = |bank| the(bank).face_at(Micros(1), Who::Speaker, &bank.default_face_profile(), LookAt::AHEAD);
    face_of: Linear = |bank| the(bank).face_at(Micros(1), "amy", &bank.default_face_profile(), LookAt::AHEAD);
    verify: Linear = |bank| bank.verify().is_err();
}

/// Returns the only clip.
fn the<'a>(bank: &'a Bank<'a>) -> lipz_bank::Clip<'a> {
    bank.clip_at(0).unwrap().or_fps(Fps::whole(24))
}

fn last<'a>(bank: &'a Bank<'a>) -> lipz_bank::Segment<'a> {
    let clip = the(bank);
    clip.segment(clip.segment_count() - 1).unwrap()
}

/// The same, found without a search.
fn first<'a>(bank: &'a Bank<'a>) -> lipz_bank::curve::Curve<'a> {
    the(bank).curve_in_place(0).unwrap()
}

/// Returns the curve with the most keys.
fn longest<'a>(bank: &'a Bank<'a>) -> lipz_bank::curve::Curve<'a> {
    the(bank).curve("joy").unwrap()
}

/// Returns a bank with this number of locales.
fn many_locales(entries: usize) -> Vec<u8> {
    let clip = ForgedClip { key: "k", frames: vec![], starts: vec![] };
    forge::bank(&[clip], entries, &[0], b"")
}

/// Returns a bank with `entries` of everything that one clip can refer to: segments that are all empty, event strings
/// that all refer to all typed events, names that are all the same, curves with one name, and face profiles.
fn hostile(entries: usize) -> Vec<u8> {
    let starts = vec![0; entries - 1];
    let clip = ForgedClip { key: "k", frames: vec![b'A'; entries], starts };
    let whole = forge::bank(&[clip], 1, &vec![0; entries], b"");
    let mut contents: Vec<(Tag, u16, Vec<u8>)> = directory(&whole)
        .iter()
        .map(|entry| (Tag(entry.tag), entry.entry_bytes.get(), whole[section(&whole, Tag(entry.tag))].to_vec()))
        .collect();
    let number = |number: usize| U32::new(number as u32);
    let event = EventRecord {
        offset_bytes: number(0),
        length_bytes: number(1),
        typed_first: number(0),
        typed_count: number(entries),
    };
    let typed = TypedEventRecord { character: number(0), object: number(0), verb: VERB_DOES, reserved: [0; 7] };
    let name = EventNameRecord { offset_bytes: number(0), length_bytes: number(EMOTION.len()) };
    for (tag, _, contents) in &mut contents {
        match *tag {
            Tag::KEY_ORDER => *contents = vec![0; 4 * entries],
            Tag::EVENT_REFS => *contents = vec![0; 4 * entries],
            Tag::EVENTS => *contents = vec![event; entries].as_bytes().to_vec(),
            Tag::TYPED_EVENTS => *contents = vec![typed; entries].as_bytes().to_vec(),
            Tag::EVENT_NAMES => *contents = vec![name; entries].as_bytes().to_vec(),
            Tag::EVENT_STRINGS => *contents = EMOTION.to_vec(),
            _ => {}
        }
    }
    // The first curve has half of the keys, the others have one each.
    let first_key = |curve: usize| if curve == 0 { 0 } else { entries + curve };
    let curve = |index| CurveRecord { keys_first: number(first_key(index)), name_and_width: number(0) };
    let curves: Vec<_> = (0..entries).map(curve).collect();
    let keys: Vec<_> =
        (0..2 * entries).map(|index| CurveKeyRecord { frame: (index as u16).into(), thousandths: 1.into() }).collect();
    let profile = [whole_face().as_bytes(), b"a"].concat().repeat(entries);
    let clips = [CurveClipRecord { slot: number(0), curves_first: number(0) }];
    let beside = [
        (Tag::CURVE_CLIPS, clips.as_bytes()),
        (Tag::CURVES, curves.as_bytes()),
        (Tag::CURVE_KEYS, keys.as_bytes()),
        (Tag::FACES, &profile),
    ];
    let entry_bytes =
        |tag| Tag::OPTIONAL.iter().find(|known| known.tag == tag).map_or(0, |known| known.entry_bytes as u16);
    contents.extend(beside.map(|(tag, bytes)| (tag, entry_bytes(tag), bytes.to_vec())));
    let sections: Vec<_> = contents.iter().map(|(tag, entry, contents)| (*tag, *entry, contents.as_slice())).collect();
    forge::file(&sections, 0, 0)
}

/// Returns a profile with thirteen different blink intervals.
fn whole_face() -> FaceRecord {
    FaceRecord {
        blink_interval_ms: std::array::from_fn(|place| (400 + 10 * place as u16).into()),
        blink_length_ms: 240.into(),
        double_blink_percent: 100,
        glance_percent: 50,
        head_motion: 3000.into(),
        head_follows: 20_000.into(),
        pose_ms: 100.into(),
        fixation_ms: 100.into(),
        name_length_bytes: 1.into(),
    }
}

/// Runs under callgrind.
#[test]
#[ignore = "run by `queries_cost_what_is_stated`"]
fn every_query_once() {
    let entries = std::env::var(VARIABLE).unwrap().parse().unwrap();
    let bytes = hostile(entries);
    let bank = Bank::open(&bytes).unwrap();
    let other_bytes = many_locales(entries);
    let other = Bank::open(&other_bytes).unwrap();
    assert_eq!((the(&bank).segment_count() as usize, other.locales().count()), (entries, entries));
    assert_eq!((last(&bank).events().count(), bank.clips().count()), (entries, entries));
    for (name, _, query) in QUERIES {
        query(if name.contains("locale") { &other } else { &bank });
    }
}

/// Returns the instructions of each query on a bank with this number of entries, callees included.
fn instructions(entries: usize) -> Vec<u64> {
    let folder = std::env::temp_dir().join(format!("lipz-bounds-{}-{entries}", std::process::id()));
    let run = |command: &mut Command| {
        let output = command.output().unwrap();
        assert!(output.status.success(), "{command:?}: {}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    run(Command::new("valgrind")
        .args(["--tool=callgrind", &format!("--callgrind-out-file={}", folder.display())])
        .arg(std::env::current_exe().unwrap())
        .args(["--exact", "every_query_once", "--ignored", "--test-threads=1"])
        .env(VARIABLE, entries.to_string()));
    let annotated = run(Command::new("callgrind_annotate").args(["--inclusive=yes", "--threshold=100"]).arg(&folder));
    std::fs::remove_file(&folder).unwrap();
    // `1,234 (0.01%)  file:bounds::queries::name [program]`
    let count = |name: &str| {
        let function = format!("bounds::queries::{name}");
        let line = annotated.lines().find(|line| ends_name(line, &function));
        let line = line.unwrap_or_else(|| panic!("{name} is not in\n{annotated}"));
        line.split_whitespace().next().unwrap().replace(',', "").parse().unwrap()
    };
    QUERIES.iter().map(|(name, ..)| count(name)).collect()
}

/// Whether the line belongs to this function, not to a longer name with the same start.
fn ends_name(line: &str, function: &str) -> bool {
    line.split_once(function).is_some_and(|(_, rest)| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_'))
}

#[test]
fn queries_cost_what_is_stated() {
    if !["valgrind", "callgrind_annotate"].iter().all(|tool| Command::new(tool).arg("--version").output().is_ok()) {
        assert!(std::env::var_os("CI").is_none(), "needs valgrind");
        eprintln!("skipped: needs valgrind");
        return;
    }
    let [small, large] = ENTRIES.map(instructions);
    let times = (ENTRIES[1] / ENTRIES[0]) as u64;
    for ((name, growth, _), (small, large)) in QUERIES.iter().zip(small.into_iter().zip(large)) {
        println!("{name:<18} {small:>9} {large:>9}");
        let most = match growth {
            Growth::Constant => small + NO_LOOP,
            Growth::Logarithmic => small + SEARCH_STEP * u64::from(times.ilog2()) * 2,
            // Different branches may also be taken at each entry.
            Growth::Linear => small * times * 21 / 20 + NO_LOOP,
        };
        assert!(large <= most, "{name}: {small} instructions, with {times} times the entries {large}");
        // Check that the measurement counts loops at all.
        assert!(*growth != Growth::Linear || *name == "verify" || large > small * 2, "{name}: {small}, {large}");
    }
}
