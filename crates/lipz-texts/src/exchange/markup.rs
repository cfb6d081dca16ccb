//! Markup of texts, such as `<i>…</i>` and `[b]…[/b]`, which a translation must close as its source does.

use lipz_diagnostics::escape;
use std::collections::BTreeMap;

/// The help for markup that differs.
pub(crate) const HELP: &str = "repeat the tags as in the source, and close each of them";

/// Tags that only change the look of words. A language may do without them, or emphasise other words.
const LOOKS: [&str; 8] = ["b", "bold", "em", "i", "italic", "s", "strong", "u"];

/// A tag: its name, and whether it is a closing one.
type Tag<'t> = (&'t str, bool);

/// Returns the difference between the markup of a translation and its source; `None` if both can be displayed alike.
pub(crate) fn difference(source: &str, text: &str) -> Option<String> {
    let (from, to) = (tags(source, text), tags(text, source));
    // `<unknown>` without a closing tag is a word, which may be translated.
    let is_closed = |name: &str| from.iter().chain(&to).any(|tag| tag.1 && tag.0.eq_ignore_ascii_case(name));
    let is_pair = |name: &str| is_look(name) || is_closed(name);
    if unclosed(&from, is_pair).is_none()
        && let Some(tag) = unclosed(&to, is_pair)
    {
        return Some(format!("{} has no counterpart in the translation", escape::quoted(&spelled(tag, text))));
    }
    let count = |tags: &[Tag<'_>]| {
        let mut counts: BTreeMap<(String, bool), isize> = BTreeMap::new();
        for (name, is_closing) in tags.iter().filter(|(name, _)| !is_look(name) && is_closed(name)) {
            *counts.entry((name.to_ascii_lowercase(), *is_closing)).or_default() += 1;
        }
        counts
    };
    let (from, to) = (count(&from), count(&to));
    let names = from.keys().chain(to.keys());
    let of = |counts: &BTreeMap<_, isize>, tag| counts.get(tag).copied().unwrap_or_default();
    let other = names.into_iter().find(|tag| of(&from, tag) != of(&to, tag))?;
    let tag =
        escape::quoted(&spelled((&other.0, other.1), if of(&from, other) > 0 { source } else { text })).to_string();
    Some(match of(&from, other) > of(&to, other) {
        true => format!("the translation lacks the tag {tag}"),
        false => format!("the translation has the tag {tag}, but its source does not"),
    })
}

fn is_look(name: &str) -> bool {
    LOOKS.iter().any(|look| name.eq_ignore_ascii_case(look))
}

/// Returns the tag as written in a text.
fn spelled((name, is_closing): Tag<'_>, text: &str) -> String {
    let slash = if is_closing { "/" } else { "" };
    let is_square = text.to_ascii_lowercase().contains(&format!("[{slash}{}", name.to_ascii_lowercase()));
    if is_square { format!("[{slash}{name}]") } else { format!("<{slash}{name}>") }
}

/// Returns the tags of a text in order. Square brackets are tags if a closing one with the same name is in either text;
/// other ones are directions for actors.
fn tags<'t>(text: &'t str, other: &str) -> Vec<Tag<'t>> {
    let mut tags = Vec::new();
    let mut rest = text;
    while let Some(at) = rest.find(['<', '[']) {
        let is_square = rest.get(at..).is_some_and(|rest| rest.starts_with('['));
        rest = rest.get(at + 1..).unwrap_or_default();
        let (is_closing, inner) = rest.strip_prefix('/').map_or((false, rest), |inner| (true, inner));
        let length = inner.find(|character: char| !(character.is_ascii_alphanumeric() || "_-".contains(character)));
        let name = inner.get(..length.unwrap_or(inner.len())).unwrap_or_default();
        let after = inner.get(name.len()..).unwrap_or_default();
        let Some(end) = after.find(if is_square { ['[', ']'] } else { ['<', '>'] }) else { continue };
        let attributes = after.get(..end).unwrap_or_default();
        let is_whole = after.get(end..).is_some_and(|end| end.starts_with([']', '>']));
        let is_name = name.starts_with(|first: char| first.is_ascii_alphabetic());
        if !is_whole || !is_name || !(attributes.is_empty() || attributes.starts_with([' ', '=', '/', ':'])) {
            continue;
        }
        let closing = format!("[/{}]", name.to_ascii_lowercase());
        let has_pair = || [text, other].iter().any(|text| text.to_ascii_lowercase().contains(&closing));
        let is_empty = attributes.trim_end().ends_with('/');
        if !is_empty && (!is_square || has_pair()) {
            tags.push((name, is_closing));
        }
    }
    tags
}

/// Returns the first tag without a counterpart, among those that come in pairs.
fn unclosed<'t>(tags: &[Tag<'t>], is_pair: impl Fn(&str) -> bool) -> Option<Tag<'t>> {
    let is_same = |one: &Tag<'_>, other: &Tag<'_>| one.0.eq_ignore_ascii_case(other.0) && one.1 != other.1;
    let count =
        |tag: &Tag<'_>| tags.iter().filter(|other| other.0.eq_ignore_ascii_case(tag.0) && other.1 == tag.1).count();
    let counterparts = |tag: &Tag<'_>| tags.iter().filter(|other| is_same(other, tag)).count();
    tags.iter().find(|tag| is_pair(tag.0) && count(tag) > counterparts(tag)).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tags_that_are_not_closed_are_found() {
        let none = |source, text| assert_eq!(difference(source, text), None, "{text}");
        none("<i>Go</i> home", "Geh <i>heim</i>");
        none("<i>Go</i> home", "Geh heim");
        none("[b]Go[/b]", "Geh");
        none("Go [Laughs] <3 > 2", "Geh [Lacht] 3 < 4 >");
        none("a<br/>b<br>c", "a<br/>b<br>c");
        none("a <unknown> b", "a <unbekannt> b");
        none("a b", "a<br>b");
        let found = |source, text| difference(source, text).unwrap();
        assert_eq!(found("<i>Go</i>", "<i>Geh"), "`<i>` has no counterpart in the translation");
        assert_eq!(found("<i>Go</i>", "<i>Geh<i>"), "`<i>` has no counterpart in the translation");
        assert_eq!(found("[b]Go[/b]", "Geh[/b]"), "`[/b]` has no counterpart in the translation");
        assert_eq!(found("<ref id='a'>Go</ref>", "Geh"), "the translation lacks the tag `<ref>`");
        assert_eq!(found("Go", "<big>Geh</big>"), "the translation has the tag `<big>`, but its source does not");
    }
}
