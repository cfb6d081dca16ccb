//! The text of a Lipz file that is spoken in its recording.

use lipz_compiler::settings::Settings;
use lipz_file::locale::{TextName, text_name};
use lipz_file::{Document, JsonString, Value};

/// Returns the spoken text in `locale`, and its locale. Without a locale, returns the first text.
pub(crate) fn spoken<'d>(
    document: &'d Document<'d>,
    locale: Option<&str>,
    default_locale: Option<&str>,
) -> Option<(Option<String>, &'d JsonString<'d>)> {
    let mut texts = document.elements.iter().filter_map(|element| {
        let Value::String(string) = &element.value else { return None };
        let tag = match text_name(&element.name.text)? {
            TextName::NoLocale => default_locale.map(str::to_owned),
            text => Some(text.tag()?),
        };
        Some((tag, string))
    });
    match locale {
        Some(locale) => texts.find(|(tag, _)| tag.as_ref().is_none_or(|tag| tag == locale)),
        None => texts.next(),
    }
}

/// Returns the spoken text of a Lipz file: in the locale of a voice, or that of the project.
pub(crate) fn spoken_text<'d>(settings: &Settings, voice: Option<&str>, document: &'d Document<'d>) -> Option<&'d str> {
    spoken_string(settings, voice, document).map(|text| &*text.text)
}

/// Returns the same, with its position in the file.
pub(crate) fn spoken_string<'d>(
    settings: &Settings,
    voice: Option<&str>,
    document: &'d Document<'d>,
) -> Option<&'d JsonString<'d>> {
    let default_locale = settings.options.get_default_locale();
    let locale = voice.or(settings.audio.locale.as_deref()).or(default_locale);
    spoken(document, locale, default_locale).map(|(_, text)| text)
}
