//! The formats of other tools, one file each, and the list of them.

mod azure;
mod bohemia;
mod cartesia;
mod kotor;
mod lipz_editor;
mod lipz_txt;
mod live_link;
mod moho;
mod ovr;
mod pamela;
mod papagayo;
mod papagayo_pg2;
mod papagayo_pgo;
mod polly;
mod rhubarb;
mod rhubarb_json;
mod rhubarb_tsv;
mod rhubarb_xml;

use crate::{ImportOptions, Track, fallout, textgrid};
use lipz_diagnostics::Diagnostic;

/// A format of another tool.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Format {
    /// What commands call it, `rhubarb-tsv`.
    pub name: &'static str,
    /// The tool and its file, in a few words.
    pub about: &'static str,
    /// The extension that its files have, without the dot.
    pub extension: &'static str,
    /// The mapping tables of its symbols; the first one is used unless another viseme type is asked for.
    pub maps: &'static [&'static str],
    /// Whether its files are not text: then diagnostics have no spans, and notes name bytes.
    pub is_binary: bool,
    /// Whether its tools write in the encoding of the system, so that a file that is not UTF-8 may be
    /// [guessed](crate::to_utf8) to be Windows-1252.
    pub is_legacy: bool,
    /// Whether it has a place for segments, texts and events.
    pub keeps_texts: bool,
    /// Reads a file, if lipz imports the format.
    pub read: Option<Read>,
    /// Writes a file, if lipz exports the format.
    pub write: Option<Write>,
}

/// Reads a file: a track for each speaker, as far as the file can be read, and diagnostics.
pub type Read = fn(&[u8], &ImportOptions<'_>, &mut Vec<Diagnostic>) -> Vec<Track>;

/// Writes a track whose symbols are those of the format. Diagnostics say what the format cannot hold.
pub type Write = fn(&Track, &mut Vec<Diagnostic>) -> Vec<u8>;

/// Every format, in the order in which lists show them.
pub const ALL: &[Format] = &[
    rhubarb_tsv::FORMAT,
    rhubarb_json::FORMAT,
    rhubarb_xml::FORMAT,
    moho::FORMAT,
    papagayo_pgo::FORMAT,
    papagayo_pg2::FORMAT,
    pamela::FORMAT,
    kotor::FORMAT,
    bohemia::FORMAT,
    fallout::clip::FORMAT,
    polly::FORMAT,
    azure::FORMAT,
    cartesia::FORMAT,
    ovr::FORMAT,
    live_link::FORMAT,
    textgrid::clip::FORMAT,
    lipz_txt::FORMAT,
    lipz_editor::FORMAT,
];

/// The format of this name.
pub fn find(name: &str) -> Option<&'static Format> {
    ALL.iter().find(|format| format.name == name)
}
