//! Recordings for tests: WAV files.

/// Samples per second of [`voice`].
pub(crate) const RATE_HZ: u32 = 16_000;

/// Returns a WAV file of [`voice_samples`].
pub(crate) fn voice(parts: &[(bool, u32)], take: u32) -> Vec<u8> {
    wav(RATE_HZ, &voice_samples(parts, take))
}

/// Returns samples that resemble a voice. Each part states whether there is speech, and its length in milliseconds.
/// `take` makes different samples of the same loudness.
pub(crate) fn voice_samples(parts: &[(bool, u32)], take: u32) -> Vec<i16> {
    let mut samples: Vec<i16> = Vec::new();
    let mut noise = 1 + take;
    for &(speaks, ms) in parts {
        for at in 0..ms * 16 {
            noise = noise.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let hiss = ((noise >> 24) as i32 - 128) / 16;
            // A buzz of 125 Hz with a gliding formant, five syllables per second.
            let formant = 12.0 + 9.0 * (std::f64::consts::TAU * f64::from(at) / 4000.0).sin();
            let phase = f64::from(at % 128) / 128.0;
            let buzz = (1..30)
                .map(|k| (std::f64::consts::TAU * f64::from(k) * phase).cos() / (1.0 + (f64::from(k) - formant).abs()));
            let syllable = (std::f64::consts::PI * f64::from(at) / 3200.0).sin().abs().max(0.2);
            let level = if speaks { 2500.0 * syllable } else { 0.0 };
            #[allow(clippy::cast_possible_truncation)]
            samples.push((level * buzz.sum::<f64>()) as i16 / 2 + hiss as i16);
        }
    }
    samples
}

/// Returns a WAV file of one channel, with `rate_hz` samples per second.
pub(crate) fn wav(rate_hz: u32, samples: &[i16]) -> Vec<u8> {
    let data_bytes = u32::try_from(samples.len() * 2).unwrap();
    let mut file = b"RIFF".to_vec();
    file.extend((36 + data_bytes).to_le_bytes());
    file.extend(b"WAVEfmt \x10\0\0\0\x01\0\x01\0");
    file.extend(rate_hz.to_le_bytes());
    file.extend((rate_hz * 2).to_le_bytes());
    file.extend(b"\x02\0\x10\0data");
    file.extend(data_bytes.to_le_bytes());
    file.extend(samples.iter().flat_map(|sample| sample.to_le_bytes()));
    file
}
