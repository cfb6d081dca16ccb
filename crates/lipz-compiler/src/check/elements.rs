//! Which element plays which role: names, types, locales.

use crate::Options;
use lipz::locale::{self, TextName};
use lipz::{Code, Diagnostic, Document, Element, Level, Value};
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

/// Names of the elements of the format that are not texts.
const NAMES: [&str; 4] = ["fps", "visemes", "viseme_type", "events"];

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
                "fps" => roles.fps = number(element, diagnostics),
                "viseme_type" => roles.viseme_type = string(element, diagnostics),
                "visemes" => roles.visemes = string(element, diagnostics),
                "events" => roles.events = string(element, diagnostics),
                name => match locale::text_name(name) {
                    Some(text_name) => roles.text(element, text_name, options, diagnostics),
                    None => diagnostics.push(unknown(element)),
                },
            }
        }
        roles
    }

    fn text(&mut self, element: &'d Element<'d>, name: TextName, options: &Options, diagnostics: &mut Vec<Diagnostic>) {
        let locale = text_locale(element, name, options, diagnostics);
        let (Some(locale), Some(string)) = (locale, string(element, diagnostics)) else { return };
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

/// The locale of a text element, after reporting what is odd about its name.
fn text_locale(
    element: &Element<'_>,
    name: TextName,
    options: &Options,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<String> {
    let span = element.name.span();
    let written = &element.name.text;
    match name {
        TextName::Canonical(locale) => {
            unknown_locale(element, &locale, diagnostics);
            Some(locale)
        }
        TextName::Misspelt(locale) => {
            diagnostics.push(
                Diagnostic::at(Code::LocaleSpelling, span, format!("`{written}` is read as `text_{locale}`"))
                    .note("the format spells locales in lower case, with a hyphen, after text_")
                    .help(format!("write \"text_{locale}\""))
                    .fix(span, format!("\"text_{locale}\"")),
            );
            unknown_locale(element, &locale, diagnostics);
            Some(locale)
        }
        TextName::NoLocale => match &options.default_locale {
            Some(locale) => {
                let mut finding = Diagnostic::at(
                    Code::TextWithoutLocale,
                    span,
                    format!("`text` has no locale and is read as the default, `text_{locale}`"),
                )
                .help(format!("write \"text_{locale}\""))
                .fix(span, format!("\"text_{locale}\""));
                finding.level = Level::Warning;
                diagnostics.push(finding);
                Some(locale.clone())
            }
            None => {
                diagnostics.push(Diagnostic::at(Code::TextWithoutLocale, span, "`text` has no locale").help(
                    "write the locale, \"text_en-us\", or set the project's default locale: --default-locale en-us",
                ));
                None
            }
        },
        TextName::OtherShape(_, Some(tag)) if options.extended_locales => {
            // Tags differ in case by custom (zh-Hant); only separators are misspelt.
            if !written.eq_ignore_ascii_case(&format!("text_{tag}")) {
                diagnostics.push(
                    Diagnostic::at(Code::LocaleSpelling, span, format!("`{written}` is read as `text_{tag}`"))
                        .note("the format spells locales in lower case, with a hyphen, after text_")
                        .help(format!("write \"text_{tag}\""))
                        .fix(span, format!("\"text_{tag}\"")),
                );
            }
            Some(tag)
        }
        TextName::OtherShape(locale, tag) => {
            let finding =
                Diagnostic::at(Code::LocaleShape, span, format!("`{locale}` is not a locale of the form ll-cc"))
                    .note("ll is a language (ISO 639-1), cc a country (ISO 3166-1), both lower case: en-us, zh-tw");
            diagnostics.push(match tag {
                Some(_) => finding.help("name a country, or accept any BCP 47 tag: --extended-locales"),
                None => finding.help("write \"text_ll-cc\", for example \"text_en-us\""),
            });
            None
        }
    }
}

fn unknown_locale(element: &Element<'_>, tag: &str, diagnostics: &mut Vec<Diagnostic>) {
    let (language_unknown, country_unknown) = locale::unknown_parts(tag);
    if !language_unknown && !country_unknown {
        return;
    }
    let (language, country) = tag.split_once('-').unwrap_or((tag, ""));
    let what = match (language_unknown, country_unknown) {
        (true, true) => format!("`{language}` is no language and `{country}` no country"),
        (true, false) => format!("`{language}` is no language"),
        _ => format!("`{country}` is no country"),
    };
    let finding = Diagnostic::at(Code::UnknownLocale, element.name.span(), format!("{what} of the ISO lists"));
    diagnostics.push(match tag {
        "en-uk" => finding.help("the United Kingdom is gb: \"text_en-gb\""),
        _ => finding.help("languages are ISO 639-1 codes, countries ISO 3166-1 alpha-2 codes"),
    });
}

fn string<'d>(element: &'d Element<'d>, diagnostics: &mut Vec<Diagnostic>) -> Option<&'d JsonString<'d>> {
    if let Value::String(string) = &element.value {
        return Some(string);
    }
    let finding = wrong_type(element, "a string");
    diagnostics.push(match &element.value {
        Value::Number(_) => finding.help("put the value into double quotes"),
        _ => finding.help("remove the element if it has no value"),
    });
    None
}

fn number<'d>(element: &'d Element<'d>, diagnostics: &mut Vec<Diagnostic>) -> Option<&'d Raw<'d>> {
    match &element.value {
        Value::Number(number) => return Some(number),
        Value::String(string) if lipz::rate::parse(&string.text).is_some() => diagnostics.push(
            wrong_type(element, "a number")
                .help(format!("remove the quotes: {}", string.text))
                .fix(string.span(), string.text.clone()),
        ),
        _ => diagnostics.push(wrong_type(element, "a number").help("write frames per second as a number: 24, 29.97")),
    }
    None
}

fn wrong_type(element: &Element<'_>, expected: &str) -> Diagnostic {
    let found = element.value.type_name();
    Diagnostic::at(Code::WrongType, element.value.span(), format!("`{}` is {found}, not {expected}", element.name.text))
        .also(element.name.span(), format!("this element is {expected}"))
}

fn unknown(element: &Element<'_>) -> Diagnostic {
    let name = &element.name.text;
    let shown: String = name.chars().take(60).flat_map(char::escape_debug).collect();
    let finding =
        Diagnostic::at(Code::UnknownElement, element.name.span(), format!("`{shown}` is not an element of the format"))
            .note("it is kept in the bank's source section and not used");
    match suggestion(name) {
        Some(known) => finding.help(format!("did you mean `{known}`?")),
        None => finding,
    }
}

/// The element that someone who wrote `name` probably meant.
fn suggestion(name: &str) -> Option<&'static str> {
    let plain = |name: &str| name.to_lowercase().replace(['_', '-', ' '], "");
    if name.len() > 40 {
        return None;
    }
    let written = plain(name);
    NAMES
        .into_iter()
        .chain(["text_ll-cc"])
        .map(|known| (strsim::damerau_levenshtein(&written, &plain(known)), known))
        .filter(|&(distance, known)| distance * 3 <= known.len())
        .min()
        .map(|(_, known)| known)
}
