//! Spreadsheets as people send them: titles above the table, cover sheets, OpenDocument files, files with a password.
#![cfg(feature = "xlsx")]
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_diagnostics::Diagnostic;
use lipz_texts::{Format, IncomingFile, ReadOptions, read};
use std::io::{Cursor, Write};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

fn archive(parts: &[(&str, &str)]) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, text) in parts {
        archive.start_file(*name, SimpleFileOptions::default()).unwrap();
        archive.write_all(text.as_bytes()).unwrap();
    }
    archive.finish().unwrap().into_inner()
}

fn incoming(format: Format, bytes: &[u8]) -> IncomingFile {
    read(format, bytes, &ReadOptions::new("en-us"))
}

/// Returns the keys and translations.
fn texts(incoming: &IncomingFile) -> Vec<(&str, &str)> {
    incoming.entries.iter().map(|entry| (entry.key.text.as_str(), entry.text.text.as_str())).collect()
}

fn messages(incoming: &IncomingFile) -> Vec<&str> {
    incoming.diagnostics.iter().map(|found| found.message.as_str()).collect()
}

/// The texts of the diagnostics' positions.
fn places(incoming: &IncomingFile) -> Vec<&str> {
    let place = |found: &Diagnostic| &incoming.text[found.primary.as_ref().unwrap().span.range()];
    incoming.diagnostics.iter().map(place).collect()
}

/// An XLSX file with sheets of rows of texts.
fn xlsx(sheets: &[(&str, &[&[&str]])]) -> Vec<u8> {
    let cell = |text: &&str| format!(r#"<c t="inlineStr"><is><t>{text}</t></is></c>"#);
    let row = |row: &&[&str]| format!("<row>{}</row>", row.iter().map(cell).collect::<String>());
    let (mut names, mut relations) = (String::new(), String::new());
    let mut parts = Vec::new();
    for (at, (name, rows)) in sheets.iter().enumerate() {
        names += &format!(r#"<sheet name="{name}" sheetId="{at}" r:id="rId{at}"/>"#);
        relations += &format!(r#"<Relationship Id="rId{at}" Type="x/worksheet" Target="worksheets/s{at}.xml"/>"#);
        let rows: String = rows.iter().map(row).collect();
        parts.push((
            format!("xl/worksheets/s{at}.xml"),
            format!("<worksheet><sheetData>{rows}</sheetData></worksheet>"),
        ));
    }
    parts.push(("xl/workbook.xml".to_owned(), format!("<workbook><sheets>{names}</sheets></workbook>")));
    parts.push(("xl/_rels/workbook.xml.rels".to_owned(), format!("<Relationships>{relations}</Relationships>")));
    archive(&parts.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect::<Vec<_>>())
}

const TABLE: &[&[&str]] = &[&["key", "en-us", "de-de"], &["a", "Hi.", "Hallo."]];

#[test]
fn rows_above_the_header_are_reported() {
    let csv = incoming(Format::Csv, b"Lighthouse, German\n\nAnna M.\nkey;en-us;de-de\na;Hi.;Hallo.\n");
    assert_eq!(texts(&csv), [("a", "Hallo.")]);
    assert_eq!(messages(&csv), ["2 rows above the header are not imported"]);
    let rows: Vec<&[&str]> = [&["Lighthouse"][..]].into_iter().chain(TABLE.iter().copied()).collect();
    let sheet = incoming(Format::Xlsx, &xlsx(&[("de", &rows)]));
    assert_eq!((texts(&sheet), places(&sheet)), (vec![("a", "Hallo.")], vec!["Lighthouse"]));
    // A table without a header has one error, at its first row.
    let none = incoming(Format::Csv, "a,Hi.,Hallo.\n".repeat(100).as_bytes());
    let errors: Vec<&str> =
        none.diagnostics.iter().filter(|found| found.is_error()).map(|found| &*found.message).collect();
    assert_eq!((errors, none.entries.len()), (vec!["no column has the keys of clips"], 0));
    let no_locale = incoming(Format::Csv, b"Title\nkey,notes\na,Hi.\n");
    assert!(messages(&no_locale).contains(&"no column has translations"), "{:?}", no_locale.diagnostics);
}

#[test]
fn the_first_sheet_with_a_table_is_imported() {
    let cover: &[&[&str]] = &[&["Lighthouse"], &["Please return by Friday"]];
    let one = incoming(Format::Xlsx, &xlsx(&[("Cover", cover), ("German", TABLE), ("Notes", cover)]));
    assert_eq!((texts(&one), messages(&one)), (vec![("a", "Hallo.")], Vec::new()));
    let french: &[&[&str]] = &[&["key", "fr-fr"], &["a", "Bonjour."]];
    let two = incoming(Format::Xlsx, &xlsx(&[("German", TABLE), ("French", french)]));
    assert_eq!((texts(&two), messages(&two)), (vec![("a", "Hallo.")], vec!["the sheet `French` is not imported"]));
    let none = incoming(Format::Xlsx, &xlsx(&[("Cover", cover), ("Notes", cover)]));
    assert!(none.entries.is_empty() && messages(&none).contains(&"no column has the keys of clips"));
}

#[test]
fn comments_on_cells_are_reported() {
    let (comments, sheet) = ("<comments/>", "<worksheet><sheetData/></worksheet>");
    let read = incoming(Format::Xlsx, &archive(&[("xl/worksheets/sheet1.xml", sheet), ("xl/comments1.xml", comments)]));
    assert!(messages(&read).contains(&"comments on cells are not imported"), "{:?}", read.diagnostics);
}

fn ods(tables: &str) -> Vec<u8> {
    let content = format!(
        "<office:document-content><office:body><office:spreadsheet>{tables}</office:spreadsheet></office:body></office:document-content>"
    );
    archive(&[("mimetype", "application/vnd.oasis.opendocument.spreadsheet"), ("content.xml", &content)])
}

/// A cell of a text.
fn cell(text: &str) -> String {
    format!(r#"<table:table-cell office:value-type="string"><text:p>{text}</text:p></table:table-cell>"#)
}

fn row(cells: &[String]) -> String {
    format!("<table:table-row>{}</table:table-row>", cells.concat())
}

fn table(rows: &[String]) -> String {
    format!(r#"<table:table table:name="German"><table:table-column/>{}</table:table>"#, rows.concat())
}

#[test]
fn open_document_spreadsheets_are_read_like_others() {
    let head = row(&["key", "en-us", "de-de"].map(cell));
    let lines = r#"<table:table-cell><office:annotation><text:p>checked</text:p></office:annotation><text:p>Guten<text:s text:c="2"/><text:span>Tag,</text:span></text:p><text:p>Otto.<text:line-break/>Ja.</text:p></table:table-cell>"#;
    let empty = r#"<table:table-row table:number-rows-repeated="2"><table:table-cell table:number-columns-repeated="16384"/></table:table-row>"#;
    let date = r#"<table:table-cell office:value-type="date" office:date-value="2026-04-03"><text:p>03.04.26</text:p></table:table-cell>"#;
    let number =
        r#"<table:table-cell office:value-type="float" office:value="42"><text:p>42,00</text:p></table:table-cell>"#;
    let error = r##"<table:table-cell table:formula="of:=Yes!" office:value-type="string" calcext:value-type="error"><text:p>#NAME?</text:p></table:table-cell>"##;
    let rows = [
        head,
        row(&[cell("a"), cell("Hi."), lines.to_owned()]),
        empty.to_owned(),
        row(&[cell("b"), cell("3/4"), date.to_owned()]),
        row(&[cell("c"), cell("42"), number.to_owned()]),
        row(&[cell("d"), cell("=Yes!"), error.to_owned()]),
        r#"<table:table-row table:number-rows-repeated="1048570"><table:table-cell table:number-columns-repeated="16384"/></table:table-row>"#.to_owned(),
    ];
    let cover = table(&[row(&[cell("Lighthouse")])]);
    let read = incoming(Format::of_extension("ods").unwrap(), &ods(&(cover + &table(&rows))));
    assert_eq!(texts(&read), [("a", "Guten  Tag,\nOtto.\nJa."), ("b", ""), ("c", "42"), ("d", "")]);
    let expected = [
        "comments on cells are not imported",
        "the cell contains a date, not a text, and is not imported",
        "the cell contains an error, not a text, and is not imported",
    ];
    assert_eq!(messages(&read), expected);
    // Positions count the rows of the sheet.
    let start = read.diagnostics[1].primary.as_ref().unwrap().span.range().start;
    assert_eq!(read.text[..start].matches('\n').count() + 1, 5);
}

#[test]
fn hostile_open_document_files_are_refused() {
    let head = row(&["key", "de-de"].map(cell));
    let long = "x".repeat(1 << 20);
    let wide = format!(
        r#"<table:table-cell table:number-columns-repeated="16000"><text:p>{long}</text:p></table:table-cell>"#
    );
    let tall = format!(r#"<table:table-row table:number-rows-repeated="999999999999">{}</table:table-row>"#, cell("a"));
    let many = r#"<table:table-cell table:number-columns-repeated="18446744073709551615"><text:p>a</text:p></table:table-cell>"#;
    for rows in [row(&[wide]), tall, row(&[many.to_owned()]), row(&[many.to_owned(), many.to_owned()])] {
        let read = incoming(Format::Xlsx, &ods(&table(&[head.clone(), rows])));
        assert!(read.entries.is_empty() && read.diagnostics.iter().any(Diagnostic::is_error), "{:?}", read.diagnostics);
    }
}

#[test]
fn files_with_a_password_are_named() {
    let read = incoming(Format::Xlsx, b"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1 and so on");
    let expected =
        "the file cannot be read as a spreadsheet: it has a password, or is in the format of Excel 97 (.xls)";
    assert_eq!(messages(&read), [expected]);
}
