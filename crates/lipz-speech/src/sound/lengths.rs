//! WAV and AIFF files whose headers have wrong lengths. Decoders reject some of them, although they contain samples.

use super::source::SizedSource;
use std::io::{Read, Result, Seek};

/// The size of a chunk's head in bytes: its name and its length.
const HEAD_BYTES: u64 = 8;
/// The offset of the first chunk, after the head of the file and the name of its form.
const FIRST_CHUNK: u64 = 12;
/// The most chunks that are examined. Usual files have a dozen.
const MOST_CHUNKS: usize = 1_000;
/// The least length that stands for an unknown length. Programs that stream write the greatest length (ffmpeg), or half
/// of it (sox).
const STREAMED: u32 = 0x7fff_f000;

/// The header's information about the end of the file.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(super) struct FileEnd {
    /// The header has no length, so the file ends with its last byte.
    pub(super) is_streamed: bool,
    /// The header declares more samples than the file contains.
    pub(super) is_cut: bool,
    /// The number of samples per channel, if the last block may have more.
    pub(super) samples: Option<u64>,
}

/// The formats of WAV whose blocks have a fixed number of samples: Microsoft's and IMA's ADPCM.
const OF_BLOCKS: [&[u8]; 2] = [&[0x02, 0], &[0x11, 0]];

/// Checks the lengths in the header, and fixes those for which the decoder would reject the file.
pub(super) fn mend<S: Read + Seek>(source: &mut SizedSource<S>) -> Result<FileEnd> {
    let head = source.peek(0, 12)?;
    let length = |bytes: [u8; 4]| match head.starts_with(b"FORM") {
        true => u32::from_be_bytes(bytes),
        false => u32::from_le_bytes(bytes),
    };
    let Some(whole) = head.get(4..).and_then(|rest| rest.first_chunk()).copied().map(length) else {
        return Ok(FileEnd::default());
    };
    let is_true = u64::from(whole) + HEAD_BYTES == source.length;
    match (head.get(..4), head.get(8..)) {
        (Some(b"RIFF"), Some(b"WAVE")) => {
            // The decoder then uses only the length of the sample chunk, which may exceed the file.
            source.mended.push((4, u32::MAX.to_le_bytes()));
            let end = samples(source, !is_true)?;
            Ok(FileEnd { is_streamed: whole >= STREAMED || end.is_streamed, ..end })
        }
        // RF64 (EBU Tech 3306) is WAV with lengths of 64 bits in a chunk that decoders skip.
        (Some(b"RF64" | b"BW64"), Some(b"WAVE")) => {
            source.mended.push((0, *b"RIFF"));
            source.mended.push((4, u32::MAX.to_le_bytes()));
            Ok(FileEnd { is_streamed: true, ..FileEnd::default() })
        }
        (Some(b"FORM"), Some(b"AIFF" | b"AIFC")) => {
            let Some(end) = u32::try_from(source.length - HEAD_BYTES).ok() else { return Ok(FileEnd::default()) };
            if !is_true {
                source.mended.push((4, end.to_be_bytes()));
            }
            cut_samples(source)
        }
        _ => Ok(FileEnd::default()),
    }
}

/// Returns the end of a WAV file's samples. They end with the file if their length is 0 and the file `may_be_unfinished`:
/// programs write the length at the end, and some never do.
fn samples<S: Read + Seek>(source: &mut SizedSource<S>, may_be_unfinished: bool) -> Result<FileEnd> {
    let (mut at, mut has_blocks, mut end) = (FIRST_CHUNK, false, FileEnd::default());
    for _ in 0..MOST_CHUNKS {
        let head = source.peek(at, 12)?;
        let Some((name, rest)) = head.split_first_chunk::<4>() else { break };
        let Some((length, content)) = rest.split_first_chunk() else { break };
        let length = u64::from(u32::from_le_bytes(*length));
        match name {
            b"fmt " => has_blocks = content.get(..2).is_some_and(|format| OF_BLOCKS.contains(&format)),
            b"fact" if has_blocks => {
                let count = content.first_chunk().map(|count| u64::from(u32::from_le_bytes(*count)));
                end.samples = count.filter(|count| *count > 0);
            }
            b"data" => {
                end.is_streamed = may_be_unfinished && length == 0 && at + HEAD_BYTES < source.length;
                if end.is_streamed {
                    source.mended.push((at + 4, u32::MAX.to_le_bytes()));
                }
                break;
            }
            _ => {}
        }
        at += HEAD_BYTES + length + length % 2;
    }
    Ok(end)
}

/// Shortens the samples of an AIFF file to the length of the file, if they should be longer.
fn cut_samples<S: Read + Seek>(source: &mut SizedSource<S>) -> Result<FileEnd> {
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
            return Ok(FileEnd { is_cut: true, ..FileEnd::default() });
        }
        // Chunks start at even offsets.
        at = start + length + length % 2;
        if at >= source.length {
            break;
        }
    }
    Ok(FileEnd::default())
}
