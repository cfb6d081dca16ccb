//! Stale translations.

use super::{FewDiagnostics, LocaleText};
use crate::exchange::State;
use crate::exchange::changes::changes;
use crate::record::{Standing, TextRecord};
use lipz_diagnostics::{Code, Diagnostic, escape};

/// The most changes of a text that are marked individually.
const MARKED: usize = 4;

/// Reports the segments of a translation whose source text has changed, or which were marked for review.
pub(super) fn check(
    record: &TextRecord,
    file: &str,
    source: &LocaleText<'_>,
    translation: &LocaleText<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let standings =
        record.standings(file, &source.locale, &translation.locale, &source.segments, &translation.segments);
    let mut found = FewDiagnostics::default();
    for (at, standing) in standings.into_iter().enumerate() {
        match standing {
            Standing::Stale { made_from, is_changed } => {
                found.add(|| stale(source, translation, at, &made_from, is_changed));
            }
            Standing::Current(State::Initial) => found.add(|| rejected(translation, at)),
            Standing::Current(_) | Standing::Unknown => {}
        }
    }
    found.report(diagnostics);
}

/// Returns the diagnostic about a segment whose translation was marked for review in an imported file.
fn rejected(translation: &LocaleText<'_>, at: usize) -> Diagnostic {
    let message = "the translation was marked for review in an imported file";
    Diagnostic::at(Code::StaleTranslation, translation.span(at, None), message)
        .help("import a new translation, or run `lipz approve FILE` if this one is correct")
}

/// Returns the diagnostic about a segment.
fn stale(
    source: &LocaleText<'_>,
    translation: &LocaleText<'_>,
    at: usize,
    made_from: &str,
    is_changed: bool,
) -> Diagnostic {
    let message = match is_changed {
        false => format!("the text in {} has changed since this was translated", source.name),
        true => {
            format!("the translation and the text in {} have both changed since the last translation", source.name)
        }
    };
    let now = source.segments.get(at).map_or("", String::as_str);
    let mut diagnostic = Diagnostic::at(Code::StaleTranslation, translation.span(at, None), message);
    let changes = changes(made_from, now);
    if changes.len() > MARKED {
        diagnostic = diagnostic.also(source.span(at, None), "many words have changed");
    } else {
        for change in changes {
            let was = match change.old.is_empty() {
                true => "this is new".to_owned(),
                false if change.new.is_empty() => format!("{} was removed here", escape::quoted(change.old)),
                false => format!("this was {}", escape::quoted(change.old)),
            };
            diagnostic = diagnostic.also(source.span(at, Some(change.new)), was);
        }
    }
    diagnostic
        .note(format!("the translation was made from {}", escape::quoted(made_from)))
        .note(format!("the text is now               {}", escape::quoted(now)))
        .help("translate the new text, or run `lipz approve FILE` if the translation is still correct")
}
