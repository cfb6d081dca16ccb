//! Values of options: frame rates, viseme types, locales and numbers.

use crate::reporter::{Abort, Reporter};
use lipz_bank::{Fps, VisemeType};
use lipz_compiler::{LocaleError, Options};

/// Returns the options with the command line's locale for texts without one, even if the project does not accept it.
pub(crate) fn with_default_locale(options: Options, locale: &str) -> Result<Options, LocaleError> {
    let extended = options.get_extended_locales();
    Ok(options.extended_locales(true).default_locale(locale)?.extended_locales(extended))
}

/// Refuses the first of these locales that the project does not accept in its Lipz files.
pub(crate) fn refuse_locales<'l>(
    locales: impl IntoIterator<Item = &'l str>,
    options: &Options,
    reporter: &mut Reporter,
) -> Result<(), Abort> {
    let is_refused = |tag: &&str| !options.get_extended_locales() && !lipz_file::locale::has_lipz_shape(tag);
    let Some(tag) = locales.into_iter().find(is_refused) else { return Ok(()) };
    let tip = "add a country, as in en-us, or set `extended-locales = true` in lipz.toml";
    Err(reporter.usage(format!("the locale `{tag}` does not have the form ll-cc"), tip))
}

pub(crate) fn parse_fps(text: &str) -> Result<Fps, String> {
    lipz_file::rate::parse(text)
        .and_then(|rate| Fps::new(rate.numerator, rate.denominator))
        .ok_or_else(|| "expected a frame rate from 1 to 1000, such as 24 or 29.97".into())
}

pub(crate) fn parse_viseme_type(text: &str) -> Result<VisemeType, String> {
    text.parse().map_err(|_| "expected blair, toonboom or rms".into())
}

pub(crate) fn parse_locale(text: &str) -> Result<String, String> {
    lipz_file::locale::canonical_tag(text, true)
        .ok_or_else(|| "expected a language and a country, such as en-us".into())
}
