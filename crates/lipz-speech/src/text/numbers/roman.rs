//! Roman numerals up to 39: `Henry VIII`, `Act II`.

/// Reads the numeral at the start of a text, which must have at least two letters. Returns its length in bytes and its
/// value.
pub(super) fn read(text: &str) -> Option<(usize, u64)> {
    let length = text.find(|c: char| !c.is_alphanumeric()).unwrap_or(text.len());
    let numeral = text.get(..length).filter(|numeral| (2..=7).contains(&numeral.len()))?;
    let tens = numeral.bytes().take_while(|byte| *byte == b'X').count();
    let ones = numeral.get(tens..)?;
    let value = ["", "I", "II", "III", "IV", "V", "VI", "VII", "VIII", "IX"].iter().position(|all| *all == ones)?;
    (tens <= 3).then_some((length, u64::try_from(10 * tens + value).ok()?))
}

#[cfg(test)]
mod tests {
    use super::read;

    #[test]
    fn numerals_are_written_as_romans_did() {
        for (text, value) in
            [("II", Some(2)), ("IV.", Some(4)), ("VIII and", Some(8)), ("XXXIX", Some(39)), ("XX", Some(20))]
        {
            assert_eq!(read(text).map(|found| found.1), value, "{text}");
        }
        for text in ["I", "V", "IIII", "VX", "XXXX", "IVa", "ii", "", "IIé"] {
            assert_eq!(read(text), None, "{text}");
        }
    }
}
