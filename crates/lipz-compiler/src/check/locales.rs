//! The locale in the name of a text element.

use crate::clip::Locales;
use crate::project::Options;
use lipz_diagnostics::{Code, Diagnostic, Severity, escape};
use lipz_file::locale::{self, LanguageTag, TextName};
use lipz_file::{Document, Element};
use std::collections::HashMap;

/// Returns the locale of a text element, or `Some(None)` if its name does not contain a usable one, and `None` if it is
/// not a text element. Reports problems with the name.
pub(super) fn text_locale(
    element: &Element<'_>,
    options: &Options,
    locales: &mut Locales,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Option<u32>> {
    let name = element.name.text.as_ref();
    if let Some(known) = name.strip_prefix("text_").and_then(|tag| locales.clean(tag)) {
        return Some(Some(known));
    }
    let name = locale::text_name(name)?;
    let before = diagnostics.len();
    let tag = tag_of(element, name, options, diagnostics);
    // `clean` neither fills blank segments of variants nor checks them.
    Some(tag.map(|tag| locales.number(&tag, diagnostics.len() == before && !locale::is_variant(&tag))))
}

/// Returns the tag in the name of a text element.
fn tag_of(
    element: &Element<'_>,
    name: TextName,
    options: &Options,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<String> {
    match name {
        TextName::Canonical(locale) => {
            diagnostics.extend(unknown_parts(element, &locale));
            Some(locale)
        }
        TextName::Misspelt(locale) => {
            diagnostics.push(misspelt(element, &locale));
            diagnostics.extend(unknown_parts(element, &locale));
            Some(locale)
        }
        TextName::NoLocale => {
            let default = default_locale(options);
            diagnostics.push(no_locale(element, default.as_deref(), options));
            default
        }
        TextName::OtherShape(_, Some(tag)) if options.extended_locales => {
            // By convention, the case of tags varies (zh-Hant). Only wrong separators are misspelt.
            if !element.name.text.eq_ignore_ascii_case(&format!("text_{tag}")) {
                diagnostics.push(misspelt(element, &tag));
            }
            Some(tag)
        }
        TextName::OtherShape(locale, tag) => {
            diagnostics.push(other_shape(element, &locale, tag.is_some(), options));
            None
        }
    }
}

fn misspelt(element: &Element<'_>, locale: &str) -> Diagnostic {
    let message = format!("{} is read as `text_{locale}`", escape::quoted(&element.name.text));
    let diagnostic = Diagnostic::at(Code::LocaleSpelling, element.name.span(), message)
        .note("the format spells locales in lower case, with a hyphen, after text_");
    renamed(diagnostic, element, locale)
}

/// Returns the default locale of the project in canonical form. Callers that fix a single file may pass a different
/// spelling.
fn default_locale(options: &Options) -> Option<String> {
    locale::canonical_tag(options.default_locale.as_deref()?, options.extended_locales)
}

fn no_locale(element: &Element<'_>, default: Option<&str>, options: &Options) -> Diagnostic {
    let name = &element.name.text;
    let diagnostic = |message| Diagnostic::at(Code::TextWithoutLocale, element.name.span(), message);
    let Some(default) = default else {
        let diagnostic = diagnostic(format!("`{name}` has no locale")).help(
            "write the locale, \"text_en-us\", or set the project's default locale: default-locale = \"en-us\" in \
             lipz.toml",
        );
        let is_lowered = options.levels.lowers(Code::TextWithoutLocale);
        return if is_lowered { diagnostic.note("it is kept for unpacking; games do not see it") } else { diagnostic };
    };
    let mut diagnostic = diagnostic(format!("`{name}` has no locale and is read as the default, `text_{default}`"));
    diagnostic.severity = Severity::Warning;
    renamed(diagnostic, element, default)
}

/// Adds the help and the fix that rename the element to `text_` and the locale.
fn renamed(diagnostic: Diagnostic, element: &Element<'_>, locale: &str) -> Diagnostic {
    let name = format!("\"text_{locale}\"");
    diagnostic.help(format!("write {name}")).fix(element.name.span(), name)
}

/// Removes fixes that would give two elements the same name.
pub(super) fn keep_names_apart(document: &Document<'_>, diagnostics: &mut [Diagnostic]) {
    let renames = |diagnostic: &Diagnostic| {
        matches!(diagnostic.code, Code::LocaleSpelling | Code::TextWithoutLocale | Code::LocaleShape)
    };
    if !diagnostics.iter().any(|diagnostic| renames(diagnostic) && diagnostic.fixes().next().is_some()) {
        return;
    }
    let mut count_of: HashMap<String, usize> = HashMap::new();
    for name in document.elements.iter().map(|element| lipz_file::literal(&element.name.text)) {
        *count_of.entry(name).or_default() += 1;
    }
    for fix in diagnostics.iter().filter(|diagnostic| renames(diagnostic)).flat_map(Diagnostic::fixes) {
        *count_of.entry(fix.replacement).or_default() += 1;
    }
    for diagnostic in diagnostics.iter_mut().filter(|diagnostic| renames(diagnostic)) {
        diagnostic.retain_fixes(|fix| count_of.get(&fix.replacement) == Some(&1));
    }
}

/// Returns the diagnostic for a locale that the options do not allow. `is_tag` states whether it is a tag of BCP 47.
fn other_shape(element: &Element<'_>, locale: &str, is_tag: bool, options: &Options) -> Diagnostic {
    if let Some(diagnostic) = other_key(element, locale) {
        return diagnostic;
    }
    let shown = escape::quoted(locale);
    let diagnostic = if options.extended_locales {
        Diagnostic::at(Code::LocaleShape, element.name.span(), format!("{shown} is not a BCP 47 language tag"))
            .note("a tag is a language, with a script or a region: en-us, es-419, zh-hant")
    } else {
        Diagnostic::at(Code::LocaleShape, element.name.span(), format!("{shown} is not a locale of the form ll-cc"))
            .note("ll is a language (ISO 639-1), cc a country (ISO 3166-1), both lower case: en-us, zh-tw")
    };
    let without_blanks = element.name.text.trim();
    match locale::text_name(without_blanks) {
        Some(TextName::Canonical(tag)) if without_blanks.len() < element.name.text.len() => {
            let name = format!("\"text_{tag}\"");
            diagnostic.help(format!("remove the space: {name}")).fix(element.name.span(), name)
        }
        _ if let Some(tag) = meant_variant(locale, options) => {
            diagnostic.help(format!("for a variant, write \"text_{tag}\""))
        }
        _ if is_tag => diagnostic.help("add a country, or accept any BCP 47 tag: extended-locales = true in lipz.toml"),
        _ => diagnostic.help("write \"text_ll-cc\", for example \"text_en-us\""),
    }
}

/// Returns the tag of the variant that a name probably means: `x-one` without a locale, or `en-us-one` without `x`.
fn meant_variant(locale: &str, options: &Options) -> Option<String> {
    let tag = locale.to_ascii_lowercase().replace('_', "-");
    let (base, key) = match tag.strip_prefix("x-") {
        Some(key) => (default_locale(options).unwrap_or_else(|| "en-us".to_owned()), key),
        None => {
            let (base, key) = tag.split_at_checked("ll-cc".len())?;
            (base.to_owned(), key.strip_prefix('-')?)
        }
    };
    let is_variant = locale::has_lipz_shape(&base) && locale::is_variant_key(key);
    is_variant.then(|| locale::variant_tag(&base, key))
}

/// Returns the diagnostic for the tag of a variant whose key is missing, too long or spelled with other characters.
fn other_key(element: &Element<'_>, locale: &str) -> Option<Diagnostic> {
    let tag = locale.to_ascii_lowercase().replace('_', "-");
    let (base, key) = match locale::split_variant(&tag) {
        (base, Some(key)) => (base, key),
        (tag, None) => (tag.strip_suffix("-x")?, ""),
    };
    if LanguageTag::parse(base).is_none() || locale::is_variant_key(key) {
        return None;
    }
    let limit = locale::LONGEST_KEY;
    let message = match key.len() {
        0 => "the key of the variant is missing after `-x-`".to_owned(),
        length if length > limit => format!("the key of the variant has {length} bytes; the limit is {limit}"),
        _ => format!("{} is not the key of a variant", escape::quoted(key)),
    };
    let note = format!(
        "a key is one or more names of at most {} letters a to z and digits, joined by hyphens, at most {limit} bytes \
         in all; no name is `x`",
        locale::LONGEST_NAME,
    );
    let help = format!("write a key of this form: \"text_{base}-x-few\", \"text_{base}-x-few-fem\"");
    Some(Diagnostic::at(Code::LocaleShape, element.name.span(), message).note(note).help(help))
}

/// Returns the warning for a language or a country that is not in an ISO list.
fn unknown_parts(element: &Element<'_>, tag: &str) -> Option<Diagnostic> {
    let (tag, _) = locale::split_variant(tag);
    let diagnostic = Diagnostic::at(Code::UnknownLocale, element.name.span(), in_no_list(tag)?);
    Some(diagnostic.help(match tag {
        "en-uk" => "write \"text_en-gb\"; the code of the United Kingdom is gb",
        _ => "use an ISO 639-1 code for the language and an ISO 3166-1 alpha-2 code for the country",
    }))
}

/// Returns a sentence about the parts of an `ll-cc` tag that are not in an ISO list, or `None` if both are.
pub(crate) fn in_no_list(tag: &str) -> Option<String> {
    let (language, country) = tag.split_once('-').unwrap_or((tag, ""));
    let what = match locale::unknown_parts(tag) {
        (false, false) => return None,
        (true, true) => format!("`{language}` is not a language and `{country}` not a country"),
        (true, false) => format!("`{language}` is not a language"),
        (false, true) => format!("`{country}` is not a country"),
    };
    Some(format!("{what} in the ISO lists"))
}
