//! The round trips documented in docs/guides/other-tools.md.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use lipz_file::Document;
use lipz_file::rate::Rate;
use lipz_interop::{ExportOptions, Format, ImportOptions, Map, export, find_map, formats, import};
use lipz_types::VisemeType;
use proptest::prelude::*;
use support::fixtures;

const RATES: [&str; 6] = ["24", "25", "29.97", "30", "50", "60"];

fn clip(viseme_type: VisemeType, fps: &str, visemes: &str) -> String {
    format!("{{\"fps\": {fps}, \"viseme_type\": \"{viseme_type}\", \"visemes\": \"{visemes}\"}}")
}

/// Returns the codes after writing and reading.
fn there_and_back(format: &Format, map: &Map, fps: &str, visemes: &str) -> String {
    let text = clip(map.viseme_type, fps, visemes);
    let document: Document<'_> = lipz_file::parse(text.as_bytes()).document.unwrap();
    let exported = export(format, &document, &ExportOptions::new().map(map));
    let rate: Option<Rate> = lipz_file::rate::parse(fps);
    let options = ImportOptions::new().map(map).rate(rate).file_rate(rate);
    let imported = import(format, &exported.bytes.unwrap(), &options);
    assert!(imported.diagnostics.is_empty(), "{:?}", imported.diagnostics);
    imported.clips.first().unwrap().document.string("visemes").unwrap().to_owned()
}

/// Replaces codes that share a symbol with the code for which the symbol stands.
fn as_read(map: &Map, visemes: &str) -> String {
    let read = |code: u8| map.symbol(code).and_then(|symbol| map.code(symbol)).unwrap();
    visemes.bytes().map(|code| char::from(read(code))).collect()
}

proptest! {
    #[test]
    fn codes_come_back_from_every_format_that_is_written(visemes in "[-AMOSWEFLU]{1,60}", fps in prop::sample::select(&RATES)) {
        for format in formats::ALL.iter().filter(|format| format.write.is_some()) {
            // Pamela has 24 frames per second.
            let fps = if format.name == "pamela" { "24" } else { fps };
            let map = find_map(format.maps.first().unwrap()).unwrap();
            prop_assert_eq!(there_and_back(format, map, fps, &visemes), as_read(map, &visemes), "{}", format.name);
        }
    }

    #[test]
    fn mohos_names_lose_no_code(visemes in "[-AMOSWEFLU]{1,60}", fps in prop::sample::select(&RATES)) {
        let map = find_map("papagayo").unwrap();
        prop_assert_eq!(there_and_back(formats::find("moho").unwrap(), map, fps, &visemes), visemes);
    }
}

/// Reads a file and writes it again, at Rhubarb's own rate or the rate of the fixture.
fn file_again(format: &str, fps: &str) -> (Vec<u8>, Vec<u8>) {
    let format = formats::find(format).unwrap();
    let bytes = std::fs::read(fixtures(format).first().unwrap()).unwrap();
    let rate = lipz_file::rate::parse(fps);
    let imported = import(format, &bytes, &ImportOptions::new().rate(rate));
    let document = &imported.clips.first().unwrap().document;
    (export(format, document, &ExportOptions::default()).bytes.unwrap(), bytes)
}

#[test]
fn files_come_back_byte_by_byte() {
    for (format, fps) in [("rhubarb-tsv", "100"), ("moho", "24")] {
        let (written, read) = file_again(format, fps);
        assert_eq!(String::from_utf8_lossy(&written), String::from_utf8_lossy(&read), "{format}");
    }
    // The audio file is not part of a clip.
    let (written, read) = file_again("rhubarb-json", "100");
    let read = String::from_utf8(read).unwrap().replace("C:\\\\voices\\\\mayor.wav", "");
    assert_eq!(String::from_utf8(written).unwrap(), read);
}
