//! Markup in cues: tags, character references, speakers.

use lipz_file::text::{display, is_white_space, push_after_meta};
use std::ops::Range;

/// The meta of a Lipz text that names the speaker of the text after it.
const SPEAKER: &str = "{speaker:";

/// Character references of WebVTT, with their characters (W3C, "WebVTT cue text parsing rules").
const REFERENCES: [(&str, char); 8] = [
    ("lt", '<'),
    ("gt", '>'),
    ("lrm", '\u{200e}'),
    ("rlm", '\u{200f}'),
    ("nbsp", '\u{a0}'),
    ("amp", '&'),
    ("quot", '"'),
    ("apos", '\''),
];

/// The length of the longest reference that is searched for, in bytes.
const LONGEST_REFERENCE: usize = 10;

/// The tags that SubRip players support. Anything else between `<` and `>` is text.
const SRT_TAGS: [&str; 5] = ["i", "b", "u", "s", "font"];

/// The text of a cue in the form of a Lipz file.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct PlainText {
    pub(super) text: String,
    /// The range of the first tag that a Lipz text cannot store, in the text with markup.
    pub(super) lost_tag: Option<Range<usize>>,
}

/// The conversion of a tag.
enum Tag {
    Text,
    Lost,
    Nothing,
    /// Characters that replace it.
    Written(&'static str),
    Speaker(String),
}

/// Converts a text of WebVTT: `<v Mara>` becomes `{speaker: Mara}`, and ruby text is put in parentheses, as in browsers
/// that do not support it.
pub(super) fn from_vtt(text: &str) -> PlainText {
    let mut is_ruby_text = false;
    let tag = |tag: &str| {
        let (name, annotation) = tag.split_once(char::is_whitespace).unwrap_or((tag, ""));
        match name.split('.').next() {
            Some("v") => Tag::Speaker(referenced(annotation)),
            // A Lipz text stores neither the end of a voice nor the times of words.
            Some("/v") => Tag::Nothing,
            Some(time) if time.starts_with(|first: char| first.is_ascii_digit()) => Tag::Nothing,
            Some("rt") => Tag::Written(if std::mem::replace(&mut is_ruby_text, true) { ")(" } else { "(" }),
            // The end of ruby may also end its text.
            Some("/rt" | "/ruby") if std::mem::take(&mut is_ruby_text) => Tag::Written(")"),
            _ => Tag::Lost,
        }
    };
    without_tags(text, tag, referenced)
}

/// Converts a text of SubRip.
pub(super) fn from_srt(text: &str) -> PlainText {
    let tag = |tag: &str| {
        let name = tag.trim_start_matches('/').split(char::is_whitespace).next().unwrap_or_default();
        if SRT_TAGS.iter().any(|known| name.eq_ignore_ascii_case(known)) { Tag::Lost } else { Tag::Text }
    };
    without_tags(text, tag, str::to_owned)
}

fn without_tags(text: &str, mut tag: impl FnMut(&str) -> Tag, plain: impl Fn(&str) -> String) -> PlainText {
    let mut result = PlainText { text: String::new(), lost_tag: None };
    let mut rest = text;
    while let Some((before, tagged)) = rest.split_once('<') {
        result.text += &plain(before);
        let Some((inner, after)) = tagged.split_once('>') else {
            result.text.push('<');
            rest = tagged;
            continue;
        };
        rest = after;
        match tag(inner) {
            Tag::Lost => {
                let place = text.len() - tagged.len() - 1..text.len() - after.len();
                result.lost_tag.get_or_insert(place);
            }
            Tag::Nothing => {}
            Tag::Written(characters) => result.text += characters,
            Tag::Speaker(name) => result.text += &speaker(&name, result.text.is_empty()),
            Tag::Text => {
                result.text.push('<');
                rest = tagged;
            }
        }
    }
    result.text += &plain(rest);
    result
}

/// Replaces references, by name or number, with their characters. Anything else stays.
fn referenced(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('&') {
        shown.push_str(before);
        let end = after.bytes().take(LONGEST_REFERENCE).position(|byte| byte == b';');
        match end.and_then(|end| Some((character(after.get(..end)?)?, after.get(end + 1..)?))) {
            Some((character, behind)) => {
                shown.push(character);
                rest = behind;
            }
            None => {
                shown.push('&');
                rest = after;
            }
        }
    }
    shown + rest
}

/// Returns the character of a reference without `&` and `;`.
fn character(reference: &str) -> Option<char> {
    let by_name = REFERENCES.iter().find(|(name, _)| *name == reference).map(|(_, character)| *character);
    by_name.or_else(|| {
        let digits = reference.strip_prefix('#')?;
        let number = match digits.strip_prefix(['x', 'X']) {
            Some(digits) => u32::from_str_radix(digits, 16).ok()?,
            None => digits.parse().ok()?,
        };
        char::from_u32(number).filter(|character| *character != '\0')
    })
}

/// Returns the meta for a speaker; empty for a voice without a name. Only the first one in a text is followed by a
/// space, because that one is not displayed.
fn speaker(name: &str, is_first: bool) -> String {
    let name = name.replace(['{', '}'], "");
    match name.trim() {
        "" => String::new(),
        name if is_first => format!("{SPEAKER} {name}}} "),
        name => format!("{SPEAKER} {name}}}"),
    }
}

/// Converts a text for WebVTT. `{speaker: Mara}` becomes `<v Mara>`.
pub(super) fn to_vtt(text: &str) -> String {
    let mut marked_up = String::new();
    for (speaker, said) in voices(text) {
        if let Some(name) = speaker {
            marked_up += &format!("<v {}>", escaped(name));
        }
        marked_up += &escaped(&said);
    }
    lines(&marked_up)
}

/// Returns the first speaker who is named after the start of a displayed text.
pub(super) fn later_speaker(text: &str) -> Option<&str> {
    voices(text).into_iter().skip(1).find_map(|(name, _)| name)
}

/// Returns a text as displayed, without speakers.
pub(super) fn to_plain(text: &str) -> String {
    lines(&voices(text).into_iter().map(|(_, said)| said).collect::<String>())
}

/// Removes blank lines, which would end a cue, and replaces other line breaks with `\n`.
fn lines(text: &str) -> String {
    let lines = text.split(['\n', '\r']).filter(|line| !line.chars().all(is_white_space));
    lines.collect::<Vec<_>>().join("\n")
}

/// Returns the displayed texts with their speakers, in order; `None` for a text without a speaker.
fn voices<'t>(text: &'t str) -> Vec<(Option<&'t str>, String)> {
    // A character that replaces `{speaker: …}` while the rest is converted for display.
    let Some(mark) = ('\u{e000}'..='\u{f8ff}').find(|mark| !text.contains(*mark)) else {
        return vec![(None, display(text).text.into_owned())];
    };
    let (mut marked, mut names, mut rest) = (String::with_capacity(text.len()), Vec::new(), text);
    while let Some((before, meta)) = rest.split_once(SPEAKER) {
        let Some((name, after)) = meta.split_once('}') else { break };
        marked.push_str(before);
        marked.push(mark);
        names.push(name.trim());
        rest = after;
    }
    marked.push_str(rest);
    let shown = display(&marked).text;
    let names = names.into_iter().map(|name| Some(name).filter(|name| !name.is_empty()));
    // All texts together, and the start of each.
    let (mut said, mut starts) = (String::with_capacity(shown.len()), Vec::new());
    for (name, part) in std::iter::once(None).chain(names).zip(shown.split(mark)) {
        // The displayed text starts with the first character that is not a space, whoever speaks it.
        let part = if said.is_empty() { part.trim_start_matches(is_white_space) } else { part };
        starts.push((name, push_after_meta(&mut said, part)));
    }
    let end = said.trim_end_matches(is_white_space).len();
    let ends = starts.iter().skip(1).map(|(_, start)| *start).chain([end]);
    let voice = |(&(name, start), until): (&(Option<&'t str>, usize), usize)| {
        (name, said.get(start..until.min(end)).unwrap_or_default().to_owned())
    };
    starts.iter().zip(ends).map(voice).filter(|(_, said)| !said.is_empty()).collect()
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_of_web_vtt() {
        for (vtt, text, lost_tag) in [
            ("Tom &amp; Amy &lt;3 &amp;lt;", "Tom & Amy <3 &lt;", None),
            ("<v Mara>Good evening.", "{speaker: Mara} Good evening.", None),
            ("<v.loud Mara &amp; Tom>Hey!</v>", "{speaker: Mara & Tom} Hey!", None),
            ("<v Mara>Hi.\n<v Tom>Ho.", "{speaker: Mara} Hi.\n{speaker: Tom}Ho.", None),
            ("<v>Who?", "Who?", None),
            ("<i>So</i> <00:00:01.500>late", "So late", Some("<i>")),
            ("<ruby>漢<rt>kan</rt>字<rt>ji</ruby>!", "漢(kan)字(ji)!", Some("<ruby>")),
            ("1 < 2", "1 < 2", None),
            ("&quot;It&#39;s&#x20;me&quot; &unknown; &#0; R&D", "\"It's me\" &unknown; &#0; R&D", None),
        ] {
            let plain = from_vtt(vtt);
            assert_eq!((plain.text.as_str(), plain.lost_tag.map(|tag| &vtt[tag])), (text, lost_tag));
        }
    }

    #[test]
    fn texts_of_sub_rip() {
        for (srt, text, lost_tag) in [
            ("<i>So</i> <FONT color=\"red\">late</FONT>", "So late", Some("<i>")),
            ("{\\an8}Up", "{\\an8}Up", None),
            ("a <b c", "a <b c", None),
            ("<Mara> &amp; <- Tom", "<Mara> &amp; <- Tom", None),
        ] {
            let plain = from_srt(srt);
            assert_eq!((plain.text.as_str(), plain.lost_tag.map(|tag| &srt[tag])), (text, lost_tag));
        }
    }

    #[test]
    fn what_is_written() {
        let text = " {smiling} Tom & <Amy>\n\n {speaker: Mara} -->{nod} {speaker:} Me?";
        assert_eq!(to_vtt(text), "Tom &amp; &lt;Amy&gt;\n <v Mara>--&gt; Me?");
        assert_eq!(to_plain(text), "Tom & <Amy>\n --> Me?");
        assert_eq!(to_vtt("{speaker: Mara"), "{speaker: Mara");
        for text in [
            "{speaker: Mara} Good evening & <welcome>!",
            "Hi {speaker: Bob}there",
            "{speaker: A}{speaker: Bob}there",
            "\u{a0}Salut\u{a0}",
            "Hi \n{speaker: Bob} there \u{2003}\n ho",
        ] {
            assert_eq!(display(&from_vtt(&to_vtt(text)).text).text, display(text).text);
            assert_eq!(display(&to_plain(text)).text, display(text).text);
        }
        let text = "{speaker: Mara} Good evening!\n{speaker: Tom}Ho.";
        assert_eq!(from_vtt(&to_vtt(text)).text, text);
    }
}
