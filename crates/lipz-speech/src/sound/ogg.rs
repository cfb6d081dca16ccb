//! Where pages of an Ogg file are missing.
//!
//! The decoder's reader leaves out what is damaged, and gives the packets behind it the times of those that are gone: only those of
//! the page after next are right. What stands in the pages tells more.

use super::window::Window;
use std::collections::VecDeque;
use std::io::{Read, Result};
use symphonia::core::checksum::Crc32;
use symphonia::core::io::Monitor;

/// What a page starts with, and how many bytes of it come before the lengths of its parts.
const MARK: &[u8] = b"OggS";
const HEAD_BYTES: usize = 27;
/// Where its checksum is.
const CHECKSUM: std::ops::Range<usize> = 22..26;
/// The time of a page in which no packet ends.
const NO_TIME: i64 = -1;

/// A place where pages are missing.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Hole {
    /// When the last page before it ends, in samples.
    pub(super) start: i64,
    /// When the first page behind it ends.
    pub(super) next_end: i64,
}

/// What is known of a page.
struct Page {
    bytes: usize,
    serial: u32,
    number: u32,
    time: i64,
}

/// The places where pages of the first stream are missing, in order. Reads the file from its first to its last byte.
pub(super) fn holes(reader: impl Read) -> Result<VecDeque<Hole>> {
    let mut window = Window::new(reader);
    let mut holes = VecDeque::new();
    let (mut serial, mut number, mut time) = (None, 0_u32, 0);
    // The start of a hole behind which no packet has ended yet.
    let mut open = None;
    while window.peek(0, 1)?.is_some() {
        let Some(page) = page(&mut window)? else {
            window.skip(1)?;
            continue;
        };
        window.skip(page.bytes)?;
        if *serial.get_or_insert(page.serial) != page.serial {
            continue;
        }
        if page.number > number.saturating_add(1) {
            open.get_or_insert(time);
        }
        number = page.number;
        if page.time != NO_TIME {
            holes.extend(open.take().map(|start| Hole { start, next_end: page.time }));
            time = page.time;
        }
    }
    Ok(holes)
}

/// The page that starts here, if there is one, and it is whole.
fn page<R: Read>(window: &mut Window<R>) -> Result<Option<Page>> {
    let Some(head) = window.peek(0, HEAD_BYTES)?.filter(|head| head.starts_with(MARK)) else { return Ok(None) };
    let parts = usize::from(head[HEAD_BYTES - 1]);
    let Some(head) = window.peek(0, HEAD_BYTES + parts)? else { return Ok(None) };
    let bytes = head.len() + head[HEAD_BYTES..].iter().map(|&part| usize::from(part)).sum::<usize>();
    let Some(page) = window.peek(0, bytes)? else { return Ok(None) };
    let (before, checksum, behind) = (&page[..CHECKSUM.start], &page[CHECKSUM], &page[CHECKSUM.end..]);
    let mut crc = Crc32::new(0);
    [before, &[0; 4], behind].into_iter().for_each(|part| crc.process_buf_bytes(part));
    let number = |at: usize| page[at..].first_chunk().map_or(0, |bytes| u32::from_le_bytes(*bytes));
    let time = page[6..].first_chunk().map_or(NO_TIME, |bytes| i64::from_le_bytes(*bytes));
    let is_whole = checksum == crc.crc().to_le_bytes();
    Ok(is_whole.then(|| Page { bytes, serial: number(14), number: number(18), time }))
}
