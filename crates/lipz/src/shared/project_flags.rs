//! The flags for what a project decides about its Lipz files: one for every setting of `lipz.toml`.

use crate::reporter::{Abort, Reporter};
use clap::{Arg, ArgAction, Args};
use lipz_bank::{Fps, VisemeType};
use lipz_compiler::settings::is_word;
use lipz_compiler::{KnownNames, LocaleError, Options, TextLimits};

const DEFAULTS: &str = "What files leave open";
const LOCALES: &str = "Locales";
const TEXTS: &str = "Texts";
const EVENTS: &str = "Events";

/// Flags about a bank as a whole, by their fields below.
const OF_BANKS: [&str; 4] = ["locales", "fallback", "pseudo", "min_coverage"];

/// Hides flags about a bank as a whole from the help of a command that makes none. They are still accepted there, as
/// the settings of a project are.
pub(crate) fn hide_of_banks(flag: Arg) -> Arg {
    let is_of_bank = OF_BANKS.contains(&flag.get_id().as_str());
    if is_of_bank { flag.hide(true) } else { flag }
}

/// Flags that override settings.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct ProjectFlags {
    /// Frame rate of files without `fps` [default: unspecified, the game supplies it]
    #[arg(long, value_name = "FPS", value_parser = parse_fps, help_heading = DEFAULTS)]
    default_fps: Option<Fps>,

    /// Viseme type of files without `viseme_type`: blair, toonboom, rms [default: unspecified]
    #[arg(long, value_name = "TYPE", value_parser = parse_viseme_type, help_heading = DEFAULTS)]
    default_viseme_type: Option<VisemeType>,

    /// Locale of `text` without a locale, and the last fallback of the others
    #[arg(long, value_name = "LOCALE", value_parser = parse_locale, help_heading = DEFAULTS)]
    default_locale: Option<String>,

    /// Convert clips of other viseme types to this one
    #[arg(long, value_name = "TYPE", value_parser = parse_viseme_type)]
    viseme_type: Option<VisemeType>,

    /// Accept any BCP 47 language tag (es-419, zh-hant), not only ll-cc
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    #[arg(help_heading = LOCALES)]
    extended_locales: Option<bool>,

    /// Locales to pack, separated by `,` [default: all that the files have]
    #[arg(long, value_name = "LOCALES", value_delimiter = ',', value_parser = parse_locale)]
    #[arg(help_heading = LOCALES)]
    locales: Option<Vec<String>>,

    /// Fallbacks for missing texts of a locale, in order: de-at=de-de,en-us
    #[arg(long, value_name = "LOCALE=LOCALES", value_parser = parse_fallback, action = ArgAction::Append)]
    #[arg(help_heading = LOCALES)]
    fallback: Vec<(String, Vec<String>)>,

    /// Add a pseudo-locale of the default locale's texts, with accents and longer: en-xa of en-us
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    #[arg(help_heading = LOCALES)]
    pseudo: Option<bool>,

    /// Minimum percentage of clips with text in each locale, or in one: 90, de-de=100
    #[arg(long, value_name = "[LOCALE=]PERCENT", value_parser = parse_min_coverage, action = ArgAction::Append)]
    #[arg(help_heading = LOCALES)]
    min_coverage: Vec<(Option<String>, f64)>,

    /// Display braces as they are: `{0}` is a placeholder of the game, not meta information
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    #[arg(help_heading = TEXTS)]
    literal_braces: Option<bool>,

    /// Maximum columns in a line of text
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u32).range(1..), help_heading = TEXTS)]
    max_line_columns: Option<u32>,

    /// Maximum lines in the text of a segment
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u32).range(1..), help_heading = TEXTS)]
    max_lines: Option<u32>,

    /// Maximum reading speed, in characters per second
    #[arg(long, value_name = "NUMBER", value_parser = parse_positive, help_heading = TEXTS)]
    max_characters_per_second: Option<f64>,

    /// Characters that events may mention, separated by `,` [default: any]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = parse_word, help_heading = EVENTS)]
    characters: Option<Vec<String>>,

    /// Props that events may mention in addition to characters [default: any]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = parse_word, help_heading = EVENTS)]
    props: Option<Vec<String>>,

    /// Emotions in addition to those of the specification
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = parse_word, help_heading = EVENTS)]
    emotions: Option<Vec<String>>,

    /// Actions that characters can do [default: any]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = parse_word, help_heading = EVENTS)]
    actions: Option<Vec<String>>,

    /// Curves in addition to the emotions and the blend shapes of ARKit [default: any]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', help_heading = EVENTS)]
    curves: Option<Vec<String>>,
}

impl ProjectFlags {
    /// The options of the project with what the flags name over them.
    ///
    /// # Errors
    /// Those of the setters, for locales that no project accepts: flags with such locales are refused before.
    pub(crate) fn apply(&self, options: Options) -> Result<Options, LocaleError> {
        let options = self.apply_locales(options)?;
        let (limits, names) = (self.limits(options.get_text_limits()), self.names(options.get_known_names().clone()));
        let default_fps = self.default_fps.or(options.get_default_fps());
        let default_viseme_type = self.default_viseme_type.or(options.get_default_viseme_type());
        let viseme_type = self.viseme_type.or(options.get_viseme_type());
        let literal_braces = self.literal_braces.unwrap_or(options.get_literal_braces());
        let options = options.default_fps(default_fps).default_viseme_type(default_viseme_type);
        Ok(options.viseme_type(viseme_type).literal_braces(literal_braces).text_limits(limits).known_names(names))
    }

    /// The same with what they say about locales.
    fn apply_locales(&self, options: Options) -> Result<Options, LocaleError> {
        let extended = self.extended_locales.unwrap_or(options.get_extended_locales());
        let pseudo = self.pseudo.unwrap_or(options.get_pseudo());
        let mut min_coverage = options.get_min_coverage().clone();
        for (locale, percent) in &self.min_coverage {
            min_coverage = match locale {
                None => min_coverage.all(*percent),
                Some(locale) => min_coverage.locale(locale, *percent)?,
            };
        }
        // Whether the project accepts these locales is checked afterwards, together with those of its settings.
        let mut options = options.extended_locales(true).pseudo(pseudo).min_coverage(min_coverage);
        if let Some(locale) = &self.default_locale {
            options = options.default_locale(locale)?;
        }
        if let Some(locales) = &self.locales {
            options = options.locales(locales)?;
        }
        for (locale, chain) in &self.fallback {
            options = options.fallback(locale, chain)?;
        }
        Ok(options.extended_locales(extended))
    }

    fn limits(&self, mut limits: TextLimits) -> TextLimits {
        if let Some(count) = self.max_line_columns {
            limits = limits.line_columns(count);
        }
        if let Some(count) = self.max_lines {
            limits = limits.lines(count);
        }
        if let Some(count) = self.max_characters_per_second {
            limits = limits.characters_per_second(count);
        }
        limits
    }

    fn names(&self, mut names: KnownNames) -> KnownNames {
        let present = |names: &Vec<String>| names.iter().filter(|name| !name.is_empty()).cloned().collect::<Vec<_>>();
        if let Some(characters) = &self.characters {
            names = names.characters(present(characters));
        }
        if let Some(props) = &self.props {
            names = names.props(present(props));
        }
        if let Some(emotions) = &self.emotions {
            names = names.emotions(present(emotions));
        }
        if let Some(actions) = &self.actions {
            names = names.actions(present(actions));
        }
        if let Some(curves) = &self.curves {
            names = names.curves(present(curves));
        }
        names
    }
}

/// The options with a locale of the command line for texts without one, whether the project accepts it or not.
pub(crate) fn with_default_locale(options: Options, locale: &str) -> Result<Options, LocaleError> {
    let extended = options.get_extended_locales();
    Ok(options.extended_locales(true).default_locale(locale)?.extended_locales(extended))
}

/// Refuses locales of the options that need `extended-locales`, which is not set.
pub(crate) fn refuse_locales_of(options: &Options, reporter: &mut Reporter) -> Result<(), Abort> {
    let fallbacks = options.get_fallbacks().iter().flat_map(|(locale, chain)| std::iter::once(locale).chain(chain));
    let locales = options.get_locales().into_iter().flatten().chain(fallbacks).map(String::as_str);
    refuse_locales(options.get_default_locale().into_iter().chain(locales), options, reporter)
}

/// Refuses the first of these locales that the project does not accept in its Lipz files.
pub(crate) fn refuse_locales<'l>(
    locales: impl IntoIterator<Item = &'l str>,
    options: &Options,
    reporter: &mut Reporter,
) -> Result<(), Abort> {
    let is_refused = |tag: &&str| !options.get_extended_locales() && !lipz_file::locale::has_lipz_shape(tag);
    let Some(tag) = locales.into_iter().find(is_refused) else { return Ok(()) };
    let tip = "name a country, as in en-us, or accept any BCP 47 tag: --extended-locales, `extended-locales = true` in lipz.toml";
    Err(reporter.usage(format!("the locale `{tag}` does not have the form ll-cc"), tip))
}

pub(crate) fn parse_fps(text: &str) -> Result<Fps, String> {
    lipz_file::rate::parse(text)
        .and_then(|rate| Fps::new(rate.numerator, rate.denominator))
        .ok_or_else(|| "a frame rate is a number from 1 to 1000, such as 24 or 29.97".into())
}

pub(crate) fn parse_viseme_type(text: &str) -> Result<VisemeType, String> {
    text.parse().map_err(|_| "the viseme types are blair, toonboom and rms".into())
}

pub(crate) fn parse_locale(text: &str) -> Result<String, String> {
    lipz_file::locale::canonical_tag(text, true)
        .ok_or_else(|| "a locale is a language and a country, such as en-us".into())
}

fn parse_fallback(text: &str) -> Result<(String, Vec<String>), String> {
    let (locale, chain) = text.split_once('=').ok_or("write the locale, `=`, and those it falls back to")?;
    let chain = chain.split(',').map(parse_locale).collect::<Result<_, _>>()?;
    Ok((parse_locale(locale)?, chain))
}

fn parse_min_coverage(text: &str) -> Result<(Option<String>, f64), String> {
    let (locale, percent) = match text.split_once('=') {
        Some((locale, percent)) => (Some(parse_locale(locale)?), percent),
        None => (None, text),
    };
    match percent.parse::<f64>() {
        Ok(percent) if (0.0..=100.0).contains(&percent) => Ok((locale, percent)),
        _ => Err("write percent from 0 to 100: 90, or de-de=90".into()),
    }
}

pub(crate) fn parse_positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number > 0.0 && number.is_finite() => Ok(number),
        _ => Err("it must be a number above 0".into()),
    }
}

/// A word that events mention; nothing between the commas is no word.
fn parse_word(text: &str) -> Result<String, String> {
    if text.is_empty() || is_word(text) {
        Ok(text.to_owned())
    } else {
        Err("names in events are words without spaces, `,` and `|`".into())
    }
}
