//! WAV and AIFF files whose headers tell other lengths than they have: decoders refuse some of them, although the samples are
//! there.

use super::source::Source;
use std::io::{Read, Result, Seek};

/// The bytes of the head of a chunk: its name and its length.
const HEAD_BYTES: u64 = 8;
/// Where the first chunk of a file starts, behind the head of the file and the name of its form.
const FIRST_CHUNK: u64 = 12;
/// So many chunks are looked at: files have a dozen.
const MOST_CHUNKS: usize = 1_000;
/// A writer that does not know how long its file will be writes the greatest length (ffmpeg), or the half of it (sox).
const STREAMED: u32 = 0x7fff_f000;

/// What a header tells about where the file ends.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(super) struct Told {
    /// The writer did not know: the file ends where its bytes end.
    pub(super) is_streamed: bool,
    /// The samples should go on behind the last byte.
    pub(super) is_cut: bool,
}

/// Looks whether the lengths in the header are true, and mends those for which the decoder would refuse the file.
pub(super) fn mend<S: Read + Seek>(source: &mut Source<S>) -> Result<Told> {
    let head = source.peek(0, 12)?;
    let length = |bytes: [u8; 4]| match head.starts_with(b"RIFF") {
        true => u32::from_le_bytes(bytes),
        false => u32::from_be_bytes(bytes),
    };
    let Some(whole) = head.get(4..).and_then(|rest| rest.first_chunk()).copied().map(length) else {
        return Ok(Told::default());
    };
    let is_true = u64::from(whole) + HEAD_BYTES == source.length;
    match (head.get(..4), head.get(8..)) {
        (Some(b"RIFF"), Some(b"WAVE")) => {
            // The decoder then asks the chunk of samples alone, and that may be longer than the file.
            source.mended.push((4, u32::MAX.to_le_bytes()));
            Ok(Told { is_streamed: whole >= STREAMED, is_cut: false })
        }
        (Some(b"FORM"), Some(b"AIFF" | b"AIFC")) => {
            let Some(end) = u32::try_from(source.length - HEAD_BYTES).ok() else { return Ok(Told::default()) };
            if !is_true {
                source.mended.push((4, end.to_be_bytes()));
            }
            cut_samples(source)
        }
        _ => Ok(Told::default()),
    }
}

/// Makes the samples of an AIFF file end with the file, if they should go on behind it.
fn cut_samples<S: Read + Seek>(source: &mut Source<S>) -> Result<Told> {
    let mut at = FIRST_CHUNK;
    for _ in 0..MOST_CHUNKS {
        let head = source.peek(at, 8)?;
        let Some((name, length)) = head.split_first_chunk::<4>() else { break };
        let Some(length) = length.first_chunk().map(|length| u64::from(u32::from_be_bytes(*length))) else { break };
        let start = at + HEAD_BYTES;
        let there = source.length - start;
        if name == b"SSND" && length > there {
            let there = u32::try_from(there).unwrap_or(u32::MAX);
            source.mended.push((at + 4, there.to_be_bytes()));
            return Ok(Told { is_streamed: false, is_cut: true });
        }
        // Chunks start at even places.
        at = start + length + length % 2;
        if at >= source.length {
            break;
        }
    }
    Ok(Told::default())
}
