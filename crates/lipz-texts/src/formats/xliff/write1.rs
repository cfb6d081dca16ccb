//! Writing of XLIFF 1.2.

use super::ids::Ids;
use super::xml::{plain, push};
use super::{CHARACTER, COMMENTS_EXPORTED, EXPORTED};
use crate::exchange::Mark;
use crate::exchange::model::{Division, Exchange, Item, State, Translation};
use crate::exchange::placeholder::{TextPart, parts};
use crate::exchange::tag::bcp47;
use std::fmt::Write;

/// Returns the file of the locale at `at` of the exchange.
pub(crate) fn write(exchange: &Exchange, at: usize, division: Division) -> Vec<u8> {
    let locale = exchange.locales.get(at).map_or("", String::as_str);
    let mut out = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <xliff xmlns=\"urn:oasis:names:tc:xliff:document:1.2\" version=\"1.2\">\n  \
         <file original=\"lipz\" datatype=\"plaintext\" source-language=\"{}\" target-language=\"{}\">\n    <body>\n",
        plain(&bcp47(&exchange.source_locale)),
        plain(&bcp47(locale))
    );
    let none = Translation::default();
    for item in exchange.items(Some(at), division) {
        unit(&mut out, &item, item.unit.translations.get(at).unwrap_or(&none));
    }
    out.push_str("    </body>\n  </file>\n</xliff>\n");
    out.into_bytes()
}

fn unit(out: &mut String, item: &Item<'_>, translation: &Translation) {
    let id = plain(&item.id());
    let approved = if item.state(translation) >= State::Reviewed { " approved=\"yes\"" } else { "" };
    let _ = writeln!(out, "      <trans-unit id=\"{id}\" resname=\"{id}\"{approved} xml:space=\"preserve\">");
    let sources: Vec<&str> = item.segments.iter().map(|(_, segment)| segment.source.as_str()).collect();
    let mut ids = Ids::default();
    let _ = writeln!(out, "        <source>{}</source>", content(&sources, false, |text| ids.of_source(text)));
    if sources.len() > 1 {
        // The same texts with marks, and the same IDs.
        let mut ids = Ids::default();
        let marked = content(&sources, true, |text| ids.of_source(text));
        let _ = writeln!(out, "        <seg-source>{marked}</seg-source>");
    }
    if !item.text(translation).is_empty() {
        let text = |(at, _): &(usize, _)| translation.texts.get(*at).map_or("", String::as_str);
        let targets: Vec<&str> = item.segments.iter().map(text).collect();
        let state = match item.state(translation) {
            State::Initial => "needs-review-translation",
            State::Translated => "translated",
            State::Reviewed => "signed-off",
            State::Final => "final",
        };
        let target = content(&targets, targets.len() > 1, |text| ids.of_target(text));
        let _ = writeln!(out, "        <target state=\"{state}\">{target}</target>");
    }
    let own = item.translator_comments(translation);
    for comment in own {
        let _ = writeln!(out, "        <note from=\"translator\">{}</note>", plain(comment));
    }
    if !own.is_empty() {
        let _ = writeln!(out, "        <note from=\"lipz\">{COMMENTS_EXPORTED}: {}</note>", Mark::of_comments(own));
    }
    for comment in item.comments() {
        let _ = writeln!(out, "        <note from=\"lipz\">{}</note>", plain(&comment));
    }
    for path in item.paths() {
        let _ = writeln!(out, "        <note from=\"lipz\">{}</note>", plain(path));
    }
    if let Some(made_from) = item.made_from(translation) {
        let _ = writeln!(out, "        <note from=\"lipz\">translated from: {}</note>", plain(&made_from));
    }
    let _ = writeln!(out, "        <note from=\"lipz\">{EXPORTED}: {}</note>", item.mark(translation));
    out.push_str("      </trans-unit>\n");
}

/// Returns the texts of segments with ` | ` between them, so that tools without support for segments preserve them.
fn content(texts: &[&str], is_marked: bool, mut id: impl FnMut(&str) -> usize) -> String {
    let mut out = String::new();
    for (at, text) in texts.iter().enumerate() {
        if at > 0 {
            out.push_str(" | ");
        }
        if is_marked {
            let _ = write!(out, "<mrk mtype=\"seg\" mid=\"{}\">", at + 1);
        }
        for part in parts(text) {
            match part {
                TextPart::Text(text) => push(&mut out, text, |character| {
                    code(id(&character.to_string()), CHARACTER, &format!("U+{:04X}", u32::from(character)))
                }),
                TextPart::Placeholder(placeholder) => {
                    out.push_str(&code(id(placeholder), "x-lipz-meta", &plain_code(placeholder)));
                }
            }
        }
        if is_marked {
            out.push_str("</mrk>");
        }
    }
    out
}

fn code(id: usize, kind: &str, native: &str) -> String {
    format!("<ph id=\"{id}\" ctype=\"{kind}\">{native}</ph>")
}

/// Returns a placeholder as the content of its element. Characters that XML does not allow are escaped as in JSON.
fn plain_code(placeholder: &str) -> String {
    let mut out = String::new();
    push(&mut out, placeholder, |character| format!("\\u{:04x}", u32::from(character)));
    out
}
