//! Links from a file to its recording.

use crate::document::Document;
use crate::project::KnownProject;
use crate::{convert, uri};
use lipz_diagnostics::Span;
use lsp_types::DocumentLink;
use std::path::Path;

/// Returns links to the recording of the clip from the name of its visemes, and to those of its dubs from the names of
/// their texts.
pub(crate) fn links(document: &Document, known: &KnownProject) -> Vec<DocumentLink> {
    let parsed = lipz_file::parse(document.text.as_bytes());
    let read = parsed.document.or(parsed.fragment.map(|fragment| fragment.document)).unwrap_or_default();
    let key = known.key(document.path.as_deref());
    let link = |name: &str, recording: &Path| {
        let name = read.get(name)?.name.span();
        let inside = Span { start: name.start + 1, end: name.end.saturating_sub(1) };
        Some(DocumentLink {
            range: convert::range(&document.rope, inside, document.mark_bytes()),
            target: Some(uri::of_path(recording)?),
            tooltip: Some(format!("the recording: {}", recording.file_name()?.to_string_lossy())),
            data: None,
        })
    };
    let own = known.recordings.find(&key).and_then(|recording| link("visemes", recording));
    let dubs = known.recordings.dubs(&key).into_iter();
    own.into_iter().chain(dubs.filter_map(|(locale, path)| link(&format!("text_{locale}"), path?))).collect()
}
