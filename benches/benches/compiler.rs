//! Parsing and packing in memory, compared with serde_json on the same files.
#![allow(
    missing_docs,
    clippy::expect_used,
    reason = "a bench program: criterion's macros, and a stop at the first surprise"
)]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use lipz_benches::files;
use lipz_compiler::{Compiler, Input, Options};
use std::hint::black_box;

const CLIPS: usize = 2000;
const LOCALES: usize = 5;

fn packing(criterion: &mut Criterion) {
    let files = files(CLIPS, LOCALES);
    let inputs: Vec<Input> = files.iter().map(|(key, json)| Input::from_bytes(key, json.as_bytes())).collect();
    let options = Options::new().threads(1);
    let mut group = criterion.benchmark_group("one thread");
    group.throughput(Throughput::Bytes(files.iter().map(|(_, json)| json.len() as u64).sum())).sample_size(20);
    group.bench_function("parse (serde_json::Value)", |bencher| {
        bencher
            .iter(|| files.iter().filter(|(_, json)| serde_json::from_str::<serde_json::Value>(json).is_ok()).count());
    });
    group.bench_function("parse", |bencher| {
        bencher.iter(|| files.iter().filter(|(_, json)| lipz_file::parse(json.as_bytes()).document.is_some()).count());
    });
    group.bench_function("check", |bencher| {
        bencher.iter(|| Compiler::new(options.clone()).check(black_box(&inputs)).reports.len());
    });
    group.bench_function("compile", |bencher| {
        bencher.iter(|| Compiler::new(options.clone()).compile(black_box(&inputs)).bank.expect("a bank").len());
    });
    group.finish();
}

criterion_group!(benches, packing);
criterion_main!(benches);
