//! `{say: …}`: a meta with the pronunciation of a word.

use std::ops::Range;

/// The content of a `{say …}`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Say {
    /// The pronunciation: phones, IPA between `/` or `[ ]`, or a plain respelling. Empty if the word is silent.
    pub(crate) how: String,
    /// Its range in the text.
    pub(crate) range: Range<usize>,
}

/// Parses the content of a meta, at `range` of `text`. Returns `None` if it is not a `{say …}`. The first value is the
/// range of the name to which it applies, unless that is the word before it.
pub(super) fn parse(text: &str, range: Range<usize>) -> Option<(Option<Range<usize>>, Say)> {
    let content = text.get(range.clone())?;
    let start = range.start + content.len() - content.trim_start().len();
    let content = content.trim();
    let rest = content.get(..3).filter(|word| word.eq_ignore_ascii_case("say")).and(content.get(3..))?;
    let colon = rest.find(':')?;
    if !rest.starts_with(|c: char| c == ':' || c.is_whitespace()) {
        return None; // `{saying: …}`
    }
    let trimmed = |from: usize, to: usize| {
        let part = rest.get(from..to).unwrap_or_default();
        let start = start + 3 + from + part.len() - part.trim_start().len();
        start..start + part.trim().len()
    };
    let name = trimmed(0, colon);
    let how = trimmed(colon + 1, rest.len());
    let say = Say { how: text.get(how.clone()).unwrap_or_default().to_owned(), range: how };
    Some(((!name.is_empty()).then_some(name), say))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn say_has_a_colon_and_maybe_a_name() {
        let parts = |text: &'static str| {
            let (name, say) = parse(text, 1..text.len() - 1)?;
            assert_eq!(&text[say.range.clone()], say.how);
            Some((name.map_or("", |name| &text[name]), &text[say.range]))
        };
        assert_eq!(parts("{say: W EH S}"), Some(("", "W EH S")));
        assert_eq!(parts("{ SAY New York : noo york }"), Some(("New York", "noo york")));
        assert_eq!(parts("{say:}"), Some(("", "")));
        for other in ["{say}", "{say it loudly}", "{saying: x}", "{smile: y}", "{}", "{é: x}"] {
            assert_eq!(parts(other), None, "{other}");
        }
    }
}
