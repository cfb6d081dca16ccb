//! Which element plays which role.

use super::Spoken;
use super::locales::{keep_names_apart, text_locale};
use super::{names, types};
use crate::Options;
use crate::clip::Locales;
use foldhash::HashMap;
use lipz_diagnostics::{Code, Diagnostic, bound};
use lipz_file::{Document, Element};
use lipz_file::{JsonString, Raw, curve};

/// Texts that are looked through one by one: for so few, a table costs more.
const FEW_TEXTS: usize = 32;

/// Elements of the format by role, with values of the right type.
#[derive(Default)]
pub(super) struct Roles<'d> {
    pub(super) fps: Option<&'d Raw<'d>>,
    pub(super) viseme_type: Option<&'d JsonString<'d>>,
    pub(super) visemes: Option<&'d JsonString<'d>>,
    pub(super) events: Option<&'d JsonString<'d>>,
    pub(super) curves: Option<&'d Raw<'d>>,
    /// Texts in file order, no locale twice.
    pub(super) texts: Vec<TextElement<'d>>,
    /// Where the text of each locale is among them, if they are many.
    places: HashMap<u32, usize>,
}

/// A text element whose locale is known.
pub(super) struct TextElement<'d> {
    /// Number of the locale.
    pub(super) locale: u32,
    pub(super) name: &'d JsonString<'d>,
    pub(super) string: &'d JsonString<'d>,
}

impl<'d> Roles<'d> {
    /// Sorts the elements of `document` into roles; reports unknown names, wrong types and odd
    /// locales.
    pub(super) fn assign(
        document: &'d Document<'d>,
        options: &Options,
        locales: &mut Locales,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Roles<'d> {
        let mut roles = Roles { texts: Vec::with_capacity(document.elements.len()), ..Roles::default() };
        for element in &document.elements {
            bound::limit_many(diagnostics);
            match element.name.text.as_ref() {
                "fps" => roles.fps = types::number(element, diagnostics),
                "viseme_type" => roles.viseme_type = types::string(element, diagnostics),
                "visemes" => roles.visemes = types::string(element, diagnostics),
                "events" => roles.events = types::string(element, diagnostics),
                curve::ELEMENT => roles.curves = types::object(element, diagnostics),
                _ => match text_locale(element, options, locales, diagnostics) {
                    Some(locale) => roles.text(element, locale, locales, diagnostics),
                    None => diagnostics.push(names::unknown(element)),
                },
            }
        }
        keep_names_apart(document, diagnostics);
        roles
    }

    /// The element that says how many segments the clip has: `visemes`, or else the text of the default locale, or
    /// that of the first tag, or the events. Not the first of the file: the order of elements means nothing.
    pub(super) fn reference(&self, options: &Options, locales: &Locales) -> Option<&'d JsonString<'d>> {
        let default = options.default_locale.as_deref();
        let rank = |text: &&TextElement<'d>| {
            let tag = locales.tag(text.locale);
            (Some(tag) != default, tag)
        };
        let first_text = || self.texts.iter().min_by_key(rank).map(|text| text.string);
        self.visemes.or_else(first_text).or(self.events)
    }

    /// The texts: first that in the locale of the voice, then that of the default locale, then in the order of their tags.
    pub(super) fn texts_by_voice(
        &self,
        options: &Options,
        spoken: Spoken<'_>,
        locales: &Locales,
    ) -> Vec<&TextElement<'d>> {
        let mut texts: Vec<_> = self.texts.iter().collect();
        texts.sort_by_key(|text| {
            let tag = locales.tag(text.locale);
            (spoken.locale != Some(tag), Some(tag) != options.default_locale.as_deref(), tag)
        });
        texts
    }

    fn text(
        &mut self,
        element: &'d Element<'d>,
        locale: Option<u32>,
        locales: &Locales,
        diagnostics: &mut Vec<Diagnostic>,
    ) {
        let (Some(locale), Some(string)) = (locale, types::string(element, diagnostics)) else { return };
        if let Some(before) = self.text_in(locale) {
            let tag = locales.tag(locale);
            diagnostics.push(
                Diagnostic::at(
                    Code::SameLocaleTwice,
                    element.name.span(),
                    format!("a second text for the locale `{tag}`"),
                )
                .also(before.name.span(), "the first one")
                .help("remove or rename one of the two"),
            );
            return;
        }
        if self.texts.len() >= FEW_TEXTS {
            if self.places.is_empty() {
                self.places = self.texts.iter().map(|text| text.locale).zip(0..).collect();
            }
            self.places.insert(locale, self.texts.len());
        }
        self.texts.push(TextElement { locale, name: &element.name, string });
    }

    /// The text in this locale.
    fn text_in(&self, locale: u32) -> Option<&TextElement<'d>> {
        match self.places.is_empty() {
            true => self.texts.iter().find(|text| text.locale == locale),
            false => self.places.get(&locale).and_then(|&place| self.texts.get(place)),
        }
    }
}
