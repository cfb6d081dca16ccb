//! What a file may take in memory: its texts, not what a sheet is unpacked to, nor what its keys and columns multiply.
#![cfg(feature = "xlsx")]
#![allow(clippy::unwrap_used, reason = "tests")]

use cap::Cap;
use lipz_texts::{Format, Incoming, ReadOptions, read};
use std::alloc::System;
use std::io::{Cursor, Write};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, usize::MAX);

/// Reads a file with so many bytes of memory. If it wants more, the allocation fails, and the test with it.
fn within(bytes: usize, format: Format, file: &[u8]) -> Incoming {
    ALLOCATOR.set_limit(ALLOCATOR.allocated() + bytes).unwrap();
    let incoming = read(format, file, &ReadOptions::new("en-us"));
    ALLOCATOR.set_limit(usize::MAX).unwrap();
    incoming
}

/// A spreadsheet whose sheet has this between its rows with texts.
fn sheet(between: &str) -> Vec<u8> {
    let row = |texts: [&str; 3]| {
        let cells = texts.map(|text| format!("<c t=\"inlineStr\"><is><t>{text}</t></is></c>")).concat();
        format!("<row>{cells}</row>")
    };
    let (head, first, last) = (row(["key", "en-us", "de-de"]), row(["a", "Hi.", "Hallo."]), row(["b", "Bye.", "Ade."]));
    let sheet = format!("<worksheet>{head}{first}{between}{last}</worksheet>");
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    archive.start_file("xl/worksheets/sheet1.xml", SimpleFileOptions::default()).unwrap();
    archive.write_all(sheet.as_bytes()).unwrap();
    archive.finish().unwrap().into_inner()
}

#[test]
fn memory_is_that_of_the_texts() {
    // Twenty megabytes of a sheet.
    for between in [
        "<mergeCell ref=\"A1:B2\"/>".repeat(800_000),
        format!("<row><c><v></v><x>{}</x></c></row>", "<y z=\"1\">t</y>".repeat(300)).repeat(3_000),
        "<!-- a comment -->".repeat(1_100_000),
    ] {
        let file = sheet(&between);
        drop(between);
        let incoming = within(1 << 20, Format::Xlsx, &file);
        assert_eq!(incoming.diagnostics, []);
        let texts: Vec<&str> = incoming.entries.iter().map(|entry| entry.text.text.as_str()).collect();
        assert_eq!(texts, ["Hallo.", "Ade."]);
    }

    // A key and a source text of a megabyte each, and five thousand columns of translations.
    let letter = |number: usize, place: u32| char::from(b"abcdefghijklmnopqrst"[number / 20_usize.pow(place) % 20]);
    let tag = |number| format!("{}{}-{}a", letter(number, 2), letter(number, 1), letter(number, 0));
    let locales: Vec<String> = (0..5_000).map(tag).collect();
    let long = "x".repeat(1 << 20);
    let table = format!("key,en-us,{}\n{long},{long}{}\n", locales.join(","), ",y".repeat(locales.len()));
    let incoming = within(16 << 20, Format::Csv, table.as_bytes());
    assert_eq!((incoming.diagnostics.first(), incoming.entries.len()), (None, locales.len()));
}
