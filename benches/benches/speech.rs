//! Lip sync: the time per second of audio. Criterion's "elements per second" are milliseconds of audio per second:
//! 40,000 are 40 times real time.

#![allow(missing_docs, clippy::unwrap_used, reason = "a bench")]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use lipz_speech::{AlignOptions, Aligner, Language, Model, Pronouncer, RenderRules, RmsRules, Sound, render, rms};
use lipz_types::{Fps, VisemeType};
use std::hint::black_box;

const BOBBY: &[u8] = include_bytes!("../../fixtures/speech/bobby.wav");
const FILM: Fps = Fps::whole(24);

fn speech(criterion: &mut Criterion) {
    let sound = Sound::from_bytes(BOBBY, Some("wav")).unwrap();
    let script = Pronouncer::new(Language::ENGLISH).script("Bobby ripped the ledger.");
    let aligner = Aligner::new(Model::english(), AlignOptions::default());
    let alignment = aligner.align(&sound, &script);
    let mut group = criterion.benchmark_group("speech");
    group.throughput(Throughput::Elements(sound.duration_us() / 1_000));
    group.bench_function("read", |bencher| bencher.iter(|| Sound::from_bytes(black_box(BOBBY), None).unwrap()));
    group.bench_function("align", |bencher| bencher.iter(|| aligner.align(black_box(&sound), &script)));
    group.bench_function("listen", |bencher| bencher.iter(|| aligner.listen(black_box(&sound))));
    group.bench_function("render", |bencher| {
        bencher.iter(|| render(black_box(&alignment), FILM, VisemeType::Blair, &RenderRules::default()));
    });
    group.bench_function("rms", |bencher| bencher.iter(|| rms(black_box(&sound), FILM, &RmsRules::default())));
    group.finish();
}

criterion_group!(benches, speech);
criterion_main!(benches);
