//! The problems that a delivery would bring into the project, at their positions in the delivery.

use crate::commands::check::check_files;
use crate::shared::settings_file::Project;
use crate::shared::translations::texts_of_clips;
use lipz_compiler::{Content, Input};
use lipz_diagnostics::{Code, Diagnostic, Report, Span};
use lipz_file::locale::{TextName, text_name};
use lipz_file::{Document, Value, text};
use lipz_texts::{ClipTexts, Entry, texts_of};
use std::collections::HashMap;

/// The problems, each with the number of its file, and the reports about other parts of the clips.
type NewProblems = (Vec<(usize, Diagnostic)>, Vec<Report>);

/// Returns the problems of clips after an import: all those of texts that the import changes, and those of other parts that
/// the clips do not have before it. Each changed clip comes with its new text.
pub(super) fn new_problems<'e>(
    project: &Project,
    changed: Vec<(Input, String)>,
    entries: impl Iterator<Item = &'e Entry>,
) -> NewProblems {
    let keys: HashMap<String, String> = changed.iter().map(|(input, _)| (input.name(), input.key.clone())).collect();
    let before: Vec<Input> = changed.iter().map(|(input, _)| input.clone()).collect();
    let after = changed.into_iter().map(|(input, text)| {
        let content = Content::Bytes { name: input.name(), bytes: text.into_bytes() };
        Input { key: input.key, content }
    });
    let after: Vec<Input> = after.collect();
    let mut known: HashMap<(String, Code, String), usize> = HashMap::new();
    let texts = texts_of_clips(&before, &project.settings.options).into_iter().collect();
    for report in check_files(project, &before) {
        for old in report.diagnostics {
            *known.entry((report.source.path.clone(), old.code, old.message)).or_default() += 1;
        }
    }
    let by_key = by_key(entries);
    let (mut placed, mut others) = (Vec::new(), Vec::new());
    for mut report in check_files(project, &after) {
        let path = report.source.path.clone();
        let key = keys.get(&path).map_or("", String::as_str);
        let bytes = report.source.text.as_bytes();
        let document = lipz_file::parse(bytes).document.unwrap_or_default();
        let default_locale = project.settings.options.get_default_locale();
        let now = texts_of(&document, default_locale);
        report.diagnostics.retain(|new| {
            let place = new.primary.as_ref().and_then(|label| text_place(&document, label.span, default_locale));
            let is_changed = place.as_ref().is_some_and(|place| segment_of(&texts, key, place) != segment(&now, place));
            // The import will record the source texts.
            if new.code == Code::StaleTranslation || !is_changed && is_known(&mut known, &path, new) {
                return false;
            }
            let entry = place.and_then(|(locale, segment)| entry_of(by_key.get(key)?, &locale, segment));
            if let Some(entry) = entry {
                placed.push((entry.file, at_entry(new, entry, &path)));
            }
            entry.is_none()
        });
        others.extend((!report.diagnostics.is_empty()).then_some(report));
    }
    (placed, others)
}

/// Takes a problem from those before the import, if it is one of them.
fn is_known(known: &mut HashMap<(String, Code, String), usize>, path: &str, new: &Diagnostic) -> bool {
    let count = known.get_mut(&(path.to_owned(), new.code, new.message.clone()));
    count.filter(|count| **count > 0).map(|count| *count -= 1).is_some()
}

/// Returns a segment of a clip before the import.
fn segment_of<'t>(clips: &'t HashMap<String, ClipTexts>, key: &str, place: &(String, usize)) -> Option<&'t String> {
    segment(clips.get(key)?, place)
}

/// Returns the segment with this locale and this number, from 1.
fn segment<'t>(texts: &'t ClipTexts, (locale, number): &(String, usize)) -> Option<&'t String> {
    texts.get(locale)?.get(number.saturating_sub(1))
}

fn by_key<'e>(entries: impl Iterator<Item = &'e Entry>) -> HashMap<&'e str, Vec<&'e Entry>> {
    let mut by_key: HashMap<&str, Vec<&Entry>> = HashMap::new();
    entries.for_each(|entry| by_key.entry(&entry.key.text).or_default().push(entry));
    by_key
}

/// Returns the locale of the text at a position of a clip, and the number of its segment, from 1.
fn text_place(document: &Document<'_>, span: Span, default_locale: Option<&str>) -> Option<(String, usize)> {
    let at = span.range().start;
    let element = document.elements.iter().find(|element| element.value.span().range().contains(&at))?;
    let locale = match text_name(&element.name.text)? {
        TextName::NoLocale => default_locale?.to_owned(),
        name => name.tag()?,
    };
    let Value::String(string) = &element.value else { return None };
    let mut segments = text::segments(&string.text).map(|range| string.span_of(range).range());
    let segment = segments.position(|segment| at <= segment.end)?;
    Some((locale, segment + 1))
}

fn entry_of<'e>(entries: &[&'e Entry], locale: &str, segment: usize) -> Option<&'e Entry> {
    let of_segment = |entry: &&&Entry| entry.segment.is_none_or(|number| number == segment);
    entries.iter().filter(of_segment).find(|entry| &*entry.locale == locale && !entry.text.text.is_empty()).copied()
}

/// Returns the diagnostic at the position of an entry.
fn at_entry(found: &Diagnostic, entry: &Entry, path: &str) -> Diagnostic {
    let mut placed = Diagnostic::at(found.code, entry.text.span, found.message.as_str());
    placed.severity = found.severity;
    placed.notes.clone_from(&found.notes);
    placed.help.clone_from(&found.help);
    placed.note(format!("after the import, the text is in {path}"))
}
