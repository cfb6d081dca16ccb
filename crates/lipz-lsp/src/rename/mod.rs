//! Renaming of a character, a prop or an action, in all files of a project.

mod settings;

use crate::document::Document;
use crate::project::KnownProject;
use crate::timing::decoded;
use crate::words::{Role, each, events};
use crate::{convert, uri};
use lipz_compiler::settings::is_word;
use lipz_diagnostics::Span;
use lipz_file::{Value, curve, literal};
use lsp_types::{
    DocumentChanges, OneOf, OptionalVersionedTextDocumentIdentifier, TextDocumentEdit, TextEdit, Uri, WorkspaceEdit,
};
use ropey::Rope;
use std::borrow::Cow;
use std::collections::HashMap;
use std::path::Path;

/// A name in the events of a file.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct NamedSpan {
    pub(crate) text: String,
    pub(crate) span: Span,
    role: Role,
}

impl NamedSpan {
    /// Returns the roles that share their names with this one.
    fn roles(&self) -> &'static [Role] {
        if self.role == Role::Action { &[Role::Action] } else { &[Role::Character, Role::Target] }
    }

    /// Returns the lists of the settings that may contain the name.
    fn lists(&self) -> &'static [&'static str] {
        if self.role == Role::Action { &["actions"] } else { &["characters", "props"] }
    }
}

/// Returns the name at byte `at` of the text, after a byte order mark. Emotions cannot be renamed, because the format
/// defines them.
pub(crate) fn name_at(text: &str, at: usize) -> Option<NamedSpan> {
    let parsed = lipz_file::parse(text.as_bytes());
    let read = parsed.document.or(parsed.fragment.map(|fragment| fragment.document))?;
    let events = events(&read)?;
    let at = decoded(events, at)?;
    let mut found = None;
    each(&events.text, |role, range| {
        if role != Role::Emotion && (range.start..=range.end).contains(&at) {
            found = Some((role, range));
        }
    });
    let (role, range) = found?;
    let text = events.text.get(range.clone())?.to_owned();
    Some(NamedSpan { text, span: events.span_of(range), role })
}

/// The files that are open in the editor, by path name.
pub(crate) type OpenFiles<'d> = HashMap<String, &'d Document>;

/// Returns the edits that rename `name` to `new`.
///
/// # Errors
/// If `new` is not a valid name, or is already in use.
pub(crate) fn rename(
    known: &KnownProject,
    open: &OpenFiles<'_>,
    name: &NamedSpan,
    new: &str,
) -> Result<WorkspaceEdit, String> {
    if !is_word(new) {
        return Err("a name is one word without spaces, `,` or `|`".to_owned());
    }
    let is_same = new == name.text;
    let is_taken =
        |role: &Role| known.words.allowed(*role, known.project.settings.options.get_known_names()).contains(new);
    if !is_same && name.roles().iter().any(is_taken) {
        return Err(format!("`{new}` is already in use"));
    }
    let unsaved = open.iter().map(|(path, document)| (path.clone(), document.text.clone())).collect();
    let work = |path: &str, bytes: &[u8]| file_edit(path, bytes, open.get(path).copied(), name, new);
    let found: Vec<Option<TextDocumentEdit>> =
        known.each_file(&unsaved, work).into_iter().collect::<Result<_, String>>()?;
    let settings = known.project.file.as_deref().and_then(|file| settings_edit(file, open, name, new));
    let edits = found.into_iter().flatten().chain(settings).collect();
    Ok(WorkspaceEdit { document_changes: Some(DocumentChanges::Edits(edits)), ..WorkspaceEdit::default() })
}

/// Returns the edit of a Lipz file that contains the name. Fails if the file may contain it, but cannot be parsed.
fn file_edit(
    path: &str,
    bytes: &[u8],
    open: Option<&Document>,
    name: &NamedSpan,
    new: &str,
) -> Result<Option<TextDocumentEdit>, String> {
    // Most files do not contain the name. Escapes may hide it.
    if !contains(bytes, name.text.as_bytes()) && !bytes.contains(&b'\\') {
        return Ok(None);
    }
    let Some(document) = lipz_file::parse(bytes).document else {
        return Err(format!("`{path}` has errors that hide its events; fix them first"));
    };
    let mut spans = Vec::new();
    if let Some(events) = events(&document) {
        let mut ranges = Vec::new();
        each(&events.text, |role, range| {
            if name.roles().contains(&role) && events.text.get(range.clone()) == Some(&name.text) {
                ranges.push(range);
            }
        });
        spans.extend(events.spans_of(ranges));
    }
    if name.role != Role::Action {
        spans.extend(curves_of(&document, &name.text));
    }
    let quoted = literal(new);
    let inside = quoted.get(1..quoted.len() - 1).unwrap_or_default();
    Ok(text_edit(Path::new(path), bytes, open, &spans, inside))
}

/// Returns the positions of curves whose names start with a character's name: `mara.fear`.
fn curves_of(document: &lipz_file::Document<'_>, name: &str) -> Vec<Span> {
    let Some(Value::Other(raw)) = document.get(curve::ELEMENT).map(|element| &element.value) else { return Vec::new() };
    let curves = curve::parse(raw, &mut Vec::new()).unwrap_or_default();
    let is_theirs = |curve: &curve::Curve<'_>| {
        let rest = curve.name.text.strip_prefix(name);
        rest.is_some_and(|rest| rest.starts_with('.'))
    };
    let theirs = curves.iter().filter(|curve| is_theirs(curve));
    theirs.map(|curve| curve.name.span_of(0..name.len())).collect()
}

/// Returns the edit of the settings file, if its registry contains the name.
fn settings_edit(file: &Path, open: &OpenFiles<'_>, name: &NamedSpan, new: &str) -> Option<TextDocumentEdit> {
    let path = crate::server::path_name(file);
    let document = open.get(&path).copied();
    let text = document.map_or_else(|| std::fs::read_to_string(file).ok(), |document| Some(document.text.clone()))?;
    // JSON and TOML use the same escapes here.
    let mark = text.len() - lipz_file::without_byte_order_mark(text.as_bytes()).len();
    let spans = settings::places(&text[mark..], name.lists(), &name.text);
    text_edit(file, text.as_bytes(), document, &spans, &literal(new))
}

/// Returns an edit that writes `new` at each of the spans; `None` if there are no spans.
fn text_edit(
    path: &Path,
    bytes: &[u8],
    open: Option<&Document>,
    spans: &[Span],
    new: &str,
) -> Option<TextDocumentEdit> {
    let (uri, version): (Uri, _) = match open {
        Some(document) => (document.uri.clone(), Some(document.version)),
        None => (uri::of_path(path)?, None),
    };
    if spans.is_empty() {
        return None;
    }
    // Editors remove the byte order mark of the files that they read.
    let (text, shift) = match open {
        Some(document) => (Cow::Borrowed(document.text.as_str()), document.mark_bytes()),
        None => (String::from_utf8_lossy(lipz_file::without_byte_order_mark(bytes)), 0),
    };
    let rope = Rope::from_str(&text);
    let edit =
        |span: &Span| OneOf::Left(TextEdit { range: convert::range(&rope, *span, shift), new_text: new.to_owned() });
    let text_document = OptionalVersionedTextDocumentIdentifier { uri, version };
    Some(TextDocumentEdit { text_document, edits: spans.iter().map(edit).collect() })
}

fn contains(bytes: &[u8], name: &[u8]) -> bool {
    !name.is_empty() && bytes.windows(name.len()).any(|window| window == name)
}
