//! Pseudo-localisation: longer texts with many accents that are still readable, for testing screens and fonts before
//! there are translations.
//!
//! Unicode's CLDR defines the pseudo-locale `en-XA` for this. The conventions (accents, brackets, counting words) are
//! those of Android and ICU.

use crate::util::strings::Strings;

/// The growth of a text in percent, as in typical translations from English (W3C, "Text size in translation").
const GROWTH_PERCENT: usize = 40;

/// The padding of texts: if `two` is the last visible word, a reader can tell how much was cut off.
const PADDING: [&str; 10] = ["one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"];

/// Accented forms of `a` to `z`, then of `A` to `Z`.
const ACCENTED: &str = "åƀçðéƒĝĥîĵķļɱñöþǫŕšţûṽŵẋýžÅƁÇÐÉƑĜĤÎĴĶĻṀÑÖÞǪŔŠŢÛṼŴẊÝŽ";

/// Replaces the display texts of a clip with their pseudo-translations.
pub(crate) fn translate(displays: &mut Strings) {
    let translated: Vec<String> = displays.iter().map(pseudo).collect();
    displays.clear();
    translated.iter().for_each(|text| displays.push(text));
}

/// Returns the pseudo-translation of a display text: letters with accents, 40 % longer, in brackets. Text for programs
/// stays unchanged: placeholders in braces, tags, addresses. An empty text stays empty.
fn pseudo(text: &str) -> String {
    if text.is_empty() {
        return String::new();
    }
    let mut out = String::with_capacity(text.len() * 2);
    out.push('[');
    let (mut depth, mut kept_until, mut before) = (0_usize, 0, None);
    for (place, character) in text.char_indices() {
        match character {
            '{' => depth += 1,
            '}' => depth = depth.saturating_sub(1),
            '<' if place >= kept_until => kept_until = place + tag(&text[place..]),
            _ if place >= kept_until && before.is_none_or(ends_word) => {
                kept_until = place + address(&text[place..]);
            }
            _ => {}
        }
        out.push(if depth == 0 && place >= kept_until { accented(character) } else { character });
        before = Some(character);
    }
    let mut missing = (text.chars().count() * GROWTH_PERCENT).div_ceil(100);
    for word in PADDING.iter().cycle() {
        if missing == 0 {
            break;
        }
        out.push(' ');
        out.push_str(word);
        missing = missing.saturating_sub(word.len() + 1);
    }
    out.push(']');
    out
}

/// Returns the length in bytes of the tag at the start of the text, such as `<b>`, `</color>` or `<sprite="x"
/// name="y">`; 0 if the text does not start with a tag.
fn tag(text: &str) -> usize {
    let is_tag = text[1..].starts_with(|c: char| c.is_ascii_alphabetic() || c == '/');
    let end = text[1..].find(['<', '>', '\n']).map(|end| end + 1);
    end.filter(|end| is_tag && text[*end..].starts_with('>')).map_or(0, |end| end + 1)
}

/// Returns the length in bytes of the web or mail address at the start of the text, such as `https://…` or `www.…`; 0
/// if the text does not start with an address.
fn address(text: &str) -> usize {
    let word = text.find(ends_word).map_or(text, |end| &text[..end]);
    let is_scheme = |scheme: &str| !scheme.is_empty() && scheme.chars().all(|c| c.is_ascii_alphanumeric());
    let is_mail = |(name, host): (&str, &str)| {
        host.contains('.') && name.ends_with(char::is_alphanumeric) && host.starts_with(char::is_alphanumeric)
    };
    let is_address = word.split_once("://").is_some_and(|(scheme, _)| is_scheme(scheme))
        || word.starts_with("www.")
        || word.split_once('@').is_some_and(is_mail);
    if is_address { word.len() } else { 0 }
}

/// Whether this character ends an address, in which it cannot occur and which it cannot follow without a blank.
fn ends_word(character: char) -> bool {
    character.is_whitespace() || "<>\"{}()".contains(character)
}

fn accented(character: char) -> char {
    let place = match character {
        'a'..='z' => character as usize - 'a' as usize,
        'A'..='Z' => character as usize - 'A' as usize + 26,
        _ => return character,
    };
    ACCENTED.chars().nth(place).unwrap_or(character)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::pseudo_locale::{is_pseudo, locale_for};

    #[test]
    fn longer_accented_and_in_brackets() {
        assert_eq!(pseudo("Hello, Amy."), "[Ĥéļļö, Åɱý. one two]");
        assert_eq!(pseudo(""), "");
        assert_eq!(pseudo("いいえ。"), "[いいえ。 one]");
        for text in ["a", "No.", "Now, boys and girls, I'd like you to put away your readers."] {
            let (before, after) = (text.chars().count(), pseudo(text).chars().count());
            assert!(after * 100 >= before * (100 + GROWTH_PERCENT), "{text}");
            assert!(after <= before * 2 + 10, "{text}");
        }
    }

    #[test]
    fn placeholders_stay() {
        assert_eq!(pseudo("Take {count} of {max}"), "[Ţåķé {count} öƒ {max} one two three]");
        assert_eq!(pseudo("a } b"), "[å } ƀ one]");
    }

    #[test]
    fn tags_and_addresses_stay() {
        let pseudo = |text: &str| pseudo(text).split(" one").next().unwrap_or_default().to_owned();
        assert_eq!(pseudo("<b>Go</b> <color=#ff0>on</color>!"), "[<b>Ĝö</b> <color=#ff0>öñ</color>!");
        assert_eq!(pseudo("a < b, c > d"), "[å < ƀ, ç > ð");
        assert_eq!(pseudo("<b <i>x"), "[<ƀ <i>ẋ");
        assert_eq!(pseudo("See https://a.b/c?d=e (www.a.b)."), "[Šéé https://a.b/c?d=e (www.a.b).");
        assert_eq!(pseudo("Write to me@a-b.org, not to me @ home."), "[Ŵŕîţé ţö me@a-b.org, ñöţ ţö ɱé @ ĥöɱé.");
    }

    #[test]
    fn every_letter_has_one_accented_form() {
        let mut forms: Vec<char> = ('a'..='z').chain('A'..='Z').map(accented).collect();
        assert!(forms.iter().all(|form| form.is_alphabetic() && !form.is_ascii()));
        forms.sort_unstable();
        forms.dedup();
        assert_eq!((forms.len(), ACCENTED.chars().count()), (52, 52));
    }

    #[test]
    fn tags() {
        assert_eq!(locale_for("en-us"), "en-xa");
        assert!(is_pseudo("en-xa") && !is_pseudo("en-us"));
    }
}
