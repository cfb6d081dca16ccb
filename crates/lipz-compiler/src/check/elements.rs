//! Which element plays which role.

use super::{locales, names, types};
use crate::Options;
use lipz::locale::{self, TextName};
use lipz::{Code, Diagnostic, Document, Element};
use lipz::{JsonString, Raw};

/// Elements of the format by role, with values of the right type.
#[derive(Default)]
pub(super) struct Roles<'d> {
    pub(super) fps: Option<&'d Raw<'d>>,
    pub(super) viseme_type: Option<&'d JsonString<'d>>,
    pub(super) visemes: Option<&'d JsonString<'d>>,
    pub(super) events: Option<&'d JsonString<'d>>,
    /// Texts in file order, no locale twice.
    pub(super) texts: Vec<TextElement<'d>>,
}

/// A text element whose locale is known.
pub(super) struct TextElement<'d> {
    pub(super) locale: Box<str>,
    pub(super) name: &'d JsonString<'d>,
    pub(super) string: &'d JsonString<'d>,
}

impl<'d> Roles<'d> {
    /// Sorts the elements of `document` into roles; reports unknown names, wrong types and odd
    /// locales.
    pub(super) fn assign(
        document: &'d Document<'d>,
        options: &Options,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Roles<'d> {
        let mut roles = Roles::default();
        for element in &document.elements {
            match element.name.text.as_ref() {
                "fps" => roles.fps = types::number(element, diagnostics),
                "viseme_type" => roles.viseme_type = types::string(element, diagnostics),
                "visemes" => roles.visemes = types::string(element, diagnostics),
                "events" => roles.events = types::string(element, diagnostics),
                name => match locale::text_name(name) {
                    Some(text_name) => roles.text(element, text_name, options, diagnostics),
                    None => diagnostics.push(names::unknown(element)),
                },
            }
        }
        locales::keep_names_apart(document, diagnostics);
        roles
    }

    fn text(&mut self, element: &'d Element<'d>, name: TextName, options: &Options, diagnostics: &mut Vec<Diagnostic>) {
        let locale = locales::text_locale(element, name, options, diagnostics);
        let (Some(locale), Some(string)) = (locale, types::string(element, diagnostics)) else { return };
        if let Some(before) = self.texts.iter().find(|text| *text.locale == *locale) {
            diagnostics.push(
                Diagnostic::at(
                    Code::SameLocaleTwice,
                    element.name.span(),
                    format!("a second text for the locale `{locale}`"),
                )
                .also(before.name.span(), "the first one")
                .help("remove or rename one of the two"),
            );
            return;
        }
        self.texts.push(TextElement { locale: locale.into(), name: &element.name, string });
    }
}
