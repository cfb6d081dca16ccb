//! Entries with plural forms: a text, and its variants for plural categories.

use super::Reader;
use crate::exchange::Mark;
use crate::exchange::entry::{Entry, Words};
use crate::plural::PluralForms;
use lipz_diagnostics::{Code, Diagnostic};
use std::sync::Arc;

/// The parts of a message that its plural forms share.
pub(super) struct PluralMessage {
    /// The source texts for one thing, and for all other numbers.
    pub(super) sources: [Arc<Words>; 2],
    /// The marks of the texts of all forms, and of their sources.
    pub(super) marks: Marks,
    pub(super) source_marks: Marks,
}

/// Marks by plural category, because other programs change the order of the forms. That of the text itself, or of an
/// entry without plural forms, has none: `one:0292aac1 few:8a57147d 1e2eeca1`.
#[derive(Default)]
pub(super) struct Marks(Vec<(String, Mark)>);

impl Marks {
    /// Parses the marks in a comment. Stops at the first that is invalid.
    pub(super) fn parse(text: &str) -> Marks {
        let mark = |word: &str| {
            let (category, mark) = word.split_once(':').unwrap_or(("", word));
            Some((category.to_owned(), mark.parse().ok()?))
        };
        Marks(text.split_whitespace().map_while(mark).collect())
    }

    /// Returns the mark for a plural category, or with `""` for the text itself.
    pub(super) fn of(&self, category: &str) -> Option<Mark> {
        self.0.iter().find(|(known, _)| known == category).map(|(_, mark)| *mark)
    }
}

/// One of the texts of a message with plural forms.
pub(super) struct Form {
    pub(super) number: usize,
    /// Its entry, as for a message without plural forms.
    pub(super) entry: Entry,
}

impl Reader<'_> {
    /// Adds an entry for each form: that of the text, and those of its variants.
    pub(super) fn plural_entries(&mut self, message: &PluralMessage, forms: Vec<Form>) {
        let with_category = |form: Form| {
            let category = self.category(form.number, &form.entry.text, &form.entry.locale)?;
            Some((category, form))
        };
        let forms: Vec<(&str, Form)> = forms.into_iter().filter_map(with_category).collect();
        let [one, other] = &message.sources;
        for (category, Form { mut entry, .. }) in forms {
            entry.mark = message.marks.of(category);
            entry.source_mark = message.source_marks.of(category);
            // The file has the source texts of two forms.
            entry.source = match (category, entry.source_mark) {
                ("", _) => Some(Arc::clone(other)),
                (_, Some(_)) => None,
                ("one", None) => Some(Arc::clone(one)),
                (_, None) => Some(Arc::clone(other)),
            };
            if !category.is_empty() {
                // Comments concern the whole message, and belong to the text.
                (entry.comments, entry.comments_mark) = (Vec::new(), None);
            }
            entry.find_variant();
            entry.add_category(category);
            self.incoming.entries.push(entry);
        }
    }

    /// Returns the plural category of a form; `""` for the text itself. Reports a text in a form that no number has.
    fn category(&mut self, form: usize, text: &Words, locale: &str) -> Option<&'static str> {
        let forms = match &self.forms {
            Some(forms) => forms,
            None => {
                let forms = self.plural_forms(locale);
                self.forms.insert(forms)
            }
        };
        let category = forms.as_ref()?.keys.get(form).copied().flatten();
        if category.is_none() && !text.text.is_empty() {
            let message = format!("form {form} has no plural category of its own in {locale}, and is not imported");
            let diagnostic = Diagnostic::at(Code::ExchangeLoss, text.span, message);
            let help = "the other forms are imported; if the form is needed, correct `Plural-Forms` in the header";
            self.incoming.diagnostics.push(diagnostic.help(help));
        }
        category
    }

    /// Returns the plural forms of the file: those of its header, or those of the language if the header states none.
    /// Reports forms that cannot be read or are unknown.
    fn plural_forms(&mut self, locale: &str) -> Option<PluralForms> {
        let known = PluralForms::of(locale);
        let Some(header) = &self.plural_header else {
            if known.is_none() {
                let message = format!("the plural forms of {locale} are unknown, and are not imported");
                let diagnostic = Diagnostic::new(Code::ExchangeSyntax, message);
                self.incoming.diagnostics.push(diagnostic.help("add the header `Plural-Forms`"));
            }
            return known.map(|(forms, _)| forms);
        };
        let stated = PluralForms::of_header(&header.text, locale);
        if stated.is_none() {
            let message = "`Plural-Forms` in the header cannot be read";
            let diagnostic = Diagnostic::at(Code::ExchangeSyntax, header.span, message);
            self.incoming.diagnostics.push(match known {
                Some((_, header)) => diagnostic.help(format!("write \"Plural-Forms: {header}\\n\"")),
                None => diagnostic.help("write the number of forms, and the expression for the form of a number"),
            });
        }
        stated
    }
}
