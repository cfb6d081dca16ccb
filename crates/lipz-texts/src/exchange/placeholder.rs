//! Placeholders and other `{meta}` of a text, which its translation should contain as well.

use lipz_diagnostics::escape;
use lipz_file::emotion::{Blend, preset};
use lipz_file::placeholder::PlaceholderPattern;
use lipz_file::text::{is_white_space, meta as meta_places, trim};
use std::cmp::Reverse;
use std::ops::Range;

/// The help for placeholders that differ.
pub(crate) const HELP: &str = "repeat placeholders as in the source, for games and actors";

/// The help for other meta that differ.
pub(crate) const META_HELP: &str = "repeat it; you may translate the part after `:`, and notes for people";

/// A part of a text: a placeholder, or the text between placeholders.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum TextPart<'t> {
    Text(&'t str),
    Placeholder(&'t str),
}

/// Returns the parts of a text in order, without empty ones.
pub(crate) fn parts(text: &str) -> Vec<TextPart<'_>> {
    let mut parts = Vec::new();
    let mut done = 0;
    for place in meta_places(text) {
        let before = text.get(done..place.start).unwrap_or_default();
        parts.extend((!before.is_empty()).then_some(TextPart::Text(before)));
        parts.extend(text.get(place.clone()).map(TextPart::Placeholder));
        done = place.end;
    }
    let rest = text.get(done..).unwrap_or_default();
    parts.extend((!rest.is_empty()).then_some(TextPart::Text(rest)));
    parts
}

/// The purpose of a meta.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum Meta<'t> {
    /// `{name}`, which a game replaces or evaluates.
    Placeholder(&'t str),
    /// `{to: amy}`, identified by its name. The part after the colon may be translated.
    Named(&'t str),
    /// `%s` or `$name`, which some engines replace, or a placeholder of the project.
    Engine(&'t str),
    /// `{very loud, then calm}`, a note for people, which may be translated.
    Note,
}

/// Returns the purposes of all meta in a text, sorted, because their order may change with the language. Emotions are
/// excluded, because they depend on the voice.
fn metas<'t>(text: &'t str, own: &[PlaceholderPattern]) -> Vec<Meta<'t>> {
    let meta = |place: Range<usize>| {
        let whole = text.get(place)?;
        let inner = trim(whole.get(1..whole.len().checked_sub(1)?)?);
        let is_emotion = Blend::parse(inner, 0)
            .is_some_and(|blend| blend.has_value() || blend.terms.iter().all(|term| preset(term.name.text).is_some()));
        match inner.split_once(':') {
            _ if is_emotion => None,
            Some((name, value)) if value.starts_with(is_white_space) && !name.contains(is_white_space) => {
                Some(Meta::Named(name))
            }
            _ if inner.contains(is_white_space) => Some(Meta::Note),
            _ => Some(Meta::Placeholder(whole)),
        }
    };
    let places = meta_places(text);
    let mut all: Vec<Meta<'_>> = of_project(text, own, &places).into_iter().map(Meta::Engine).collect();
    all.extend(places.into_iter().filter_map(meta));
    all.sort_unstable();
    all
}

/// Returns the placeholders of engines, and those of the project outside the braces at `places`. Of those that overlap, the first counts, and then the longest.
fn of_project<'t>(text: &'t str, own: &[PlaceholderPattern], places: &[Range<usize>]) -> Vec<&'t str> {
    let is_in_braces = |one: &Range<usize>| {
        let after = places.partition_point(|place| place.start <= one.start);
        after.checked_sub(1).and_then(|at| places.get(at)).is_some_and(|place| one.end <= place.end)
    };
    let of_patterns = own.iter().flat_map(|pattern| pattern.find(text)).filter(|one| !is_in_braces(one));
    let mut all: Vec<Range<usize>> = engine_placeholders(text).chain(of_patterns).collect();
    all.sort_unstable_by_key(|one| (one.start, Reverse(one.end)));
    let mut end = 0;
    all.retain(|one| {
        let is_apart = one.start >= end;
        end = end.max(one.end);
        is_apart
    });
    all.into_iter().filter_map(|place| text.get(place)).collect()
}

/// Returns the places of placeholders of `printf` (`%s`, `%2$d`) and variables (`$name`), in order.
fn engine_placeholders(text: &str) -> impl Iterator<Item = Range<usize>> {
    let is_word = |character: char| character.is_alphanumeric() || character == '_';
    text.match_indices(['%', '$']).filter_map(move |(start, sign)| {
        let rest = text.get(start + 1..)?;
        let length = if sign == "$" {
            let length = rest.find(|character| !is_word(character)).unwrap_or(rest.len());
            rest.starts_with(|first: char| first.is_ascii_alphabetic() || first == '_').then_some(length)?
        } else {
            let digits = rest.len() - rest.trim_start_matches(|digit: char| digit.is_ascii_digit()).len();
            let number = rest.get(digits..)?.strip_prefix('$').filter(|_| digits > 0).map_or(0, |_| digits + 1);
            let kind = rest.get(number..)?;
            let is_alone = !kind.get(1..)?.starts_with(is_word);
            (kind.starts_with(['s', 'd', 'i', 'u', 'f']) && is_alone).then_some(number + 1)?
        };
        // A sign after a word is a unit or a price: `US$`.
        let is_first = !text.get(..start)?.ends_with(is_word);
        is_first.then_some(start..start + 1 + length)
    })
}

/// Whether all placeholders of a text are also in `whole`.
pub(crate) fn are_among(text: &str, whole: &str, own: &[PlaceholderPattern]) -> bool {
    let is_checked = |meta: &Meta<'_>| !matches!(meta, Meta::Named(_) | Meta::Note);
    let known = metas(whole, own);
    metas(text, own).into_iter().filter(is_checked).all(|meta| known.contains(&meta))
}

/// Whether a text has placeholders that are all plain names or numbers, `{name}` and `{0}`, and no other braces.
pub(crate) fn are_plain(text: &str) -> bool {
    let is_word = |character: char| character.is_ascii_alphanumeric() || character == '_';
    let is_name = |name: &str| {
        let is_number = name.chars().all(|character| character.is_ascii_digit());
        is_number || !name.starts_with(|first: char| first.is_ascii_digit()) && name.chars().all(is_word)
    };
    let places = meta_places(text);
    let braces = text.chars().filter(|character| matches!(character, '{' | '}')).count();
    let metas = metas(text, &[]);
    let plain = metas.iter().filter(|meta| match meta {
        Meta::Placeholder(whole) => whole.get(1..whole.len() - 1).is_some_and(|name| !name.is_empty() && is_name(name)),
        Meta::Named(_) | Meta::Engine(_) | Meta::Note => false,
    });
    !places.is_empty() && plain.count() == places.len() && braces == 2 * places.len()
}

/// Returns the difference between the placeholders of a translation and its source; `None` if they are the same.
///
/// Lost placeholders occur less often in the translation, added ones more often. `own` are the patterns of the project.
pub(crate) fn difference(source: &str, text: &str, own: &[PlaceholderPattern]) -> Option<String> {
    said([source, text].map(|text| metas(text, own)), |meta| match meta {
        Meta::Placeholder(whole) | Meta::Engine(whole) => Some(escape::quoted(whole).to_string()),
        Meta::Named(_) | Meta::Note => None,
    })
}

/// Returns the same for other meta: those with a name, by name, and the number of notes for people.
pub(crate) fn meta_difference(source: &str, text: &str) -> Option<String> {
    said([source, text].map(|text| metas(text, &[])), |meta| match meta {
        Meta::Placeholder(_) | Meta::Engine(_) => None,
        Meta::Named(name) => Some(format!("`{{{}: …}}`", escape::text(name))),
        Meta::Note => Some("a note `{…}`".to_owned()),
    })
}

/// Returns the difference between the meta for which `shown` returns a text.
fn said([source, text]: [Vec<Meta<'_>>; 2], shown: impl Fn(&Meta<'_>) -> Option<String>) -> Option<String> {
    let list = |all: Vec<Meta<'_>>| all.iter().filter_map(&shown).collect::<Vec<_>>().join(", ");
    let (lost, added) = (list(without(&source, &text)), list(without(&text, &source)));
    match (lost.is_empty(), added.is_empty()) {
        (true, true) => None,
        (false, true) => Some(format!("the translation lacks {lost}")),
        (true, false) => Some(format!("the translation has {added}, but its source does not")),
        (false, false) => Some(format!("the translation has {added} instead of {lost}")),
    }
}

/// Returns the elements of `all`, which is sorted, that occur less often in `others`.
fn without<'t>(all: &[Meta<'t>], others: &[Meta<'_>]) -> Vec<Meta<'t>> {
    let mut others = others.iter().peekable();
    let mut rest = Vec::new();
    for one in all {
        while others.next_if(|other| *other < one).is_some() {}
        if others.next_if(|other| *other == one).is_none() {
            rest.push(*one);
        }
    }
    rest
}

#[cfg(test)]
mod tests {
    use super::*;

    fn difference(source: &str, text: &str) -> Option<String> {
        super::difference(source, text, &[])
    }

    #[test]
    fn placeholders_of_a_project_are_compared_too() {
        let own = ["[item:*]", "{0}*"].map(|pattern| pattern.parse().unwrap());
        let german = |text: &str| super::difference("Take [item:lamp] to {0}, $who.", text, &own);
        assert_eq!(german("Bring $who [item:lamp] für {0}."), None);
        let expected = "the translation has `[item:Lampe]` instead of `[item:lamp]`";
        assert_eq!(german("Bring $who [item:Lampe] für {0}.").as_deref(), Some(expected));
        assert_eq!(german("Bring [item:lamp], $who.").as_deref(), Some("the translation lacks `{0}`"));
        // Placeholders in braces belong to these, and overlapping ones count once.
        let own = ["[item:*]", "[*]", "$*"].map(|pattern| pattern.parse().unwrap());
        let lost = super::difference("[item:{0}] [item:lamp] $who", "[ding:{0}]", &own);
        assert_eq!(
            lost.as_deref(),
            Some("the translation has `[ding:{0}]` instead of `$who`, `[item:lamp]`, `[item:{0}]`")
        );
    }

    #[test]
    fn placeholders_count_and_their_order_does_not() {
        assert_eq!(difference("{a} and {b}", "{b} und {a}"), None);
        assert_eq!(difference("{a}{a}", "{a}"), Some("the translation lacks `{a}`".into()));
        let added = Some("the translation has `{b}`, but its source does not".into());
        assert_eq!(difference("{a}", "{a}{b}"), added);
        assert_eq!(difference("{a}", "{A}"), Some("the translation has `{A}` instead of `{a}`".into()));
    }

    #[test]
    fn placeholders_of_engines_count() {
        let found = |text: &'static str| engine_placeholders(text).map(|at| &text[at]).collect::<Vec<_>>();
        assert_eq!(found("Hi $name, %s, %2$d: $unit.name|"), ["$name", "%s", "%2$d", "$unit"]);
        assert_eq!(found("100%ig, 50 % de, $5, US$ish, 5%s, %sth, %"), [""; 0]);
        assert_eq!(difference("%s has $gold", "$gold hat"), Some("the translation lacks `%s`".into()));
    }

    #[test]
    fn names_of_meta_and_notes_count_and_their_words_do_not() {
        assert_eq!(meta_difference("{to: amy} {very loud} {anger 2} {joy}", "{to: Эми} {sehr laut}"), None);
        assert_eq!(meta_difference("{to: amy} Hi", "Hallo"), Some("the translation lacks `{to: …}`".into()));
        let added = Some("the translation has a note `{…}`, but its source does not".into());
        assert_eq!(meta_difference("{a}", "{b} {sehr laut}"), added);
        assert_eq!(difference("{to: amy} {0:NAME}", "{0:NAME}"), None);
    }

    #[test]
    fn plain_placeholders_are_those_that_gettext_checks() {
        for text in ["{name}", "Hi {first_name}, {0}!"] {
            assert!(are_plain(text), "{text}");
        }
        for text in ["", "Hi", "{speaker: Mara} {name}", "{anger 2}", "{very loud}", "{a-b}", "{}", "{a} {", "{1a}"] {
            assert!(!are_plain(text), "{text}");
        }
    }

    #[test]
    fn parts_make_the_text() {
        use TextPart::{Placeholder, Text};
        assert_eq!(parts("a {m} b"), [Text("a "), Placeholder("{m}"), Text(" b")]);
        assert_eq!(parts("{m}{n}"), [Placeholder("{m}"), Placeholder("{n}")]);
        assert_eq!(parts(""), []);
    }
}
