//! Translations that are older than their source.

use super::{Few, Text};
use crate::changes::changes;
use crate::record::{Standing, TextRecord};
use lipz_diagnostics::{Code, Diagnostic, escape};

/// Changes of a text that are marked one by one.
const MARKED: usize = 4;

/// Reports the segments of a translation that were made from another source text than that of today.
pub(super) fn check(
    record: &TextRecord,
    file: &str,
    source: &Text<'_>,
    translation: &Text<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let standings =
        record.standings(file, &source.locale, &translation.locale, &source.segments, &translation.segments);
    let mut found = Few::default();
    for (at, standing) in standings.into_iter().enumerate() {
        if let Standing::Stale { made_from, is_changed } = standing {
            found.add(|| stale(source, translation, at, &made_from, is_changed));
        }
    }
    found.report(diagnostics);
}

/// The diagnostic about a segment.
fn stale(source: &Text<'_>, translation: &Text<'_>, at: usize, made_from: &str, is_changed: bool) -> Diagnostic {
    let message = match is_changed {
        false => format!("the text in {} has changed since this was translated", source.locale),
        true => format!("this and the text in {} have both changed since one was made from the other", source.locale),
    };
    let now = source.segments.get(at).map_or("", String::as_str);
    let mut diagnostic = Diagnostic::at(Code::StaleTranslation, translation.span(at, None), message);
    let changes = changes(made_from, now);
    if changes.len() > MARKED {
        diagnostic = diagnostic.also(source.span(at, None), "many words are others");
    } else {
        for change in changes {
            let was = match change.old.is_empty() {
                true => "this is new".to_owned(),
                false if change.new.is_empty() => format!("here was {}", escape::quoted(change.old)),
                false => format!("this was {}", escape::quoted(change.old)),
            };
            diagnostic = diagnostic.also(source.span(at, Some(change.new)), was);
        }
    }
    diagnostic
        .note(format!("it was made from {}", escape::quoted(made_from)))
        .note(format!("the text is now  {}", escape::quoted(now)))
        .help("translate the new text; if the translation still says the same, `lipz accept FILE` notes that")
}
