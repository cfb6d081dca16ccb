//! The frames of an MP3 file, and the number of missing frames between them.
//!
//! The decoder's own reader silently skips invalid bytes up to the next frame, which makes all later audio too early.
//! This reader estimates the number of missing frames from the bytes between two frames.

use super::window::Window;
use std::io::{Read, Result};
use symphonia::core::formats::Track;
use symphonia::core::packet::{Packet, PacketBuilder};
use symphonia::core::units::{Duration, Timestamp};

/// Kilobits per second by their index in a header, for MPEG 1 and its half rates.
const KILOBITS: [[u32; 16]; 2] = [
    [0, 32, 40, 48, 56, 64, 80, 96, 112, 128, 160, 192, 224, 256, 320, 0],
    [0, 8, 16, 24, 32, 40, 48, 56, 64, 80, 96, 112, 128, 144, 160, 0],
];
/// Samples per second by their index in a header, for MPEG 1.
const RATES_HZ: [u32; 3] = [44_100, 48_000, 32_000];
/// The size of a header in bytes.
const HEADER_BYTES: usize = 4;
/// The bits that are equal in all headers of a file: the mark, version, layer, rate.
const ALIKE: u32 = 0xfffe_0c00;
/// Data that may follow the last frame: tags of several kinds, and spaces.
const TAGS: [&[u8]; 5] = [b"TAG", b"APETAGEX", b"LYRICSBEGIN", b"ID3", b"3DI"];
/// The most zeros that are examined.
const MOST_ZEROS: usize = 1 << 15;

/// The content of a header.
#[derive(Clone, Copy)]
struct MpegHeader {
    word: u32,
    /// The size of the frame, including its header.
    bytes: usize,
    samples: u64,
    /// The bytes between the header and the audio.
    side_bytes: usize,
}

impl MpegHeader {
    fn parse(bytes: &[u8]) -> Option<MpegHeader> {
        let word = u32::from_be_bytes(*bytes.first_chunk()?);
        let bits = |shift: u32, count: u32| (word >> shift) & ((1 << count) - 1);
        let (version, layer) = (bits(19, 2), bits(17, 2));
        if word >> 21 != 0x7ff || version == 1 || layer != 1 {
            return None;
        }
        let is_full = version == 3;
        let kilobits = KILOBITS[usize::from(!is_full)][bits(12, 4) as usize];
        let halves = [2, 0, 1, 0][version as usize];
        let rate_hz = RATES_HZ.get(bits(10, 2) as usize)? >> halves;
        let bytes = (if is_full { 144_000 } else { 72_000 }) * kilobits / rate_hz + bits(9, 1);
        let side_bytes = match (is_full, bits(6, 2) == 3) {
            (true, false) => 32,
            (true, true) | (false, false) => 17,
            (false, true) => 9,
        };
        let samples = if is_full { 1152 } else { 576 };
        (kilobits > 0).then_some(MpegHeader { word, bytes: bytes as usize, samples, side_bytes })
    }

    fn is_like(&self, other: &MpegHeader) -> bool {
        let is_mono = |header: &MpegHeader| (header.word >> 6) & 3 == 3;
        (self.word ^ other.word) & ALIKE == 0 && is_mono(self) == is_mono(other)
    }
}

/// The frames of a file, in order.
pub(super) struct Frames<R> {
    window: Window<R>,
    /// The header of the first frame. All others have the same format.
    first: MpegHeader,
    /// The declared number of frames.
    declared: Option<u64>,
    /// The number of frames so far, including missing ones; of missing ones; and the bytes of the others.
    count: u64,
    missing: u64,
    bytes: u64,
    /// The samples to drop at the start, and the number of samples after which the audio ends.
    delay: u64,
    end: Option<u64>,
    /// Whether the file ends in the middle of a frame, or before its last.
    pub(super) is_cut: bool,
}

impl<R: Read> Frames<R> {
    /// Returns the frames of `reader`, which is at its start, or `None` if there is no frame. `track` has the
    /// information that the decoder already has.
    pub(super) fn new(reader: R, track: &Track) -> Result<Option<Frames<R>>> {
        let mut window = Window::new(reader);
        window.skip_tag()?;
        let first = loop {
            let Some(bytes) = window.peek(0, HEADER_BYTES)? else { return Ok(None) };
            match MpegHeader::parse(bytes) {
                Some(header) if window.is_followed(&header)? => break header,
                _ => window.skip(1)?,
            }
        };
        let mut frames = Frames {
            window,
            first,
            declared: None,
            count: 0,
            missing: 0,
            bytes: 0,
            delay: u64::from(track.delay.unwrap_or(0)),
            end: None,
            is_cut: false,
        };
        frames.read_tag(track)?;
        Ok(Some(frames))
    }

    /// Reads the first frame, which may contain the number of frames instead of audio.
    fn read_tag(&mut self, track: &Track) -> Result<()> {
        let Some(frame) = self.window.peek(0, self.first.bytes)? else { return Ok(()) };
        let number =
            |at: usize| frame.get(at..).and_then(|rest| rest.first_chunk()).map(|four| u32::from_be_bytes(*four));
        let at = HEADER_BYTES + self.first.side_bytes;
        self.declared = match (frame.get(at..at + 4), frame.get(36..40)) {
            (Some(b"Xing" | b"Info"), _) => {
                number(at + 8).filter(|_| number(at + 4).is_some_and(|flags| flags & 1 == 1))
            }
            (_, Some(b"VBRI")) => number(36 + 14),
            _ => return Ok(()),
        }
        .map(u64::from);
        self.end = self.declared.and(track.num_frames);
        self.window.skip(self.first.bytes)
    }

    /// Returns the next frame, and the number of samples that are missing before it, if any; `None` at the end.
    pub(super) fn next(&mut self) -> Result<Option<(Packet, Option<u64>)>> {
        let mut junk = 0_u64;
        let header = loop {
            let Some(bytes) = self.window.peek(0, HEADER_BYTES)? else {
                self.finish(junk);
                return Ok(None);
            };
            let is_tagged = bytes.starts_with(b"ID3");
            match MpegHeader::parse(bytes).filter(|header| header.is_like(&self.first)) {
                Some(header) if self.is_frame(&header, junk == 0)? => break header,
                // The tag of a file that was appended to this one.
                None if junk == 0 && is_tagged => self.window.skip_tag()?,
                None if junk == 0 && self.window.is_end()? => {
                    self.finish(0);
                    return Ok(None);
                }
                _ => {
                    self.window.skip(1)?;
                    junk += 1;
                }
            }
        };
        let missing = (junk > 0).then(|| self.lose(junk));
        let data = self.window.peek(0, header.bytes)?.unwrap_or_default().to_vec();
        self.window.skip(header.bytes)?;
        let start = (self.count * header.samples).cast_signed() - self.delay.cast_signed();
        // The end is followed by padding of the last frames, or by another file.
        let end = self.end.filter(|_| self.declared.is_none_or(|declared| self.count < declared));
        self.count += 1;
        self.bytes += header.bytes as u64;
        let packet = PacketBuilder::new()
            .track_id(0)
            .pts(Timestamp::new(start))
            .trimmed_dur(Duration::from(header.samples), end.map(|end| Timestamp::new(end.cast_signed())))
            .data(data)
            .build();
        Ok(Some((packet, missing)))
    }

    /// Whether a frame starts here. Directly after a frame, its header is sufficient evidence.
    fn is_frame(&mut self, header: &MpegHeader, is_in_step: bool) -> Result<bool> {
        if self.window.peek(0, header.bytes)?.is_none() {
            self.is_cut |= is_in_step;
            return Ok(false);
        }
        Ok(is_in_step || self.window.is_followed(header)?)
    }

    /// Counts these bytes as missing, and returns their number of samples.
    fn lose(&mut self, bytes: u64) -> u64 {
        let frames = self.frames_in(bytes);
        self.count += frames;
        self.missing += frames;
        frames * self.first.samples
    }

    /// Returns the number of frames of mean length in these bytes.
    fn frames_in(&self, bytes: u64) -> u64 {
        let mean = self.bytes.checked_div(self.count - self.missing).unwrap_or(self.first.bytes as u64).max(1);
        (bytes + mean / 2) / mean
    }

    /// Handles the end of the file, which has `junk` invalid bytes after the last frame.
    fn finish(&mut self, junk: u64) {
        // The number of lost frames is an estimate.
        let missing = self.declared.map(|declared| declared.saturating_sub(self.count + 1 + self.missing / 2));
        self.is_cut = match missing {
            Some(missing) => missing > 0,
            None => self.is_cut || self.frames_in(junk) > 0,
        };
    }
}

/// The methods for MP3 files.
impl<R: Read> Window<R> {
    /// Skips the tags at the start of a file.
    fn skip_tag(&mut self) -> Result<()> {
        while let Some(&[b'I', b'D', b'3', _, _, flags, ref size @ ..]) = self.peek(0, 10)? {
            let size = size.iter().fold(0_usize, |size, byte| size << 7 | usize::from(byte & 0x7f));
            let footer = if flags & 0x10 == 0 { 0 } else { 10 };
            self.skip(10 + size + footer)?;
        }
        Ok(())
    }

    /// Whether the frame that starts here is followed by another frame of this format, or by the end.
    fn is_followed(&mut self, header: &MpegHeader) -> Result<bool> {
        if self.peek(0, header.bytes)?.is_none() {
            return Ok(false);
        }
        Ok(match self.peek(header.bytes, HEADER_BYTES)? {
            Some(next) => MpegHeader::parse(next).is_some_and(|next| next.is_like(header)) || is_tag(next),
            None => true,
        })
    }

    /// Whether only tags, or zeros up to the end, follow.
    fn is_end(&mut self) -> Result<bool> {
        let Some(start) = self.peek(0, HEADER_BYTES)? else { return Ok(true) };
        if is_tag(start) {
            return Ok(true);
        }
        let mut from = 0;
        while let Some(&[byte]) = self.peek(from, 1)? {
            if byte != 0 || from > MOST_ZEROS {
                return Ok(false);
            }
            from += 1;
        }
        Ok(true)
    }
}

fn is_tag(start: &[u8]) -> bool {
    TAGS.iter().any(|tag| start.starts_with(tag.get(..HEADER_BYTES).unwrap_or(tag)))
}
