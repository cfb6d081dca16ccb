//! Converting clips to another viseme type.
//!
//! Blair's and Toon Boom's charts show the same shapes, except for two that Toon Boom's chart lacks. Loudness (rms)
//! does not describe shapes, so it cannot be converted from or to.

mod chart;
mod report;

pub(crate) use report::loss;

use crate::clip::ClipData;
use chart::counterpart;
use lipz_bank::VisemeType;
use lipz_diagnostics::Diagnostic;
use lipz_file::{Document, Element, Value};
use std::borrow::Cow;

/// Converts a clip before it is packed. Returns the document with the converted codes, or `None` if the clip stays as
/// it is.
pub(crate) fn convert_clip<'d>(
    document: &Document<'d>,
    clip: &mut ClipData,
    to: VisemeType,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Document<'d>> {
    let conversion = match Conversion::new(document, clip, to) {
        Ok(conversion) => conversion?,
        Err(diagnostic) => {
            diagnostics.push(*diagnostic);
            return None;
        }
    };
    diagnostics.extend(loss(document, &conversion));
    let document = conversion.document(document);
    clip.frames = conversion.frames;
    clip.viseme_type = Some(to);
    Some(document)
}

/// The conversion of a clip.
pub(crate) struct Conversion {
    from: VisemeType,
    pub(crate) to: VisemeType,
    frames: Vec<u8>,
}

impl Conversion {
    /// Returns the conversion of the clip that `document` describes, or `None` if the clip stays as it is.
    pub(crate) fn new(
        document: &Document<'_>,
        clip: &ClipData,
        to: VisemeType,
    ) -> Result<Option<Conversion>, Box<Diagnostic>> {
        let candidates: Vec<VisemeType> = match clip.viseme_type {
            Some(known) if known == to => return Ok(None),
            Some(known) => vec![known],
            None => VisemeType::ALL.into_iter().filter(|known| known.contains_all(&clip.frames)).collect(),
        };
        let converted = |from: VisemeType| -> Option<Vec<u8>> {
            clip.frames.iter().map(|&code| counterpart(code, from, to)).collect()
        };
        let mut results = candidates.iter().map(|&from| converted(from));
        let (Some(&from), Some(first)) = (candidates.first(), results.next()) else { return Ok(None) };
        if results.any(|other| other != first) {
            return Err(Box::new(report::ambiguous(document, &candidates)));
        }
        match first {
            None => Err(Box::new(report::refused(document, from, to))),
            Some(frames) if clip.viseme_type.is_none() && frames == clip.frames => Ok(None),
            Some(frames) => Ok(Some(Conversion { from, to, frames })),
        }
    }

    /// Converts the codes of a viseme string. Delimiters and white space stay.
    pub(crate) fn visemes(&self, text: &str) -> String {
        let code = |byte| counterpart(byte, self.from, self.to).unwrap_or(byte);
        text.bytes().map(|byte| char::from(code(byte))).collect()
    }

    /// Returns the document with converted codes and the name of their type.
    fn document<'d>(&self, document: &Document<'d>) -> Document<'d> {
        let string = |text: String| Value::String(Cow::<str>::Owned(text).into());
        let viseme_type = || string(self.to.name().to_owned());
        let is_named = document.get("viseme_type").is_some();
        let mut elements = Vec::with_capacity(document.elements.len() + 1);
        for Element { name, value } in &document.elements {
            let value = match (name.text.as_ref(), value) {
                ("viseme_type", _) => viseme_type(),
                ("visemes", Value::String(visemes)) => string(self.visemes(&visemes.text)),
                _ => value.clone(),
            };
            elements.push(Element { name: name.clone(), value });
            if name.text == "visemes" && !is_named {
                let name = Cow::Borrowed("viseme_type").into();
                elements.push(Element { name, value: viseme_type() });
            }
        }
        Document { elements }
    }
}
