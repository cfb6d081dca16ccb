//! FLAC files whose metadata break rules. Decoders reject some of them, although the samples do not depend on metadata:
//! a cue sheet that is not that of a CD, damaged tags or pictures.

use super::source::SizedSource;
use std::io::{Read, Result, Seek};

const MAGIC: &[u8; 4] = b"fLaC";
/// The head of a block in bytes: its type, with the flag of the last block, and its length.
const HEAD_BYTES: u64 = 4;
const IS_LAST: u8 = 0x80;
/// The types of blocks (RFC 9639, section 8.1): about the samples, and without content.
const STREAM_INFO: u8 = 0;
const PADDING: u8 = 1;
/// The most blocks that are examined. Usual files have five.
const MOST_BLOCKS: usize = 128;

/// Replaces the metadata of a FLAC file by padding, except for the properties of its samples.
pub(super) fn mend<S: Read + Seek>(source: &mut SizedSource<S>) -> Result<()> {
    let mut at = id3_bytes(&source.peek(0, 10)?);
    if source.peek(at, MAGIC.len())? != MAGIC {
        return Ok(());
    }
    at += MAGIC.len() as u64;
    for _ in 0..MOST_BLOCKS {
        let Ok([kind, length @ ..]) = <[u8; 4]>::try_from(source.peek(at, 4)?) else { break };
        if kind & !IS_LAST != STREAM_INFO {
            let [high, middle, low] = length;
            source.mended.push((at, [kind & IS_LAST | PADDING, high, middle, low]));
        }
        if kind & IS_LAST != 0 {
            break;
        }
        let [high, middle, low] = length;
        at += HEAD_BYTES + u64::from(u32::from_be_bytes([0, high, middle, low]));
    }
    Ok(())
}

/// Returns the length of ID3 tags at the start of a file, which some programs put before other formats.
fn id3_bytes(head: &[u8]) -> u64 {
    match *head {
        [b'I', b'D', b'3', _, _, _, a, b, c, d] => {
            10 + [a, b, c, d].into_iter().fold(0, |size, byte| size << 7 | u64::from(byte & 0x7f))
        }
        _ => 0,
    }
}
