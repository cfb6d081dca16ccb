//! Numbers and signs in words: cardinals, ordinals, years, decimals, money, percentages, times of day.

mod counters;
mod dates;
mod plural;
mod roman;
mod rules;
mod signs;
mod units;

use super::Spelling;
use rules::{LARGEST, Rules, Use};

/// Spaces and apostrophes that group digits.
const GROUPING: [char; 5] = [' ', '\u{a0}', '\u{2009}', '\u{202f}', '’'];
/// Currency signs.
const MONEY: [char; 6] = ['€', '$', '£', '¥', '₽', '₺'];
/// The range of numbers that may be years.
const YEARS: std::ops::RangeInclusive<u64> = 1_100..=2_099;
/// Numbers with more digits are read digit by digit.
const MOST_DIGITS: usize = 15;

/// A number in a text.
#[derive(Default, Debug)]
struct FoundNumber {
    /// The digits before the decimal mark, and after it.
    whole: String,
    decimals: String,
    grouped: bool,
    /// Where the number ends.
    end: usize,
}

/// Returns a one-character fraction in words, with the word of its language or as two numbers.
fn fraction(code: &str, rules: &Rules, c: char) -> Option<String> {
    if let Some(word) = signs::word(code, c, false) {
        return Some(word.to_owned());
    }
    let plain = any_ascii::any_ascii_char(c);
    let (above, below) = plain.split_once('/').filter(|_| c.is_numeric())?;
    Some(format!("{} {}", cardinal(rules, above.trim())?, cardinal(rules, below.trim())?))
}

/// Returns the number or sign that begins at `at`, with all its readings.
pub(crate) fn spelled(code: &str, text: &str, at: usize) -> Option<Spelling> {
    let rest = text.get(at..)?;
    let before = text.get(..at)?.chars().next_back();
    let first = rest.chars().next()?;
    let spelling =
        |end: usize, readings: Vec<String>| (!readings.is_empty()).then_some(Spelling { length: end, readings });
    if matches!(first, 'I' | 'V' | 'X') {
        let (length, value) = roman::read(rest)?;
        return spelling(length, roman_readings(code, value, rest.get(..length)?));
    }
    let rules = rules::find(code)?;
    // `-5` and `$5`, but not `4-5`.
    let mut start = 0;
    let mut minus = false;
    if matches!(first, '-' | '−') && before.is_none_or(|c| c.is_whitespace() || c == '(') {
        minus = true;
        start = first.len_utf8();
    }
    let money = rest.get(start..)?.chars().next().filter(|c| MONEY.contains(c));
    start += money.map_or(0, char::len_utf8);
    if let Some(found) = number(code, rest, start) {
        // In a word such as `3D`, the digit is not a number.
        let (end, mut readings) = readings(code, rules, rest, &found, money)?;
        let day = found.whole.parse().ok().filter(|_| end == found.end && found.decimals.is_empty());
        if let Some(ordinal) = day.filter(|day| dates::is_behind_month(code, text.get(..at).unwrap_or_default(), *day))
        {
            readings.splice(0..0, rules.spell(ordinal, Use::Ordinal));
        }
        if minus {
            readings.iter_mut().for_each(|reading| *reading = format!("{} {reading}", rules.minus()));
        }
        return spelling(end, readings);
    }
    if let Some(words) = fraction(code, rules, first).filter(|_| first.is_numeric()) {
        return spelling(first.len_utf8(), vec![words]);
    }
    let is_sign = matches!(first, '&' | '+' | '=' | '@' | '%' | '§') && start == 0;
    let word = signs::word(code, first, false).filter(|_| is_sign)?;
    spelling(first.len_utf8(), vec![word.to_owned()])
}

/// Returns the readings of a row of digits: as a number if it is short, otherwise digit by digit.
pub(crate) fn row(code: &str, digits: &str) -> Vec<String> {
    let Some(rules) = rules::find(code) else { return Vec::new() };
    let digits: String = any_ascii::any_ascii(digits).chars().filter(char::is_ascii_digit).collect();
    let whole = (digits.len() <= 4).then(|| cardinal(rules, &digits)).flatten();
    whole.or_else(|| one_by_one(rules, &digits)).into_iter().collect()
}

/// Returns the ASCII digit for a digit of any script.
fn digit(c: char) -> Option<char> {
    if c.is_ascii_digit() {
        return Some(c);
    }
    let plain = any_ascii::any_ascii_char(c);
    plain.chars().next().filter(|digit| c.is_numeric() && plain.len() == 1 && digit.is_ascii_digit())
}

/// Returns the digits at `start`, with grouping and decimals.
fn number(code: &str, text: &str, start: usize) -> Option<FoundNumber> {
    let (group, decimal) = if signs::has_decimal_point(code) { (',', '.') } else { ('.', ',') };
    let mut found = FoundNumber { end: start, ..FoundNumber::default() };
    let digits = |from: usize| -> (String, usize) {
        let rest = text.get(from..).unwrap_or_default();
        let digits: Vec<(char, usize)> = rest.chars().map_while(|c| Some((digit(c)?, c.len_utf8()))).collect();
        (digits.iter().map(|(digit, _)| digit).collect(), digits.iter().map(|(_, length)| length).sum())
    };
    let (whole, length) = digits(start);
    if whole.is_empty() {
        return None;
    }
    found.whole = whole;
    found.end += length;
    // Groups of three, all with the same mark.
    let mut mark = None;
    while found.whole.len() <= MOST_DIGITS && (found.grouped || found.whole.len() <= 3) {
        let Some(next) = text.get(found.end..).and_then(|rest| rest.chars().next()) else { break };
        let groups = mark
            .map_or(next == group || GROUPING.contains(&next) && (next != ' ' || group == '.'), |mark| mark == next);
        let (three, length) = digits(found.end + next.len_utf8());
        if !groups || three.len() != 3 || found.whole.starts_with('0') {
            break;
        }
        (mark, found.grouped) = (Some(next), true);
        found.whole.push_str(&three);
        found.end += next.len_utf8() + length;
    }
    let next = text.get(found.end..).and_then(|rest| rest.chars().next());
    if next.is_some_and(|c| c == decimal || c == group && !found.grouped) {
        let (decimals, length) = digits(found.end + 1);
        if !decimals.is_empty() {
            found.decimals = decimals;
            found.end += 1 + length;
        }
    }
    Some(found)
}

/// Returns all readings of a number with adjacent signs, and the end of these, or `None` if the number is part of a
/// word.
fn readings(
    code: &str,
    rules: &Rules,
    text: &str,
    found: &FoundNumber,
    money: Option<char>,
) -> Option<(usize, Vec<String>)> {
    let rest = text.get(found.end..)?;
    if found.decimals.is_empty() && !found.grouped && money.is_none() {
        if let Some((length, reading)) = time(code, rules, &found.whole, rest) {
            return Some((found.end + length, vec![reading]));
        }
        if let Some((length, readings)) = with_suffix(code, rules, &found.whole, rest) {
            return Some((found.end + length, readings));
        }
    }
    if let Some(unit) = units::find(code, rest).filter(|_| money.is_none()) {
        return Some((found.end + unit.length, with_unit(code, rules, found, &unit)));
    }
    if rest.starts_with(char::is_alphabetic) && !rest.starts_with(|c: char| super::writing(c).stands_alone()) {
        return None;
    }
    let mut all = plain(rules, found);
    let one = found.whole == "1" && found.decimals.is_empty();
    // After the number, with or without a space: percent, degrees, money.
    let blank = rest.chars().next().filter(|c| GROUPING[..4].contains(c)).map_or(0, char::len_utf8);
    let behind = rest.get(blank..).and_then(|rest| rest.chars().next());
    let sign = behind.filter(|c| matches!(c, '%' | '°') || MONEY.contains(c) && money.is_none());
    let word = money.or(sign).and_then(|sign| signs::word(code, sign, one));
    let end = found.end + if money.is_none() && word.is_some() { blank + sign.map_or(0, char::len_utf8) } else { 0 };
    if let Some(word) = word {
        // In Chinese and Turkish, percent precedes the number.
        let leads = sign == Some('%') && matches!(code, "zh" | "tr");
        let with = |number: &String| if leads { format!("{word} {number}") } else { format!("{number} {word}") };
        all = all.iter().map(with).collect();
        if let (Some(cents), true) = (cents(rules, found), sign != Some('%') && sign != Some('°')) {
            let whole = cardinal(rules, &found.whole)?;
            let word = signs::word(code, money.or(sign)?, found.whole == "1")?;
            all.insert(0, format!("{whole} {word} {cents}"));
        }
    } else if found.decimals.is_empty() && !found.grouped {
        let value = found.whole.parse().ok();
        if let Some((native, is_likely)) =
            value.filter(|_| code == "ko").and_then(|value| counters::native(value, rest))
        {
            all.insert(if is_likely { 0 } else { all.len() }, native);
        }
        let ordinal = dates::ordinal(code, rest, value).zip(spell(rules, &found.whole, Use::Ordinal));
        if let Some((is_likely, ordinal)) = ordinal {
            let at = if is_likely { 0 } else { all.len() };
            all.splice(at..at, dates::forms(code, ordinal));
        }
    }
    Some((end, all))
}

/// Returns all readings of a number with its unit.
fn with_unit(code: &str, rules: &Rules, found: &FoundNumber, unit: &units::MeasureUnit) -> Vec<String> {
    let one = found.whole == "1" && found.decimals.is_empty();
    let numbers = plain(rules, found);
    // The number one has a different form before a noun: `ein Kilo`.
    let before_noun = |words: &String| match (code, one) {
        ("de", true) => "ein".to_owned(),
        ("ca" | "es" | "it", true) => "un".to_owned(),
        _ => words.clone(),
    };
    let value = found.whole.parse().ok().filter(|_| found.decimals.is_empty());
    let degrees = signs::word(code, '°', one).filter(|_| unit.is_of_degrees).map(|word| format!("# {word}"));
    let names: Vec<String> = unit.names(value).map(str::to_owned).chain(degrees).collect();
    let with = |words: String| names.iter().map(move |name| name.replace('#', &words));
    numbers.iter().map(before_noun).flat_map(with).collect()
}

/// Returns the readings of a number alone.
fn plain(rules: &Rules, found: &FoundNumber) -> Vec<String> {
    let digits = || one_by_one(rules, &found.whole);
    let Some(whole) = cardinal(rules, &found.whole) else { return digits().into_iter().collect() };
    if !found.decimals.is_empty() {
        let point = rules.point();
        let with = |decimals: String| format!("{whole} {point} {decimals}");
        let single = one_by_one(rules, &found.decimals).map(with);
        let together = (found.decimals.len() > 1 && !found.decimals.starts_with('0'))
            .then(|| cardinal(rules, &found.decimals).map(with))
            .flatten();
        return single.into_iter().chain(together).collect();
    }
    let mut all = vec![whole];
    let value: Option<u64> = found.whole.parse().ok();
    let is_year = value.is_some_and(|value| YEARS.contains(&value)) && !found.grouped && found.whole.len() == 4;
    let year = is_year.then(|| spell(rules, &found.whole, Use::Year)).flatten().filter(|year| !all.contains(year));
    if let Some(year) = year {
        all.insert(0, year);
    }
    if (3..=4).contains(&found.whole.len()) && !found.grouped {
        all.extend(digits());
    }
    all
}

/// Returns the reading of a valid time of day, such as `10:30`.
fn time(code: &str, rules: &Rules, hours: &str, rest: &str) -> Option<(usize, String)> {
    let minutes = rest.strip_prefix(':')?.get(..2)?;
    let more = rest.get(3..)?.starts_with(|c: char| c.is_alphanumeric());
    let fits = |text: &str, most: u64| text.len() <= 2 && text.parse::<u64>().is_ok_and(|value| value <= most);
    if more || !fits(hours, 24) || !minutes.bytes().all(|byte| byte.is_ascii_digit()) || !fits(minutes, 59) {
        return None;
    }
    let native = hours.parse().ok().filter(|hour| code == "ko" && (1..=12).contains(hour)).and_then(counters::words);
    let hour = native.or_else(|| cardinal(rules, hours.trim_start_matches('0'))).or_else(|| cardinal(rules, "0"))?;
    let between = signs::word(code, ':', false).unwrap_or_default();
    let minute = match minutes {
        "00" if code == "en" => "o'clock".to_owned(),
        "00" => String::new(),
        minutes if code == "en" && minutes.starts_with('0') => format!("oh {}", cardinal(rules, &minutes[1..])?),
        minutes => cardinal(rules, minutes.trim_start_matches('0'))?,
    };
    let between = if minute.is_empty() && matches!(code, "es" | "it" | "pt") { "" } else { between };
    let parts = [hour.as_str(), between, minute.as_str()];
    Some((3, parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" ")))
}

/// Returns the readings of `3rd`, `2e`, `1º`, and in English `1980s`.
fn with_suffix(code: &str, rules: &Rules, digits: &str, rest: &str) -> Option<(usize, Vec<String>)> {
    let letters = rest.find(|c: char| !c.is_alphabetic() && c != '°').unwrap_or(rest.len());
    let suffix = rest.get(..letters).filter(|suffix| !suffix.is_empty())?;
    let ordinals: &[&str] = match code {
        "en" => &["st", "nd", "rd", "th"],
        "fr" => &["er", "re", "ère", "e", "ème", "nd", "nde"],
        "nl" => &["e", "de", "ste"],
        "ca" => &["r", "n", "t", "è", "a"],
        "es" | "it" | "pt" => &["º", "ª", "°", "o", "a"],
        "sv" => &["a", "e"],
        _ => &[],
    };
    if ordinals.contains(&suffix.to_lowercase().as_str()) {
        return Some((letters, vec![spell(rules, digits, Use::Ordinal)?]));
    }
    if code == "en" && suffix == "s" && digits.ends_with('0') && digits.len() > 1 {
        let how = if digits.len() == 4 { Use::Year } else { Use::Cardinal };
        let words = spell(rules, digits, how)?;
        let plural = words.strip_suffix('y').map_or_else(|| format!("{words}s"), |words| format!("{words}ies"));
        return Some((letters, vec![plural]));
    }
    None
}

/// Returns the decimals of an amount of money, if they are cents.
fn cents(rules: &Rules, found: &FoundNumber) -> Option<String> {
    let cents = found.decimals.trim_start_matches('0');
    (found.decimals.len() == 2 && !cents.is_empty()).then(|| cardinal(rules, cents)).flatten()
}

/// Whether the whole text is a Roman numeral: `III`.
pub(crate) fn is_roman(text: &str) -> bool {
    roman::read(text).is_some_and(|(length, _)| length == text.len())
}

fn roman_readings(code: &str, value: u64, written: &str) -> Vec<String> {
    let Some(rules) = rules::find(code) else { return Vec::new() };
    let digits = value.to_string();
    let ordinal = spell(rules, &digits, Use::Ordinal);
    let the = ordinal.clone().filter(|_| code == "en").map(|ordinal| format!("the {ordinal}"));
    let mut all: Vec<String> = cardinal(rules, &digits).into_iter().chain(the).chain(ordinal).collect();
    all.push(written.to_lowercase());
    all
}

fn spell(rules: &Rules, digits: &str, how: Use) -> Option<String> {
    let value: u64 = digits.parse().ok().filter(|value| *value <= LARGEST)?;
    rules.spell(value, how)
}

/// Returns a number in words. With leading zeros, it is read digit by digit.
fn cardinal(rules: &Rules, digits: &str) -> Option<String> {
    let plain = digits.len() == 1 || !digits.starts_with('0');
    plain.then(|| spell(rules, digits, Use::Cardinal)).flatten()
}

fn one_by_one(rules: &Rules, digits: &str) -> Option<String> {
    let words: Option<Vec<String>> =
        digits.chars().map(|digit| spell(rules, digit.encode_utf8(&mut [0; 4]), Use::Cardinal)).collect();
    words.map(|words| words.join(" ")).filter(|words| !words.is_empty())
}

#[cfg(test)]
mod tests;
