//! Entries with plural forms: a text, and its variants for plural categories.

use super::Reader;
use crate::exchange::Mark;
use crate::exchange::clip_texts::trimmed;
use crate::exchange::entry::{Entry, Words};
use crate::exchange::model::joined;
use crate::plural::PluralForms;
use lipz_diagnostics::{Code, Diagnostic};
use std::sync::Arc;

/// The parts of a message that its plural forms share.
pub(super) struct PluralMessage {
    /// The source texts for one thing, and for all other numbers.
    pub(super) sources: [Arc<Words>; 2],
    /// The marks of the source texts of all forms.
    pub(super) source_marks: Vec<Mark>,
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
        let whole = forms.iter().find(|(category, _)| category.is_empty());
        let whole = whole.map_or_else(String::new, |(_, form)| form.entry.text.text.clone());
        let [one, other] = &message.sources;
        for (category, Form { number, mut entry }) in forms {
            entry.source_mark = message.source_marks.get(number).copied();
            // The file has the source texts of two forms.
            entry.source = match (category, entry.source_mark) {
                ("", _) => Some(Arc::clone(other)),
                (_, Some(_)) => None,
                ("one", None) => Some(Arc::clone(one)),
                (_, None) => Some(Arc::clone(other)),
            };
            if !category.is_empty() {
                entry.text.text = without_unvaried(&entry.text.text, &whole, [&one.text, &other.text]);
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
        if self.forms.is_none() {
            let stated = self.plural_header.as_ref().and_then(|header| PluralForms::of_header(header, locale));
            self.forms = stated.or_else(|| Some(PluralForms::of(locale)?.0));
        }
        let category = self.forms.as_ref().and_then(|forms| forms.keys.get(form).copied().flatten());
        if category.is_none() && !text.text.is_empty() {
            let message = format!("by the plural forms of the file, no number has form {form}; it is not imported");
            let diagnostic = Diagnostic::at(Code::ExchangeLoss, text.span, message);
            let help = "correct `Plural-Forms` in the header, or delete the form";
            self.incoming.diagnostics.push(diagnostic.help(help));
        }
        category
    }
}

/// Returns the text of a plural form with blanks in place of the segments that are as in the `whole` text and equal in
/// both source texts. The export has filled them.
fn without_unvaried(text: &str, whole: &str, sources: [&str; 2]) -> String {
    let [of_form, whole, one, other] = [text, whole, sources[0], sources[1]].map(trimmed);
    let count = of_form.len();
    if count == 1 || [&whole, &one, &other].iter().any(|texts| texts.len() != count) {
        return text.to_owned();
    }
    let segment = |(at, text): (usize, &String)| {
        let is_same = one.get(at) == other.get(at) && whole.get(at) == Some(text);
        if is_same { String::new() } else { text.clone() }
    };
    joined(&of_form.iter().enumerate().map(segment).collect::<Vec<_>>())
}
