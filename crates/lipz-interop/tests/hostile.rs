//! No changed or damaged file makes an importer panic, and the results are consistent.
#![allow(clippy::unwrap_used, clippy::indexing_slicing, reason = "tests")]

mod support;

use lipz_diagnostics::Severity;
use lipz_file::text::segment_count;
use lipz_interop::{Format, ImportOptions, MergeOptions, Segments, import};
use support::every_fixture;

/// The number of changed files per fixture.
const MUTATIONS: u64 = 1500;

/// A changed length can make a Fallout file hours long, which takes long to convert. One in this many may be long; the
/// others have so many units per second that they are short.
const ONE_IN: u64 = 9;
const SHORT_UNITS_PER_SECOND: u32 = 1_000_000;

/// The most frames of clips that are also merged. Longer ones behave the same, but take more time.
const MERGED_FRAMES: usize = 10_000;

fn options(segments: Segments) -> ImportOptions<'static> {
    ImportOptions::new().segments(segments).locale("en-us").min_hold(2)
}

/// Imports the bytes and checks the result.
fn check(format: &Format, bytes: &[u8], options: &ImportOptions<'_>) {
    let line = br#"{ "visemes": "--MA|EO", "text_en-us": "One two.|Three.", "events": "a|b", "note": 1 }"#;
    let line = lipz_file::parse(line).document.unwrap();
    let imported = import(format, bytes, options);
    let has_errors = imported.diagnostics.iter().any(|diagnostic| diagnostic.severity == Severity::Error);
    assert!(!has_errors || imported.clips.is_empty(), "{}", format.name);
    for clip in imported.clips {
        let visemes = clip.document.string("visemes").unwrap();
        assert_eq!(visemes.bytes().filter(|byte| *byte != b'|').count(), clip.frames);
        for element in &clip.document.elements {
            if element.name.text.starts_with("text_en") {
                let text = clip.document.string(&element.name.text).unwrap();
                assert_eq!(segment_count(text), segment_count(visemes), "{}: {text}", format.name);
            }
        }
        if clip.frames < MERGED_FRAMES {
            let merged = clip.merge(&line, &MergeOptions::new());
            let visemes = merged.document.string("visemes").unwrap();
            assert_eq!(visemes.bytes().filter(|byte| *byte != b'|').count(), clip.frames);
            assert_eq!(segment_count(visemes), 2, "{}: {visemes}", format.name);
            assert_eq!(merged.document.string("text_en-us"), line.string("text_en-us"));
        }
        let written = lipz_file::write(&clip.document);
        assert!(lipz_file::parse(written.as_bytes()).document.is_some(), "{}: {written}", format.name);
    }
    for diagnostic in &imported.diagnostics {
        for label in diagnostic.primary.iter().chain(&diagnostic.labels) {
            assert!(label.span.start <= label.span.end && label.span.end as usize <= bytes.len() + 3, "{diagnostic:?}");
        }
    }
}

#[test]
fn truncation_at_every_byte() {
    for (format, _, bytes) in every_fixture() {
        for length in 0..=bytes.len() {
            check(format, &bytes[..length], &options(Segments::Pauses));
        }
    }
}

#[test]
fn random_changes() {
    // The same on every machine: a linear congruential generator (Knuth, MMIX).
    let mut state: u64 = 1;
    let mut random = move |below: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(state >> 33).unwrap() % below.max(1)
    };
    let pieces: [&[u8]; 10] =
        [b"\"", b"999999999999999999999", b"-1", b"\n", b"|", b"{", b"\xFF", b"1e308", b"\0", b","];
    for (format, _, bytes) in every_fixture() {
        for round in 0..MUTATIONS {
            let mut changed = bytes.clone();
            for _ in 0..=random(4) {
                let at = random(changed.len());
                match random(4) {
                    0 if !changed.is_empty() => changed[at] = u8::try_from(random(256)).unwrap(),
                    1 => drop(changed.drain(at..(at + random(8)).min(changed.len()))),
                    2 => drop(changed.splice(at..at, pieces[random(pieces.len())].iter().copied())),
                    _ => {
                        let end = (at + random(40)).min(changed.len());
                        changed.extend_from_within(at..end);
                    }
                }
            }
            let segments = [Segments::Phrases, Segments::Pauses, Segments::Sentences, Segments::None];
            let options = options(segments[usize::try_from(round % 4).unwrap()]);
            let units_per_second = (round % ONE_IN != 0).then_some(SHORT_UNITS_PER_SECOND);
            check(format, &changed, &options.units_per_second(units_per_second));
        }
    }
}
