//! The work of a project as one HTML file, without scripts.

use super::html::{html, html_page};
use super::list::cost_of;
use super::{LocaleWork, OpenSegment, Progress, Work};
use crate::exchange::changes::changes;
use std::fmt::Write;

/// The most segments of a locale that the page shows. The rest are counted.
const SHOWN: usize = 500;

/// Returns an HTML file about the work: the progress of each locale in words, and its missing and stale segments.
/// `title` names the project. With a cost per word, it includes the cost of the remaining work. The same texts always
/// produce the same bytes.
pub fn page(work: &Work, title: &str, cost_per_word: Option<f64>) -> String {
    let source_locale = html(&work.source_locale);
    let source = work.locales.first().map(LocaleWork::all).unwrap_or_default();
    let mut out = format!(
        "<p>From <b>{source_locale}</b>: {} with {}.</p>\n",
        counted(source.segments, "segment"),
        counted(source.words, "word")
    );
    summary(work, cost_per_word, &mut out);
    let (translated, unknown) = work.unknown();
    if unknown > 0 {
        let _ = writeln!(
            out,
            "<p>Unknown: the source text of {} is not recorded. Run <code>lipz approve --all</code> to record the \
                current one.</p>",
            share(unknown, translated)
        );
    }
    for locale in work.locales.iter().filter(|locale| !locale.open.is_empty()) {
        details(locale, &work.source_locale, &mut out);
    }
    html_page(&format!("Translations of {title}"), &out)
}

fn summary(work: &Work, cost_per_word: Option<f64>, out: &mut String) {
    let cost_head = if cost_per_word.is_some() { "<th class=\"n\">cost</th>" } else { "" };
    let states: String =
        Progress::ALL.iter().rev().map(|progress| format!("<th class=\"n\">{}</th>", progress.name())).collect();
    let _ = write!(
        out,
        "<div class=\"wide\"><table>\n<caption>Words by progress of their translations</caption>\n\
         <tr><th>locale</th><th class=\"bar\"></th><th class=\"n\">done</th>{states}<th class=\"n\">to do</th>{cost_head}</tr>\n",
    );
    for locale in &work.locales {
        let name = html(&locale.locale);
        let linked = match locale.open.is_empty() {
            true => name.clone(),
            false => format!("<a href=\"#{name}\">{name}</a>"),
        };
        let amounts: String = Progress::ALL
            .iter()
            .rev()
            .map(|progress| format!("<td class=\"n\">{}</td>", grouped(locale.amount(*progress).words)))
            .collect();
        let to_do = locale.to_do().words;
        let cost = cost_per_word.map(|cost| format!("<td class=\"n\">{}</td>", cost_of(to_do, cost)));
        let _ = writeln!(
            out,
            "<tr><th>{linked}</th><td class=\"bar\">{}</td><td class=\"n\">{:.1} %</td>{amounts}<td class=\"n\"><b>{}</b></td>{}</tr>",
            bar(locale),
            locale.percent_in_tenths(),
            grouped(to_do),
            cost.unwrap_or_default()
        );
    }
    out.push_str("</table></div>\n");
}

/// Returns the progress of a locale as a bar. The numbers next to it state the same.
fn bar(locale: &LocaleWork) -> String {
    let all = locale.all().words.max(1) as f64;
    let mut bar = "<span class=\"bar\" aria-hidden=\"true\">".to_owned();
    for progress in Progress::ALL.iter().rev() {
        let words = locale.amount(*progress).words;
        if words > 0 {
            let percent = words as f64 * 100.0 / all;
            let name = progress.name();
            let _ =
                write!(bar, "<i class=\"{name}\" style=\"width:{percent:.2}%\" title=\"{name}: {words} words\"></i>");
        }
    }
    bar + "</span>"
}

/// Appends the open segments of a locale. Stale ones come first, because players see them.
fn details(locale: &LocaleWork, source_locale: &str, out: &mut String) {
    let name = html(&locale.locale);
    let _ = writeln!(out, "<h2 id=\"{name}\">{name}</h2>");
    for progress in [Progress::Stale, Progress::Missing] {
        let amount = locale.amount(progress);
        if amount.segments == 0 {
            continue;
        }
        let (open, other) = match progress {
            Progress::Stale => (" open=\"\"", "<th>translation</th>"),
            _ => ("", ""),
        };
        let _ = writeln!(
            out,
            "<details{open}><summary>{}: {}, {}</summary>\n<div class=\"wide\"><table>\n\
             <tr><th>clip</th><th>{}</th>{other}</tr>",
            progress.name(),
            counted(amount.segments, "segment"),
            counted(amount.words, "word"),
            html(source_locale)
        );
        let of_kind = || locale.open.iter().filter(|open| open.progress() == progress);
        of_kind().take(SHOWN).for_each(|open| row(open, out));
        out.push_str("</table></div>\n");
        let rest = amount.segments.saturating_sub(SHOWN);
        if rest > 0 {
            let _ = writeln!(out, "<p>{} more are not shown.</p>", grouped(rest));
        }
        out.push_str("</details>\n");
    }
}

fn row(open: &OpenSegment, out: &mut String) {
    let number = open.number.map(|number| format!(" <small>{number}</small>")).unwrap_or_default();
    let source = match &open.made_from {
        Some(made_from) => marked(made_from, &open.source),
        None => html(&open.source),
    };
    let text = match open.progress() {
        Progress::Missing => String::new(),
        _ => format!("<td dir=\"auto\">{}</td>", html(&open.text)),
    };
    let _ = writeln!(
        out,
        "<tr><td class=\"key\">{}{number}</td><td dir=\"auto\">{source}</td>{text}</tr>",
        html(&open.key)
    );
}

/// Returns the new text, with the old one struck out.
fn marked(old: &str, new: &str) -> String {
    let mut out = String::new();
    let mut done = 0;
    for change in changes(old, new) {
        out += &html(new.get(done..change.new.start).unwrap_or_default());
        if !change.old.is_empty() {
            let _ = write!(out, "<del>{}</del>", html(change.old));
        }
        if !change.new.is_empty() {
            let _ = write!(out, "<ins>{}</ins>", html(new.get(change.new.clone()).unwrap_or_default()));
        }
        done = change.new.end;
    }
    out + &html(new.get(done..).unwrap_or_default())
}

/// Returns a phrase such as `1 translated segment` or `2 of 5 translated segments`.
fn share(unknown: usize, translated: usize) -> String {
    let all = counted(translated, "translated segment");
    if unknown == translated { all } else { format!("{} of {all}", grouped(unknown)) }
}

/// Returns a phrase such as `1 word` or `12,345 words`.
fn counted(number: usize, what: &str) -> String {
    format!("{} {what}{}", grouped(number), if number == 1 { "" } else { "s" })
}

/// Returns a number such as `12,345`.
fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let mut out = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            out.push(',');
        }
        out.push(digit);
    }
    out
}
