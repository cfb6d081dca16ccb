//! Reading of a [`Lip`] from bytes.

use super::{HEADER_BYTES, Lip, MARKER_BYTES, Marker, NAME_BYTES, VERSION, offset};
use crate::fallout::place;
use lipz_diagnostics::{Code, Diagnostic};
use std::ops::Range;

/// The size of a file of version 1: the game's structure with its pointers.
const VERSION_1_BYTES: usize = 360;

impl Lip {
    /// Reads a file. Irregularities are kept; [`Lip::oddities`] reports them.
    ///
    /// # Errors
    /// [`Code::LipVersion`] for a different version, and for anything that is not a LIP file; [`Code::LipCutOff`] for a
    /// file that ends before its last marker.
    pub fn read(bytes: &[u8]) -> Result<Lip, Box<Diagnostic>> {
        let header = LipFileHeader(bytes);
        let version = header.word(offset::VERSION)?;
        if version != VERSION {
            return Err(Box::new(refused_version(version)));
        }
        let phoneme_count = header.word(offset::PHONEME_COUNT)?;
        let marker_count = header.word(offset::MARKER_COUNT)?;
        let extension = header.array(offset::EXTENSION)?;
        let cut_off = || Box::new(cut_off_body(bytes.len(), phoneme_count, marker_count));
        let body = bytes.get(HEADER_BYTES..).unwrap_or_default();
        let (phonemes, body) = split(body, phoneme_count, 1).ok_or_else(cut_off)?;
        let (markers, trailing) = split(body, marker_count, MARKER_BYTES).ok_or_else(cut_off)?;
        let (markers, _) = markers.as_chunks::<MARKER_BYTES>();
        let marker = |&[a, b, c, d, e, f, g, h]: &[u8; MARKER_BYTES]| Marker {
            kind: u32::from_be_bytes([a, b, c, d]),
            position: u32::from_be_bytes([e, f, g, h]),
        };
        Ok(Lip {
            constant: header.word(offset::CONSTANT)?,
            flags: header.word(offset::FLAGS)?,
            unknown_0c: header.word(offset::UNKNOWN_0C)?,
            length_word: header.array(offset::LENGTH)?,
            unknown_18: header.word(offset::UNKNOWN_18)?,
            name: header.array::<NAME_BYTES>(offset::NAME)?,
            extension,
            phonemes: phonemes.to_vec(),
            markers: markers.iter().map(marker).collect(),
            trailing: trailing.to_vec(),
        })
    }
}

/// The bytes of the file, which may be truncated.
struct LipFileHeader<'b>(&'b [u8]);

impl LipFileHeader<'_> {
    fn array<const N: usize>(&self, range: Range<usize>) -> Result<[u8; N], Box<Diagnostic>> {
        let array = self.0.get(range).and_then(|bytes| bytes.try_into().ok());
        array.ok_or_else(|| {
            let message = format!("the file ends within the header, after {} of {HEADER_BYTES} bytes", self.0.len());
            Box::new(whole_again(Diagnostic::new(Code::LipCutOff, message)))
        })
    }

    fn word(&self, range: Range<usize>) -> Result<u32, Box<Diagnostic>> {
        self.array(range).map(u32::from_be_bytes)
    }
}

/// Returns the first `count` items of `item_bytes` each, and the rest; `None` if there are fewer items.
fn split(bytes: &[u8], count: u32, item_bytes: usize) -> Option<(&[u8], &[u8])> {
    let length = usize::try_from(count).ok()?.checked_mul(item_bytes)?;
    bytes.split_at_checked(length)
}

fn cut_off_body(length_bytes: usize, phonemes: u32, markers: u32) -> Diagnostic {
    let needed = HEADER_BYTES as u64 + u64::from(phonemes) + u64::from(markers) * MARKER_BYTES as u64;
    let message = format!("the file ends before its last marker: it has {length_bytes} of {needed} bytes");
    let counts = format!("the header counts {phonemes} phonemes and {markers} markers");
    let places = offset::PHONEME_COUNT.start..offset::MARKER_COUNT.end;
    whole_again(place(Code::LipCutOff, places, message).note(counts))
}

fn whole_again(diagnostic: Diagnostic) -> Diagnostic {
    diagnostic.help("copy the file again from its source, in binary mode")
}

fn refused_version(version: u32) -> Diagnostic {
    let at = |message: String| place(Code::LipVersion, offset::VERSION, message);
    match version {
        1 => at("this is a LIP file of version 1, which lipz does not read".into())
            .note(format!("version 1 starts with a copy of the game's structure in memory, {VERSION_1_BYTES} bytes"))
            .help("look for a file of version 2, and report this one, which would be the first of its kind"),
        _ if version.swap_bytes() == VERSION => at("the words of this LIP file are little-endian".into())
            .help("write them big-endian; only the length at 0x10 is little-endian in files of the game"),
        _ if version.to_be_bytes() == *b"LIP " => {
            at("this is a LIP file of Knights of the Old Republic".into()).help("import it as the format `kotor`")
        }
        _ => at(format!("this is not a LIP file of Fallout 2: its version is {version}, not {VERSION}"))
            .help("name a LIP file from sound/speech in the game's data"),
    }
}
