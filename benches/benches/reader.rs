//! Queries of the reader, compared with the specification's own algorithm on the same clips.
#![allow(
    missing_docs,
    clippy::expect_used,
    reason = "a bench program: criterion's macros, and a stop at the first surprise"
)]

use criterion::measurement::WallTime;
use criterion::{BatchSize, BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use lipz_bank::curve::{CurveCursor, CurveValue};
use lipz_bank::face::{Emotions, Face, LookAt, Who};
use lipz_bank::files::DialogueFile;
use lipz_bank::{Bank, Clip, ClipId, Dialogue, Micros};
use lipz_benches::{DEFAULT_SEED, RIG, Random, faces, files, layers, mouths, naive};
use lipz_compiler::{Compiler, Input, Options};
use std::hint::black_box;

const CLIPS: usize = 10_000;
const LOCALES: usize = 5;
/// The microseconds between two frames of a display.
const TICK_US: i64 = 16_667;

fn bank(files: &[(String, String)]) -> Vec<u8> {
    let inputs: Vec<Input> = files.iter().map(|(key, json)| Input::from_bytes(key, json.as_bytes())).collect();
    let options = Options::new().strip(true);
    Compiler::new(options.clone()).compile(&inputs).bank.expect("clips without errors")
}

/// As in a game that follows links: the processor cannot start a look-up before it has the answer to the last one.
fn follow_links(group: &mut BenchmarkGroup<'_, WallTime>, bank: &Bank<'_>, ids: &[ClipId], files: &[(String, String)]) {
    let mut at = 0;
    let behind = |at: usize, clip: Option<Clip<'_>>| (at + clip.expect("a clip").slot() as usize) % CLIPS;
    group.bench_function("find, by the id that the last answer leads to", |bencher| {
        bencher.iter(|| at = behind(at + 1, bank.clip(ids[at])));
    });
    group.bench_function("find, by the key that the last answer leads to", |bencher| {
        bencher.iter(|| at = behind(at + 1, bank.clip_by_key(&files[at].0)));
    });
}

fn queries(criterion: &mut Criterion) {
    let files = files(CLIPS, LOCALES);
    let bytes = bank(&files);
    let bank = Bank::open(&bytes).and_then(Bank::verify).expect("a bank without fault");
    let rival = naive::Naive::parse(files.iter().map(|(key, json)| (key.as_str(), json.as_str()))).expect("JSON");
    let locale = bank.locale("de-de").expect("the second locale");
    let clips: Vec<_> = files.iter().filter_map(|(key, _)| Some((bank.clip_by_key(key)?, rival.clip(key)?))).collect();
    assert_eq!(clips.len(), CLIPS);

    // Both must return the same answers to be comparable.
    for (clip, value) in clips.iter().step_by(97) {
        for time_us in (0..12_500_000).step_by(133_337) {
            let seconds = time_us as f64 / 1e6;
            assert_eq!(clip.viseme_at(Micros(time_us)).to_char(), naive::current_viseme(value, seconds));
        }
    }

    let mut random = Random::new(DEFAULT_SEED, 0);
    let picks: Vec<usize> = (0..4096).map(|_| random.between(0, CLIPS - 1)).collect();
    let mut next = picks.iter().cycle();
    let mut pick = move || *next.next().expect("an endless iterator");
    let ids: Vec<ClipId> = files.iter().map(|(key, _)| ClipId::from_key(key)).collect();

    let mut group = criterion.benchmark_group("reader");
    group.bench_function("find, by id", |bencher| bencher.iter(|| bank.clip(ids[pick()]).map(|clip| clip.slot())));
    follow_links(&mut group, &bank, &ids, &files);
    let (patch, addition) = layers::over(&bytes, CLIPS).expect("two layers");
    let mut places = [DialogueFile::ABSENT; 3];
    let stack = Dialogue::open(&mut places, [&bytes, &patch, &addition].map(Vec::as_slice)).expect("patches that fit");
    group.bench_function("find in a stack of three, by id", |bencher| {
        bencher.iter(|| stack.clip(ids[pick()]).map(|clip| clip.slot()));
    });
    group.bench_function("find, by key", |bencher| {
        bencher.iter(|| bank.clip_by_key(&files[pick()].0).map(|clip| clip.slot()));
    });
    group
        .bench_function("find, by key (serde_json)", |bencher| bencher.iter(|| rival.clip(&files[pick()].0).is_some()));
    group.bench_function("find, missing id", |bencher| {
        bencher.iter(|| bank.clip(ClipId::from_u64(ids[pick()].get() ^ 1)).is_some());
    });
    let mut time = Random::new(DEFAULT_SEED, 1);
    group.bench_function("viseme at a time", |bencher| {
        bencher.iter(|| clips[pick()].0.viseme_at(Micros(time.between(0, 3_000_000) as i64)));
    });
    group.bench_function("viseme at a time (specification)", |bencher| {
        bencher.iter(|| naive::current_viseme(clips[pick()].1, time.between(0, 3_000_000) as f64 / 1e6));
    });
    group.bench_function("segment and text at a time", |bencher| {
        bencher.iter(|| {
            let segment = clips[pick()].0.segment_at(Micros(time.between(0, 1_000_000) as i64));
            segment.and_then(|segment| segment.text(locale)).map(|text| text.len())
        });
    });
    group.bench_function("segment and text at a time (specification)", |bencher| {
        bencher.iter(|| {
            naive::current_text(clips[pick()].1, "de-de", time.between(0, 1_000_000) as f64 / 1e6).map(str::len)
        });
    });
    let (clip, value) = clips[pick()];
    let mut now = 0;
    let mut tick = move || {
        now = (now + TICK_US) % 6_000_000;
        now
    };
    group.bench_function("60 Hz tick", |bencher| bencher.iter(|| clip.viseme_at(Micros(tick()))));
    group.bench_function("60 Hz tick (specification)", |bencher| {
        bencher.iter(|| naive::current_viseme(value, tick() as f64 / 1e6));
    });
    group.bench_function("open", |bencher| bencher.iter(|| Bank::open(black_box(&bytes)).is_ok()));
    group.finish();
}

/// Lines with seven curves, one of which has a key in each frame.
fn curves_and_faces(criterion: &mut Criterion) {
    let bytes = faces::bank(DEFAULT_SEED, 100).expect("lines without errors");
    let bank = Bank::open(&bytes).and_then(Bank::verify).expect("a bank without fault");
    let (clips, profile) = (bank.clips().collect::<Vec<_>>(), bank.default_face_profile());
    let jaws: Vec<_> = clips.iter().map(|clip| clip.curve("jawOpen").expect("a jaw")).collect();
    let mut random = Random::new(DEFAULT_SEED, 0);
    let mut drawn = move || (random.between(0, 99), Micros(random.between(0, 12_000_000) as i64));
    let mut group = criterion.benchmark_group("faces");
    group.bench_function("a curve at a time", |bencher| {
        bencher.iter(|| {
            let (at, time) = drawn();
            jaws[at].value_at(time)
        });
    });
    let (mut cursor, mut now) = (CurveCursor::new(), 0);
    group.bench_function("60 Hz tick of a curve", |bencher| {
        bencher.iter(|| {
            now = (now + TICK_US) % 12_000_000;
            cursor.value_at(&jaws[0], Micros(now))
        });
    });
    group.bench_function("emotions at a time", |bencher| {
        bencher.iter(|| {
            let (at, time) = drawn();
            clips[at].emotions_at(time, Who::Speaker)
        });
    });
    group.bench_function("the face at a time", |bencher| {
        bencher.iter(|| {
            let (at, time) = drawn();
            clips[at].face_at(time, Who::Speaker, &profile, LookAt::AHEAD)
        });
    });
    group.finish();
}

/// Lines of which every second one has phones, and a rig with 35 weights.
fn articulation(criterion: &mut Criterion) {
    let bytes = mouths::bank(DEFAULT_SEED, 100).expect("lines without errors");
    let bank = Bank::open(&bytes).and_then(Bank::verify).expect("a bank without fault");
    let (profile, rig) = (bank.default_articulation(), bank.rig(RIG).expect("a rig"));
    let mut random = Random::new(DEFAULT_SEED, 0);
    let mut drawn = move || (random.between(0, 49), Micros(random.between(0, 12_000_000) as i64));
    let mut group = criterion.benchmark_group("mouths");
    for (name, has_phones) in [("articulation at a time", true), ("articulation from visemes", false)] {
        let clips: Vec<_> = bank.clips().filter(|clip| clip.phones().is_empty() != has_phones).collect();
        group.bench_function(name, |bencher| {
            bencher.iter(|| {
                let (at, time) = drawn();
                clips[at].articulation_at(time, &profile)
            });
        });
    }
    let mouth = bank.clips().next().expect("a clip").articulation_at(Micros(6_000_000), &profile);
    let mut weights = [CurveValue::default(); 64];
    group.bench_function("weights of a rig", |bencher| {
        bencher.iter(|| rig.weights(black_box(&mouth), &Emotions::default(), &Face::default(), &mut weights));
    });
    group.finish();
}

fn whole_bank(criterion: &mut Criterion) {
    let files = files(CLIPS, LOCALES);
    let bytes = bank(&files);
    let mut group = criterion.benchmark_group("whole bank");
    group.throughput(Throughput::Bytes(bytes.len() as u64)).sample_size(20);
    group.bench_function("verify", |bencher| {
        bencher.iter(|| Bank::open(black_box(&bytes)).and_then(Bank::verify).is_ok());
    });
    group.bench_function("parse (serde_json)", |bencher| {
        let parse = |()| naive::Naive::parse(files.iter().map(|(key, json)| (key.as_str(), json.as_str()))).is_ok();
        bencher.iter_batched(|| (), parse, BatchSize::PerIteration);
    });
    group.finish();
}

criterion_group!(benches, queries, curves_and_faces, articulation, whole_bank);
criterion_main!(benches);
