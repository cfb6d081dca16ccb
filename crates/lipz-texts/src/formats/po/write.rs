//! Writing of PO files.

use super::string::literal;
use super::{COMMENTS_EXPORTED, EXPORTED};
use crate::exchange::model::{Exchange, Item, State, Translation};
use crate::exchange::placeholder;
use crate::exchange::tag::underscored;
use crate::exchange::unreal::unreal_identity;
use crate::exchange::{Mark, WriteOptions};
use crate::formats::csv::report_misread;
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
    let mut out = header(&exchange.source_locale, locale);
    let none = Translation::default();
    let mut has_nul = false;
    if options.namespace.is_some() {
        report_misread(exchange, diagnostics);
    }
    for item in exchange.items(options.division) {
        let translation = item.unit.translations.get(at).unwrap_or(&none);
        let text = entry(&item, translation, locale.is_empty(), options.namespace.as_deref());
        if text.contains("\\000") && !has_nul {
            has_nul = true;
            let key = escape::quoted(&item.unit.key);
            let message = format!("the text of {key} contains U+0000, where gettext ends a text");
            diagnostics.push(Diagnostic::new(Code::ExchangeLoss, message).help("delete the character"));
        }
        out.push('\n');
        out.push_str(&text);
    }
    out.into_bytes()
}

/// Returns the first entry, which describes the file. It omits dates, so that the same texts produce the same file.
fn header(source_locale: &str, locale: &str) -> String {
    let fields = [
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
    let mut out = "msgid \"\"\nmsgstr \"\"\n".to_owned();
    for (name, value) in fields {
        let _ = writeln!(out, "\"{name}: {value}\\n\"");
    }
    out
}

fn entry(item: &Item<'_>, translation: &Translation, is_template: bool, namespace: Option<&str>) -> String {
    let text = item.text(translation);
    let mut out = String::new();
    let own = item.translator_comments(translation);
    for comment in own {
        let _ = writeln!(out, "# {}", escape::text(comment));
    }
    if namespace.is_some() {
        let location = item.paths().next().map(path).unwrap_or_default();
        let _ = writeln!(out, "#. Key:\t{}\n#. SourceLocation:\t{location}", escape::text(&item.id()));
    }
    for comment in item.comments() {
        let _ = writeln!(out, "#. {comment}");
    }
    if !own.is_empty() {
        let _ = writeln!(out, "#. {COMMENTS_EXPORTED}{}", Mark::of_comments(own));
    }
    // A template has no marks: `msgmerge` would copy them into files with translations.
    if !is_template {
        let _ = writeln!(out, "#. {EXPORTED}{}", item.mark(translation));
    }
    let paths: Vec<String> = item.paths().map(path).collect();
    if !paths.is_empty() {
        let _ = writeln!(out, "#: {}", paths.join(" "));
    }
    let made_from = item.made_from(translation);
    let is_fuzzy = !text.is_empty() && item.state(translation) == State::Initial;
    let has_placeholders = placeholder::are_plain(&item.source());
    let flags = [(is_fuzzy, "fuzzy"), (has_placeholders, PLAIN_PLACEHOLDERS)].into_iter();
    let flags: Vec<&str> = flags.filter(|(is_set, _)| *is_set).map(|(_, flag)| flag).collect();
    if !flags.is_empty() {
        let _ = writeln!(out, "#, {}", flags.join(", "));
    }
    if let Some(made_from) = made_from {
        for (number, line) in literal(&made_from).lines().enumerate() {
            let _ = writeln!(out, "#| {}{line}", if number == 0 { "msgid " } else { "" });
        }
    }
    let id = namespace.map_or_else(|| item.id(), |namespace| unreal_identity(namespace, &item.id()));
    let (id, source) = (literal(&id), literal(&item.source()));
    let _ = writeln!(out, "msgctxt {id}\nmsgid {source}\nmsgstr {}", literal(&text));
    out
}

/// Returns a path in the form of gettext 0.22, which puts paths with spaces between U+2068 and U+2069.
fn path(path: &str) -> String {
    let path = escape::text(path).into_owned();
    if path.contains(char::is_whitespace) { format!("\u{2068}{path}\u{2069}") } else { path }
}
