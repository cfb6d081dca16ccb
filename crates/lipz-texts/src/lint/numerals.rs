//! Recognition of numbers in texts, with digits of any script and any grouping.

/// The zeros of all decimal digits (Unicode 16, `Nd`). Each is followed by the digits 1 to 9.
const ZEROS: [char; 66] = [
    '\u{30}',
    '\u{660}',
    '\u{6F0}',
    '\u{7C0}',
    '\u{966}',
    '\u{9E6}',
    '\u{A66}',
    '\u{AE6}',
    '\u{B66}',
    '\u{BE6}',
    '\u{C66}',
    '\u{CE6}',
    '\u{D66}',
    '\u{DE6}',
    '\u{E50}',
    '\u{ED0}',
    '\u{F20}',
    '\u{1040}',
    '\u{1090}',
    '\u{17E0}',
    '\u{1810}',
    '\u{1946}',
    '\u{19D0}',
    '\u{1A80}',
    '\u{1A90}',
    '\u{1B50}',
    '\u{1BB0}',
    '\u{1C40}',
    '\u{1C50}',
    '\u{A620}',
    '\u{A8D0}',
    '\u{A900}',
    '\u{A9D0}',
    '\u{A9F0}',
    '\u{AA50}',
    '\u{ABF0}',
    '\u{FF10}',
    '\u{104A0}',
    '\u{10D30}',
    '\u{11066}',
    '\u{110F0}',
    '\u{11136}',
    '\u{111D0}',
    '\u{112F0}',
    '\u{11450}',
    '\u{114D0}',
    '\u{11650}',
    '\u{116C0}',
    '\u{11730}',
    '\u{118E0}',
    '\u{11950}',
    '\u{11C50}',
    '\u{11D50}',
    '\u{11DA0}',
    '\u{16A60}',
    '\u{16AC0}',
    '\u{16B50}',
    '\u{1D7CE}',
    '\u{1D7D8}',
    '\u{1D7E2}',
    '\u{1D7EC}',
    '\u{1D7F6}',
    '\u{1E140}',
    '\u{1E2F0}',
    '\u{1E950}',
    '\u{1FBF0}',
];

/// The characters between the digits of a number in some language: thousands separators and decimal marks.
const SEPARATORS: [char; 6] = ['.', ',', '\u{66B}', '\u{66C}', '\u{FF0C}', '\u{FF0E}'];

/// The characters that are only thousands separators.
const THOUSANDS: [char; 6] = [' ', '\u{A0}', '\u{2009}', '\u{202F}', '\'', '\u{2019}'];

/// A number of a text.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Number {
    /// As in the text: `1.000,50`.
    pub(super) spelled: String,
    /// Without thousands separators: `1000.5`.
    pub(super) value: String,
}

/// Consecutive digits.
struct DigitRun {
    /// As in the text.
    spelled: String,
    /// In ASCII.
    digits: String,
    /// The character before these digits and after the previous ones, if there is exactly one.
    before: Option<char>,
}

fn all_runs(text: &str) -> Vec<DigitRun> {
    let mut runs: Vec<DigitRun> = Vec::new();
    let mut is_open = false;
    let mut between: Vec<char> = Vec::new();
    for character in text.chars() {
        let Some(digit) = digit(character) else {
            is_open = false;
            // Two characters suffice to rule out a single one.
            if between.len() < 2 {
                between.push(character);
            }
            continue;
        };
        if !is_open {
            let before = if let [only] = between.as_slice() { Some(*only).filter(|_| !runs.is_empty()) } else { None };
            runs.push(DigitRun { spelled: String::new(), digits: String::new(), before });
            between.clear();
            is_open = true;
        }
        if let Some(run) = runs.last_mut() {
            run.spelled.push(character);
            run.digits.push(digit);
        }
    }
    runs
}

/// Returns the ASCII digit of a character.
fn digit(character: char) -> Option<char> {
    if character.is_ascii() {
        return character.is_ascii_digit().then_some(character);
    }
    let at = ZEROS.partition_point(|zero| *zero <= character).checked_sub(1)?;
    let value = u32::from(character) - u32::from(*ZEROS.get(at)?);
    char::from_digit(value, 10)
}

/// Returns the runs of digits, sorted, without leading zeros.
pub(super) fn runs(text: &str) -> Vec<String> {
    let mut runs: Vec<String> = all_runs(text).into_iter().map(|run| without_zeros(&run.digits)).collect();
    runs.sort_unstable();
    runs
}

/// Returns the numbers of a text, in order.
pub(super) fn numbers(text: &str) -> Vec<Number> {
    let mut numbers = Vec::new();
    let mut open: Vec<DigitRun> = Vec::new();
    for run in all_runs(text) {
        let goes_on = open.last().is_some_and(|last| match run.before {
            Some(between) if THOUSANDS.contains(&between) => run.digits.len() == 3 && last.digits.len() <= 3,
            between => between.is_some_and(|between| SEPARATORS.contains(&between)),
        });
        if !goes_on {
            numbers.extend(number(&open));
            open.clear();
        }
        open.push(run);
    }
    numbers.extend(number(&open));
    numbers
}

/// Returns the number with these parts. Three digits after the last mark are thousands, others a fraction.
fn number(parts: &[DigitRun]) -> Option<Number> {
    let (last, before) = parts.split_last()?;
    let mut spelled = String::new();
    for (at, part) in parts.iter().enumerate() {
        spelled.extend(part.before.filter(|_| at > 0));
        spelled.push_str(&part.spelled);
    }
    let whole: String = before.iter().map(|part| part.digits.as_str()).collect();
    let value = match before.is_empty() || last.digits.len() == 3 {
        true => without_zeros(&(whole + &last.digits)),
        false => match last.digits.trim_end_matches('0') {
            "" => without_zeros(&whole),
            fraction => format!("{}.{fraction}", without_zeros(&whole)),
        },
    };
    Some(Number { spelled, value })
}

fn without_zeros(digits: &str) -> String {
    let rest = digits.trim_start_matches('0');
    if rest.is_empty() { "0".to_owned() } else { rest.to_owned() }
}

/// Whether a text contains a number as a Roman numeral.
pub(super) fn has_roman(text: &str, number: &Number) -> bool {
    let Some(roman) = number.value.parse().ok().and_then(roman) else { return false };
    text.split(|character: char| !character.is_alphanumeric()).any(|word| word == roman)
}

/// Returns the Roman numeral of a number from 1 to 3999.
fn roman(number: u16) -> Option<String> {
    const STEPS: [(u16, &str); 13] = [
        (1000, "M"),
        (900, "CM"),
        (500, "D"),
        (400, "CD"),
        (100, "C"),
        (90, "XC"),
        (50, "L"),
        (40, "XL"),
        (10, "X"),
        (9, "IX"),
        (5, "V"),
        (4, "IV"),
        (1, "I"),
    ];
    let mut rest = Some(number).filter(|number| (1..4000).contains(number))?;
    let mut roman = String::new();
    for (value, letters) in STEPS {
        while rest >= value {
            roman.push_str(letters);
            rest -= value;
        }
    }
    Some(roman)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zeros_ascend_and_do_not_overlap() {
        let gap = |pair: &[char]| u32::from(pair[1]) - u32::from(pair[0]);
        assert!(ZEROS.windows(2).all(|pair| gap(pair) >= 10));
        assert!(ZEROS.iter().all(|zero| zero.is_numeric()));
    }

    #[test]
    fn roman_numerals() {
        assert_eq!(roman(363).as_deref(), Some("CCCLXIII"));
        assert_eq!((roman(0), roman(4000)), (None, None));
    }
}
