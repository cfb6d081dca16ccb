//! The names of emotions.

use crate::check::names::inside;
use crate::project::{KnownNames, Options};
use lipz_diagnostics::{Code, Diagnostic, Span, escape, suggest};
use lipz_file::emotion::{Blend, Term};
use lipz_file::event;

/// The names that a project may use.
pub(super) struct AllowedNames<'o> {
    options: &'o Options,
    names: &'o KnownNames,
}

impl<'o> AllowedNames<'o> {
    pub(super) fn new(options: &'o Options) -> AllowedNames<'o> {
        AllowedNames { options, names: &options.known_names }
    }

    pub(super) fn has(&self, name: &str) -> bool {
        self.options.emotions.knows(name) || self.names.emotions.contains(name)
    }

    /// Whether the name of an emotion does not need a diagnostic, and its value, if any, changes a face.
    pub(super) fn is_clean(&self, term: &Term<'_>) -> bool {
        self.options.emotions.knows(term.name.text)
            && (term.thousandths.is_none() || self.options.emotions.has_attributes(term.name.text))
    }

    /// Returns the name that was probably meant.
    pub(super) fn nearest(&self, name: &str) -> Option<&str> {
        suggest::nearest(name, self.options.emotions.names().chain(self.names.emotions.iter().map(String::as_str)))
    }

    /// Adds the diagnostics about the names of a blend. An unknown `object` of an event is left out because the check
    /// of events reports it.
    pub(super) fn faults(
        &self,
        blend: &Blend<'_>,
        object: Option<Option<event::Word<'_>>>,
        span: &impl Fn(&Term<'_>) -> Span,
        found: &mut Vec<Diagnostic>,
    ) {
        for term in blend.terms.iter().filter(|term| !self.is_clean(term)) {
            if self.has(term.name.text) {
                found.push(self.without_attributes(term, span(term)));
            } else if object.flatten() != Some(term.name) {
                found.push(self.unknown(term, span(term)));
            }
        }
    }

    fn unknown(&self, term: &Term<'_>, span: Span) -> Diagnostic {
        let message = format!("{} is not a known emotion", escape::quoted(term.name.text));
        let found = Diagnostic::at(Code::UnknownEmotion, span, message);
        match self.nearest(term.name.text) {
            Some(near) => found.help(format!("did you mean {}?", escape::quoted(near))).suggest(span, inside(near)),
            None => {
                found.help("use an emotion from docs/guides/faces.md, or define your own in [emotions] of lipz.toml")
            }
        }
    }

    fn without_attributes(&self, term: &Term<'_>, span: Span) -> Diagnostic {
        let name = term.name.text;
        let quoted = escape::quoted(name);
        if self.options.emotions.knows(name) {
            let message = format!("{quoted} has no attributes, so its value has no effect");
            return Diagnostic::at(Code::EmotionHidden, span, message).help(format!("write {quoted} alone"));
        }
        let message = format!("{quoted} has no definition in [emotions] and makes no curve");
        Diagnostic::at(Code::EmotionHidden, span, message).help(format!(
            "define it in [emotions] of lipz.toml, as {name} = \"joy 2 + disgust 1\", or as {name} = \"\" for no face"
        ))
    }
}
