//! The section `XPRT`: data of an object in addition to its bank.

use super::ContentHash;
use super::plan::MAKER;
use super::wire::WireReport;
use lipz_layout::{CHECKED_FROM, DirectoryEntry, Header, MAX_SECTIONS, Tag};
use serde::{Deserialize, Serialize};
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::Path;
use zerocopy::FromBytes;

/// The format name in an export table.
const FORMAT: &str = "lipz-object";
/// The version of its format.
const VERSION: u32 = 1;

/// The export table of an object.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ExportTable {
    pub(super) format: String,
    pub(super) version: u32,
    /// The version of lipz that made the object.
    pub(super) lipz: String,
    pub(super) shard: u16,
    pub(super) shards: u16,
    /// The hash of the options, except for those about single clips.
    pub(super) options: ContentHash,
    /// Path and contents of the settings file.
    pub(super) settings: Option<(String, String)>,
    /// The locales of the clips' texts, in order.
    pub(super) locales: Vec<String>,
    /// The names of the clips' files in messages, sorted by key.
    pub(super) names: Vec<String>,
    /// Diagnostics of the files.
    pub(super) reports: Vec<WireReport>,
}

impl ExportTable {
    pub(super) fn new(shard: u16, shards: u16, options: ContentHash) -> ExportTable {
        ExportTable {
            format: FORMAT.to_owned(),
            version: VERSION,
            lipz: MAKER.to_owned(),
            shard,
            shards,
            options,
            settings: None,
            locales: Vec::new(),
            names: Vec::new(),
            reports: Vec::new(),
        }
    }

    /// Returns the section.
    pub(super) fn encode(&self) -> Vec<u8> {
        // It consists of strings and numbers, which JSON can always represent.
        serde_json::to_vec(self).unwrap_or_default()
    }

    /// Decodes the export table in a section, or returns the reason for a failure.
    fn decode(section: &[u8]) -> Result<ExportTable, String> {
        let export: ExportTable =
            serde_json::from_slice(section).map_err(|error| format!("its export table is invalid: {error}"))?;
        if export.format != FORMAT || export.version != VERSION {
            return Err(format!("its export table has version {}, not {VERSION}", export.version));
        }
        Ok(export)
    }
}

/// Returns the checksum of the object at `path`, and its export table, or the reason why it is not an object. Nothing
/// else is read, and nothing is verified yet.
pub(super) fn read(path: &Path) -> io::Result<Result<(u64, ExportTable), String>> {
    let mut file = File::open(path)?;
    let mut head = vec![0; size_of::<Header>() + MAX_SECTIONS * size_of::<DirectoryEntry>()];
    let length = read_up_to(&mut file, &mut head)?;
    head.truncate(length);
    let Some((header, entries)) = directory(&head) else { return Ok(Err("it is not a bank".to_owned())) };
    let Some(entry) = entries.iter().find(|entry| entry.tag == Tag::EXPORT.0) else {
        return Ok(Err("it is a bank without an export table".to_owned()));
    };
    let (start, length) = (u64::from(entry.offset_bytes.get()), u64::from(entry.length_bytes.get()));
    file.seek(SeekFrom::Start(start))?;
    let mut section = Vec::new();
    file.take(length).read_to_end(&mut section)?;
    Ok(ExportTable::decode(&section).map(|export| (header.checksum.get(), export)))
}

fn directory(head: &[u8]) -> Option<(&Header, &[DirectoryEntry])> {
    let (header, rest) = Header::ref_from_prefix(head).ok()?;
    let count = (header.section_count.get() as usize).min(MAX_SECTIONS);
    let (entries, _) = <[DirectoryEntry]>::ref_from_prefix_with_elems(rest, count).ok()?;
    (head.len() > CHECKED_FROM && header.magic == lipz_layout::MAGIC).then_some((header, entries))
}

fn read_up_to(file: &mut File, buffer: &mut [u8]) -> io::Result<usize> {
    let mut length = 0;
    while length < buffer.len() {
        match file.read(&mut buffer[length..]) {
            Ok(0) => break,
            Ok(read) => length += read,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
    Ok(length)
}
