//! Tests of numbers in their usual notations.

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

#[test]
fn units_behind_numbers() {
    let cases = [
        ("bg", "5 км", "5 км: пет километра"),
        ("ca", "1 km", "1 km: un quilòmetre"),
        ("cs", "2 Kč", "2 Kč: dva koruny"),
        ("cs", "3 s bratrem", "3: tři"),
        ("de", "5kg", "5kg: fünf Kilogramm"),
        ("de", "1 km/h", "1 km/h: ein Kilometer pro Stunde"),
        ("de", "20 °C", "20 °C: zwanzig Grad Celsius"),
        ("en", "5kg", "5kg: five kilograms"),
        ("en", "1 kg", "1 kg: one kilogram"),
        ("en", "-3 °F", "-3 °F: minus three degrees Fahrenheit"),
        ("en", "1.5 m", "1.5 m: one point five meters"),
        ("en", "5 men", "5: five"),
        ("es", "1 km", "1 km: un kilómetro"),
        ("fi", "2 m", "2 m: kaksi metriä"),
        ("fr", "3 l", "3 l: trois litres"),
        ("it", "1 kg", "1 kg: un chilogrammo"),
        ("ja", "5kg", "5kg: 五 キログラム"),
        ("ja", "60km/h", "60km/h: 時速 六十 キロメートル"),
        ("ko", "5kg", "5kg: 오킬로그램"),
        ("nl", "10 cm", "10 cm: tien centimeter"),
        ("pl", "2 kg", "2 kg: dwa kilogramy"),
        ("pl", "5 kg", "5 kg: pięć kilogramów"),
        ("pl", "22 zł", "22 zł: dwadzieścia dwa złote"),
        ("pt", "7 mm", "7 mm: sete milímetros"),
        ("ru", "21 км", "21 км: двадцать один километр"),
        ("ru", "5 с братом", "5: пять"),
        ("tr", "4 kg", "4 kg: dört kilogram"),
        ("uk", "5 грн", "5 грн: пʼять гривень"),
        ("zh", "5kg", "5kg: 五千克"),
        ("zh", "20°C", "20°C: 二十摄氏度"),
    ];
    let wrong: Vec<_> = cases.iter().map(|(code, text, expected)| (first(code, text), *expected)).collect();
    let wrong: Vec<_> = wrong.into_iter().filter(|(found, expected)| found != expected).collect();
    assert!(wrong.is_empty(), "{wrong:?}");
    assert_eq!(all("de", "5 kg").1, ["fünf Kilogramm", "fünf Kilo"]);
    assert_eq!(all("en", "20°C").1, ["twenty degrees Celsius", "twenty degrees"]);
    assert_eq!(all("zh", "5kg").1, ["五千克", "五公斤"]);
}

#[test]
fn korean_counts_with_its_own_numbers() {
    let cases = [
        ("3시", "세"),
        ("12시", "열두"),
        ("15시", "십오"),
        ("3시간", "세"),
        ("20개", "스무"),
        ("21 명", "스물한"),
        ("99살", "아흔아홉"),
        ("3개월", "삼"),
        ("3년", "삼"),
        ("100개", "백"),
        ("2번", "두"),
        ("31번", "삼십일"),
        ("3:30", "세 시 삼십"),
    ];
    for (text, words) in cases {
        let digits: String = text.chars().take_while(|c| c.is_ascii_digit() || *c == ':').collect();
        assert_eq!(first("ko", text), format!("{digits}: {words}"), "{text}");
    }
    assert_eq!(all("ko", "31번").1, ["삼십일", "서른한"]);
}

#[test]
fn days_are_ordinals() {
    assert_eq!(all("de", "3. Mai").1, ["dritte", "dritten", "drei"]);
    assert_eq!(all("de", "3. Dann").1, ["drei", "dritte", "dritten"]);
    assert_eq!(all("de", "19. Jahrhundert").1[0], "neunzehnte");
    assert_eq!(first("fi", "3. toukokuuta"), "3: kolmas");
    assert_eq!(first("en", "3 May"), "3: third");
    assert_eq!(first("en", "40 May"), "40: forty");
    let behind = |text: &str, at| spelled("en", text, at).map(|found| found.readings).unwrap_or_default();
    assert_eq!(behind("May 3", 4), ["third", "three"]);
    assert_eq!(behind("may 3", 4), ["three"]);
    assert_eq!(behind("May 3 kg", 4)[0], "three kilograms");
}

#[test]
fn years_are_said_digit_by_digit_in_mandarin() {
    assert!(all("zh", "2024年").1.contains(&"二 〇 二 四".to_owned()), "{:?}", all("zh", "2024年").1);
}
