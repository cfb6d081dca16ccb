//! Malicious files: entities, archives that unpack to gigabytes, endless sheets.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_texts::{Format, ReadOptions, read};

/// Returns the diagnostics of reading a file.
fn told(format: Format, bytes: &[u8]) -> String {
    let incoming = read(format, bytes, &ReadOptions::new("en-us"));
    assert_eq!(incoming.entries, []);
    incoming.diagnostics.iter().map(ToString::to_string).collect()
}

#[test]
fn entities_are_refused() {
    let bomb = r#"<?xml version="1.0"?><!DOCTYPE x [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;">]>
        <xliff version="1.2">&b;</xliff>"#;
    assert!(
        told(Format::Xliff, bomb.as_bytes()).contains("lipz does not read a DTD"),
        "{}",
        told(Format::Xliff, bomb.as_bytes())
    );
    let outside = r#"<!DOCTYPE x [<!ENTITY a SYSTEM "file:///etc/passwd">]><xliff version="2.1">&a;</xliff>"#;
    assert!(told(Format::Xliff12, outside.as_bytes()).contains("lipz does not read a DTD"));
    let deep = "<a>".repeat(200_000);
    assert!(told(Format::Xliff, deep.as_bytes()).contains("the file is not XML"));
    assert!(told(Format::Json, "[".repeat(200_000).as_bytes()).contains("LZ1901"));
}

/// The XML parser compares each attribute of a tag with all others, which took minutes for a megabyte.
#[test]
fn tags_with_many_attributes_are_refused() {
    for attribute in ["a", "xmlns:a"] {
        let attributes: String = (0..20_000).map(|number| format!(" {attribute}{number}='x'")).collect();
        for format in [Format::Xliff, Format::Xliff12] {
            let found = told(format, format!("<xliff version='1.2'><file{attributes}/></xliff>").as_bytes());
            assert!(found.contains("a tag has more than 256 attributes"), "{found}");
        }
    }
}

/// Written by tools without support for marked segments. Without a diagnostic, the text would be lost.
#[test]
fn a_text_beside_marked_segments_is_told() {
    let file = |target: &str| {
        format!(
            r#"<xliff version="1.2"><file source-language="en-US" target-language="de-DE"><body><trans-unit id="a">
            <source>One | Two</source><target>{target}</target></trans-unit></body></file></xliff>"#
        )
    };
    let marked = r#"<mrk mtype="seg" mid="1">Eins</mrk> | <mrk mtype="seg" mid="2">Zwei</mrk>"#;
    let beside = told(Format::Xliff12, file(&format!("Eins | Zwo{marked}")).as_bytes());
    assert!(beside.contains("a text is outside the segments of its target"), "{beside}");
    let incoming = read(Format::Xliff12, file(marked).as_bytes(), &ReadOptions::new("en-us"));
    assert_eq!((incoming.entries.len(), incoming.diagnostics.len()), (1, 0));
}

#[cfg(feature = "xlsx")]
mod spreadsheets {
    use super::{Format, told};
    use std::io::{Cursor, Write};
    use zip::ZipWriter;
    use zip::write::SimpleFileOptions;

    /// Returns an archive with these parts.
    fn archive(parts: &[(&str, &[u8])]) -> Vec<u8> {
        let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
        for (name, bytes) in parts {
            archive.start_file(*name, SimpleFileOptions::default()).unwrap();
            archive.write_all(bytes).unwrap();
        }
        archive.finish().unwrap().into_inner()
    }

    fn sheet(rows: &str) -> Vec<u8> {
        let sheet = format!("<worksheet><sheetData>{rows}</sheetData></worksheet>");
        archive(&[("xl/worksheets/sheet1.xml", sheet.as_bytes())])
    }

    /// Texts of many clips in many languages may unpack to more bytes than a small file.
    #[test]
    fn a_large_file_is_read() {
        let unused = format!("<si><t>{}</t></si>", "not used ".repeat(1 << 10));
        let strings = format!("<sst><si><t>a</t></si>{}</sst>", unused.repeat(8 << 10));
        let header = r#"<row><c t="inlineStr"><is><t>key</t></is></c><c t="inlineStr"><is><t>de-de</t></is></c></row>"#;
        let sheet = format!(r#"<worksheet>{header}<row><c t="s"><v>0</v></c><c t="s"><v>0</v></c></row></worksheet>"#);
        let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
        let stored = SimpleFileOptions::default().compression_method(zip::CompressionMethod::Stored);
        for (name, text) in [("xl/sharedStrings.xml", &strings), ("xl/worksheets/sheet1.xml", &sheet)] {
            archive.start_file(name, stored).unwrap();
            archive.write_all(text.as_bytes()).unwrap();
        }
        let file = archive.finish().unwrap().into_inner();
        let incoming = lipz_texts::read(Format::Xlsx, &file, &lipz_texts::ReadOptions::new("en-us"));
        assert_eq!((incoming.diagnostics, incoming.entries.len()), (Vec::new(), 1));
    }

    /// Reads a sheet whose second row has these cells for a translation and for a comment, which is not imported.
    fn with(cells: [&str; 2]) -> lipz_texts::IncomingFile {
        let text = |text: &str| format!(r#"<c t="inlineStr"><is><t>{text}</t></is></c>"#);
        let (head, key) = (["key", "de-de", "comment"].map(text).concat(), text("a"));
        let file = sheet(&format!("<row>{head}</row><row>{key}{}</row>", cells.concat()));
        lipz_texts::read(Format::Xlsx, &file, &lipz_texts::ReadOptions::new("en-us"))
    }

    /// `=Ja` in a spreadsheet is a formula. Programs that do not compute formulas save it without a value, Excel with
    /// an error.
    #[test]
    fn a_formula_without_a_value_or_with_an_error_is_told() {
        let without = "the cell is a formula without a value and is not imported";
        for (cell, message) in [
            ("<c><f>Ja</f></c>", without),
            ("<c><f>Ja</f><v/></c>", without),
            ("<c><f>Ja</f><v></v></c>", without),
            (r#"<c t="str"><f>Ja</f></c>"#, without),
            (r#"<c t="e"><f>Ja</f><v>#NAME?</v></c>"#, "the cell contains the error `#NAME?` and is not imported"),
        ] {
            let incoming = with([cell, ""]);
            let [told] = incoming.diagnostics.as_slice() else { panic!("{cell}: {:?}", incoming.diagnostics) };
            assert_eq!(told.message, message, "{cell}");
            assert_eq!(told.start(), 20, "behind the key of the second row");
            assert_eq!(incoming.entries[0].text.text, "", "{cell}");
            assert_eq!(with(["<c/>", cell]).diagnostics, [], "{cell}: nobody imports comments");
        }
        for (cell, text) in [
            (r#"<c t="str"><f>A1</f><v>Ja</v></c>"#, "Ja"),
            (r#"<c t="str"><f>A1</f><v></v></c>"#, ""),
            (r#"<c t="str"><f>A1</f><v/></c>"#, ""),
        ] {
            let computed = with([cell, ""]);
            assert_eq!((computed.diagnostics, computed.entries[0].text.text.as_str()), (Vec::new(), text), "{cell}");
        }
    }

    /// A spreadsheet makes a date of `3/4`, and a truth value of `true`.
    #[test]
    fn values_that_the_sheet_shows_in_a_different_form_are_told() {
        let styles = r#"<styleSheet><numFmts><numFmt numFmtId="164" formatCode="d. mmm"/></numFmts>
            <cellStyleXfs><xf numFmtId="0"/></cellStyleXfs>
            <cellXfs><xf numFmtId="0"/><xf numFmtId="14"/><xf numFmtId="164"/></cellXfs></styleSheet>"#;
        let text = |text: &str| format!(r#"<c t="inlineStr"><is><t>{text}</t></is></c>"#);
        let read = |cell: &str| {
            let rows = format!("<row>{}{}</row><row>{}{cell}</row>", text("key"), text("de-de"), text("a"));
            let sheet = format!("<worksheet><sheetData>{rows}</sheetData></worksheet>");
            let parts: [(&str, &[u8]); 2] =
                [("xl/styles.xml", styles.as_bytes()), ("xl/worksheets/sheet1.xml", sheet.as_bytes())];
            let incoming = lipz_texts::read(Format::Xlsx, &archive(&parts), &lipz_texts::ReadOptions::new("en-us"));
            let told: Vec<String> = incoming.diagnostics.iter().map(|told| told.message.clone()).collect();
            (told.join("; "), incoming.entries[0].text.text.clone())
        };
        let not = |what: &str| (format!("the cell contains {what}, not a text, and is not imported"), String::new());
        assert_eq!(read(r#"<c s="1"><v>45413</v></c>"#), not("a date"));
        assert_eq!(read(r#"<c s="2" t="n"><v>45413</v></c>"#), not("a date"));
        assert_eq!(read(r#"<c t="d"><v>2026-04-03</v></c>"#), not("a date"));
        assert_eq!(read(r#"<c t="b"><v>1</v></c>"#), not("a truth value"));
        assert_eq!(read("<c><v>1.234567890123457E+19</v></c>"), not("a number with an exponent"));
        assert_eq!(read(r#"<c s="0"><v>42</v></c>"#), (String::new(), "42".to_owned()));
    }

    #[test]
    fn archives_and_sheets_without_end_are_refused() {
        let megabyte = format!("<a>{}</a>", "b".repeat(1 << 20));
        for part in ["xl/workbook.xml", "xl/sharedStrings.xml", "xl/worksheets/sheet1.xml"] {
            let bomb = archive(&[(part, &megabyte.repeat(80).into_bytes())]);
            assert!(bomb.len() < 1 << 20, "{}", bomb.len());
            assert!(told(Format::Xlsx, &bomb).contains("unpacked it has more than 66 megabytes"), "{part}");
        }
        for piece in [
            " ".to_owned() + &"x".repeat(5 << 20),
            format!("<!--{}-->", " ".repeat(5 << 20)),
            format!("<a {}/>", "b='' ".repeat(1 << 20)),
        ] {
            assert!(told(Format::Xlsx, &sheet(&piece)).contains("a tag or a text in it has more than 4 megabytes"));
        }
        let strings = format!("<sst><si><t>{}</t></si></sst>", "a".repeat(1 << 20));
        let cells = r#"<c t="s"><v>0</v></c>"#.repeat(100);
        let sheet_of_strings = format!("<worksheet><row>{cells}</row></worksheet>");
        let parts: [(&str, &[u8]); 2] =
            [("xl/sharedStrings.xml", strings.as_bytes()), ("xl/worksheets/sheet1.xml", sheet_of_strings.as_bytes())];
        assert!(told(Format::Xlsx, &archive(&parts)).contains("its cells have more than 64 megabytes"));
        for (rows, why) in [
            (r#"<row r="99999999"/>"#, "row 99999999 follows row 0"),
            (
                r#"<row r="2"><c t="inlineStr"><is><t>key</t></is></c><c><v>de-de</v></c></row><row r="1"/>"#,
                "row 1 follows row 2",
            ),
            (r#"<row><c r="ZZZZ1"/></row>"#, "the cells of a row are not in order"),
            (r#"<row><c t="s"><v>7</v></c></row>"#, "a missing string"),
            ("", "the file has no header"),
            (&"<a>".repeat(200_000), "more than 100 deep"),
            ("<row></sheetData>", "expected `</row>`"),
            ("<row><c><v>&b;</v></c></row>", "an unknown XML entity: `b`"),
            ("<row><c><v>&#0;</v></c></row>", "cannot be read as a spreadsheet"),
            ("<row a=\"\u{0}\"", "cannot be read as a spreadsheet"),
        ] {
            let told = told(Format::Xlsx, &sheet(rows));
            assert!(told.contains(why), "{rows}: {told}");
        }
        let entities = format!(
            "<!DOCTYPE a [<!ENTITY b '{}'>]><worksheet><row><c><v>&b;</v></c></row></worksheet>",
            "a".repeat(100)
        );
        for (sheet, why) in [
            (entities.as_bytes(), "it has a DTD"),
            (b"<!DOCTYPE a SYSTEM 'file:///etc/passwd'><worksheet/>", "it has a DTD"),
            (b"<worksheet><row><c><v>\xff</v></c></row></worksheet>", "utf-8"),
            (b"<worksheet><row><c><v>a</v>", "one of its parts ends inside an element"),
        ] {
            let told = told(Format::Xlsx, &archive(&[("xl/worksheets/sheet1.xml", sheet)]));
            assert!(told.contains(why), "{told}");
        }
        assert!(told(Format::Xlsx, &archive(&[("a", b"")])).contains("it has no sheet"));
        assert!(told(Format::Xlsx, b"PK\x03\x04").contains("the file cannot be read as a spreadsheet"));
        assert!(told(Format::Xlsx, b"\xD0\xCF\x11\xE0").contains("without a password"));
    }
}

/// Iterating over all columns for each of them would take minutes.
#[test]
fn a_table_of_many_locales_is_read_at_once() {
    let tag = |number: usize| {
        let letter = |place: u32| char::from(b'a' + u8::try_from(number / 26_usize.pow(place) % 26).unwrap());
        format!("{}{}-{}{}", letter(3), letter(2), letter(1), letter(0))
    };
    let locales: Vec<String> = (0..50_000).map(tag).collect();
    let header: String = locales.iter().map(|locale| format!(",{locale},lock {locale}")).collect();
    let file = format!("key{header}\nmayor{}\n", ",x,".repeat(locales.len()));
    let options = ReadOptions::new("en-us").known(locales.clone());
    let incoming = read(Format::Csv, file.as_bytes(), &options);
    assert_eq!(incoming.entries.len(), locales.len(), "{:?}", incoming.diagnostics.first());
}
