//! Strings of PO files: quotes and escapes, as in C.

/// Returns a text as strings of a PO file: one line, or an empty string and a string for each line of the text.
pub(super) fn literal(text: &str) -> String {
    if !text.trim_end_matches('\n').contains('\n') {
        return format!("\"{}\"", escaped(text));
    }
    let lines = text.split_inclusive('\n').map(|line| format!("\"{}\"", escaped(line)));
    std::iter::once("\"\"".to_owned()).chain(lines).collect::<Vec<_>>().join("\n")
}

fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '"' => escaped.push_str("\\\""),
            '\\' => escaped.push_str("\\\\"),
            '\n' => escaped.push_str("\\n"),
            '\r' => escaped.push_str("\\r"),
            '\t' => escaped.push_str("\\t"),
            // gettext treats it as the end of the string, as C does.
            '\0' => escaped.push_str("\\000"),
            _ => escaped.push(character),
        }
    }
    escaped
}

/// Returns the text between the quotes of a string, or the offset of the first invalid byte.
pub(super) fn unescaped(inner: &str) -> Result<String, usize> {
    // Escapes may be the bytes of a character, as `msgcat --escape` of gettext writes them.
    let mut text = Vec::with_capacity(inner.len());
    let mut rest = inner;
    while let Some(at) = rest.find(['\\', '"']) {
        let place = inner.len() - rest.len() + at;
        text.extend(rest.get(..at).unwrap_or_default().bytes());
        let escape = rest.get(at + 1..).unwrap_or_default();
        let (byte, length) = match escape.as_bytes().first().filter(|_| rest.as_bytes().get(at) == Some(&b'\\')) {
            Some(b'n') => (b'\n', 1),
            Some(b't') => (b'\t', 1),
            Some(b'r') => (b'\r', 1),
            Some(b'a') => (0x07, 1),
            Some(b'b') => (0x08, 1),
            Some(b'v') => (0x0b, 1),
            Some(b'f') => (0x0c, 1),
            Some(&byte @ (b'"' | b'\\' | b'\'' | b'?')) => (byte, 1),
            Some(b'0'..=b'7') => number(escape, 8, 3).ok_or(place)?,
            Some(b'x') => number(escape.get(1..).unwrap_or_default(), 16, 2).map(|(c, n)| (c, n + 1)).ok_or(place)?,
            _ => return Err(place),
        };
        text.push(byte);
        rest = escape.get(length..).unwrap_or_default();
    }
    text.extend(rest.bytes());
    String::from_utf8(text).map_err(|_| inner.find('\\').unwrap_or_default())
}

/// Returns the byte of a numeric escape, and the number of its digits.
fn number(digits: &str, radix: u32, most: usize) -> Option<(u8, usize)> {
    let length = digits.chars().take(most).take_while(|digit| digit.is_digit(radix)).count();
    let value = u8::try_from(u32::from_str_radix(digits.get(..length)?, radix).ok()?).ok()?;
    Some((value, length))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn escapes_are_those_of_c() {
        assert_eq!(unescaped(r#"a\"\\\n\t\x41\101\0é"#), Ok("a\"\\\n\tAA\0é".into()));
        assert_eq!(unescaped(r"ab\q"), Err(2));
        assert_eq!(unescaped(r"Sch\303\266n"), Ok("Schön".into()), "as `msgcat --escape` writes it");
        assert_eq!(unescaped(r"\377"), Err(0));
        assert_eq!(unescaped(r"\477"), Err(0), "more than a byte");
        assert_eq!(unescaped("a\"b"), Err(1));
        assert_eq!(unescaped("a\\"), Err(1));
        assert_eq!(literal("a\nb\n"), "\"\"\n\"a\\n\"\n\"b\\n\"");
        assert_eq!(literal("a\n"), "\"a\\n\"");
    }

    proptest! {
        #[test]
        fn every_text_comes_back(text in ".{0,20}|[\\\\\"\n\r\t\0x0-9]{0,12}") {
            let written = literal(&text);
            let inner: String = written.lines().map(|line| &line[1..line.len() - 1]).collect();
            prop_assert_eq!(unescaped(&inner), Ok(text));
        }
    }
}
