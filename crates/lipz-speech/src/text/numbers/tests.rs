//! Numbers as people write them.

use super::*;

fn all(code: &str, text: &str) -> (String, Vec<String>) {
    let found = spelled(code, text, 0).unwrap_or(Spelling { length: 0, readings: Vec::new() });
    (text[..found.length].to_owned(), found.readings.iter().map(|reading| reading.replace('\u{ad}', "")).collect())
}

fn first(code: &str, text: &str) -> String {
    let (used, readings) = all(code, text);
    format!("{used}: {}", readings.first().cloned().unwrap_or_default())
}

#[test]
fn english_numbers() {
    let cases = [
        ("5 men", "5: five"),
        ("1,234 men", "1,234: one thousand two hundred thirty-four"),
        ("3.14 is", "3.14: three point one four"),
        ("1984.", "1984: nineteen eighty-four"),
        ("1980s", "1980s: nineteen eighties"),
        ("3rd", "3rd: third"),
        ("50%", "50%: fifty percent"),
        ("50 %", "50 %: fifty percent"),
        ("$1", "$1: one dollar"),
        ("$2.50", "$2.50: two dollars fifty"),
        ("-3 ", "-3: minus three"),
        ("10:30", "10:30: ten thirty"),
        ("7:05", "7:05: seven oh five"),
        ("12:00", "12:00: twelve o'clock"),
        ("007", "007: zero zero seven"),
        (
            "12345678901234567890",
            "12345678901234567890: one two three four five six seven eight nine zero one two three four five six seven eight nine zero",
        ),
        ("٣", "٣: three"),
        ("&", "&: and"),
        ("VIII", "VIII: eight"),
        ("10, 20", "10: ten"),
        ("3D", ": "),
        ("", ": "),
        ("x", ": "),
    ];
    for (text, expected) in cases {
        assert_eq!(first("en", text), expected, "{text}");
    }
    assert_eq!(
        all("en", "1984").1,
        ["nineteen eighty-four", "one thousand nine hundred eighty-four", "one nine eight four"]
    );
    assert_eq!(all("en", "II").1, ["two", "the second", "second", "ii"]);
}

#[test]
fn numbers_of_other_languages() {
    let cases = [
        ("de", "1.234,5", "1.234,5: eintausendzweihundertvierunddreißig Komma fünf"),
        ("de", "3. mal", "3: dritte"),
        ("de", "3. Dann", "3: drei"),
        ("de", "10:30", "10:30: zehn Uhr dreißig"),
        ("de", "5 €", "5 €: fünf Euro"),
        ("fr", "1 234 567", "1 234 567: un million deux cent trente-quatre mille cinq cent soixante-sept"),
        ("fr", "1er", "1er: premier"),
        ("fr", "2\u{a0}%", "2\u{a0}%: deux pour cent"),
        ("es", "1º", "1º: primero"),
        ("it", "3,5", "3,5: tre virgola cinque"),
        ("pl", "2 000", "2 000: dwa tysiące"),
        ("ru", "21", "21: двадцать один"),
        ("zh", "50%", "50%: 百分之 五十"),
        ("ja", "3年", "3: 三"),
        ("hi", "५", "५: पाँच"),
    ];
    for (code, text, expected) in cases {
        assert_eq!(first(code, text), expected, "{code} {text}");
    }
}
