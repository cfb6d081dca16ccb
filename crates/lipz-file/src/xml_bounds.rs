//! Bounds for XML of other programs, before it is parsed. XML parsers compare each attribute of a tag with all others, and
//! copy the namespaces in scope for each tag that declares some, so a small file can take minutes and gigabytes.

use memchr::{memchr, memmem};
use std::collections::HashSet;
use std::ops::Range;

/// The most attributes of a tag. XLIFF, Rhubarb and the viewers of Second Life write about ten.
pub const MOST_XML_ATTRIBUTES: usize = 256;

/// The most namespaces that a parser copies: the tags that declare some, times the different prefixes.
const MOST_COPIES: usize = 10_000_000;

/// Returns the start of the first tag, `<name`, that has more than [`MOST_XML_ATTRIBUTES`], or with which the file declares
/// too many namespaces. Takes linear time, also for texts that are not XML.
///
/// ```
/// assert_eq!(lipz_file::costly_xml_tag("<a b='1' c=\"<x =\"/>"), None);
/// let long = format!("<a><bc {}/></a>", "x='1' ".repeat(300));
/// assert_eq!(lipz_file::costly_xml_tag(&long), Some(3..6));
/// ```
pub fn costly_xml_tag(text: &str) -> Option<Range<usize>> {
    let bytes = text.as_bytes();
    let mut prefixes: HashSet<&str> = HashSet::new();
    let (mut declaring, mut at) = (0, 0);
    while let Some(start) = memchr(b'<', bytes.get(at..)?).map(|found| at + found) {
        let rest = bytes.get(start..)?;
        let skipped = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>")];
        if let Some((_, end)) = skipped.into_iter().find(|(open, _)| rest.starts_with(open.as_bytes())) {
            at = start + memmem::find(rest, end.as_bytes())? + end.len();
            continue;
        }
        let tag = Tag::of(text.get(start..)?);
        prefixes.extend(&tag.prefixes);
        declaring += usize::from(!tag.prefixes.is_empty());
        if tag.attributes > MOST_XML_ATTRIBUTES || declaring * prefixes.len() > MOST_COPIES {
            let is_end = |c: char| c.is_whitespace() || matches!(c, '>' | '/');
            let name = text.get(start + 1..)?;
            return Some(start..start + 1 + name.find(is_end).unwrap_or(name.len()));
        }
        at = start + tag.length;
    }
    None
}

/// A tag of a text.
struct Tag<'t> {
    length: usize,
    attributes: usize,
    /// The prefixes of the namespaces that it declares: `xmlns:PREFIX`.
    prefixes: Vec<&'t str>,
}

impl Tag<'_> {
    fn of(text: &str) -> Tag<'_> {
        let (mut tag, mut quote, mut word) = (Tag { length: 0, attributes: 0, prefixes: Vec::new() }, None, 0);
        for (at, byte) in text.bytes().enumerate().skip(1) {
            tag.length = at + 1;
            match (byte, quote) {
                (_, Some(open)) if byte == open => quote = None,
                (_, Some(_)) => {}
                (b'"' | b'\'', None) => quote = Some(byte),
                (b'>', None) => break,
                (b' ' | b'\t' | b'\r' | b'\n', None) => word = at + 1,
                (b'=', None) => {
                    tag.attributes += 1;
                    tag.prefixes.extend(text.get(word..at).and_then(|name| name.strip_prefix("xmlns")));
                }
                _ => {}
            }
        }
        tag.length = tag.length.max(1);
        tag
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tags_that_parsers_take_long_for() {
        let attributes = |count: usize| (0..count).map(|n| format!(" a{n}=''")).collect::<String>();
        let spaces = |count: usize| (0..count).map(|n| format!(" xmlns:a{n}=''")).collect::<String>();
        assert_eq!(costly_xml_tag(&format!("<a{}/>", attributes(256))), None);
        assert_eq!(
            costly_xml_tag(&format!("<!-- <a{0}/> --><?x <a{0}/> ?><![CDATA[<a{0}/>]]>", attributes(300))),
            None
        );
        assert_eq!(costly_xml_tag(&format!("<a><b{}", attributes(257))), Some(3..5));
        let copies = format!("<a{}>{}", spaces(200), "<b xmlns:c=''/>".repeat(60_000));
        assert!(costly_xml_tag(&copies).is_some());
        let usual = format!("<a{}>{}", spaces(5), "<b xmlns=''>x</b>".repeat(200_000));
        assert_eq!(costly_xml_tag(&usual), None);
        for text in ["", "<", "<!--", "<a b='", "a > b = c < d"] {
            assert_eq!(costly_xml_tag(text), None, "{text}");
        }
    }

    #[test]
    fn a_million_attributes_take_linear_time() {
        assert!(costly_xml_tag(&format!("<a {}", "b=".repeat(1_000_000))).is_some());
        assert!(costly_xml_tag(&"<a ".repeat(1_000_000)).is_none());
    }
}
