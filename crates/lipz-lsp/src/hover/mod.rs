//! Hover: the position in the clip, a description of the content, and its diagnostics.

pub(crate) mod element;
mod phone;
mod shape;

use crate::convert;
use crate::document::Document;
use crate::project::KnownProject;
use crate::timing::{Timing, decoded, element_at, frames, segment_at};
use lipz_diagnostics::{Code, Span};
use lipz_file::locale::text_name;
use lipz_file::{Element, JsonString, Value, phones, text};
use lipz_types::VisemeType;
use lsp_types::{Hover, HoverContents, MarkupContent, MarkupKind};

/// Returns the hover for byte `at`.
pub(crate) fn hover(document: &Document, known: &KnownProject, at: usize, has_pictures: bool) -> Option<Hover> {
    let shift = document.mark_bytes();
    let at = at.checked_sub(shift)?;
    let parsed = lipz_file::parse(document.text.as_bytes());
    let read = parsed.document.or(parsed.fragment.map(|fragment| fragment.document)).unwrap_or_default();
    let options = &known.project.settings.options;
    let mut parts = Vec::new();
    let mut span = None;
    if let Some(element) = element_at(&read, at) {
        let timing = Timing::of(&read, options.get_default_fps());
        let viseme_type =
            read.string("viseme_type").and_then(|name| name.parse().ok()).or(options.get_default_viseme_type());
        let clip = HoverClip { timing: timing.as_ref(), viseme_type, has_pictures };
        if let Some((said, place)) = clip.about(element, at) {
            parts.push(said);
            span = Some(place);
        }
    }
    let mut codes: Vec<Code> = Vec::new();
    for diagnostic in &document.shown {
        let Some(label) = &diagnostic.primary else { continue };
        let range = label.span.range();
        if (range.contains(&at) || range.start == at) && !codes.contains(&diagnostic.code) {
            codes.push(diagnostic.code);
            span = span.or(Some(label.span));
        }
    }
    parts.extend(codes.into_iter().map(explanation));
    let range = span.map(|span| convert::range(&document.rope, span, shift));
    let contents = MarkupContent { kind: MarkupKind::Markdown, value: parts.join("\n\n---\n\n") };
    (!parts.is_empty()).then_some(Hover { contents: HoverContents::Markup(contents), range })
}

/// Returns the page about a rule, as in `lipz explain`.
fn explanation(code: Code) -> String {
    format!("**{code}** {}: {}\n\n{}", code.name(), code.summary(), code.page().trim_end())
}

/// The parts of a clip that a hover describes.
struct HoverClip<'t> {
    timing: Option<&'t Timing>,
    viseme_type: Option<VisemeType>,
    has_pictures: bool,
}

impl HoverClip<'_> {
    /// Returns a description of byte `at` of an element, and the characters that it describes.
    fn about(&self, element: &Element<'_>, at: usize) -> Option<(String, Span)> {
        let name = element.name.text.as_ref();
        let place = match &element.value {
            Value::String(string) => decoded(string, at).map(|at| (string, at)),
            _ => None,
        };
        match (name, place) {
            ("visemes", Some((string, at))) => self.code(string, at),
            (phones::ELEMENT, Some((string, at))) => phone::about(string, at),
            (_, Some((string, at))) if name == "events" || text_name(name).is_some() => self.segment(string, at),
            _ => element::about(name).map(|(title, about)| (format!("**{title}**\n\n{about}"), element.name.span())),
        }
    }

    /// Returns the frame and the shape of a code.
    fn code(&self, string: &JsonString<'_>, at: usize) -> Option<(String, Span)> {
        let code = string.text.get(at..)?.chars().next()?;
        let (segment, _) = segment_at(&string.text, at);
        let span = string.span_of(at..at + code.len_utf8());
        if code == text::DELIMITER || text::is_white_space(code) {
            return self.segment_line(segment).map(|line| (line, span));
        }
        let frame = frames(string.text.get(..at)?);
        let time =
            self.timing.and_then(|timing| timing.time(frame)).map(|time| format!(", {time}")).unwrap_or_default();
        let shape = self.viseme_type.and_then(|kind| shape::about(kind, code, self.has_pictures));
        let shape = shape.map(|shape| format!("{shape}\n\n")).unwrap_or_default();
        let line = self.segment_line(segment).unwrap_or_default();
        Some((format!("{shape}frame {frame}{time}\n\n{line}"), span))
    }

    /// Returns the segment of a text or of events.
    fn segment(&self, string: &JsonString<'_>, at: usize) -> Option<(String, Span)> {
        let (segment, range) = segment_at(&string.text, at);
        Some((self.segment_line(segment)?, string.span_of(range)))
    }

    /// Returns a line such as `segment 2 of 3: frames 24–48, 1.000 s–2.000 s`.
    fn segment_line(&self, segment: usize) -> Option<String> {
        let timing = self.timing?;
        let shown = timing
            .shown(segment..segment + 1)
            .unwrap_or_else(|| "no frames because `visemes` has fewer segments".to_owned());
        Some(format!("segment {} of {}: {shown}", segment + 1, timing.segment_count()))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "tests")]
mod tests {
    use super::*;
    use crate::{check, place};
    use lsp_types::Uri;
    use std::str::FromStr;

    /// Returns the hover at `§`, and the characters that it describes.
    fn at(text: &str) -> (String, String) {
        let place = text.find('§').unwrap();
        let mut document = Document::new(Uri::from_str("untitled:a").unwrap(), 1, text.replace('§', ""));
        let known = KnownProject::default();
        document.shown = check::check(&known, None, &document.text);
        let Some(hover) = hover(&document, &known, place, false) else { return Default::default() };
        let HoverContents::Markup(contents) = hover.contents else { panic!() };
        let range = place::bytes(&document.rope, hover.range.unwrap());
        (contents.value, document.text[range].to_owned())
    }

    #[test]
    fn a_code_has_a_frame_a_time_a_segment_and_a_shape() {
        let (text, about) = at(r#"{ "visemes": "MA|§EO", "viseme_type": "blair", "fps": 10, "text_en-us": "Ma|yor" }"#);
        let expected = "**E** of blair: E: “bet”\n\nframe 2, 0.200 s\n\nsegment 2 of 2: frames 2–4, 0.200 s–0.400 s";
        assert_eq!((text.as_str(), about.as_str()), (expected, "E"));
    }

    #[test]
    fn texts_have_segments_names_their_meaning_and_mistakes_their_page() {
        let (text, about) = at(r#"{ "visemes": "MA|EO", "text_en-us": "Ma|y§or" }"#);
        assert_eq!((text.as_str(), about.as_str()), ("segment 2 of 2: frames 2–4", "yor"));
        let (text, about) = at(r#"{ "f§ps": 24 }"#);
        assert!(text.starts_with("**Frame rate**") && about == "\"fps\"", "{text}");
        let (text, about) = at("{ \"visemes\": \"M§Z\", \"viseme_type\": \"blair\", }");
        assert!(about == "Z" || about == "M", "{about}");
        let (text_of_z, about) = at("{ \"visemes\": \"MA§Z\", \"viseme_type\": \"blair\", }");
        assert!(text_of_z.contains("**LZ0401** foreign-code") && about == "Z", "{text_of_z}: {text}");
        assert_eq!(at("{ §}"), Default::default());
    }

    #[test]
    fn a_phone_has_its_symbol_and_its_time() {
        let (text, about) = at(r#"{ "visemes": "-SE--", "fps": 10, "phones": "sil@0 D§H@191 AH@232" }"#);
        assert_eq!((text.as_str(), about.as_str()), ("**DH**, IPA `ð`: 0.191 s–0.232 s", "DH@191"));
        let (text, _) = at(r#"{ "visemes": "-SE--", "fps": 10, "phones": "s§il@0" }"#);
        assert_eq!(text, "silence: 0.000 s to the end of the clip");
    }
}
