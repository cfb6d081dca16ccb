//! Reading XLSX files: the first sheet.

use super::MAX_UNPACKED_BYTES;
use crate::csv::{Row, Table};
use crate::{Incoming, ReadOptions};
use lipz_diagnostics::{Code, Diagnostic, Span, escape};
use roxmltree::{Document, Node, ParsingOptions};
use std::io::{Cursor, Read};
use zip::ZipArchive;

/// What the parts of any file may have unpacked, in bytes, all together.
const FREE_BYTES: u64 = 1 << 26;

/// Bytes more for each of the file: what is written by programs has a tenth of its length packed, what is made to do harm a
/// thousandth.
const RATIO: u64 = 32;

/// Bytes of a part for each of its nodes: a cell has three, and at least 32 bytes.
const BYTES_PER_NODE: u64 = 10;

/// What the parts of a file of this length may have unpacked.
fn most_bytes(file_bytes: usize) -> u64 {
    (FREE_BYTES + RATIO * file_bytes as u64).min(MAX_UNPACKED_BYTES)
}

/// What a whole file may have unpacked, if its parts have more.
pub(super) fn exceeded(file: &[u8]) -> Option<u64> {
    let mut archive = ZipArchive::new(Cursor::new(file)).ok()?;
    let parts = 0..archive.len();
    let unpacked: u64 = parts.filter_map(|part| Some(archive.by_index(part).ok()?.size())).sum();
    Some(most_bytes(file.len())).filter(|most| unpacked > *most)
}

/// Why a file is not read.
struct Refusal {
    why: String,
    help: &'static str,
}

impl<T: Into<String>> From<T> for Refusal {
    fn from(why: T) -> Refusal {
        Refusal { why: why.into(), help: "open it in a spreadsheet, and save it as .xlsx without a password" }
    }
}

impl Refusal {
    fn too_large(what: &str, most: u64) -> Refusal {
        let why = format!("{what} more than {} megabytes", most >> 20);
        Refusal { why, help: "divide it, or save it as CSV" }
    }
}

/// Rows and columns of a sheet, at most, as Excel has them.
const MAX_ROWS: usize = 1 << 20;
const MAX_COLUMNS: usize = 1 << 14;

/// Reads a file of any bytes. Places count in a text with a line for each row of the sheet, and tabs between its cells.
pub(crate) fn read(bytes: &[u8], options: &ReadOptions, incoming: &mut Incoming) {
    let mut text = String::new();
    match rows(bytes, &mut text) {
        Ok(rows) => {
            let mut table = Table::new(options);
            let mut goes_on = rows.iter().all(|row| table.row(row, incoming));
            goes_on |= rows.is_empty();
            if goes_on {
                table.finish(incoming);
            }
        }
        Err(Refusal { why, help }) => incoming.diagnostics.push(
            Diagnostic::at(
                Code::ExchangeSyntax,
                Span::default(),
                format!("the file cannot be read as a spreadsheet: {why}"),
            )
            .help(help),
        ),
    }
    incoming.text = text;
}

/// The parts of a file, and how much more of them may be unpacked.
struct Parts<'b> {
    archive: ZipArchive<Cursor<&'b [u8]>>,
    most_bytes: u64,
    left_bytes: u64,
}

impl Parts<'_> {
    /// The text of a part; `None` if there is none with the name.
    fn text(&mut self, name: &str) -> Result<Option<String>, Refusal> {
        let Ok(part) = self.archive.by_name(name) else { return Ok(None) };
        let mut bytes = Vec::new();
        // One byte more than is allowed shows that there are too many, whatever the archive says.
        let read = part.take(self.left_bytes + 1).read_to_end(&mut bytes);
        read.map_err(|error| escape::text(&error.to_string()).into_owned())?;
        match self.left_bytes.checked_sub(bytes.len() as u64) {
            Some(left) => self.left_bytes = left,
            None => return Err(Refusal::too_large("unpacked it has", self.most_bytes)),
        }
        String::from_utf8(bytes).map(Some).map_err(|_| format!("{} is not UTF-8", escape::quoted(name)).into())
    }
}

fn parsed(text: &str) -> Result<Document<'_>, String> {
    let nodes_limit = u32::try_from((FREE_BYTES.max(text.len() as u64)) / BYTES_PER_NODE).unwrap_or(u32::MAX);
    let options = ParsingOptions { nodes_limit, ..ParsingOptions::default() };
    Document::parse_with_options(text, options).map_err(|error| escape::text(&error.to_string()).into_owned())
}

/// Elements of a name at any depth, whatever their namespace: there are two, strict and transitional.
fn elements<'a>(document: &'a Document<'_>, name: &'static str) -> impl Iterator<Item = Node<'a, 'a>> {
    document.descendants().filter(move |node| node.tag_name().name() == name)
}

/// The rows of the first sheet, which are lines of `text`.
fn rows(bytes: &[u8], text: &mut String) -> Result<Vec<Row>, Refusal> {
    let archive = ZipArchive::new(Cursor::new(bytes)).map_err(|error| escape::text(&error.to_string()).into_owned())?;
    let most_bytes = most_bytes(bytes.len());
    let mut parts = Parts { archive, most_bytes, left_bytes: most_bytes };
    let (sheet, strings) = places(&mut parts)?;
    let strings = match parts.text(&strings)? {
        Some(strings) => shared(&parsed(&strings)?),
        None => Vec::new(),
    };
    let sheet = parts.text(&sheet)?.ok_or("it has no sheet")?;
    let sheet = parsed(&sheet)?;
    let mut rows = Vec::new();
    let mut line = 0;
    for row in elements(&sheet, "row") {
        let number = row.attribute("r").and_then(|number| number.parse().ok()).unwrap_or(line + 1);
        if number <= line || number > MAX_ROWS {
            return Err(format!("row {number} follows row {line}").into());
        }
        text.extend(std::iter::repeat_n('\n', number - line - usize::from(line == 0)));
        line = number;
        rows.push(cells(row, &strings, text, most_bytes)?);
        if text.len() as u64 > most_bytes {
            return Err(Refusal::too_large("its cells have", most_bytes));
        }
    }
    Ok(rows)
}

/// The names of the parts with the first sheet and with the shared strings.
fn places(parts: &mut Parts<'_>) -> Result<(String, String), Refusal> {
    let (mut sheet, mut strings) = ("xl/worksheets/sheet1.xml".to_owned(), "xl/sharedStrings.xml".to_owned());
    let (Some(workbook), Some(relations)) = (parts.text("xl/workbook.xml")?, parts.text("xl/_rels/workbook.xml.rels")?)
    else {
        return Ok((sheet, strings));
    };
    let workbook = parsed(&workbook)?;
    let first = elements(&workbook, "sheet").next();
    // The namespace of the attribute differs, too.
    let id = first.and_then(|sheet| sheet.attributes().find(|one| one.name() == "id").map(|one| one.value()));
    let relations = parsed(&relations)?;
    for relation in elements(&relations, "Relationship") {
        let Some(target) = relation.attribute("Target") else { continue };
        let path = target.strip_prefix('/').map_or_else(|| format!("xl/{target}"), str::to_owned);
        if relation.attribute("Id") == id && id.is_some() {
            sheet = path;
        } else if relation.attribute("Type").is_some_and(|kind| kind.ends_with("/sharedStrings")) {
            strings = path;
        }
    }
    Ok((sheet, strings))
}

/// The strings that cells refer to by their numbers.
fn shared(document: &Document<'_>) -> Vec<String> {
    elements(document, "si").map(string).collect()
}

/// The text of a string, without its phonetic readings.
fn string(node: Node<'_, '_>) -> String {
    let is_reading = |text: &Node<'_, '_>| text.parent().is_some_and(|parent| parent.tag_name().name() == "rPh");
    let texts = node.descendants().filter(|text| text.tag_name().name() == "t" && !is_reading(text));
    unescaped(&texts.filter_map(|text| text.text()).collect::<String>())
}

/// Adds the cells of a row to the text, up to so many bytes.
fn cells(row: Node<'_, '_>, strings: &[String], text: &mut String, most_bytes: u64) -> Result<Row, String> {
    let mut read = Row { start: text.len(), ..Row::default() };
    for cell in row.children().filter(|node| node.tag_name().name() == "c") {
        let column = cell.attribute("r").and_then(column).unwrap_or(read.cells.len());
        if column < read.cells.len() || column >= MAX_COLUMNS {
            return Err("the cells of a row are not in order".to_owned());
        }
        while read.cells.len() < column {
            push(&mut read, "", text);
        }
        let value = cell.children().find(|node| node.tag_name().name() == "v").and_then(|node| node.text());
        match (cell.attribute("t"), value) {
            (Some("s"), Some(number)) => {
                let string = number.trim().parse::<usize>().ok().and_then(|number| strings.get(number));
                push(&mut read, string.ok_or("a cell refers to a string that is not there")?, text);
            }
            (Some("inlineStr"), _) => push(&mut read, &string(cell), text),
            (_, Some(value)) => push(&mut read, &unescaped(value), text),
            (_, None) => push(&mut read, "", text),
        }
        if text.len() as u64 > most_bytes {
            break;
        }
    }
    Ok(read)
}

/// Adds a cell. Line ends and tabs in it are blanks in the text, so that a line stays a row.
fn push(row: &mut Row, cell: &str, text: &mut String) {
    if !row.cells.is_empty() {
        text.push('\t');
    }
    let start = text.len() - row.start;
    text.extend(cell.chars().map(|character| if matches!(character, '\n' | '\r' | '\t') { ' ' } else { character }));
    row.places.push(start..text.len() - row.start);
    row.cells.push(cell.to_owned());
}

/// The number of a column from 0: that of `AB12` is 27.
fn column(reference: &str) -> Option<usize> {
    let letters = reference.bytes().take_while(u8::is_ascii_alphabetic);
    let number =
        letters.take(4).fold(0, |number, letter| number * 26 + usize::from(letter.to_ascii_uppercase() - b'A') + 1);
    number.checked_sub(1)
}

/// Characters that XML does not have, as `_x000D_`, and this itself, as `_x005F_x000D_`.
fn unescaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find("_x") {
        let code = rest.get(at + 2..at + 6).filter(|_| rest.get(at + 6..at + 7) == Some("_"));
        let is_hex = |code: &&str| code.bytes().all(|digit| digit.is_ascii_hexdigit());
        let character =
            code.filter(is_hex).and_then(|code| u32::from_str_radix(code, 16).ok()).and_then(char::from_u32);
        let length = if character.is_some() { 7 } else { 1 };
        out.push_str(rest.get(..at).unwrap_or_default());
        out.push(character.unwrap_or('_'));
        rest = rest.get(at + length..).unwrap_or_default();
    }
    out + rest
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn what_is_too_large_to_be_read_is_not_written() {
        let packed = |bytes: usize| {
            let mut archive = zip::ZipWriter::new(Cursor::new(Vec::new()));
            archive.start_file("a", zip::write::SimpleFileOptions::default()).unwrap();
            std::io::Write::write_all(&mut archive, &vec![b'a'; bytes]).unwrap();
            archive.finish().unwrap().into_inner()
        };
        assert_eq!(exceeded(&packed(1 << 20)), None);
        let large = packed(usize::try_from(FREE_BYTES * 2).unwrap());
        assert_eq!(exceeded(&large), Some(most_bytes(large.len())));
    }

    #[test]
    fn columns_and_characters_are_those_of_excel() {
        assert_eq!([column("A1"), column("Z9"), column("AB12"), column("7")], [Some(0), Some(25), Some(27), None]);
        assert_eq!(unescaped("a_x000D_b_x005F_x000D__x00_"), "a\rb_x000D__x00_");
    }
}
