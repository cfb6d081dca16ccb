//! Writing of PO files.

use super::plural::{Grouped, ItemForms};
use super::string::literal;
use super::{COMMENTS_EXPORTED, EXPORTED, SOURCES_EXPORTED};
use crate::exchange::model::{Exchange, Item, State, Translation};
use crate::exchange::placeholder;
use crate::exchange::tag::underscored;
use crate::exchange::unreal::unreal_identity;
use crate::exchange::{Mark, WriteOptions};
use crate::formats::csv::report_misread;
use crate::plural::PluralForms;
use lipz_diagnostics::{Code, Diagnostic, escape};
use std::fmt::Write;

/// The flag of texts whose placeholders have the form of Python's: `{name}`. With it, `msgfmt -c`, Poedit and Weblate
/// check that a translation has the same placeholders.
const PLAIN_PLACEHOLDERS: &str = "python-brace-format";

/// Returns the file of the locale at `at` of the exchange.
pub(crate) fn write(
    exchange: &Exchange,
    at: usize,
    options: &WriteOptions,
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<u8> {
    let locale = exchange.locales.get(at).map_or("", String::as_str);
    // Unreal reads no plural forms, and a template has those of its source until `msginit` makes a file from it.
    let forms = match options.namespace {
        Some(_) => None,
        None if locale.is_empty() => PluralForms::of("en").map(|(forms, _)| (forms, TEMPLATE_FORMS.to_owned())),
        None => PluralForms::of(locale),
    };
    let grouped = Grouped::new(exchange, at, options.division, forms.as_ref().map(|(forms, _)| forms));
    // `msgmerge` needs the header where plural forms are added later; `msginit` writes it into files from a template.
    let plural_forms = forms.filter(|_| grouped.has_plurals() || !locale.is_empty()).map(|(_, header)| header);
    let mut out = header(&exchange.source_locale, locale, plural_forms);
    let mut has_nul = false;
    if options.namespace.is_some() {
        report_misread(exchange, diagnostics);
    }
    let writer = EntryWriter {
        items: &grouped.items,
        at,
        is_template: locale.is_empty(),
        namespace: options.namespace.as_deref(),
        none: Translation::default(),
    };
    for (item, forms) in grouped.entries() {
        let text = writer.entry(item, forms);
        if text.contains("\\000") && !has_nul {
            has_nul = true;
            let id = item.unit.id();
            let key = escape::quoted(&id);
            let message = format!("the text of {key} contains U+0000, where gettext ends a text");
            diagnostics.push(Diagnostic::new(Code::ExchangeLoss, message).help("delete the character"));
        }
        out.push('\n');
        out.push_str(&text);
    }
    out.into_bytes()
}

/// Returns the first entry, which describes the file. It omits dates, so that the same texts produce the same file.
fn header(source_locale: &str, locale: &str, plural_forms: Option<String>) -> String {
    let mut fields = vec![
        ("Project-Id-Version", "lipz".to_owned()),
        ("PO-Revision-Date", "YEAR-MO-DA HO:MI+ZONE".to_owned()),
        ("Last-Translator", "FULL NAME <EMAIL@ADDRESS>".to_owned()),
        ("Language-Team", "LANGUAGE <LL@li.org>".to_owned()),
        ("Language", underscored(locale)),
        ("MIME-Version", "1.0".to_owned()),
        ("Content-Type", "text/plain; charset=UTF-8".to_owned()),
        ("Content-Transfer-Encoding", "8bit".to_owned()),
        ("X-Generator", "lipz".to_owned()),
        ("X-Source-Language", underscored(source_locale)),
    ];
    fields.extend(plural_forms.map(|forms| ("Plural-Forms", forms)));
    let mut out = "msgid \"\"\nmsgstr \"\"\n".to_owned();
    for (name, value) in fields {
        let _ = writeln!(out, "\"{name}: {value}\\n\"");
    }
    out
}

/// The forms of a template, as `xgettext` writes them.
const TEMPLATE_FORMS: &str = "nplurals=INTEGER; plural=EXPRESSION;";

/// What the entries of a file have in common.
struct EntryWriter<'e> {
    items: &'e [Item<'e>],
    /// The index of the locale.
    at: usize,
    is_template: bool,
    namespace: Option<&'e str>,
    none: Translation,
}

impl EntryWriter<'_> {
    fn translation<'i>(&'i self, item: &'i Item<'_>) -> &'i Translation {
        item.unit.translations.get(self.at).unwrap_or(&self.none)
    }

    /// Returns the comments of an entry for people, and the mark of those of translators.
    fn comments(&self, item: &Item<'_>) -> String {
        let mut out = String::new();
        let own = item.translator_comments(self.translation(item));
        for comment in own {
            let _ = writeln!(out, "# {}", escape::text(comment));
        }
        if self.namespace.is_some() {
            let location = item.paths().next().map(path).unwrap_or_default();
            let _ = writeln!(out, "#. Key:\t{}\n#. SourceLocation:\t{location}", escape::text(&item.id()));
        }
        for comment in item.comments() {
            let _ = writeln!(out, "#. {comment}");
        }
        if !own.is_empty() {
            let _ = writeln!(out, "#. {COMMENTS_EXPORTED}{}", Mark::of_comments(own));
        }
        out
    }

    /// Returns the entry of an item, with its plural forms.
    fn entry(&self, item: &Item<'_>, forms: Option<&ItemForms>) -> String {
        let mut out = self.comments(item);
        let of_forms: Vec<(&str, Option<&Item<'_>>)> = match forms {
            Some(forms) => {
                let form = |(category, form): &(&'static str, Option<usize>)| {
                    (*category, form.and_then(|form| self.items.get(form)))
                };
                forms.items.iter().map(form).collect()
            }
            None => vec![("", Some(item))],
        };
        let marks = |mark: &dyn Fn(&Item<'_>) -> Mark| {
            let one = |(category, form): &(&str, Option<&Item<'_>>)| {
                let mark = mark((*form)?);
                Some(if category.is_empty() { mark.to_string() } else { format!("{category}:{mark}") })
            };
            of_forms.iter().filter_map(one).collect::<Vec<_>>().join(" ")
        };
        // A template has no marks: `msgmerge` would copy them into files with translations.
        if !self.is_template {
            let _ = writeln!(out, "#. {EXPORTED}{}", marks(&|form| form.mark(self.translation(form))));
            if forms.is_some() {
                let _ = writeln!(out, "#. {SOURCES_EXPORTED}{}", marks(&|form| Mark::of(&form.source())));
            }
        }
        let paths: Vec<String> = item.paths().map(path).collect();
        if !paths.is_empty() {
            let _ = writeln!(out, "#: {}", paths.join(" "));
        }
        let made_from = |form: &Item<'_>| form.made_from(self.translation(form));
        let is_stale = |form: &&Item<'_>| {
            let translation = self.translation(form);
            !form.text(translation).is_empty() && form.state(translation) == State::Initial
        };
        let is_fuzzy = of_forms.iter().filter_map(|(_, form)| *form).any(|form| is_stale(&form));
        let has_placeholders = placeholder::are_plain(&item.source());
        let flags = [(is_fuzzy, "fuzzy"), (has_placeholders, PLAIN_PLACEHOLDERS)].into_iter();
        let flags: Vec<&str> = flags.filter(|(is_set, _)| *is_set).map(|(_, flag)| flag).collect();
        if !flags.is_empty() {
            let _ = writeln!(out, "#, {}", flags.join(", "));
        }
        let one = of_forms.iter().find(|(category, _)| *category == "one").and_then(|(_, one)| made_from((*one)?));
        out.push_str(&previous(
            item,
            made_from(item),
            forms.map(|forms| one.as_ref().unwrap_or(&forms.singular)),
            one.is_some(),
        ));
        let context = self.namespace.map_or_else(|| item.id(), |namespace| unreal_identity(namespace, &item.id()));
        let _ = writeln!(out, "msgctxt {}", literal(&context));
        if let Some(forms) = forms {
            let _ = writeln!(out, "msgid {}", literal(&forms.singular));
        }
        let name = if forms.is_some() { "msgid_plural" } else { "msgid" };
        let _ = writeln!(out, "{name} {}", literal(&item.source()));
        for (number, (_, form)) in of_forms.iter().enumerate() {
            let translations =
                |form: &Item<'_>| item.text_of_variant(form, [item, form].map(|one| self.translation(one)));
            let text = form.map(translations).unwrap_or_default();
            let index = if forms.is_some() { format!("[{number}]") } else { String::new() };
            let _ = writeln!(out, "msgstr{index} {}", literal(&text));
        }
        out
    }
}

/// Returns the lines with the source text that a translation was made from. With plural forms, they also have the source
/// text for one thing, because gettext reads both or neither.
fn previous(item: &Item<'_>, made_from: Option<String>, singular: Option<&String>, is_old: bool) -> String {
    let comment = |name: &str, text: &str| {
        let lines = format!("{name} {}", literal(text));
        lines.lines().map(|line| format!("#| {line}\n")).collect::<String>()
    };
    match (made_from, singular) {
        (Some(made_from), None) => comment("msgid", &made_from),
        (None, singular) if singular.is_none() || !is_old => String::new(),
        (made_from, singular) => {
            let singular = comment("msgid", singular.map_or("", String::as_str));
            singular + &comment("msgid_plural", &made_from.unwrap_or_else(|| item.source()))
        }
    }
}

/// Returns a path in the form of gettext 0.22, which puts paths with spaces between U+2068 and U+2069.
fn path(path: &str) -> String {
    let path = escape::text(path).into_owned();
    if path.contains(char::is_whitespace) { format!("\u{2068}{path}\u{2069}") } else { path }
}
