//! The roles of a file's elements.

use super::ClipSpeech;
use super::locales::{keep_names_apart, text_locale};
use super::{names, types};
use crate::clip::Locales;
use crate::project::Options;
use foldhash::HashMap;
use lipz_diagnostics::{Code, Diagnostic, bound};
use lipz_file::locale::is_variant;
use lipz_file::{Document, Element};
use lipz_file::{JsonString, RawJson, curve, phones};

/// The maximum number of texts that are searched one by one, because a hash table costs more for so few.
const FEW_TEXTS: usize = 32;

/// The elements of the format by role. Their values have the right types.
#[derive(Default)]
pub(super) struct Roles<'d> {
    pub(super) fps: Option<&'d RawJson<'d>>,
    pub(super) viseme_type: Option<&'d JsonString<'d>>,
    pub(super) visemes: Option<&'d JsonString<'d>>,
    pub(super) events: Option<&'d JsonString<'d>>,
    pub(super) curves: Option<&'d RawJson<'d>>,
    pub(super) phones: Option<&'d JsonString<'d>>,
    /// Texts in file order, at most one per locale.
    pub(super) texts: Vec<TextElement<'d>>,
    /// The index of each locale's text, if there are many texts.
    places: HashMap<u32, usize>,
}

/// A text element whose locale is known.
pub(super) struct TextElement<'d> {
    /// The number of the locale.
    pub(super) locale: u32,
    pub(super) name: &'d JsonString<'d>,
    pub(super) string: &'d JsonString<'d>,
}

impl<'d> Roles<'d> {
    /// Assigns roles to the elements of `document`. Reports unknown names, wrong types and unusual locales.
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
                phones::ELEMENT => roles.phones = types::string(element, diagnostics),
                _ => match text_locale(element, options, locales, diagnostics) {
                    Some(locale) => roles.text(element, locale, locales, diagnostics),
                    None => diagnostics.push(names::unknown(element)),
                },
            }
        }
        keep_names_apart(document, diagnostics);
        roles
    }

    /// Returns the element that determines the number of segments of the clip: `visemes`, or else the text of the
    /// default locale, or else the text with the first tag, or else the events. The first element of the file would be
    /// wrong because the order of elements does not have a meaning.
    pub(super) fn reference(&self, options: &Options, locales: &Locales) -> Option<&'d JsonString<'d>> {
        let default = options.default_locale.as_deref();
        let rank = |text: &&TextElement<'d>| {
            let tag = locales.tag(text.locale);
            (Some(tag) != default, tag)
        };
        let first_text = || self.texts.iter().min_by_key(rank).map(|text| text.string);
        self.visemes.or_else(first_text).or(self.events)
    }

    /// Returns the texts: first the one in the locale of the voice, then the one in the default locale, then the rest
    /// by tag, variants last.
    pub(super) fn texts_by_voice(
        &self,
        options: &Options,
        spoken: ClipSpeech<'_>,
        locales: &Locales,
    ) -> Vec<&TextElement<'d>> {
        let mut texts: Vec<_> = self.texts.iter().collect();
        texts.sort_by_key(|text| {
            let tag = locales.tag(text.locale);
            (spoken.locale != Some(tag), Some(tag) != options.default_locale.as_deref(), is_variant(tag), tag)
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
                Diagnostic::at(Code::SameLocaleTwice, element.name.span(), format!("the locale `{tag}` has two texts"))
                    .also(before.name.span(), "first definition")
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

    /// Returns the text in this locale.
    fn text_in(&self, locale: u32) -> Option<&TextElement<'d>> {
        match self.places.is_empty() {
            true => self.texts.iter().find(|text| text.locale == locale),
            false => self.places.get(&locale).and_then(|&place| self.texts.get(place)),
        }
    }
}
