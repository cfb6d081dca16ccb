//! The formats of other tools, one file each, and the list of them.

mod annosoft;
mod arkit_json;
mod audio2face;
mod azure;
mod bohemia;
mod cartesia;
mod face_frames;
mod glb;
mod gltf;
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
mod piper;
mod polly;
mod rhubarb;
mod rhubarb_json;
mod rhubarb_tsv;
mod rhubarb_xml;
mod timecode;

use crate::{ImportOptions, Track, fallout, textgrid};
use lipz_diagnostics::Diagnostic;

/// A format of another tool.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Format {
    /// The name in commands, `rhubarb-tsv`.
    pub name: &'static str,
    /// A short description of the tool and its file.
    pub about: &'static str,
    /// The extension of its files, without the dot.
    pub extension: &'static str,
    /// The mapping tables of its symbols. The first one is the default; another may fit a requested viseme type.
    pub maps: &'static [&'static str],
    /// Whether its files are binary. Their diagnostics have no spans, and notes state the bytes.
    pub is_binary: bool,
    /// Whether its tools write in the encoding of the system, so that a file that is not UTF-8 may be
    /// [guessed](crate::to_utf8) to be Windows-1252.
    pub is_legacy: bool,
    /// Whether it can store segments, texts and events.
    pub keeps_texts: bool,
    /// The reader, if lipz imports the format.
    pub read: Option<Read>,
    /// The writer, if lipz exports the format.
    pub write: Option<Write>,
}

/// Reads a file. Returns a track for each speaker, as far as the file is readable, and adds diagnostics.
pub type Read = fn(&[u8], &ImportOptions<'_>, &mut Vec<Diagnostic>) -> Vec<Track>;

/// Writes a track in the symbols of the format. Diagnostics report losses.
pub type Write = fn(&Track, &mut Vec<Diagnostic>) -> Vec<u8>;

/// All formats, in the order of lists.
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
    piper::FORMAT,
    annosoft::FORMAT,
    ovr::FORMAT,
    live_link::FORMAT,
    audio2face::FORMAT,
    arkit_json::FORMAT,
    gltf::FORMAT,
    textgrid::clip::FORMAT,
    lipz_txt::FORMAT,
    lipz_editor::FORMAT,
];

/// Returns the format with this name.
pub fn find(name: &str) -> Option<&'static Format> {
    ALL.iter().find(|format| format.name == name)
}
