//! Placeholders: the `{meta}` of a text, which a translation has, too.

use lipz_diagnostics::escape;
use lipz_file::text::meta;

/// What is between the placeholders of a text, and these.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Part<'t> {
    Text(&'t str),
    Placeholder(&'t str),
}

/// The parts of a text, in their order; none is empty.
pub(crate) fn parts(text: &str) -> Vec<Part<'_>> {
    let mut parts = Vec::new();
    let mut done = 0;
    for place in meta(text) {
        let before = text.get(done..place.start).unwrap_or_default();
        parts.extend((!before.is_empty()).then_some(Part::Text(before)));
        parts.extend(text.get(place.clone()).map(Part::Placeholder));
        done = place.end;
    }
    let rest = text.get(done..).unwrap_or_default();
    parts.extend((!rest.is_empty()).then_some(Part::Text(rest)));
    parts
}

/// The placeholders of a text, sorted: their order may change with the language.
fn placeholders(text: &str) -> Vec<&str> {
    let mut all: Vec<&str> = meta(text).into_iter().filter_map(|place| text.get(place)).collect();
    all.sort_unstable();
    all
}

/// How the placeholders of a translation differ from those of its source; `None` if they are the same.
///
/// `lost` are those that the translation does not have, or has less often, `added` the others.
pub(crate) fn difference(source: &str, text: &str) -> Option<String> {
    let (source, text) = (placeholders(source), placeholders(text));
    let (lost, added) = (without(&source, &text), without(&text, &source));
    let list = |all: &[&str]| all.iter().map(|one| escape::quoted(one).to_string()).collect::<Vec<_>>().join(", ");
    match (lost.is_empty(), added.is_empty()) {
        (true, true) => None,
        (false, true) => Some(format!("the translation has lost {}", list(&lost))),
        (true, false) => Some(format!("the translation has {}, which its source does not have", list(&added))),
        (false, false) => Some(format!("the translation has {} in place of {}", list(&added), list(&lost))),
    }
}

/// Those of `all`, which are sorted, that `others` have less often.
fn without<'t>(all: &[&'t str], others: &[&str]) -> Vec<&'t str> {
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

    #[test]
    fn placeholders_count_and_their_order_does_not() {
        assert_eq!(difference("{a} and {b}", "{b} und {a}"), None);
        assert_eq!(difference("{a}{a}", "{a}"), Some("the translation has lost `{a}`".into()));
        let added = Some("the translation has `{b}`, which its source does not have".into());
        assert_eq!(difference("{a}", "{a}{b}"), added);
        assert_eq!(difference("{a}", "{A}"), Some("the translation has `{A}` in place of `{a}`".into()));
    }

    #[test]
    fn parts_make_the_text() {
        use Part::{Placeholder, Text};
        assert_eq!(parts("a {m} b"), [Text("a "), Placeholder("{m}"), Text(" b")]);
        assert_eq!(parts("{m}{n}"), [Placeholder("{m}"), Placeholder("{n}")]);
        assert_eq!(parts(""), []);
    }
}
