//! Quick actions: the fix of a diagnostic, and all fixes of a file.

use crate::document::Document;
use crate::project::KnownProject;
use crate::{convert, place};
use lipz_compiler::Compiler;
use lipz_diagnostics::{Diagnostic, Span};
use lsp_types::{
    CodeAction, CodeActionKind, CodeActionOrCommand, DocumentChanges, OneOf, OptionalVersionedTextDocumentIdentifier,
    TextDocumentEdit, TextEdit, WorkspaceEdit,
};
use std::ops::Range;

/// The action that applies all certain fixes, for "fix all" and on save.
pub(crate) const FIX_ALL: &str = "source.fixAll.lipz";

/// Returns the actions for a range of the text, of the kinds that the editor requests.
pub(crate) fn actions(
    document: &Document,
    known: &KnownProject,
    range: Range<usize>,
    wanted: Option<&[CodeActionKind]>,
) -> Vec<CodeActionOrCommand> {
    let is_wanted = |kind: &str| {
        let has = |wanted: &CodeActionKind| {
            let rest = kind.strip_prefix(wanted.as_str());
            rest.is_some_and(|rest| wanted.as_str().is_empty() || rest.is_empty() || rest.starts_with('.'))
        };
        wanted.is_none_or(|wanted| wanted.iter().any(has))
    };
    let mut actions = Vec::new();
    if is_wanted(CodeActionKind::QUICKFIX.as_str()) {
        let shift = document.mark_bytes();
        let here = document.shown.iter().enumerate().filter(|(_, diagnostic)| touches(diagnostic, shift, &range));
        actions.extend(here.filter_map(|(index, diagnostic)| quick_fix(document, index, diagnostic)));
    }
    let has_fix = document.shown.iter().any(|diagnostic| diagnostic.fixes().next().is_some());
    if has_fix && is_wanted(FIX_ALL) {
        actions.extend(fix_all(document, known));
    }
    actions.into_iter().map(CodeActionOrCommand::CodeAction).collect()
}

/// Whether a diagnostic overlaps the range. A diagnostic about the whole file always does.
fn touches(diagnostic: &Diagnostic, shift: usize, range: &Range<usize>) -> bool {
    let Some(label) = &diagnostic.primary else { return true };
    label.span.start as usize + shift <= range.end && range.start <= label.span.end as usize + shift
}

fn quick_fix(document: &Document, index: usize, diagnostic: &Diagnostic) -> Option<CodeAction> {
    // "Did you mean" is offered as well, but is not what "fix all" applies.
    let fix = diagnostic.fix.as_ref()?;
    let help = diagnostic.help.as_deref().and_then(|help| help.lines().next());
    let range = convert::range(&document.rope, fix.span, document.mark_bytes());
    Some(CodeAction {
        title: format!("{} ({})", help.unwrap_or(&diagnostic.message), diagnostic.code),
        kind: Some(CodeActionKind::QUICKFIX),
        diagnostics: convert::of_document(document).get(index).map(|shown| vec![shown.clone()]),
        edit: Some(edit(document, TextEdit { range, new_text: fix.replacement.clone() })),
        is_preferred: Some(fix.is_certain()),
        ..CodeAction::default()
    })
}

fn fix_all(document: &Document, known: &KnownProject) -> Option<CodeAction> {
    let settings = &known.project.settings;
    let name = document.path.as_deref().map(|path| path.display().to_string()).unwrap_or_default();
    let options = settings.options.for_file(&name).into_owned().voices(settings.voices());
    let fixed = Compiler::new(options).fix(document.text.as_bytes())?;
    Some(CodeAction {
        title: "apply all fixes".to_owned(),
        kind: Some(CodeActionKind::new(FIX_ALL)),
        edit: Some(edit(document, replacement(document, &fixed.text))),
        ..CodeAction::default()
    })
}

/// Returns an edit of the current version of one file.
fn edit(document: &Document, edit: TextEdit) -> WorkspaceEdit {
    let text_document =
        OptionalVersionedTextDocumentIdentifier { uri: document.uri.clone(), version: Some(document.version) };
    let edits = vec![TextDocumentEdit { text_document, edits: vec![OneOf::Left(edit)] }];
    WorkspaceEdit { document_changes: Some(DocumentChanges::Edits(edits)), ..WorkspaceEdit::default() }
}

/// Returns the edit that turns the text into `after`. It only covers the differences, so that cursors and folds stay.
pub(crate) fn replacement(document: &Document, after: &str) -> TextEdit {
    let before = document.text.as_str();
    let same = |(a, b): &(char, char)| a == b;
    let start: usize = before.chars().zip(after.chars()).take_while(same).map(|(c, _)| c.len_utf8()).sum();
    let (rest_before, rest_after) = (&before[start..], &after[start..]);
    let end: usize =
        rest_before.chars().rev().zip(rest_after.chars().rev()).take_while(same).map(|(c, _)| c.len_utf8()).sum();
    // A position cannot be between the two characters of a line break.
    let (start, end) = (outside(before, start).0, before.len() - outside(before, before.len() - end).1);
    let range = place::range(&document.rope, Span::new(start, before.len() - end));
    TextEdit { range, new_text: after[start..after.len() - end].to_owned() }
}

/// Returns the byte itself, or the two bytes around the CRLF in which it is.
fn outside(text: &str, at: usize) -> (usize, usize) {
    let is_inside = text[..at].ends_with('\r') && text[at..].starts_with('\n');
    if is_inside { (at - 1, at + 1) } else { (at, at) }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "tests")]
mod tests {
    use super::*;
    use crate::check;
    use lsp_types::Uri;
    use std::str::FromStr;

    fn document(text: &str) -> Document {
        let mut document = Document::new(Uri::from_str("untitled:a").unwrap(), 1, text.into());
        document.shown = check::check(&KnownProject::default(), None, text);
        document
    }

    /// Returns the text after the single edit of an action.
    fn applied(document: &Document, action: &CodeActionOrCommand) -> String {
        let CodeActionOrCommand::CodeAction(action) = action else { panic!() };
        let Some(DocumentChanges::Edits(edits)) = &action.edit.as_ref().unwrap().document_changes else { panic!() };
        let OneOf::Left(edit) = &edits[0].edits[0] else { panic!() };
        let range = place::bytes(&document.rope, edit.range);
        format!("{}{}{}", &document.text[..range.start], edit.new_text, &document.text[range.end..])
    }

    #[test]
    fn a_fix_where_it_is_needed_and_all_of_them_at_once() {
        let document = document("{\"fps\": \"24\", \"visemes\": \"MA EO\",}");
        let of = |range, wanted: Option<&[CodeActionKind]>| actions(&document, &KnownProject::default(), range, wanted);
        let at_comma = of(33..33, Some(&[CodeActionKind::QUICKFIX]));
        assert_eq!(at_comma.len(), 1);
        assert_eq!(applied(&document, &at_comma[0]), "{\"fps\": \"24\", \"visemes\": \"MA EO\"}");
        let all = of(0..0, Some(&[CodeActionKind::SOURCE]));
        assert_eq!(applied(&document, &all[0]), "{\"fps\": 24, \"visemes\": \"MAEO\"}");
        assert_eq!(of(0..34, None).len(), 4, "three fixes, and all");
        assert_eq!(of(0..34, Some(&[CodeActionKind::REFACTOR])).len(), 0);
    }

    #[test]
    fn what_was_probably_meant_is_offered_and_not_applied_with_all() {
        let text = "{\"events\": \"feels anrgy, amy feel sad\", \"visems\": \"\", \"text_en-us\": \"{angr 2} a\"}";
        let (document, nobody) = (document(text), KnownProject::default());
        let found = actions(&document, &nobody, 0..text.len(), None);
        let mut fixed: Vec<String> = found.iter().map(|action| applied(&document, action)).collect();
        fixed.sort();
        let mut expected = [("amy feel sad", "amy feels sad"), ("visems", "visemes"), ("angr 2", "anger 2")]
            .map(|(from, to)| text.replace(from, to));
        expected.sort();
        assert_eq!(fixed, expected);
        let CodeActionOrCommand::CodeAction(first) = &found[0] else { unreachable!() };
        assert_eq!(first.is_preferred, Some(false));
    }

    #[test]
    fn only_what_differs_is_replaced() {
        let before = document("{\"a𝄞a\": 1}");
        let edit = replacement(&before, "{\"a𝄞a𝄞a\": 1}");
        assert_eq!((edit.new_text.as_str(), edit.range.start), ("𝄞a", edit.range.end));
        assert_eq!(replacement(&document("{}"), "{}").new_text, "");
        let edit = replacement(&document("{\r\n}"), "{\n}");
        assert_eq!((edit.new_text.as_str(), edit.range.end.line), ("\n", 1), "not within a line break");
    }
}
