//! Positions and changes in files, in the format of SARIF.

use crate::Label;
use crate::Report;
use crate::render::places::Places;
use crate::{Fix, Span};
use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, utf8_percent_encode};
use serde::Serialize;

/// The characters to encode in a URI: all except letters, digits, these signs (RFC 3986, 2.3) and `/`.
const ENCODED: &AsciiSet = &NON_ALPHANUMERIC.remove(b'-').remove(b'.').remove(b'_').remove(b'~').remove(b'/');

#[derive(Serialize)]
pub(super) struct Message {
    text: String,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Location {
    physical_location: PhysicalLocation,
    #[serde(skip_serializing_if = "Option::is_none")]
    message: Option<Message>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct PhysicalLocation {
    artifact_location: ArtifactLocation,
    #[serde(skip_serializing_if = "Option::is_none")]
    region: Option<Region>,
}

#[derive(Serialize)]
struct ArtifactLocation {
    uri: String,
}

/// Lines and columns from 1; the end is the column after the last character.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Region {
    start_line: u32,
    start_column: u32,
    end_line: u32,
    end_column: u32,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct ArtifactChange {
    artifact_location: ArtifactLocation,
    replacements: [Replacement; 1],
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Replacement {
    deleted_region: Region,
    inserted_content: Message,
}

impl Message {
    pub(super) fn new(text: impl Into<String>) -> Message {
        Message { text: text.into() }
    }
}

/// A file with diagnostics.
pub(super) struct File {
    uri: String,
    places: Places,
}

impl File {
    pub(super) fn new(report: &Report) -> File {
        File { uri: uri(&report.source.path), places: Places::new(report) }
    }

    /// Returns the marked position, or the whole file; `None` for a diagnostic without a file.
    pub(super) fn location(&self, label: Option<&Label>) -> Option<Location> {
        if self.uri.is_empty() {
            return None;
        }
        let text = label.map(|label| label.text.as_str()).filter(|text| !text.is_empty());
        Some(Location {
            physical_location: PhysicalLocation {
                artifact_location: self.artifact(),
                region: label.map(|label| self.region(label.span)),
            },
            message: text.map(Message::new),
        })
    }

    pub(super) fn change(&self, fix: &Fix) -> ArtifactChange {
        let inserted_content = Message::new(&fix.replacement);
        ArtifactChange {
            artifact_location: self.artifact(),
            replacements: [Replacement { deleted_region: self.region(fix.span), inserted_content }],
        }
    }

    fn artifact(&self) -> ArtifactLocation {
        ArtifactLocation { uri: self.uri.clone() }
    }

    fn region(&self, span: Span) -> Region {
        let [start, end] = self.places.ends(span);
        Region { start_line: start.line, start_column: start.column, end_line: end.line, end_column: end.column }
    }
}

/// Returns the path as a URI reference. Relative paths stay relative.
fn uri(path: &str) -> String {
    let encoded = utf8_percent_encode(path, ENCODED);
    match path.as_bytes() {
        [b'/', ..] => format!("file://{encoded}"),
        [drive, b':', b'/', ..] if drive.is_ascii_alphabetic() => {
            let rest = utf8_percent_encode(&path[2..], ENCODED);
            format!("file:///{}:{rest}", char::from(*drive))
        }
        _ => encoded.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_become_uris() {
        assert_eq!(uri("voices/act 1/mära#2?.lipz"), "voices/act%201/m%C3%A4ra%232%3F.lipz");
        assert_eq!(uri("../a:b/100%.lipz"), "../a%3Ab/100%25.lipz");
        assert_eq!(uri("/voices/aye.lipz"), "file:///voices/aye.lipz");
        assert_eq!(uri("C:/voices/aye.lipz"), "file:///C:/voices/aye.lipz");
    }
}
