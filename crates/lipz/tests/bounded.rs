//! Memory and work are proportional to the size of the input, for any content. docs/inside/performance.md has figures.
//! The tests count bytes and allocations, not seconds.
#![allow(clippy::unwrap_used, reason = "tests")]
#![allow(unsafe_code, reason = "an allocator that counts")]

use lipz_bank::files::DialogueFile;
use lipz_bank::{Dialogue, VisemeType};
use lipz_compiler::diff::diff;
use lipz_compiler::ids::{Language, generate};
use lipz_compiler::inspect::{ClipDetails, Timeline};
use lipz_compiler::stats::Stats;
use lipz_compiler::{Compiler, Documents, Input, Options, SplitBank, coverage};
use lipz_diagnostics::{Report, Severity, render, reports};
use lipz_file::format::{Style, format};
use lipz_interop::subtitles::{SubtitleFormat, SubtitleOptions, cues, join};
use lipz_texts::{Collect, Exchange, Format, IncomingFile, Merge, ReadOptions, TextLints, WriteOptions, texts_of};
use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The system's allocator with counters.
struct Counting;

static NOW_BYTES: AtomicUsize = AtomicUsize::new(0);
static PEAK_BYTES: AtomicUsize = AtomicUsize::new(0);
static ALLOCATIONS: AtomicUsize = AtomicUsize::new(0);

// SAFETY: all calls are passed on unchanged to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.fetch_add(1, Relaxed);
        let now = NOW_BYTES.fetch_add(layout.size(), Relaxed) + layout.size();
        PEAK_BYTES.fetch_max(now, Relaxed);
        // SAFETY: the caller keeps the contract of `alloc`.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        NOW_BYTES.fetch_sub(layout.size(), Relaxed);
        // SAFETY: the caller keeps the contract of `dealloc`.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

/// The counters belong to the process, so that only one test may run at a time.
static ALONE: Mutex<()> = Mutex::new(());

fn alone() -> MutexGuard<'static, ()> {
    ALONE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Returns the peak number of bytes, the number of allocations, and the result of `work`.
fn measured<R>(work: impl FnOnce() -> R) -> (usize, usize, R) {
    let (before, allocations) = (NOW_BYTES.load(Relaxed), ALLOCATIONS.load(Relaxed));
    PEAK_BYTES.store(before, Relaxed);
    let result = work();
    (PEAK_BYTES.load(Relaxed) - before, ALLOCATIONS.load(Relaxed) - allocations, result)
}

/// Returns the file `{…}` with `count` elements or parts of one.
type Shape = fn(usize) -> String;

fn elements(count: usize, element: impl Fn(usize) -> String) -> String {
    format!("{{{}}}", (0..count).map(element).collect::<Vec<_>>().join(","))
}

fn locale(number: usize) -> String {
    let letters = || 'a'..='z';
    let letter = |place: u32| letters().nth(number / 26_usize.pow(place) % 26).unwrap();
    format!("{}{}-{}{}", letter(3), letter(2), letter(1), letter(0))
}

/// Renders reports in one of the formats.
type Render = fn(&[Report]) -> String;

/// Files that repeat something a given number of times, as authors or attackers may write them.
const SHAPES: &[(&str, Shape)] = &[
    ("duplicate elements", |count| elements(count, |number| format!("\"fps\":{}", 1 + number % 1000))),
    ("unknown elements", |count| elements(count, |number| format!("\"x{number}\":1"))),
    ("wrong types", |count| elements(count, |number| format!("\"text_{}\":1", locale(number)))),
    ("locales", |count| elements(count, |number| format!("\"text_{}\":\"x\"", locale(number)))),
    ("segments that differ", |count| {
        elements(count, |number| format!("\"text_{}\":\"{}\"", locale(number), if number == 0 { "a|b" } else { "x" }))
    }),
    ("braces", |count| elements(count, |number| format!("\"text_{}\":\"{{{{}}}}}}\"", locale(number)))),
    ("segments", |count| format!("{{\"visemes\":\"{}\"}}", "M|".repeat(count))),
    ("events", |count| {
        format!(
            "{{\"events\":\"{}\"}}",
            (0..count).map(|number| format!("a{number} does b{number}|")).collect::<String>()
        )
    }),
    ("wrong codes", |count| format!("{{\"visemes\":\"{}\",\"viseme_type\":\"blair\"}}", "Z".repeat(count))),
    ("escapes", |count| format!("{{\"text_en-us\":\"{}\"}}", "\\u007c".repeat(count))),
];

fn run(file: &str) -> Vec<Report> {
    let options = Options::new()
        .threads(1)
        .default_locale("aa-aa")
        .unwrap()
        .levels([(lipz_diagnostics::Code::SegmentCount, Some(Severity::Warning))]);
    Compiler::new(options).compile(&[Input::from_bytes("a", file)]).reports
}

#[test]
fn time_and_memory_are_linear_whatever_is_in_a_file() {
    let _alone = alone();
    for (name, shape) in SHAPES {
        let [small, large] = [3_000, 6_000].map(shape);
        let [(_, few, _), (peak, many, found)] = [&small, &large].map(|file| measured(|| run(file)));
        assert!(many < few * 5 / 2 + 2_000, "{name}: {few} allocations, then {many}");
        // Up to 65,536 diagnostics are collected before they are limited.
        assert!(peak < 40 * large.len() + (24 << 20), "{name}: {peak} bytes of memory for {} of file", large.len());
        let bound = 40 * (lipz_diagnostics::bound::PER_FILE_AND_CODE + 1);
        assert!(found.iter().map(|report| report.diagnostics.len()).sum::<usize>() < bound, "{name}");

        let formats: [(&str, Render); 5] = [
            ("human", render::human),
            ("json", render::json),
            ("sarif", |reports| render::sarif(reports, true)),
            ("github", render::github),
            ("cargo", render::cargo),
        ];
        for (format, render) in formats {
            let (peak, _, text) = measured(|| render(&found));
            assert!(
                peak < (16 << 20) + 12 * large.len(),
                "{name}, {format}: {peak} bytes for a text of {}",
                text.len()
            );
        }
    }
}

/// Calls `each` with the name and the work of each command on a file, and on its bank if there is one.
fn commands(file: &str, mut each: impl FnMut(&'static str, &mut dyn FnMut())) {
    let compiler = Compiler::new(Options::new().threads(1).default_locale("aa-aa").unwrap());
    let inputs = [Input::from_bytes("a", file), Input::from_bytes("b", r#"{"text_aa-aa":"x"}"#)];
    each("fix", &mut || drop(compiler.fix(file.as_bytes())));
    each("fmt", &mut || {
        let document = lipz_file::parse(file.as_bytes()).document;
        drop(document.map(|document| format(&document, Style::default())));
    });
    each("convert", &mut || drop(compiler.convert(file.as_bytes(), VisemeType::ToonBoom)));
    for_translators(file, &mut each);
    each("lints of translations", &mut || {
        let document = lipz_file::parse(file.as_bytes()).document.unwrap_or_default();
        TextLints::new("aa-aa").check("a", &document, &mut Vec::new());
    });
    let mut bank = None;
    each("pack", &mut || bank = compiler.compile(&inputs).bank);
    let Some(bytes) = bank else { return };
    let other = compiler.compile(&inputs[1..]).bank.unwrap();
    let (mut files, mut other_files) = ([DialogueFile::ABSENT], [DialogueFile::ABSENT]);
    let bank = Dialogue::open(&mut files, [bytes.as_slice()]).unwrap();
    let other = Dialogue::open(&mut other_files, [other.as_slice()]).unwrap();
    let locales: Vec<_> = bank.locales().collect();
    let clip = bank.clip_by_key("a").unwrap();
    each("stats", &mut || drop(Stats::from_dialogue(&bank)));
    each("coverage", &mut || drop(coverage(&bank)));
    each("diff", &mut || drop((diff(&bank, &other), diff(&bank, &bank))));
    each("inspect", &mut || {
        let details = ClipDetails::new(&bank, &clip, &locales);
        drop((details, Timeline::default().render(&bank, &clip, &locales)));
    });
    each("ids", &mut || drop(generate(&bank, Language::C, None)));
    each("unpack", &mut || {
        let documents = Documents::from_dialogue(&bank).unwrap();
        documents.iter().for_each(|document| drop(lipz_file::write(&document.unwrap().1)));
    });
    each("split", &mut || drop(SplitBank::from_bytes(&bytes)));
}

/// Calls `each` with the work of `texts` and `subtitles` on a clip.
fn for_translators(file: &str, each: &mut dyn FnMut(&'static str, &mut dyn FnMut())) {
    let Some(document) = lipz_file::parse(file.as_bytes()).document else { return };
    let locales: Vec<String> = texts_of(&document, None).into_keys().filter(|locale| locale != "aa-aa").collect();
    let mut exchange = Exchange { source_locale: "aa-aa".into(), locales: locales.clone(), units: Vec::new() };
    each("texts export", &mut || {
        let unit = Collect::new("aa-aa", &locales).unit("a", &document, &mut Vec::new());
        exchange.units = unit.into_iter().collect();
    });
    let mut incoming = IncomingFile::default();
    each("texts import", &mut || {
        let table = lipz_texts::write(Format::Csv, &exchange, &WriteOptions::new());
        incoming = lipz_texts::read(Format::Csv, &table.files[0].bytes, &ReadOptions::new("aa-aa"));
        let without = lipz_file::parse(br#"{"text_aa-aa":"x"}"#).document.unwrap();
        let entries: Vec<_> = incoming.entries.iter().collect();
        drop(Merge::new("aa-aa").merge(r#"{"text_aa-aa":"x"}"#, &without, &entries));
    });
    each("subtitles", &mut || {
        let options = SubtitleOptions { default_rate: lipz_file::rate::parse("24"), ..SubtitleOptions::default() };
        let cues = cues(&document, "aa-aa", &options, &mut Vec::new()).unwrap_or_default();
        let file = SubtitleFormat::Srt.write(&cues, &mut Vec::new());
        let cues = SubtitleFormat::Srt.read(file.as_bytes(), &mut Vec::new());
        drop(join(document.clone(), &cues, "aa-aa", &SubtitleOptions::default(), &mut Vec::new()));
    });
}

#[test]
fn each_command_is_linear_whatever_is_in_a_file() {
    let _alone = alone();
    let quotes: (&str, Shape) = ("single quotes", |count| elements(count, |number| format!("'x{number}':'y'")));
    for (name, shape) in SHAPES.iter().chain([&quotes]) {
        let [small, large] = [3_000, 6_000].map(shape);
        let mut counts = [Vec::new(), Vec::new()];
        for (file, counts) in [&small, &large].into_iter().zip(&mut counts) {
            commands(file, |command, work| {
                let (peak, allocations, ()) = measured(work);
                counts.push((command, peak, allocations));
            });
        }
        assert!(counts[0].len() == counts[1].len() && counts[0].len() > 3);
        for ((command, _, few), (_, peak, many)) in counts[0].iter().zip(&counts[1]) {
            assert!(*many < few * 5 / 2 + 2_000, "{command}, {name}: {few} allocations, then {many}");
            let most = 100 * large.len() + (24 << 20);
            assert!(*peak < most, "{command}, {name}: {peak} bytes of memory for {} of file", large.len());
        }
    }
}

#[test]
fn the_rest_is_counted_and_counts() {
    let _alone = alone();
    let file = elements(5_000, |number| format!("\"fps\":{}", 1 + number % 1000));
    let found = run(&file);
    assert_eq!(reports::count(&found, Severity::Error), 4_999);
    assert_eq!(found[0].diagnostics.len(), 1_001);
    let json: serde_json::Value = serde_json::from_str(&render::json(&found)).unwrap();
    assert_eq!((&json["errors"], json["diagnostics"].as_array().unwrap().len()), (&4_999.into(), 1_001));
    assert_eq!(json["diagnostics"][1_000]["message"], "3999 more LZ0201 in this file are not shown");
    assert!(
        render::human(&found).ends_with(
            "4,899 more LZ0201 (an element appears twice) in 1 file are not shown\n4,999 errors in 1 file\n"
        )
    );
}
