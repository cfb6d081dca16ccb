//! Converting clips to another viseme type: while packing, and in source files.
//!
//! Blair's and Toon Boom's charts show the same mouths, but for two that Toon Boom's lacks. Loudness
//! (rms) says nothing about shapes, so there is no way from or to it.

mod chart;
mod edits;
mod report;

use crate::check::Spoken;
use crate::clip::{ClipData, Locales};
use crate::{Compiler, check};
use chart::counterpart;
use lipz_bank::VisemeType;
use lipz_diagnostics::{Diagnostic, Severity};
use lipz_file::{Document, Element, Value};
use std::borrow::Cow;

/// The result of converting a file.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Converted {
    /// The new text; `None` if the file stays as it is.
    pub text: Option<String>,
    /// What was lost, or the errors that stand in the way.
    pub diagnostics: Vec<Diagnostic>,
}

impl Compiler<'_> {
    /// Converts the codes of a Lipz file to the viseme type `to`, and names the type. Everything else
    /// in the file stays as it is spelled.
    ///
    /// Files without `viseme_type` have the default of the options; without one, the type that is the only
    /// one to have their codes.
    ///
    /// ```
    /// use lipz_bank::VisemeType;
    /// use lipz_compiler::Compiler;
    /// let file = br#"{ "viseme_type": "blair", "visemes": "MA-|SO" }"#;
    /// let converted = Compiler::default().convert(file, VisemeType::ToonBoom);
    /// assert_eq!(converted.text.as_deref(), Some(r#"{ "viseme_type": "toonboom", "visemes": "AD-|BE" }"#));
    /// ```
    pub fn convert(&self, bytes: &[u8], to: VisemeType) -> Converted {
        let options = &self.options;
        let mut parsed = lipz_file::parse(bytes);
        let mut clip = ClipData::default();
        if let Some(document) = &parsed.document {
            let spoken = Spoken::default();
            check::check(document, options, spoken, &mut Locales::default(), &mut clip, &mut parsed.diagnostics);
        }
        options.levels.apply(&mut parsed.diagnostics);
        parsed.diagnostics.retain(is_error);
        let (Some(document), true) = (&parsed.document, parsed.diagnostics.is_empty()) else {
            return Converted { text: None, diagnostics: parsed.diagnostics };
        };
        let (text, mut diagnostics) = match Conversion::new(document, &clip, to) {
            Err(diagnostic) => (None, vec![*diagnostic]),
            Ok(None) => (None, Vec::new()),
            Ok(Some(conversion)) => {
                (edits::apply(bytes, document, &conversion), report::loss(document, &conversion).into_iter().collect())
            }
        };
        options.levels.apply(&mut diagnostics);
        let text = text.filter(|_| !diagnostics.iter().any(is_error));
        Converted { text, diagnostics }
    }
}

fn is_error(diagnostic: &Diagnostic) -> bool {
    diagnostic.severity == Severity::Error
}

/// Converts a clip that is to be packed, and gives the document as it would have to be written for it;
/// `None` if the clip stays as it is.
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
    diagnostics.extend(report::loss(document, &conversion));
    let document = conversion.document(document);
    clip.frames = conversion.frames;
    clip.viseme_type = Some(to);
    Some(document)
}

/// How a clip is converted.
struct Conversion {
    from: VisemeType,
    to: VisemeType,
    frames: Vec<u8>,
}

impl Conversion {
    /// How the clip that `document` describes is converted; `None` if it need not be.
    fn new(document: &Document<'_>, clip: &ClipData, to: VisemeType) -> Result<Option<Conversion>, Box<Diagnostic>> {
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

    /// A viseme string with its codes converted; delimiters and white space stay.
    fn visemes(&self, text: &str) -> String {
        let code = |byte| counterpart(byte, self.from, self.to).unwrap_or(byte);
        text.bytes().map(|byte| char::from(code(byte))).collect()
    }

    /// The document with converted codes and the name of their type.
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
