//! Round trips of exchange files: unchanged texts stay, and a change in the file changes exactly that text, byte for
//! byte.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

use lipz_file::literal;
use lipz_texts::{
    Collect, Division, Entry, Exchange, Format, Merge, MergedFile, ReadOptions, Shape, WriteOptions, read, write,
};
use proptest::prelude::*;
#[cfg(feature = "xlsx")]
use std::io::{Cursor, Read, Write};

/// A word that occurs in no other text.
const TOKEN: &str = "qqq";

/// Returns all ways to write a file.
fn ways() -> Vec<(Format, WriteOptions)> {
    let mut ways = Vec::new();
    for division in [Division::Clip, Division::Segment] {
        let options = WriteOptions::new().division(division);
        for &format in Format::ALL {
            ways.push((format, options.clone()));
        }
        for shape in Shape::ALL {
            ways.push((Format::Csv, options.clone().shape(shape)));
            ways.push((Format::Csv, options.clone().shape(shape).raw_cells(true)));
        }
    }
    ways
}

fn exchange(file: &str) -> Option<Exchange> {
    let document = lipz_file::parse(file.as_bytes()).document.unwrap();
    let unit = Collect::new("en-us", ["de-de", "fr-fr"]).unit("act 1/mayor", &document, &mut Vec::new())?;
    let locales = vec!["de-de".into(), "fr-fr".into()];
    Some(Exchange { source_locale: "en-us".into(), locales, units: vec![unit] })
}

fn entries(format: Format, bytes: &[u8]) -> Vec<Entry> {
    let incoming = read(format, bytes, &ReadOptions::new("en-us"));
    assert_eq!(incoming.diagnostics, [], "{}", incoming.text);
    incoming.entries
}

fn merged(file: &str, entries: &[Entry]) -> MergedFile {
    let document = lipz_file::parse(file.as_bytes()).document.unwrap();
    Merge::new("en-us").merge(file, &document, &entries.iter().collect::<Vec<_>>())
}

/// Returns the file with the unique word replaced; `None` if it is not in the file.
fn with_another_word(format: Format, file: &[u8]) -> Option<Vec<u8>> {
    #[cfg(feature = "xlsx")]
    if format == Format::Xlsx {
        return spreadsheet_with_another_word(file);
    }
    let text = str::from_utf8(file).unwrap_or_else(|_| panic!("{format:?} is UTF-8"));
    text.contains(TOKEN).then(|| text.replace(TOKEN, "zzz").into_bytes())
}

/// Returns the same for a spreadsheet, whose parts are compressed.
#[cfg(feature = "xlsx")]
fn spreadsheet_with_another_word(file: &[u8]) -> Option<Vec<u8>> {
    let mut archive = zip::ZipArchive::new(Cursor::new(file)).unwrap();
    let mut edited = zip::ZipWriter::new(Cursor::new(Vec::new()));
    let mut is_there = false;
    for number in 0..archive.len() {
        let mut part = archive.by_index(number).unwrap();
        let mut text = String::new();
        part.read_to_string(&mut text).unwrap();
        is_there |= text.contains(TOKEN);
        edited.start_file(part.name().unwrap(), zip::write::SimpleFileOptions::default()).unwrap();
        edited.write_all(text.replace(TOKEN, "zzz").as_bytes()).unwrap();
    }
    is_there.then(|| edited.finish().unwrap().into_inner())
}

/// Returns a text of three segments, with characters that formats must escape.
fn text() -> impl Strategy<Value = Vec<String>> {
    let segment = prop_oneof![
        4 => "[a-z \"\\\\\n\r\u{7}\t,;'=@+<>&#é灯-]{0,9}",
        1 => "[a-z]{0,3}\\{[a-z]{1,3}\\}[a-z ]{0,3}",
        1 => Just(String::new()),
    ];
    proptest::collection::vec(segment, 3)
}

/// Returns the text as an element of a file, with the spaces and escapes of different authors.
fn element(name: &str, segments: &[String], blanks: usize, escapes: bool) -> String {
    let blanks = " ".repeat(blanks);
    let text = segments.iter().map(|segment| format!("{segment}{blanks}")).collect::<Vec<_>>().join("|");
    let literal = literal(&text);
    let literal = if escapes { literal.replace('é', "\\u00e9").replace('<', "\\u003c") } else { literal };
    format!("\"{name}\" :\t{literal}")
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 64, ..ProptestConfig::default() })]

    #[test]
    fn what_nobody_changed_stays(
        texts in proptest::collection::vec(text(), 3),
        blanks in 0..3_usize,
        escapes: bool,
        has_french: bool,
        edited in 0..3_usize,
    ) {
        let (english, mut german) = (&texts[0], texts[1].clone());
        german[edited] = TOKEN.to_owned();
        let mut elements = vec![
            "\"note\": [1,  2]".to_owned(),
            "\"visemes\": \"MA|EO|MA\"".to_owned(),
            element("text_en-us", english, blanks, escapes),
            element("text-de_DE", &german, blanks, escapes),
        ];
        elements.extend(has_french.then(|| element("text_fr-fr", &texts[2], 0, false)));
        let file = format!("{{ {}\n}}\n", elements.join(" ,\n   "));
        let Some(exchange) = exchange(&file) else { return Ok(()) };
        for (format, options) in ways() {
            for written in write(format, &exchange, &options).files {
                let same = merged(&file, &entries(format, &written.bytes));
                prop_assert_eq!(&same.text, &None, "{:?} {:?}", options, same);
                prop_assert_eq!(same.found.len(), 0);

                // A segment without a source is not exported alone; a translation with fewer placeholders is reported.
                let edited = with_another_word(format, &written.bytes);
                let changed = merged(&file, &entries(format, edited.as_deref().unwrap_or(&written.bytes)));
                prop_assert!(changed.found.iter().all(|(_, found)| !found.is_error()), "{:?}", changed);
                let expected = edited.map(|_| file.replace(TOKEN, "zzz"));
                prop_assert_eq!(changed.text, expected, "{:?} {:?} {}", format, options, file);
            }
        }
    }

    /// Readers accept arbitrary bytes, and positions are inside the text to which they refer.
    #[test]
    fn readers_take_any_bytes(
        cut in 0..2_000_usize,
        noise in proptest::collection::vec((0..2_000_usize, any::<u8>()), 0..6),
    ) {
        let file = r#"{ "visemes": "MA|E", "text_en-us": "a \"x\"|{b}", "text_de-de": "ä\n|{b}" }"#;
        let exchange = exchange(file).unwrap();
        for (format, options) in ways() {
            for written in write(format, &exchange, &options).files {
                let mut bytes = written.bytes;
                for (at, byte) in &noise {
                    let at = at % bytes.len();
                    bytes[at] = *byte;
                }
                bytes.truncate(cut.max(1));
                let incoming = read(format, &bytes, &ReadOptions::new("en-us"));
                for diagnostic in &incoming.diagnostics {
                    let span = diagnostic.primary.as_ref().map_or(0..0, |label| label.span.range());
                    prop_assert!(incoming.text.get(span).is_some(), "{:?}", diagnostic);
                }
                for entry in &incoming.entries {
                    prop_assert!(incoming.text.get(entry.text.span.range()).is_some(), "{:?}", entry);
                    prop_assert!(incoming.text.get(entry.key.span.range()).is_some(), "{:?}", entry);
                }
                merged(file, &incoming.entries);
            }
        }
    }
}

#[test]
fn a_new_locale_gets_a_text() {
    let file = "{\n  \"visemes\" :    \"MA|EO\",\n  \"text_en-us\" : \"Hi|You\",\n  \"fps\" :        24\n}\n";
    let exchange = exchange(file).unwrap();
    for (format, options) in ways() {
        let written = write(format, &exchange, &options).files.remove(0);
        let mut entries = entries(format, &written.bytes);
        entries.retain(|entry| &*entry.locale == "de-de");
        for entry in &mut entries {
            entry.text.text = match entry.segment {
                Some(1) => "Hallo",
                Some(_) => "du",
                None => "Hallo | du",
            }
            .into();
            entry.state = lipz_texts::State::Translated;
        }
        let expected = "{\n  \"visemes\" :    \"MA   |EO\",\n".replace("MA   ", "MA")
            + "  \"text_en-us\" : \"Hi   |You\",\n  \"text_de-de\" : \"Hallo|du\",\n  \"fps\" :        24\n}\n";
        assert_eq!(merged(file, &entries).text.as_deref(), Some(expected.as_str()), "{options:?}");
    }
}
