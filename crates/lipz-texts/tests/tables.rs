//! Tables saved by other programs, with their automatic changes and damage.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

use lipz_diagnostics::Diagnostic;
use lipz_texts::{Collect, Exchange, Format, IncomingFile, Merge, ReadOptions, Shape, WriteOptions, read, write};

const HEAD: &str = "key,en-us,de-de\n";

fn table(text: &str) -> IncomingFile {
    read(Format::Csv, text.as_bytes(), &ReadOptions::new("en-us"))
}

/// Returns the position of the only diagnostic, and its message. Nothing is imported.
fn refused(rows: &str) -> (String, String) {
    let incoming = table(&format!("{HEAD}{rows}"));
    assert_eq!(incoming.entries, [], "{rows}");
    let [diagnostic] = incoming.diagnostics.as_slice() else { panic!("{rows}: {:?}", incoming.diagnostics) };
    assert!(diagnostic.is_error());
    let start = usize::try_from(diagnostic.start()).unwrap();
    (incoming.text[start..].chars().take(6).collect(), diagnostic.message.clone())
}

#[test]
fn a_table_that_nobody_can_be_sure_about_is_not_imported() {
    let message = |rows: &str| refused(rows).1;
    // An unclosed quote includes the following rows, up to the next quote.
    let swallowed = refused("b,Halt!,\"Halt?\na,Hi.,\"Guten Tag\"\n");
    assert_eq!(swallowed, ("Guten ".to_owned(), "text follows the quote that closes a cell".to_owned()));
    let open = refused("b,Halt!,\"Halt?\na,Hi.,Tag\n");
    assert_eq!(open, ("\"Halt?".to_owned(), "the cell that starts with this quote is not closed".to_owned()));
    assert_eq!(refused("b,Halt!,\"Halt\" stop?\n").0, " stop?");
    assert_eq!(
        refused("b,Halt!,Stop, you!\n"),
        (" you!\n".to_owned(), "the row has 4 cells, but the header has 3".to_owned())
    );
    assert_eq!(message("a,Hi.,Tag\nb,Halt!"), "the row has 2 cells, but the header has 3");
    assert_eq!(table(&format!("{HEAD}b,Halt!,\"Stop, \"\"you\"\"!\"\n\na,Hi.,")).diagnostics, []);
}

#[test]
fn very_many_wrong_rows_are_counted() {
    let incoming = table(&(HEAD.to_owned() + &"a\n".repeat(100_000)));
    assert_eq!(incoming.diagnostics.iter().map(Diagnostic::count).sum::<usize>(), 100_000);
    assert!(incoming.diagnostics.len() < 2_000);
}

#[test]
fn a_cell_without_a_text_is_read_if_it_has_a_mark() {
    let of = |table: &str| {
        let entries = read(Format::Csv, table.as_bytes(), &ReadOptions::new("en-us")).entries;
        entries.iter().map(|entry| format!("{} {}", entry.locale, entry.text.text)).collect::<Vec<_>>()
    };
    let head = "key,lock de-de,lock fr-fr,fr-fr,de-de,it-it,es-es\n";
    assert_eq!(of(&format!("{head}a,0123abcd,none,,,,\n")), ["fr-fr ", "de-de "], "in the order of their places");
    assert_eq!(of(&format!("{head}a,,,,,,Hola.\n")), ["es-es Hola."]);
    assert_eq!(of(&format!("{head}a,,,,,,\n")), ["de-de "], "for its key");
    assert_eq!(of("language,id,text\nde-de,a,\n"), ["de-de "]);
}

#[test]
fn line_ends_that_another_program_changed_change_no_text() {
    for file in [
        r#"{ "visemes": "MA|E", "text_en-us": "One\nTwo|Three", "text_de-de": "Eins\nZwei|Drei" }"#,
        r#"{ "visemes": "MA|E", "text_en-us": "One\r\nTwo|Three", "text_de-de": "Eins\nZwei|Drei" }"#,
    ] {
        let document = lipz_file::parse(file.as_bytes()).document.unwrap();
        let unit = Collect::new("en-us", ["de-de"]).unit("a", &document, &mut Vec::new()).unwrap();
        let exchange = Exchange { source_locale: "en-us".into(), locales: vec!["de-de".into()], units: vec![unit] };
        for shape in Shape::ALL {
            let written = write(Format::Csv, &exchange, &WriteOptions::new().shape(shape)).files.remove(0);
            let table = String::from_utf8(written.bytes).unwrap();
            let merged = |table: &str| {
                let entries = read(Format::Csv, table.as_bytes(), &ReadOptions::new("en-us")).entries;
                Merge::new("en-us").merge(file, &document, &entries.iter().collect::<Vec<_>>())
            };
            assert_eq!(merged(&table).text, None, "{shape:?}: as it was exported");
            if file.contains("\\r") {
                // Here the CR belongs to the texts, so an additional one is a change.
                continue;
            }
            let windows = table.replace("\r\n", "\n").replace('\n', "\r\n");
            let same = merged(&windows);
            assert_eq!((same.text, same.found), (None, Vec::new()), "{shape:?}");
            let changed = merged(&windows.replace("Drei", "Vier"));
            assert_eq!(changed.text, Some(file.replace("Drei", "Vier")), "{shape:?}: {:?}", changed.found);
        }
    }
}
