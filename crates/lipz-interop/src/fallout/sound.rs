//! The length of a recording, from the header of its file: WAV, or the game's own ACM.

use crate::Time;
use std::io::Read;

/// The first bytes of an ACM file: its magic number and version.
const ACM_START: [u8; 4] = [0x97, 0x28, 0x03, 0x01];
/// The size of an ACM header in bytes: start, samples, channels, samples per second.
const ACM_HEADER_BYTES: usize = 12;
/// The sample rate at which the engine plays every ACM file, as mono, whatever the header states.
const ACM_RATE: u32 = 22_050;

/// Returns the length of a WAV or ACM file, or `None` if it is neither. Only the header is read.
pub fn length(mut file: impl Read) -> Option<Time> {
    let mut header = [0; ACM_HEADER_BYTES];
    file.read_exact(&mut header).ok()?;
    if let Some([a, b, c, d, ..]) = header.strip_prefix(&ACM_START) {
        let samples = u32::from_le_bytes([*a, *b, *c, *d]);
        return Some(Time::new(u64::from(samples), ACM_RATE));
    }
    let wav = hound::WavReader::new(header.as_slice().chain(file)).ok()?;
    Some(Time::new(u64::from(wav.duration()), wav.spec().sample_rate))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use std::io::Cursor;

    #[test]
    fn lengths_stand_in_headers() {
        let spec = hound::WavSpec {
            channels: 2,
            sample_rate: 8000,
            bits_per_sample: 16,
            sample_format: hound::SampleFormat::Int,
        };
        let mut wav = Cursor::new(Vec::new());
        let mut writer = hound::WavWriter::new(&mut wav, spec).unwrap();
        for _ in 0..8000 {
            writer.write_sample(0_i16).unwrap();
        }
        writer.finalize().unwrap();
        assert_eq!(length(wav.get_ref().as_slice()), Some(Time::new(1, 2)));

        let acm = [&ACM_START[..], &33_075_u32.to_le_bytes(), &[2, 0, 0x22, 0x56]].concat();
        assert_eq!(length(acm.as_slice()), Some(Time::new(3, 2)));
    }

    #[test]
    fn other_files_have_none() {
        assert_eq!(length(&b""[..]), None);
        assert_eq!(length(&b"RIFF....WAVEfmt "[..]), None);
        assert_eq!(length([0x97; 64].as_slice()), None);
    }
}
