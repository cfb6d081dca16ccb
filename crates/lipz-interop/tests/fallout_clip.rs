//! LIP files as clips: import, losses, and round trips.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

use lipz_diagnostics::{Code, Diagnostic};
use lipz_file::rate::parse as rate;
use lipz_interop::fallout::lip::{Lip, Marker};
use lipz_interop::{
    ExportOptions, Format, ImportOptions, ImportResult, Map, Time, Track, export, find_map, formats, import,
};
use proptest::prelude::*;
use std::fs;
use std::path::Path;

fn format() -> &'static Format {
    formats::find("fallout").unwrap()
}

fn map() -> &'static Map {
    find_map("fallout").unwrap()
}

fn fixture(name: &str) -> Vec<u8> {
    fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/interop/fallout").join(name)).unwrap()
}

fn visemes(imported: &ImportResult) -> &str {
    imported.clips.first().unwrap().document.string("visemes").unwrap()
}

fn codes(diagnostics: &[Diagnostic]) -> Vec<Code> {
    diagnostics.iter().map(|diagnostic| diagnostic.code).collect()
}

#[test]
fn phonemes_become_the_mouths_of_the_heads() {
    let options = ImportOptions::new().name("eld_1");
    let imported = import(format(), &fixture("eld_1.lip"), &options);
    assert_eq!(visemes(&imported), "--SSEELLOOOOMMEEEEE");
    assert_eq!(codes(&imported.diagnostics), []);
    assert_eq!(imported.clips[0].map, "fallout 1");
}

#[test]
fn the_table_has_all_phonemes() {
    let symbols: Vec<String> = map().symbols().map(|(symbol, _)| symbol.to_owned()).collect();
    let all: Vec<String> = (0..=0x29).map(|code| format!("0x{code:02X}")).collect();
    assert_eq!(symbols, all);
    // Each of the nine mouth shapes survives a round trip; U becomes W.
    for code in "-ASEFLMOW".bytes() {
        assert_eq!(map().symbol(code).and_then(|symbol| map().code(symbol)), Some(code));
    }
    assert_eq!(map().symbol(b'U').and_then(|symbol| map().code(symbol)), Some(b'W'));
}

#[test]
fn phonemes_between_frames_are_told() {
    let options = ImportOptions::new().rate(rate("5"));
    let imported = import(format(), &fixture("eld_2.lip"), &options);
    assert_eq!(visemes(&imported), "-LME");
    assert_eq!(codes(&imported.diagnostics), [Code::ShapesLost]);
    let lost: Vec<&str> = imported.clips[0].lost.iter().map(|lost| lost.symbol.as_str()).collect();
    assert_eq!(lost, ["0x1F", "0x04", "0x08"], "{:?}", imported.diagnostics);
}

#[test]
fn the_unit_is_named_or_told_by_the_sound() {
    let bytes = fixture("eld_2.lip");
    let frames = |units_per_second: Option<u32>, sound_length: Option<Time>| {
        let imported = import(
            format(),
            &bytes,
            &ImportOptions::new().units_per_second(units_per_second).sound_length(sound_length),
        );
        (imported.clips[0].frames, codes(&imported.diagnostics))
    };
    assert_eq!(frames(None, None), (19, vec![]));
    assert_eq!(frames(Some(88_200), None).0, 10);
    assert_eq!(frames(Some(88_200), Some(Time::new(8, 10))).0, 10, "what is named counts");
    assert_eq!(frames(None, Some(Time::new(8, 10))), (19, vec![]));
    assert_eq!(frames(None, Some(Time::new(4, 10))).0, 10);
    assert_eq!(frames(None, Some(Time::new(3, 1))), (19, vec![Code::LipTimeBase]));
}

#[test]
fn markers_that_run_backwards_wait_for_those_before_them() {
    let markers = [0, 22_050, 11_025, 33_075, 44_100].map(|position| Marker { kind: 1, position });
    let lip = Lip::new(*b"ELD_1\0\0\0", vec![0x06, 0x20, 0x04, 0x08], markers.to_vec());
    let imported = import(format(), &lip.write(), &ImportOptions::default());
    assert_eq!(visemes(&imported), "AAAAAAAAAAAAEEEEEEOOOOOO");
    assert_eq!(codes(&imported.diagnostics), [Code::LipMarkerOrder, Code::ShapesLost]);
}

#[test]
fn files_without_markers_or_phonemes_rest() {
    let marker = |position| Marker { kind: 1, position };
    let silent = Lip::new(*b"ELD_1\0\0\0", Vec::new(), vec![marker(0), marker(44_100)]);
    let imported = import(format(), &silent.write(), &ImportOptions::default());
    assert_eq!(visemes(&imported), "-".repeat(24));
    assert_eq!(codes(&imported.diagnostics), [Code::LipCounts]);
    let nothing = import(format(), &Lip::new([0; 8], Vec::new(), Vec::new()).write(), &ImportOptions::default());
    assert_eq!(codes(&nothing.diagnostics), [Code::LipCounts, Code::NoShapes]);
}

#[test]
fn a_file_cut_anywhere_gives_no_clip() {
    let bytes = fixture("eld_1.lip");
    for length in 0..bytes.len() {
        let imported = import(format(), &bytes[..length], &ImportOptions::default());
        assert_eq!((imported.clips.len(), codes(&imported.diagnostics)), (0, vec![Code::LipCutOff]), "{length}");
    }
}

/// Returns the LIP file of a clip.
fn exported(visemes: &str, fps: &str) -> Vec<u8> {
    let file = format!("{{ \"viseme_type\": \"blair\", \"visemes\": \"{visemes}\", \"fps\": {fps} }}");
    let document = lipz_file::parse(file.as_bytes()).document.unwrap();
    let exported = export(format(), &document, &ExportOptions::new().name("mayor"));
    // Few shapes produce few markers, which is reported.
    assert!(exported.diagnostics.iter().all(|diagnostic| diagnostic.code == Code::LipFewMarkers));
    exported.bytes.unwrap()
}

#[test]
fn exported_files_are_as_the_games() {
    let lip = Lip::read(&exported("--MMAA--EE|SS", "24")).unwrap();
    assert_eq!(lip.oddities("MAYOR"), []);
    assert_eq!(lip.phonemes, [0x00, 0x20, 0x06, 0x00, 0x04, 0x1B]);
    let markers: Vec<_> = lip.markers.iter().map(|marker| (marker.kind, marker.position)).collect();
    assert_eq!(markers, [(1, 0), (1, 3676), (0, 7350), (1, 11_026), (1, 14_700), (1, 18_376), (1, 22_050)]);
}

#[test]
fn names_that_do_not_fit_are_refused() {
    for name in ["", "mara-good-evening", "él", "a.b", "a/b", "a b"] {
        let mut diagnostics = Vec::new();
        let mut track = Track::default();
        track.name = Some(name.into());
        assert!(format().write.unwrap()(&track, &mut diagnostics).is_empty());
        assert_eq!(codes(&diagnostics), [Code::LipExportName], "{name}");
    }
}

proptest! {
    #[test]
    fn frames_come_back(visemes in "[-ASEFLMOW]{1,80}", fps in prop::sample::select(vec!["1", "12", "23.976", "24", "29.97", "60", "1000"])) {
        let options = ImportOptions::new().rate(rate(fps)).name("mayor");
        let imported = import(format(), &exported(&visemes, fps), &options);
        prop_assert_eq!(&imported.diagnostics, &[]);
        prop_assert_eq!(imported.clips[0].document.string("visemes"), Some(visemes.as_str()));
    }

    #[test]
    fn damaged_files_are_imported_or_refused(changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6)) {
        let mut bytes = fixture("eld_1.lip");
        for (index, byte) in changes {
            let at = index.index(bytes.len());
            bytes[at] = byte;
        }
        let imported = import(format(), &bytes, &ImportOptions::default());
        prop_assert!(imported.clips.len() == 1 || !imported.diagnostics.is_empty());
    }
}
