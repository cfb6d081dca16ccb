//! Markup of texts, such as `<i>…</i>` and `[b]…[/b]`, which a translation must close as its source does.

use lipz_diagnostics::escape;
use std::collections::{HashMap, HashSet};

/// The help for markup that differs.
pub(crate) const HELP: &str = "repeat the tags as in the source, and close each of them";

/// Tags that only change the look of words. A language may do without them, or emphasise other words.
const LOOKS: [&str; 8] = ["b", "bold", "em", "i", "italic", "s", "strong", "u"];

/// Returns the difference between the markup of a translation and its source; `None` if both can be displayed alike.
pub(crate) fn difference(source: &str, text: &str) -> Option<String> {
    if !text.contains(['<', '[']) && !source.contains(['<', '[']) {
        return None;
    }
    let (from, to) = (all_tags(source), all_tags(text));
    // `<unknown>` and `[laughs]`, without a closing tag, are words and notes, which may be translated.
    let closed: HashSet<(bool, String)> =
        from.iter().chain(&to).filter(|tag| tag.is_closing).map(MarkupTag::name).collect();
    let is_look = |tag: &MarkupTag<'_>| LOOKS.iter().any(|look| tag.name.eq_ignore_ascii_case(look));
    let counts = |tags: &[MarkupTag<'_>]| {
        let mut counts = TagCounts::new();
        let is_pair = |tag: &&MarkupTag<'_>| closed.contains(&tag.name()) || (is_look(tag) && !tag.is_square);
        for tag in tags.iter().filter(is_pair) {
            *counts.entry(tag.name()).or_default().of(tag.is_closing) += 1;
        }
        counts
    };
    let (own, others) = (counts(&to), counts(&from));
    let is_whole = |counts: &TagCounts| counts.values().all(|count| count.opening == count.closing);
    let unpaired = |tag: &&MarkupTag<'_>| own.get(&tag.name()).is_some_and(|count| count.has_more(tag.is_closing));
    if is_whole(&others)
        && let Some(tag) = to.iter().find(unpaired)
    {
        return Some(format!("{} has no counterpart in the translation", escape::quoted(&tag.spelled())));
    }
    let differs = |tag: &&MarkupTag<'_>| {
        let of = |counts: &TagCounts| counts.get(&tag.name()).copied().unwrap_or_default();
        !is_look(tag) && of(&own) != of(&others)
    };
    let tag = from.iter().chain(&to).find(differs)?;
    let of = |counts: &TagCounts| counts.get(&tag.name()).map_or(0, |count| count.opening + count.closing);
    let shown = escape::quoted(&tag.spelled()).to_string();
    Some(match of(&others) > of(&own) {
        true => format!("the translation lacks the tag {shown}"),
        false => format!("the translation has the tag {shown}, but its source does not"),
    })
}

/// A tag without its attributes.
struct MarkupTag<'t> {
    name: &'t str,
    is_closing: bool,
    /// Whether it is in square brackets.
    is_square: bool,
}

/// The numbers of tags, by kind of bracket and name in lower case.
type TagCounts = HashMap<(bool, String), TagCount>;

/// The numbers of tags with one name.
#[derive(Clone, Copy, PartialEq, Eq, Default)]
struct TagCount {
    opening: usize,
    closing: usize,
}

impl TagCount {
    fn of(&mut self, is_closing: bool) -> &mut usize {
        if is_closing { &mut self.closing } else { &mut self.opening }
    }

    /// Whether there are more tags of this kind than of the other.
    fn has_more(self, is_closing: bool) -> bool {
        if is_closing { self.closing > self.opening } else { self.opening > self.closing }
    }
}

impl MarkupTag<'_> {
    /// Returns what identifies tags that belong together.
    fn name(&self) -> (bool, String) {
        (self.is_square, self.name.to_ascii_lowercase())
    }

    fn spelled(&self) -> String {
        let slash = if self.is_closing { "/" } else { "" };
        let name = self.name;
        if self.is_square { format!("[{slash}{name}]") } else { format!("<{slash}{name}>") }
    }
}

/// Returns everything in a text that has the form of a tag, in order, except for those that close themselves: `<br/>`.
fn all_tags(text: &str) -> Vec<MarkupTag<'_>> {
    let mut tags = Vec::new();
    let mut rest = text;
    while let Some(at) = rest.find(['<', '[']) {
        let is_square = rest.get(at..).is_some_and(|rest| rest.starts_with('['));
        rest = rest.get(at + 1..).unwrap_or_default();
        let (is_closing, inner) = rest.strip_prefix('/').map_or((false, rest), |inner| (true, inner));
        let length = inner.find(|character: char| !(character.is_ascii_alphanumeric() || "_-".contains(character)));
        let name = inner.get(..length.unwrap_or(inner.len())).unwrap_or_default();
        let after = inner.get(name.len()..).unwrap_or_default();
        // A tag ends before the next one.
        let Some(end) = after.find(['<', '>', '[', ']']) else { break };
        let attributes = after.get(..end).unwrap_or_default();
        let is_whole = after.get(end..).is_some_and(|end| end.starts_with(if is_square { ']' } else { '>' }));
        let is_name = name.starts_with(|first: char| first.is_ascii_alphabetic());
        let has_attributes = attributes.is_empty() || attributes.starts_with([' ', '=', '/', ':']);
        if is_whole && is_name && has_attributes && !attributes.trim_end().ends_with('/') {
            tags.push(MarkupTag { name, is_closing, is_square });
        }
    }
    tags
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
        assert_eq!(found("<B>Go</b>", "<b>Geh</B></b>"), "`</B>` has no counterpart in the translation");
        assert_eq!(found("<ref id='a'>Go</ref>", "Geh"), "the translation lacks the tag `<ref>`");
        assert_eq!(found("Go", "<big>Geh</big>"), "the translation has the tag `<big>`, but its source does not");
    }

    /// Time grows with the text, whatever a translator's file has in it.
    #[test]
    fn very_many_tags_are_compared_once_each() {
        let text = |piece: &str| piece.repeat(100_000);
        assert_eq!(difference(&text("[a]"), &text("[a] ")), None, "notes");
        assert_eq!(difference(&text("<a></a>"), &text("<a></a> ")), None);
        assert!(difference(&text("<b></b>"), &text("<b>")).is_some());
        assert_eq!(difference(&text("<a [b "), &text("<a [c ")), None);
    }
}
