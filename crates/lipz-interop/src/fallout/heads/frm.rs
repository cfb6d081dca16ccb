//! FRM files: the frames of an animation. They are big-endian, with up to six directions; heads use one.

use crate::fallout::place;
use lipz_diagnostics::{Code, Diagnostic};
use std::ops::Range;

const VERSION: Range<usize> = 0x00..0x04;
const FPS: Range<usize> = 0x04..0x06;
pub(super) const FRAMES: Range<usize> = 0x08..0x0A;
/// The offsets in the header of the starts of each direction's frames, which count from the end of the header.
const STARTS: Range<usize> = 0x22..0x3A;
const HEADER_BYTES: usize = 0x3E;

/// The version of the game's files.
const KNOWN_VERSION: u32 = 4;

/// The size of a frame's header: width, height, length of the pixels, and two offsets on the screen.
const FRAME_HEADER_BYTES: usize = 12;
/// The offsets of the length of the pixels in the header of a frame.
const PIXEL_BYTES: Range<usize> = 4..8;

/// The content of an FRM file that matters for a head.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Frm {
    /// Frames per second.
    pub fps: u16,
    /// Frames in each direction.
    pub frames: u16,
}

impl Frm {
    /// Reads the header, and checks that all frames are present.
    ///
    /// # Errors
    /// [`Code::FrmRefused`] for a different version, and for a file that ends before its last frame.
    pub fn read(bytes: &[u8]) -> Result<Frm, Box<Diagnostic>> {
        let cut_off = |range: Range<usize>, what: &str| {
            let message = format!("the file ends within {what}, after {} bytes", bytes.len());
            Box::new(place(Code::FrmRefused, range, message).help("copy the file again from its source"))
        };
        let header =
            |range: Range<usize>| bytes.get(range).ok_or_else(|| cut_off(0..bytes.len(), "the header")).map(number);
        let version = header(VERSION)?;
        if version != KNOWN_VERSION {
            let message = format!("this is not an FRM file: its version is {version}, not {KNOWN_VERSION}");
            let help = "name only FRM files; convert images with the tools of modders";
            return Err(Box::new(place(Code::FrmRefused, VERSION, message).help(help)));
        }
        let frm = Frm { fps: short(header(FPS)?), frames: short(header(FRAMES)?) };
        let starts = bytes.get(STARTS).ok_or_else(|| cut_off(0..bytes.len(), "the header"))?;
        let mut starts: Vec<u32> = starts.as_chunks::<4>().0.iter().map(|word| u32::from_be_bytes(*word)).collect();
        starts.dedup(); // directions without frames of their own have the start of the one before, or 0
        starts.retain(|&start| start != 0);
        starts.insert(0, 0);
        for start in starts {
            let mut at = HEADER_BYTES.saturating_add(start as usize);
            for index in 0..frm.frames {
                let what = || cut_off(FRAMES, &format!("frame {index} of {}", frm.frames));
                let pixels = at.checked_add(FRAME_HEADER_BYTES).ok_or_else(what)?;
                let length =
                    bytes.get(at..pixels).and_then(|frame| frame.get(PIXEL_BYTES)).map(number).ok_or_else(what)?;
                at = pixels.saturating_add(length as usize);
                if at > bytes.len() {
                    return Err(what());
                }
            }
        }
        Ok(frm)
    }
}

/// Reads a big-endian number of up to four bytes.
fn number(bytes: &[u8]) -> u32 {
    bytes.iter().fold(0, |number, &byte| number << 8 | u32::from(byte))
}

/// Converts a number that was read from two bytes.
fn short(number: u32) -> u16 {
    u16::try_from(number).unwrap_or(u16::MAX)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    /// Returns an FRM file with frames of one pixel.
    fn frm(frames: u16) -> Vec<u8> {
        let mut bytes = vec![0; HEADER_BYTES];
        bytes[VERSION].copy_from_slice(&KNOWN_VERSION.to_be_bytes());
        bytes[FPS].copy_from_slice(&10_u16.to_be_bytes());
        bytes[FRAMES].copy_from_slice(&frames.to_be_bytes());
        for _ in 0..frames {
            bytes.extend_from_slice(&[0, 1, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 7]);
        }
        bytes
    }

    #[test]
    fn frames_are_counted() {
        assert_eq!(Frm::read(&frm(9)), Ok(Frm { fps: 10, frames: 9 }));
        assert_eq!(Frm::read(&frm(0)), Ok(Frm { fps: 10, frames: 0 }));
    }

    #[test]
    fn a_file_cut_anywhere_is_refused() {
        let whole = frm(9);
        for length in 0..whole.len() {
            assert_eq!(Frm::read(&whole[..length]).unwrap_err().code, Code::FrmRefused, "{length}");
        }
    }

    #[test]
    fn starts_and_lengths_outside_of_the_file_are_refused() {
        for (at, value) in [(STARTS.start + 4, u32::MAX), (STARTS.start + 20, 9999), (HEADER_BYTES + 4, u32::MAX)] {
            let mut bytes = frm(9);
            bytes[at..at + 4].copy_from_slice(&value.to_be_bytes());
            assert!(Frm::read(&bytes).is_err(), "{at}");
        }
        let mut little = frm(9);
        little[VERSION].reverse();
        assert!(Frm::read(&little).unwrap_err().message.contains("not an FRM file"));
    }
}
