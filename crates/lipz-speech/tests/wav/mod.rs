//! WAV and AIFF files, made in memory.

/// The storage format of a sample.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(dead_code, reason = "not every test makes every kind")]
pub(crate) enum Samples {
    U8,
    S16,
    S24,
    S32,
    F32,
    F64,
}

impl Samples {
    #[allow(dead_code, reason = "not every test makes every kind")]
    pub(crate) const ALL: [Samples; 6] =
        [Samples::U8, Samples::S16, Samples::S24, Samples::S32, Samples::F32, Samples::F64];

    /// Returns the number of the format, and the bytes per sample.
    fn format(self) -> (u16, u16) {
        match self {
            Samples::U8 => (1, 1),
            Samples::S16 => (1, 2),
            Samples::S24 => (1, 3),
            Samples::S32 => (1, 4),
            Samples::F32 => (3, 4),
            Samples::F64 => (3, 8),
        }
    }

    #[allow(clippy::cast_possible_truncation, reason = "samples are from -1 to 1")]
    fn bytes(self, sample: f32) -> Vec<u8> {
        let whole = (f64::from(sample) * f64::from(i32::MAX)) as i32;
        match self {
            Samples::U8 => vec![whole.to_be_bytes()[0].wrapping_add(128)],
            Samples::S16 => whole.to_le_bytes()[2..].to_vec(),
            Samples::S24 => whole.to_le_bytes()[1..].to_vec(),
            Samples::S32 => whole.to_le_bytes().to_vec(),
            Samples::F32 => sample.to_le_bytes().to_vec(),
            Samples::F64 => f64::from(sample).to_le_bytes().to_vec(),
        }
    }
}

/// Returns a WAV file with the same samples in every channel.
pub(crate) fn wav(samples: Samples, channels: u16, rate_hz: u32, sound: &[f32]) -> Vec<u8> {
    let (format, bytes) = samples.format();
    let data: Vec<u8> = sound.iter().flat_map(|&sample| samples.bytes(sample).repeat(channels.into())).collect();
    let length = u32::try_from(data.len()).unwrap();
    let mut file = b"RIFF".to_vec();
    file.extend((36 + length).to_le_bytes());
    file.extend(b"WAVEfmt ");
    file.extend(16_u32.to_le_bytes());
    file.extend(format.to_le_bytes());
    file.extend(channels.to_le_bytes());
    file.extend(rate_hz.to_le_bytes());
    file.extend((rate_hz * u32::from(channels * bytes)).to_le_bytes());
    file.extend((channels * bytes).to_le_bytes());
    file.extend((bytes * 8).to_le_bytes());
    file.extend(b"data");
    file.extend(length.to_le_bytes());
    file.extend(data);
    file
}

/// Returns an AIFF file with the same samples in every channel, or an AIFC file for formats that AIFF lacks.
#[allow(dead_code, reason = "not every test makes such files")]
pub(crate) fn aiff(samples: Samples, channels: u16, rate_hz: u32, sound: &[f32]) -> Vec<u8> {
    let (_, bytes) = samples.format();
    let big_endian = |sample: f32| {
        let mut bytes = samples.bytes(sample);
        match samples {
            Samples::U8 => bytes[0] = bytes[0].wrapping_add(128), // signed here
            _ => bytes.reverse(),
        }
        bytes
    };
    let data: Vec<u8> = sound.iter().flat_map(|&sample| big_endian(sample).repeat(channels.into())).collect();
    let compression: &[u8] = match samples {
        Samples::F32 => b"fl32\0\0",
        Samples::F64 => b"fl64\0\0",
        _ => b"",
    };
    // The rate as an 80-bit float: the exponent, then 64 bits of which the first is 1.
    let shift = rate_hz.leading_zeros();
    let exponent = u16::try_from(16_383 + 31 - shift).unwrap();
    let common = [
        &channels.to_be_bytes()[..],
        &u32::try_from(sound.len()).unwrap().to_be_bytes(),
        &(bytes * 8).to_be_bytes(),
        &exponent.to_be_bytes(),
        &(rate_hz << shift).to_be_bytes(),
        &[0; 4],
        compression,
    ]
    .concat();
    let length = |length: usize| u32::try_from(length).unwrap().to_be_bytes();
    let chunks = [
        if compression.is_empty() { b"AIFF" } else { b"AIFC" },
        b"COMM".as_slice(),
        &length(common.len()),
        &common,
        b"SSND",
        &length(data.len() + 8),
        &[0; 8],
        &data,
    ]
    .concat();
    [b"FORM", &length(chunks.len())[..], &chunks].concat()
}
