//! A recording, in the form that alignment needs.

pub(crate) mod audible;
mod clipping;
mod damage;
pub(crate) mod decode;
mod error;
mod flac;
mod lengths;
pub(crate) mod level;
mod mpeg;
mod ogg;
mod other;
mod output;
mod packets;
mod resample;
mod source;
mod speech;
mod window;

pub use clipping::Clipping;
pub use damage::Damage;
pub use error::SoundError;

use crate::features::mel::{HOP, MelFrontEnd, RATE_HZ, WINDOW};
use crate::features::spectrogram::{Spectrogram, SpectrogramBuilder};
pub(crate) use resample::Resampler;
use std::io::{self, Cursor, Read, Seek};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// A recording: its length, and the spectrum of each hundredth of a second. It does not keep the samples. Of a recording
/// of more than five minutes, it keeps most of the spectrum in a temporary file, 18 megabytes per hour, or in memory if
/// there is no room for a file.
#[derive(Clone, Debug)]
pub struct Sound {
    samples: u64,
    rate_hz: u32,
    spectrum: Spectrogram,
    truncated: bool,
    is_altered: bool,
    damage: Damage,
    clipping: Vec<Clipping>,
}

impl Sound {
    /// The longest supported recording in seconds: one day.
    pub const LONGEST_S: u64 = 86_400;

    /// Reads a WAV, AIFF, FLAC, Ogg Vorbis or MP3 file. Its format is detected from its first bytes, or else from
    /// `extension`. Channels are mixed down.
    ///
    /// # Errors
    ///
    /// If no audio can be read. A file that is damaged in the middle or ends too early is read as far as possible: see
    /// [`Sound::is_truncated`], [`Sound::damage`] and [`Sound::is_altered`].
    pub fn read<S>(source: S, extension: Option<&str>) -> Result<Sound, SoundError>
    where
        S: Read + Seek + Send + Sync,
    {
        let mut analysis = None;
        // In debug builds, the decoders' arithmetic on numbers of a header can overflow, and so panic. In releases, no
        // file is known that makes them panic, but they are large, and files come from anywhere.
        let decode = AssertUnwindSafe(|| {
            decode::decode(source, extension, |rate_hz, samples| {
                let analysis = analysis.get_or_insert_with(|| Analysis::new(rate_hz));
                analysis.push(samples)
            })
        });
        let decoded = catch_unwind(decode).unwrap_or(Err(SoundError::DecoderFailed))?;
        let mut sound = analysis.map(Analysis::finish).ok_or(SoundError::NoSound)?;
        if sound.samples == 0 {
            return Err(SoundError::NoSound);
        }
        sound.truncated = decoded.truncated;
        sound.is_altered = decoded.is_altered;
        sound.damage = decoded.damage;
        sound.clipping = decoded.clipping.places;
        Ok(sound)
    }

    /// Returns the length of a file in microseconds, rounded to the nearest, or 0 if it has no samples. The file is
    /// decoded to its last sample, because headers may be wrong.
    ///
    /// # Errors
    ///
    /// As for [`Sound::read`].
    pub fn length_us<S>(source: S, extension: Option<&str>) -> Result<u64, SoundError>
    where
        S: Read + Seek + Send + Sync,
    {
        let (mut samples, mut rate) = (0_u64, 1_u64);
        decode::decode(source, extension, |rate_hz, block| {
            rate = u64::from(rate_hz);
            samples += block.len() as u64;
            if samples > Sound::LONGEST_S * rate { Err(SoundError::TooLong) } else { Ok(()) }
        })?;
        Ok((samples * 1_000_000 + rate / 2) / rate)
    }

    /// Reads a file in memory: see [`Sound::read`].
    ///
    /// # Errors
    ///
    /// As for [`Sound::read`].
    pub fn from_bytes(bytes: &[u8], extension: Option<&str>) -> Result<Sound, SoundError> {
        Sound::read(Cursor::new(bytes), extension)
    }

    /// Returns the recording with these mono samples, from -1 to 1, at `rate_hz` samples per second.
    ///
    /// # Errors
    ///
    /// If there are no samples or too many, or the rate is unsuitable for speech.
    pub fn from_samples(samples: &[f32], rate_hz: u32) -> Result<Sound, SoundError> {
        if !decode::RATES_HZ.contains(&rate_hz) {
            return Err(SoundError::Rate { rate_hz });
        }
        if samples.is_empty() {
            return Err(SoundError::NoSound);
        }
        let mut analysis = Analysis::new(rate_hz);
        analysis.push(samples)?;
        let mut sound = analysis.finish();
        let mut clipping = clipping::ClippingFinder::default();
        clipping.push(samples, 1, 0, rate_hz);
        sound.clipping = clipping.places;
        Ok(sound)
    }

    /// Returns the length in microseconds.
    pub fn duration_us(&self) -> u64 {
        self.samples * 1_000_000 / u64::from(self.rate_hz)
    }

    /// Returns the sample rate of the file, in samples per second.
    pub fn rate_hz(&self) -> u32 {
        self.rate_hz
    }

    /// Whether the file ends in the middle of its data.
    pub fn is_truncated(&self) -> bool {
        self.truncated
    }

    /// Returns the missing parts in the middle of the file. They are replaced with silence, so the rest keeps its time.
    pub fn damage(&self) -> Damage {
        self.damage
    }

    /// Returns `made`, which was made from this recording, if all of the recording could be read.
    ///
    /// # Errors
    ///
    /// If a part of the temporary file of a long recording could not be read.
    pub fn intact<T>(&self, made: T) -> Result<T, SoundError> {
        match self.spectrum.is_lost() {
            true => Err(SoundError::Io(io::Error::other("a temporary file cannot be read"))),
            false => Ok(made),
        }
    }

    /// Whether the checksum in the file does not match the samples. Of the supported formats, only FLAC has one.
    pub fn is_altered(&self) -> bool {
        self.is_altered
    }

    /// Returns the places where the recording is clipped at full scale, in order. Nearby places are merged.
    pub fn clipping(&self) -> &[Clipping] {
        &self.clipping
    }

    /// Returns the level of the loud frames, in decibels relative to full scale: about -20 for a good recording. One
    /// frame in twenty is louder.
    pub fn level_db(&self) -> f32 {
        level::Levels::new(&self.audible()).loud_db
    }

    /// Returns the difference between the loud and the quiet frames, in decibels. Speech with pauses has 30 or more.
    /// Below 10, there are no pauses, or noise or music is as loud as the speech.
    pub fn range_db(&self) -> f32 {
        let levels = level::Levels::new(&self.audible());
        levels.loud_db - levels.quiet_db
    }

    /// Whether the recording is silent: at no time louder than -60 decibels relative to full scale.
    pub fn is_silent(&self) -> bool {
        audible::level_db(&self.spectrum) < level::SILENT_DB
    }

    /// Whether the recording is audible, but not speech: noise, a tone, or most music. The shape of its spectrum
    /// changes less than that of any speech.
    ///
    /// ```
    /// use lipz_speech::Sound;
    ///
    /// let hum: Vec<f32> = (0..32_000).map(|at| (at % 100) as f32 / 200.0).collect();
    /// assert!(Sound::from_samples(&hum, 16_000)?.is_no_speech());
    /// # Ok::<(), lipz_speech::SoundError>(())
    /// ```
    pub fn is_no_speech(&self) -> bool {
        !self.is_silent() && speech::is_something_else(&self.audible())
    }

    /// Returns the audible frames, or all frames if nothing is audible.
    fn audible(&self) -> Spectrogram {
        let parts = audible::parts(&self.spectrum);
        if parts.is_empty() {
            return self.spectrum.clone();
        }
        self.spectrum.cut(&parts)
    }

    /// Returns a recording with this spectrum.
    pub(crate) fn with_spectrum(&self, spectrum: Spectrogram) -> Sound {
        let samples = spectrum.len() as u64 * HOP as u64;
        Sound { samples, rate_hz: RATE_HZ, spectrum, clipping: Vec::new(), ..*self }
    }

    pub(crate) fn spectrum(&self) -> &Spectrogram {
        &self.spectrum
    }
}

/// Computes a [`Sound`] from samples, block by block.
struct Analysis {
    rate_hz: u32,
    samples: u64,
    resampler: Resampler,
    resampled: Vec<f32>,
    front_end: MelFrontEnd,
    spectrum: SpectrogramBuilder,
}

impl Analysis {
    fn new(rate_hz: u32) -> Analysis {
        Analysis {
            rate_hz,
            samples: 0,
            resampler: Resampler::new(rate_hz, RATE_HZ),
            resampled: Vec::new(),
            front_end: MelFrontEnd::new(),
            spectrum: SpectrogramBuilder::default(),
        }
    }

    fn push(&mut self, samples: &[f32]) -> Result<(), SoundError> {
        self.samples += samples.len() as u64;
        if self.samples > Sound::LONGEST_S * u64::from(self.rate_hz) {
            return Err(SoundError::TooLong);
        }
        self.resampler.push(samples, &mut self.resampled);
        self.analyse();
        Ok(())
    }

    fn finish(mut self) -> Sound {
        let resampler = std::mem::replace(&mut self.resampler, Resampler::new(RATE_HZ, RATE_HZ));
        resampler.finish(&mut self.resampled);
        // Pads the end so that each sample is in the first part of a frame.
        self.resampled.extend([0.0; WINDOW - 1]);
        self.analyse();
        Sound {
            samples: self.samples,
            rate_hz: self.rate_hz,
            spectrum: self.spectrum.finish(),
            truncated: false,
            is_altered: false,
            damage: Damage::default(),
            clipping: Vec::new(),
        }
    }

    fn analyse(&mut self) {
        for sample in &mut self.resampled {
            *sample *= 32_768.0; // the model's units
        }
        self.front_end.push(&self.resampled, |spectrum| self.spectrum.push(spectrum));
        self.resampled.clear();
    }
}
