//! The cells of a row.

use super::parts::Refusal;
use super::strings::{Strings, add_string, unescaped};
use super::xml::{Part, Step};
use crate::csv::Row;
use lipz_diagnostics::{Code, Diagnostic, Span, escape};

/// Columns of a sheet, at most, as Excel has them.
const MAX_COLUMNS: usize = 1 << 14;

/// Reads the row that has just begun, up to its end, and adds it to the text of the file, which may have so many bytes.
pub(super) fn row(
    part: &mut Part<'_, '_>,
    strings: &Strings,
    text: &mut String,
    most_bytes: u64,
) -> Result<Row, Refusal> {
    let mut row = Row { start: text.len(), ..Row::default() };
    while let Some(step) = part.next()? {
        match step {
            Step::Start if part.name() == "c" => cell(part, strings, &mut row, text)?,
            Step::Start => part.skip()?,
            Step::End => break,
            Step::Text | Step::Other => {}
        }
        if text.len() as u64 > most_bytes {
            return Err(Refusal::too_large("its cells have", most_bytes));
        }
    }
    Ok(row)
}

/// Reads the cell that has just begun, up to its end. A formula without a value is a fault, as nobody computes it here; and so
/// is an error, which was a text if somebody typed one that begins with `=`.
fn cell(part: &mut Part<'_, '_>, strings: &Strings, row: &mut Row, text: &mut String) -> Result<(), Refusal> {
    let at = part.attribute("r").as_deref().and_then(column).unwrap_or(row.cells.len());
    if at < row.cells.len() || at >= MAX_COLUMNS {
        return Err("the cells of a row are not in order".into());
    }
    while row.cells.len() < at {
        push(row, "", text);
    }
    let kind = part.attribute("t");
    let kind = kind.as_deref();
    let (mut value, mut is_formula, mut has_value) = (String::new(), false, false);
    while let Some(step) = part.next()? {
        match step {
            Step::Start if kind == Some("inlineStr") && part.name() == "is" => add_string(part, &mut value)?,
            Step::Start if kind != Some("inlineStr") && part.name() == "v" => {
                has_value = true;
                part.add_text(&mut value)?;
            }
            Step::Start => {
                is_formula |= part.name() == "f";
                part.skip()?;
            }
            Step::End => break,
            Step::Text | Step::Other => {}
        }
    }
    // A text may be computed and empty. A number cannot: some programs write an empty value where they have none.
    let is_computed = !value.is_empty() || (has_value && kind == Some("str"));
    match kind {
        Some("s") if !value.is_empty() => {
            push(row, strings.get(&value).ok_or("a cell refers to a string that is not there")?, text);
        }
        Some("s" | "e") => push(row, "", text),
        _ => push(row, &unescaped(&value), text),
    }
    let fault = match kind {
        Some("e") if is_computed => Some(error(row.span(at), &value)),
        _ => (is_formula && !is_computed).then(|| not_computed(row.span(at))),
    };
    row.faults.extend(fault.map(|fault| (at, fault)));
    Ok(())
}

/// The diagnostic for a formula without a value.
fn not_computed(span: Span) -> Diagnostic {
    Diagnostic::at(Code::ExchangeLoss, span, "the cell is a formula without a value, and is not imported").help(
        "write an apostrophe before a text that begins with `=`; or save the file in a spreadsheet, which computes it",
    )
}

/// The diagnostic for a formula whose value is an error, as `#NAME?` for `=Yes!`.
fn error(span: Span, value: &str) -> Diagnostic {
    let message = format!("the cell is the error {}, and is not imported", escape::quoted(value));
    Diagnostic::at(Code::ExchangeLoss, span, message)
        .help("write an apostrophe before a text that begins with `=`; mend what is meant as a formula")
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_those_of_excel() {
        assert_eq!([column("A1"), column("Z9"), column("AB12"), column("7")], [Some(0), Some(25), Some(27), None]);
    }
}
