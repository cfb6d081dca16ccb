//! Numbers in words, according to the rules of CLDR (RBNF).
//!
//! `data/numbers/rules.txt` has sets of rules for each language (`@en`): `%0:` for numbers, `%1:` for years, `%2:` for
//! ordinals, and the sets to which these refer. A rule consists of the smallest number to which it applies, an optional
//! `/radix`, and a text. In the text, `<<` is the number divided by the greatest power of the radix (10) that is not
//! above that smallest number, `>>` the remainder, and `=%set=` the number by another set. Text in `[ ]` is omitted if
//! there is no remainder. <https://unicode.org/reports/tr35/tr35-numbers.html#Rule-Based_Number_Formatting>

use super::plural;
use std::collections::HashMap;
use std::sync::{LazyLock, OnceLock};

/// The largest number that is read as one. Larger ones are read digit by digit.
pub(super) const LARGEST: u64 = 999_999_999_999_999;
/// The maximum depth of recursion between rules. The rules in use need less.
const DEEPEST: usize = 64;
/// The set of rules for numbers.
const CARDINAL: &str = "%0";

static LANGUAGES: LazyLock<HashMap<&str, (&str, OnceLock<Rules>)>> = LazyLock::new(|| {
    let parts = include_str!("../../../data/numbers/rules.txt").split("\n@").skip(1);
    parts.filter_map(|part| part.split_once('\n')).map(|(code, text)| (code, (text, OnceLock::new()))).collect()
});

/// The use of a number in a text.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Use {
    Cardinal,
    Ordinal,
    Year,
}

/// The rules of one language.
#[derive(Debug)]
pub(super) struct Rules {
    code: &'static str,
    sets: HashMap<&'static str, Set>,
}

#[derive(Default, Debug)]
struct Set {
    /// Sorted by their smallest numbers.
    rules: Vec<Rule>,
    /// The word for a decimal mark.
    point: Option<&'static str>,
    minus: Option<&'static str>,
}

#[derive(Clone, Copy, Debug)]
struct Rule {
    smallest: u64,
    divisor: u64,
    text: &'static str,
}

/// Returns the rules of a language, or those of English if it has none.
pub(super) fn find(code: &str) -> Option<&'static Rules> {
    let (code, (text, rules)) = LANGUAGES.get_key_value(code).or_else(|| LANGUAGES.get_key_value("en"))?;
    Some(rules.get_or_init(|| Rules { code, sets: parse(text) }))
}

impl Rules {
    /// Returns a number in words, or `None` if the rules write it only in digits.
    pub(super) fn spell(&self, number: u64, how: Use) -> Option<String> {
        if number > LARGEST {
            return None;
        }
        let name = match how {
            Use::Cardinal => CARDINAL,
            Use::Ordinal => "%2",
            Use::Year => "%1",
        };
        let mut out = String::new();
        self.number(self.sets.get(name)?, number, &mut out, DEEPEST)?;
        let words: String = out.split_whitespace().collect::<Vec<_>>().join(" ");
        (!words.is_empty() && !words.contains(|c: char| c.is_ascii_digit())).then_some(words)
    }

    /// Returns the word for the decimal mark: *point*.
    pub(super) fn point(&self) -> &'static str {
        self.found(|set| set.point).unwrap_or_default()
    }

    /// Returns the word for a minus.
    pub(super) fn minus(&self) -> &'static str {
        self.found(|set| set.minus).unwrap_or_default()
    }

    /// Searches the set for numbers, and the sets to which it refers.
    fn found(&self, what: impl Fn(&Set) -> Option<&'static str>) -> Option<&'static str> {
        let mut set = self.sets.get(CARDINAL)?;
        for _ in 0..DEEPEST {
            if let Some(found) = what(set) {
                return Some(found);
            }
            let text = set.rules.first()?.text;
            set = self.sets.get(text.strip_prefix('=')?.strip_suffix('=')?)?;
        }
        None
    }

    fn number(&self, set: &Set, number: u64, out: &mut String, depth: usize) -> Option<()> {
        let depth = depth.checked_sub(1)?;
        let at = set.rules.partition_point(|rule| rule.smallest <= number).checked_sub(1)?;
        let mut rule = set.rules.get(at)?;
        // A rule with a remainder does not apply to numbers without one: 1,100 is not *eleven hundred and*.
        let has_rest = rule.text.contains('>');
        if has_rest && number.is_multiple_of(rule.divisor) && !rule.smallest.is_multiple_of(rule.divisor) {
            rule = at.checked_sub(1).and_then(|at| set.rules.get(at)).unwrap_or(rule);
        }
        self.text(set, rule, rule.text, number, out, depth)
    }

    /// Appends the text of a rule for a number.
    fn text(
        &self,
        set: &Set,
        rule: &Rule,
        text: &'static str,
        number: u64,
        out: &mut String,
        depth: usize,
    ) -> Option<()> {
        let (quotient, rest) = (number / rule.divisor, number % rule.divisor);
        let mut text = text;
        while let Some(at) = text.find(['<', '>', '=', '[', '$']) {
            out.push_str(&text[..at]);
            let mark = text.as_bytes().get(at).copied()?;
            let after = text.get(at + 1..)?;
            match mark {
                b'[' => {
                    let end = after.find(']')?;
                    if rest != 0 {
                        self.text(set, rule, after.get(..end)?, number, out, depth)?;
                    }
                    text = after.get(end + 1..)?;
                }
                b'$' => {
                    let end = after.find(")$")?;
                    out.push_str(plural::choose(self.code, quotient, after.get(..end)?));
                    text = after.get(end + 2..)?;
                }
                mark => {
                    let end = after.find(char::from(mark))?;
                    let name = after.get(..end)?;
                    let other = match name.starts_with('%') {
                        true => self.sets.get(name)?,
                        false => set,
                    };
                    let value = match mark {
                        b'<' => quotient,
                        b'>' => rest,
                        _ => number,
                    };
                    // `=#,##0=` writes digits.
                    if name.starts_with(['#', '0']) {
                        out.push_str(&value.to_string());
                    } else {
                        self.number(other, value, out, depth)?;
                    }
                    // `>>>` is `>>` without a certain rule, which does not matter here.
                    text = after.get(end + 1..)?;
                    text = if mark == b'>' && name.is_empty() { text.strip_prefix('>').unwrap_or(text) } else { text };
                }
            }
        }
        out.push_str(text);
        Some(())
    }
}

fn parse(text: &'static str) -> HashMap<&'static str, Set> {
    let mut sets: HashMap<&str, Set> = HashMap::new();
    let mut name = "";
    for line in text.lines() {
        if let Some(next) = line.strip_suffix(':').filter(|line| line.starts_with('%')) {
            name = next;
            continue;
        }
        let Some((descriptor, rule)) = line.split_once(':') else { continue };
        // An apostrophe preserves the spaces after it.
        let rule = rule.strip_prefix('\'').unwrap_or(rule);
        let set = sets.entry(name).or_default();
        match descriptor {
            "x.x" | "x,x" => set.point = set.point.or_else(|| between(rule)),
            "-x" => set.minus = Some(rule.split(['>', '=']).next().unwrap_or_default().trim()),
            _ => {
                let (smallest, radix) = descriptor.split_once('/').unwrap_or((descriptor, "10"));
                // Each `>` after the number selects the next smaller power.
                let plain = |text: &str| text.trim_end_matches('>').replace(',', "").parse::<u64>().ok();
                let (Some(smallest), Some(radix)) = (plain(smallest), plain(radix).filter(|radix| *radix > 1)) else {
                    continue;
                };
                let lower = descriptor.matches('>').count();
                set.rules.push(Rule { smallest, divisor: divisor(smallest, radix, lower), text: rule });
            }
        }
    }
    sets
}

/// Returns the text between the two parts of a decimal number.
fn between(rule: &'static str) -> Option<&'static str> {
    let (_, rest) = rule.strip_prefix('<')?.split_once('<')?;
    let (point, _) = rest.split_once('>')?;
    Some(point.trim()).filter(|point| !point.is_empty() && !point.contains('$'))
}

/// Returns the greatest power of the radix that is not above a number, `lower` steps smaller.
fn divisor(number: u64, radix: u64, lower: usize) -> u64 {
    let mut power = 1_u64;
    while let Some(next) = power.checked_mul(radix).filter(|next| *next <= number) {
        power = next;
    }
    (0..lower).fold(power, |power, _| (power / radix).max(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(code: &str, number: u64, how: Use) -> String {
        find(code).and_then(|rules| rules.spell(number, how)).unwrap_or_default().replace('\u{ad}', "")
    }

    #[test]
    fn numbers_in_words() {
        let cases = [
            ("en", 0, "zero"),
            ("en", 1_234_567, "one million two hundred thirty-four thousand five hundred sixty-seven"),
            ("de", 1_984, "eintausendneunhundertvierundachtzig"),
            ("fr", 91, "quatre-vingt-onze"),
            ("fr", 280, "deux cent quatre-vingts"),
            ("es", 521, "quinientos veintiuno"),
            ("it", 28, "ventotto"),
            ("pt", 1_101, "mil cento e um"),
            ("nl", 53, "drieenvijftig"),
            ("pl", 2_005, "dwa tysiące pięć"),
            ("pl", 5_000, "pięć tysięcy"),
            ("cs", 345, "tři sta čtyřicet pět"),
            ("fi", 21, "kaksikymmentäyksi"),
            ("ca", 22, "vint-i-dos"),
            ("ru", 2_041, "две тысячи сорок один"),
            ("tr", 1_999, "bin dokuz yüz doksan dokuz"),
            ("ja", 345, "三百四十五"),
            ("ko", 345, "삼백사십오"),
            ("zh", 10_305, "一万〇三百〇五"),
            ("sv", 99, "nittionio"),
            ("tlh", 7, "seven"),
        ];
        for (code, number, words) in cases {
            assert_eq!(said(code, number, Use::Cardinal).replace('ë', "e"), words, "{code} {number}");
        }
        assert_eq!(said("en", 1_984, Use::Year), "nineteen eighty-four");
        assert_eq!(said("en", 1_900, Use::Year), "nineteen hundred");
        assert_eq!(said("en", 2_005, Use::Year), "two thousand five");
        assert_eq!(said("de", 1_984, Use::Year), "neunzehnhundertvierundachtzig");
        assert_eq!(said("en", 23, Use::Ordinal), "twenty-third");
        assert_eq!(said("de", 3, Use::Ordinal), "dritte");
        assert_eq!(said("fr", 1, Use::Ordinal), "premier");
        assert_eq!(find("de").map(Rules::point), Some("Komma"));
        assert_eq!(find("fr").map(Rules::minus), Some("moins"));
    }

    #[test]
    fn every_language_has_words_for_all_numbers() {
        for code in LANGUAGES.keys() {
            for number in (0..=130).chain([199, 200, 999, 1_000, 1_001, 2_000, 10_000, 123_456, 1_000_000]) {
                assert!(!said(code, number, Use::Cardinal).is_empty(), "{code} {number}");
            }
            assert_eq!(said(code, LARGEST + 1, Use::Cardinal), "");
        }
    }
}
