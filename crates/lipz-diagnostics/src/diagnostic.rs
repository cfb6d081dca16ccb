//! One diagnostic: a problem, its position and severity, and advice.

use crate::fix::Fixes;
use crate::{Code, Span, escape};
use std::fmt;

/// The severity of a diagnostic.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Severity {
    /// The input is used as described, but should be checked.
    Warning,
    /// No bank is written.
    Error,
}

impl fmt::Display for Severity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Severity::Warning => "warning",
            Severity::Error => "error",
        })
    }
}

/// A marked part of the source with a remark under it.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct Label {
    /// The marked part.
    pub span: Span,
    /// The remark; may be empty.
    pub text: String,
}

/// How certain it is that a change matches the author's intent, in the terms of rustc.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Applicability {
    /// It certainly does, so `lipz check --fix` applies it.
    MachineApplicable,
    /// It probably does ("did you mean"), so it is only offered.
    MaybeIncorrect,
}

impl Applicability {
    /// Returns its name in documents: `machine-applicable` or `maybe-incorrect`.
    pub fn name(self) -> &'static str {
        match self {
            Applicability::MachineApplicable => "machine-applicable",
            Applicability::MaybeIncorrect => "maybe-incorrect",
        }
    }
}

/// A change of the source that solves a problem.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct Fix {
    /// The part that is replaced.
    pub span: Span,
    /// The replacement.
    pub replacement: String,
    /// Whether it certainly matches the author's intent.
    pub applicability: Applicability,
}

/// One diagnostic in one file.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct Diagnostic {
    /// The rule that reports the diagnostic.
    pub code: Code,
    /// The severity, by default [`Code::default_severity`].
    pub severity: Severity,
    /// One sentence that is understandable on its own.
    pub message: String,
    /// The characters that the diagnostic marks; `None` if it concerns the whole file.
    pub primary: Option<Label>,
    /// Other positions that belong to the diagnostic.
    pub labels: Vec<Label>,
    /// Further facts, one line each.
    pub notes: Vec<String>,
    /// Advice on what to do.
    pub help: Option<String>,
    /// The change that solves the problem, if one is certain or probable.
    pub fix: Option<Fix>,
    /// How many hidden diagnostics of its code and file it stands for; 0 if it stands for itself. See
    /// [`bound`](crate::bound).
    pub rest: usize,
    /// Their fixes.
    pub(crate) rest_fixes: Option<Box<Fixes>>,
}

/// Prints `error[LZ0401]: message`, then notes and help, one per line. The position is not included, because only a
/// [`Report`](crate::Report) has it.
impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}[{}]: {}", self.severity, self.code, escape::text(&self.message))?;
        for note in &self.notes {
            writeln!(f, "  note: {}", escape::text(note))?;
        }
        self.help.iter().try_for_each(|help| writeln!(f, "  help: {}", escape::text(help)))
    }
}

impl Label {
    /// Marks the characters of `span`. The text may be empty.
    pub fn new(span: Span, text: impl Into<String>) -> Label {
        Label { span, text: text.into() }
    }
}

/// ```
/// use lipz_diagnostics::{Code, Diagnostic, Span};
/// let diagnostic = Diagnostic::at(Code::TrailingComma, Span::new(11, 12), "a comma follows the last element")
///     .help("delete the comma")
///     .fix(Span::new(11, 12), "");
/// assert!(diagnostic.is_error());
/// assert_eq!(
///     diagnostic.to_string(),
///     "error[LZ0102]: a comma follows the last element\n  help: delete the comma\n"
/// );
/// ```
impl Diagnostic {
    /// Returns a diagnostic about a whole file.
    pub fn new(code: Code, message: impl Into<String>) -> Diagnostic {
        Diagnostic {
            code,
            severity: code.default_severity(),
            message: message.into(),
            primary: None,
            labels: Vec::new(),
            notes: Vec::new(),
            help: None,
            fix: None,
            rest: 0,
            rest_fixes: None,
        }
    }

    /// Returns a diagnostic about the characters of `span`.
    pub fn at(code: Code, span: Span, message: impl Into<String>) -> Diagnostic {
        let mut diagnostic = Diagnostic::new(code, message);
        diagnostic.primary = Some(Label::new(span, ""));
        diagnostic
    }

    /// Adds a remark under the primary characters. Does nothing for a diagnostic about a whole file.
    #[must_use]
    pub fn label(mut self, text: impl Into<String>) -> Self {
        if let Some(primary) = &mut self.primary {
            primary.text = text.into();
        }
        self
    }

    /// Marks another position.
    #[must_use]
    pub fn also(mut self, span: Span, text: impl Into<String>) -> Self {
        self.labels.push(Label::new(span, text));
        self
    }

    /// Adds a line of further facts.
    #[must_use]
    pub fn note(mut self, text: impl Into<String>) -> Self {
        self.notes.push(text.into());
        self
    }

    /// Adds advice on what to do.
    #[must_use]
    pub fn help(mut self, text: impl Into<String>) -> Self {
        self.help = Some(text.into());
        self
    }

    /// Adds a change that certainly matches the author's intent.
    #[must_use]
    pub fn fix(mut self, span: Span, replacement: impl Into<String>) -> Self {
        self.fix = Some(Fix::new(span, replacement));
        self
    }

    /// Adds a change that probably matches the author's intent. It is offered, but not applied by itself.
    #[must_use]
    pub fn suggest(mut self, span: Span, replacement: impl Into<String>) -> Self {
        self.fix = Some(Fix { applicability: Applicability::MaybeIncorrect, ..Fix::new(span, replacement) });
        self
    }

    /// Returns the certain changes: its own, or those of the diagnostics that it stands for.
    pub fn fixes(&self) -> impl Iterator<Item = Fix> {
        let own = self.fix.iter().filter(|fix| fix.is_certain()).cloned();
        own.chain(self.rest_fixes.iter().flat_map(|fixes| fixes.iter()))
    }

    /// Removes changes that turn out to be uncertain.
    pub fn retain_fixes(&mut self, mut is_certain: impl FnMut(&Fix) -> bool) {
        self.fix = self.fix.take().filter(&mut is_certain);
        if let Some(fixes) = self.rest_fixes.take() {
            fixes.iter().filter(is_certain).for_each(|fix| self.add_fix_of_rest(&fix));
        }
    }

    /// Adds the fix of a diagnostic that it stands for.
    pub(crate) fn add_fix_of_rest(&mut self, fix: &Fix) {
        self.rest_fixes.get_or_insert_default().push(fix);
    }

    /// Whether it is an error, so that no bank is written.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }

    /// Returns how many diagnostics it counts as: one, or those that it stands for.
    pub fn count(&self) -> usize {
        self.rest.max(1)
    }

    /// Returns the start of the diagnostic, for sorting. Whole-file diagnostics come first.
    pub fn start(&self) -> u32 {
        self.primary.as_ref().map_or(0, |label| label.span.start)
    }
}
