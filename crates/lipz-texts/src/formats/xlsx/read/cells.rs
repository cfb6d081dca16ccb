//! The cells of a row.

use super::parts::Refusal;
use super::strings::{Strings, add_string, unescaped};
use super::styles::Styles;
use super::xml::{PartReader, XmlStep};
use crate::formats::csv::CsvRow;
use lipz_diagnostics::{Code, Diagnostic, Span, escape};

/// The most columns of a sheet, as in Excel.
pub(super) const MAX_COLUMNS: usize = 1 << 14;

/// Reads the row that has just begun, and appends it to the text of the file, which is limited to a number of bytes.
pub(super) fn row(
    part: &mut PartReader<'_, '_>,
    formats: (&Strings, &Styles),
    text: &mut String,
    most_bytes: u64,
) -> Result<CsvRow, Refusal> {
    let mut row = CsvRow { start: text.len(), ..CsvRow::default() };
    while let Some(step) = part.next()? {
        match step {
            XmlStep::Start if part.name() == "c" => cell(part, formats, &mut row, text)?,
            XmlStep::Start => part.skip()?,
            XmlStep::End => break,
            XmlStep::Text | XmlStep::Other => {}
        }
        if text.len() as u64 > most_bytes {
            return Err(Refusal::too_large("its cells have", most_bytes));
        }
    }
    Ok(row)
}

/// Reads the cell that has just begun. A formula without a value is a fault, because lipz does not compute it. So is an
/// error, which was a text if its author typed one that begins with `=`, and a value that the file stores in a different
/// form than the sheet shows it.
fn cell(
    part: &mut PartReader<'_, '_>,
    (strings, styles): (&Strings, &Styles),
    row: &mut CsvRow,
    text: &mut String,
) -> Result<(), Refusal> {
    let at = part.attribute("r").as_deref().and_then(column).unwrap_or(row.cells.len());
    if at < row.cells.len() || at >= MAX_COLUMNS {
        return Err("the cells of a row are not in order".into());
    }
    while row.cells.len() < at {
        push(row, "", text);
    }
    let (kind, style) = (part.attribute("t"), part.attribute("s"));
    let kind = kind.as_deref();
    let (mut value, mut is_formula, mut has_value) = (String::new(), false, false);
    while let Some(step) = part.next()? {
        match step {
            XmlStep::Start if kind == Some("inlineStr") && part.name() == "is" => add_string(part, &mut value)?,
            XmlStep::Start if kind != Some("inlineStr") && part.name() == "v" => {
                has_value = true;
                part.add_text(&mut value)?;
            }
            XmlStep::Start => {
                is_formula |= part.name() == "f";
                part.skip()?;
            }
            XmlStep::End => break,
            XmlStep::Text | XmlStep::Other => {}
        }
    }
    // A computed text may be empty. A number cannot, but some programs write an empty value instead of a missing one.
    let is_computed = !value.is_empty() || (has_value && kind == Some("str"));
    match kind {
        Some("s") if !value.is_empty() => {
            push(row, strings.get(&value).ok_or("a cell refers to a missing string")?, text);
        }
        Some("s" | "e" | "b" | "d") => push(row, "", text),
        None | Some("n") if other_form(&value, styles.is_date(style.as_deref())).is_some() => push(row, "", text),
        _ => push(row, &unescaped(&value), text),
    }
    let fault = match kind {
        Some("e") if is_computed => Some(error(row.span(at), &value)),
        Some("b") if is_computed => Some(not_text(row.span(at), "a truth value")),
        Some("d") if is_computed => Some(not_text(row.span(at), "a date")),
        None | Some("n") if is_computed => {
            other_form(&value, styles.is_date(style.as_deref())).map(|what| not_text(row.span(at), what))
        }
        _ => (is_formula && !is_computed).then(|| not_computed(row.span(at))),
    };
    row.faults.extend(fault.map(|fault| (at, fault)));
    Ok(())
}

/// Returns the kind of a number that the sheet shows in a different form than the file has it.
fn other_form(value: &str, is_date: bool) -> Option<&'static str> {
    match value {
        "" => None,
        _ if is_date => Some("a date"),
        value if value.contains(['e', 'E']) && value.parse::<f64>().is_ok() => Some("a number with an exponent"),
        _ => None,
    }
}

/// Returns the diagnostic for a cell that is not a text, although its author may have typed one: `3/4` becomes a date.
pub(super) fn not_text(span: Span, what: &str) -> Diagnostic {
    Diagnostic::at(Code::ExchangeLoss, span, format!("the cell contains {what}, not a text, and is not imported"))
        .help("set the format of the cell to `Text`, and type the text again")
}

/// Returns the diagnostic for a formula without a value.
fn not_computed(span: Span) -> Diagnostic {
    Diagnostic::at(Code::ExchangeLoss, span, "the cell is a formula without a value and is not imported").help(
        "write an apostrophe before a text that starts with `=`, or save the file in a spreadsheet program to compute \
            the formula",
    )
}

/// Returns the diagnostic for a formula whose value is an error, such as `#NAME?` for `=Yes!`.
fn error(span: Span, value: &str) -> Diagnostic {
    let message = format!("the cell contains the error {} and is not imported", escape::quoted(value));
    Diagnostic::at(Code::ExchangeLoss, span, message)
        .help("write an apostrophe before a text that starts with `=`, or fix the formula")
}

/// Adds a cell. Its line ends and tabs become spaces in the text, so that a row stays on one line.
pub(super) fn push(row: &mut CsvRow, cell: &str, text: &mut String) {
    if !row.cells.is_empty() {
        text.push('\t');
    }
    let start = text.len() - row.start;
    text.extend(cell.chars().map(|character| if matches!(character, '\n' | '\r' | '\t') { ' ' } else { character }));
    row.places.push(start..text.len() - row.start);
    row.cells.push(cell.to_owned());
}

/// Returns the number of a column from 0: that of `AB12` is 27.
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
