//! Conversion of source files to a different viseme type.

use super::conversion_edits::apply;
use crate::check::convert::{Conversion, loss};
use crate::check::{ClipSpeech, check};
use crate::clip::{ClipData, Locales};
use crate::run::Compiler;
use lipz_bank::VisemeType;
use lipz_diagnostics::{Diagnostic, Severity};

/// The result of converting a file.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ConvertedFile {
    /// The new text; `None` if the file stays unchanged.
    pub text: Option<String>,
    /// The losses, or the errors that prevent the conversion.
    pub diagnostics: Vec<Diagnostic>,
}

impl Compiler<'_> {
    /// Converts the codes of a Lipz file to the viseme type `to`, and sets the type. Everything else in the file keeps
    /// its spelling.
    ///
    /// The source type of files without `viseme_type` is the default of the options or, without one, the only type that
    /// has their codes.
    ///
    /// ```
    /// use lipz_bank::VisemeType;
    /// use lipz_compiler::Compiler;
    /// let file = br#"{ "viseme_type": "blair", "visemes": "MA-|SO" }"#;
    /// let converted = Compiler::default().convert(file, VisemeType::ToonBoom);
    /// assert_eq!(converted.text.as_deref(), Some(r#"{ "viseme_type": "toonboom", "visemes": "AD-|BE" }"#));
    /// ```
    pub fn convert(&self, bytes: &[u8], to: VisemeType) -> ConvertedFile {
        let options = &self.options;
        let mut parsed = lipz_file::parse(bytes);
        let mut clip = ClipData::default();
        if let Some(document) = &parsed.document {
            let spoken = ClipSpeech::default();
            check(document, options, spoken, &mut Locales::default(), &mut clip, &mut parsed.diagnostics);
        }
        options.levels.apply(&mut parsed.diagnostics);
        parsed.diagnostics.retain(is_error);
        let (Some(document), true) = (&parsed.document, parsed.diagnostics.is_empty()) else {
            return ConvertedFile { text: None, diagnostics: parsed.diagnostics };
        };
        let (text, mut diagnostics) = match Conversion::new(document, &clip, to) {
            Err(diagnostic) => (None, vec![*diagnostic]),
            Ok(None) => (None, Vec::new()),
            Ok(Some(conversion)) => {
                (apply(bytes, document, &conversion), loss(document, &conversion).into_iter().collect())
            }
        };
        options.levels.apply(&mut diagnostics);
        let text = text.filter(|_| !diagnostics.iter().any(is_error));
        ConvertedFile { text, diagnostics }
    }
}

fn is_error(diagnostic: &Diagnostic) -> bool {
    diagnostic.severity == Severity::Error
}
