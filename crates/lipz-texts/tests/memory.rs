//! The memory for reading a file is bounded by its texts, whatever its unpacked size and its numbers of keys and
//! columns.
#![cfg(feature = "xlsx")]
#![allow(clippy::unwrap_used, reason = "tests")]

use cap::Cap;
use lipz_texts::{Format, IncomingFile, ReadOptions, read};
use std::alloc::System;
use std::io::{Cursor, Write};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, usize::MAX);

/// Reads a file with so many bytes of memory. A larger allocation fails, and the test with it.
fn within(bytes: usize, format: Format, file: &[u8]) -> IncomingFile {
    ALLOCATOR.set_limit(ALLOCATOR.allocated() + bytes).unwrap();
    let incoming = read(format, file, &ReadOptions::new("en-us"));
    ALLOCATOR.set_limit(usize::MAX).unwrap();
    incoming
}

/// Returns a row of a sheet with these texts.
fn row(texts: &[&str]) -> String {
    let cells: String = texts.iter().map(|text| format!("<c t=\"inlineStr\"><is><t>{text}</t></is></c>")).collect();
    format!("<row>{cells}</row>")
}

/// Returns a spreadsheet with these rows in its sheet.
fn sheet(rows: &str) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    archive.start_file("xl/worksheets/sheet1.xml", SimpleFileOptions::default()).unwrap();
    archive.write_all(format!("<worksheet>{rows}</worksheet>").as_bytes()).unwrap();
    archive.finish().unwrap().into_inner()
}

/// Returns five thousand locales.
fn locales() -> Vec<String> {
    let letter = |number: usize, place: u32| char::from(b"abcdefghijklmnopqrst"[number / 20_usize.pow(place) % 20]);
    (0..5_000).map(|number| format!("{}{}-{}a", letter(number, 2), letter(number, 1), letter(number, 0))).collect()
}

#[test]
fn memory_is_that_of_the_texts() {
    // In order, because they share the allocator.
    of_a_sheet_with_other_parts();
    of_a_long_key_in_many_locales();
    of_cells_without_texts();
}

fn of_a_sheet_with_other_parts() {
    // Twenty megabytes of a sheet.
    for between in [
        "<mergeCell ref=\"A1:B2\"/>".repeat(800_000),
        format!("<row><c><v></v><x>{}</x></c></row>", "<y z=\"1\">t</y>".repeat(300)).repeat(3_000),
        "<!-- a comment -->".repeat(1_100_000),
    ] {
        let [head, first] = [row(&["key", "en-us", "de-de"]), row(&["a", "Hi.", "Hallo."])];
        let file = sheet(&[head, first, between, row(&["b", "Bye.", "Ade."])].concat());
        let incoming = within(1 << 20, Format::Xlsx, &file);
        assert_eq!(incoming.diagnostics, []);
        let texts: Vec<&str> = incoming.entries.iter().map(|entry| entry.text.text.as_str()).collect();
        assert_eq!(texts, ["Hallo.", "Ade."]);
    }
}

/// A key and a source text of a megabyte each, and five thousand columns of translations.
fn of_a_long_key_in_many_locales() {
    let locales = locales();
    let long = "x".repeat(1 << 20);
    let table = format!("key,en-us,{}\n{long},{long}{}\n", locales.join(","), ",y".repeat(locales.len()));
    let incoming = within(16 << 20, Format::Csv, table.as_bytes());
    assert_eq!((incoming.diagnostics.first(), incoming.entries.len()), (None, locales.len()));
}

/// Each row has one locale, with which its key and source are compared. Entries in all locales would take gigabytes.
fn of_cells_without_texts() {
    let locales = locales();
    let head: Vec<&str> = ["key", "en-us"].into_iter().chain(locales.iter().map(String::as_str)).collect();
    let rows: String = (0..20_000).map(|number| row(&[&format!("k{number}"), "Hi."])).collect();
    let last = locales.iter().map(|_| "").collect::<Vec<_>>().join("<c/>");
    let last = row(&["last", "Hi."]).replace("</row>", &format!("{last}<c t=\"str\"><v>Ho.</v></c></row>"));
    let incoming = within(16 << 20, Format::Xlsx, &sheet(&(row(&head) + &rows + &last)));
    assert_eq!((incoming.diagnostics, incoming.entries.len()), (Vec::new(), 20_001));
    let last = incoming.entries.last().unwrap();
    assert_eq!((last.key.text.as_str(), &*last.locale, last.text.text.as_str()), ("last", &*locales[4_999], "Ho."));

    let commas = ",".repeat(locales.len());
    let rows: String = (0..500).map(|number| format!("k{number},Hi.{commas}\n")).collect();
    let table = format!("{}\n{rows}", head.join(","));
    let incoming = within(16 << 20, Format::Csv, table.as_bytes());
    assert_eq!((incoming.diagnostics, incoming.entries.len()), (Vec::new(), 500));
    assert_eq!(incoming.entries[0].source.as_ref().unwrap().text, "Hi.");
}
