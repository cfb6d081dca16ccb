//! Detection of missing pages in an Ogg file.
//!
//! The decoder's reader skips damaged pages, and assigns their times to the packets that follow. Times are correct only
//! from the second page on. The headers of the pages have more information.

use super::window::Window;
use std::collections::VecDeque;
use std::io::{Read, Result};
use symphonia::core::checksum::Crc32;
use symphonia::core::io::Monitor;

/// The first bytes of a page, and the size of the header before the lengths of its segments.
const MARK: &[u8] = b"OggS";
const HEAD_BYTES: usize = 27;
/// The offsets of its checksum.
const CHECKSUM: std::ops::Range<usize> = 22..26;
/// The offsets of its version, which is 0, and of its three flags.
const VERSION: usize = 4;
const FLAGS: usize = 5;
const MOST_FLAGS: u8 = 7;
/// The size of the longest page in bytes.
const MOST_BYTES: usize = HEAD_BYTES + 255 + 255 * 255;
/// The time of a page in which no packet ends.
const NO_TIME: i64 = -1;

/// A place where pages are missing.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Hole {
    /// The end of the last page before it, in samples.
    pub(super) start: i64,
    /// The end of the first page after it, in samples.
    pub(super) next_end: i64,
}

/// The header of a page.
struct Page {
    bytes: usize,
    serial: u32,
    number: u32,
    time: i64,
}

/// Returns the places where pages of the first stream are missing, in order. Reads the whole file.
pub(super) fn holes(reader: impl Read) -> Result<VecDeque<Hole>> {
    let mut pages = Pages::new(reader);
    let mut holes = VecDeque::new();
    let (mut serial, mut number, mut time) = (None, 0_u32, 0);
    // The start of a hole after which no packet has ended yet.
    let mut open = None;
    while let Some(page) = pages.next()? {
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

/// The complete pages of a file.
struct Pages<R> {
    window: Window<R>,
    /// The number of bytes before the window.
    passed: u64,
    /// The number of bytes whose checksum was wrong.
    failed: u64,
    /// The number of bytes whose checksum was computed.
    #[cfg(test)]
    summed: usize,
}

impl<R: Read> Pages<R> {
    fn new(reader: R) -> Pages<R> {
        Pages {
            window: Window::new(reader),
            passed: 0,
            failed: 0,
            #[cfg(test)]
            summed: 0,
        }
    }

    /// Returns the next page, or `None` at the end.
    fn next(&mut self) -> Result<Option<Page>> {
        while self.window.peek(0, 1)?.is_some() {
            let page = self.page()?;
            let bytes = page.as_ref().map_or(1, |page| page.bytes);
            self.window.skip(bytes)?;
            self.passed += bytes as u64;
            if page.is_some() {
                return Ok(page);
            }
        }
        Ok(None)
    }

    /// Returns the page that starts here, if there is a complete one.
    fn page(&mut self) -> Result<Option<Page>> {
        let is_head = |head: &&[u8]| head.starts_with(MARK) && head[VERSION] == 0 && head[FLAGS] <= MOST_FLAGS;
        let Some(head) = self.window.peek(0, HEAD_BYTES)?.filter(is_head) else { return Ok(None) };
        let parts = usize::from(head[HEAD_BYTES - 1]);
        let Some(head) = self.window.peek(0, HEAD_BYTES + parts)? else { return Ok(None) };
        let bytes = head.len() + head[HEAD_BYTES..].iter().map(|&part| usize::from(part)).sum::<usize>();
        // Damaged pages follow each other. Page headers inside other pages indicate a crafted file.
        if self.failed > self.passed + MOST_BYTES as u64 {
            return Ok(None);
        }
        let Some(page) = self.window.peek(0, bytes)? else { return Ok(None) };
        let (before, checksum, behind) = (&page[..CHECKSUM.start], &page[CHECKSUM], &page[CHECKSUM.end..]);
        let mut crc = Crc32::new(0);
        [before, &[0; 4], behind].into_iter().for_each(|part| crc.process_buf_bytes(part));
        let number = |at: usize| page[at..].first_chunk().map_or(0, |bytes| u32::from_le_bytes(*bytes));
        let time = page[6..].first_chunk().map_or(NO_TIME, |bytes| i64::from_le_bytes(*bytes));
        let is_whole = checksum == crc.crc().to_le_bytes();
        let page = Page { bytes, serial: number(14), number: number(18), time };
        #[cfg(test)]
        {
            self.summed += bytes;
        }
        self.failed += if is_whole { 0 } else { bytes as u64 };
        Ok(is_whole.then_some(page))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    /// Returns a page with this content of at most 255 bytes.
    fn page(number: u32, time: i64, content: &[u8]) -> Vec<u8> {
        let mut page =
            [MARK, &[0, 0], &time.to_le_bytes(), &[7, 0, 0, 0], &number.to_le_bytes(), &[0; 4], &[1]].concat();
        page.push(u8::try_from(content.len()).unwrap());
        page.extend(content);
        let mut crc = Crc32::new(0);
        crc.process_buf_bytes(&page);
        page[CHECKSUM].copy_from_slice(&crc.crc().to_le_bytes());
        page
    }

    fn summed(file: &[u8]) -> (usize, usize) {
        let mut pages = Pages::new(file);
        let mut count = 0;
        while pages.next().unwrap().is_some() {
            count += 1;
        }
        (count, pages.summed)
    }

    #[test]
    fn a_missing_page_is_a_hole_also_behind_damaged_ones() {
        let mut file =
            [page(0, 0, b"head"), page(1, 100, b"one"), page(2, 200, b"two"), page(3, 300, b"three")].concat();
        assert!(holes(file.as_slice()).unwrap().is_empty());
        let two = file.windows(3).position(|bytes| bytes == b"two").unwrap();
        file[two] = b'T';
        assert_eq!(holes(file.as_slice()).unwrap(), [Hole { start: 100, next_end: 300 }]);
        assert_eq!(summed(&file).0, 3);
    }

    /// With headers of overlapping pages, the work must stay proportional to the size of the file.
    #[test]
    fn heads_that_somebody_made_take_no_more_than_their_bytes() {
        let marks = MARK.repeat(100_000);
        assert_eq!(summed(&marks), (0, 0));
        // As close together as possible, with as many and as long segments as possible.
        let head = [MARK, &[0, 0], &[255; 20], &[255]].concat();
        let mut file = head.repeat(20_000);
        let (count, work) = summed(&file);
        assert!(count == 0 && work <= file.len() + 2 * MOST_BYTES, "{work} of {}", file.len());
        // The pages after them are still found.
        file.extend(vec![0; MOST_BYTES]);
        file.extend([page(0, 0, b"head"), page(1, 100, b"one"), page(3, 300, b"three")].concat());
        assert_eq!(holes(file.as_slice()).unwrap(), [Hole { start: 100, next_end: 300 }]);
    }
}
