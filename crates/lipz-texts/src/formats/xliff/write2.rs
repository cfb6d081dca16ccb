//! Writing of XLIFF 2.1.

use super::ids::Ids;
use super::xml::{plain, push};
use super::{COMMENTS_EXPORTED, EXPORTED};
use crate::exchange::Mark;
use crate::exchange::model::{Division, Exchange, Item, State, Translation};
use crate::exchange::placeholder::{TextPart, parts};
use crate::exchange::tag::bcp47;
use std::fmt::Write;

/// Returns the file of the locale at `at` of the exchange.
pub(crate) fn write(exchange: &Exchange, at: usize) -> Vec<u8> {
    let locale = exchange.locales.get(at).map_or("", String::as_str);
    let mut out = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <xliff xmlns=\"urn:oasis:names:tc:xliff:document:2.0\" version=\"2.1\" srcLang=\"{}\" trgLang=\"{}\">\n  \
         <file id=\"lipz\" xml:space=\"preserve\">\n",
        plain(&bcp47(&exchange.source_locale)),
        plain(&bcp47(locale))
    );
    let none = Translation::default();
    for item in exchange.items(Some(at), Division::Clip) {
        unit(&mut out, &item, item.unit.translations.get(at).unwrap_or(&none));
    }
    out.push_str("  </file>\n</xliff>\n");
    out.into_bytes()
}

fn unit(out: &mut String, item: &Item<'_>, translation: &Translation) {
    let mut codes = Codes::default();
    let mut segments = String::new();
    for (at, segment) in &item.segments {
        let id = at + 1;
        let target = translation.texts.get(*at).map_or("", String::as_str);
        if segment.source.is_empty() {
            // There is nothing to translate, but the segments after it keep their numbers.
            let _ = writeln!(segments, "      <ignorable id=\"s{id}\">\n        <source></source>\n      </ignorable>");
            continue;
        }
        let is_open = target.is_empty() || translation.made_from_at(*at, &segment.source).is_some();
        let state = if is_open { State::Initial } else { translation.state };
        let source = codes.content(&segment.source, Ids::of_source);
        let _ = writeln!(segments, "      <segment id=\"s{id}\" state=\"{state}\">\n        <source>{source}</source>");
        if !target.is_empty() {
            let target = codes.content(target, Ids::of_target);
            let _ = writeln!(segments, "        <target>{target}</target>");
        }
        segments.push_str("      </segment>\n");
        codes.ids.end_segment();
    }
    // Keys may contain characters that an ID cannot, so they are names. Tools identify a unit by its ID, which must
    // stay the same.
    let name = item.unit.id();
    let id = unit_id(&name);
    let _ = writeln!(out, "    <unit id=\"{id}\" name=\"{}\" canResegment=\"no\">", plain(&name));
    out.push_str("      <notes>\n");
    let note = |out: &mut String, category: &str, id: &str, text: &str| {
        let _ = writeln!(out, "        <note{id} category=\"{category}\">{}</note>", plain(text));
    };
    let own = item.translator_comments(translation);
    own.iter().for_each(|comment| note(out, "comment", "", comment));
    if !own.is_empty() {
        note(out, COMMENTS_EXPORTED, "", &Mark::of_comments(own).to_string());
    }
    item.comments().iter().for_each(|comment| note(out, "context", "", comment));
    item.paths().for_each(|path| note(out, "location", "", path));
    item.made_from(translation).iter().for_each(|text| note(out, "translated from", "", text));
    for (at, segment) in &item.segments {
        if !segment.source.is_empty() {
            let mark = Mark::of(translation.texts.get(*at).map_or("", String::as_str));
            note(out, EXPORTED, &format!(" id=\"s{}\"", at + 1), &mark.to_string());
        }
    }
    out.push_str("      </notes>\n");
    out.push_str(&codes.data());
    out.push_str(&segments);
    out.push_str("    </unit>\n");
}

/// Returns the ID of a clip's unit: its key, if that is valid, otherwise the valid characters of the key with its mark.
fn unit_id(key: &str) -> String {
    let can_be = |sign: char| sign.is_ascii_alphanumeric() || matches!(sign, '-' | '_');
    if key.chars().all(can_be) {
        return key.to_owned();
    }
    let rest: String = key.chars().map(|sign| if can_be(sign) { sign } else { '_' }).collect();
    format!("{rest}.{}", Mark::of(key))
}

/// The placeholders of a unit.
#[derive(Default)]
struct Codes {
    /// The texts of placeholders, each once: `d1` is the first.
    data: Vec<String>,
    ids: Ids,
}

impl Codes {
    /// Returns the content of a source or target.
    fn content(&mut self, text: &str, id: fn(&mut Ids, &str) -> usize) -> String {
        let mut out = String::new();
        for part in parts(text) {
            match part {
                TextPart::Text(text) => push(&mut out, text, cp),
                TextPart::Placeholder(placeholder) => {
                    let data = self.data_of(placeholder);
                    let id = id(&mut self.ids, placeholder);
                    let shown = plain(placeholder);
                    let _ = write!(out, "<ph id=\"p{id}\" dataRef=\"d{data}\" disp=\"{shown}\" canDelete=\"no\"/>");
                }
            }
        }
        out
    }

    fn data_of(&mut self, placeholder: &str) -> usize {
        let known = self.data.iter().position(|data| data == placeholder);
        known.unwrap_or_else(|| {
            self.data.push(placeholder.to_owned());
            self.data.len() - 1
        }) + 1
    }

    fn data(&self) -> String {
        if self.data.is_empty() {
            return String::new();
        }
        let mut out = "      <originalData>\n".to_owned();
        for (number, data) in (1..).zip(&self.data) {
            let mut content = String::new();
            push(&mut content, data, cp);
            let _ = writeln!(out, "        <data id=\"d{number}\">{content}</data>");
        }
        out + "      </originalData>\n"
    }
}

/// Returns the element for a character that XML does not allow.
fn cp(character: char) -> String {
    format!("<cp hex=\"{:04X}\"/>", u32::from(character))
}
