//! Decoding: a sound file of any format becomes blocks of samples of one channel.

use super::clipping::ClippingFinder;
use super::error::SoundError;
use super::other;
use std::io::{Read, Seek};
use symphonia::core::codecs::audio::{AudioDecoder, AudioDecoderOptions};
use symphonia::core::common::Limit;
use symphonia::core::errors::Error;
use symphonia::core::formats::probe::Hint;
use symphonia::core::formats::{FormatOptions, FormatReader, TrackType};
use symphonia::core::io::{MediaSource, MediaSourceStream};
use symphonia::core::meta::MetadataOptions;

/// The rates that are read, in samples per second: beyond them there is no speech, or no sense.
pub(super) const RATES_HZ: std::ops::RangeInclusive<u32> = 4_000..=768_000;

/// Decodes `source` and gives its samples, as the mean of all channels from -1 to 1, to `take` in order, block by block,
/// each with the rate in samples per second.
///
/// A file that ends too early, or is damaged in the middle, gives what can be read of it, and the error that tells so.
pub(crate) fn decode<S>(
    source: S,
    extension: Option<&str>,
    mut take: impl FnMut(u32, &[f32]) -> Result<(), SoundError>,
) -> Result<Decoded, SoundError>
where
    S: Read + Seek + Send + Sync,
{
    let mut source = Source::new(source)?;
    if source.length == 0 {
        return Err(SoundError::Empty);
    }
    let start = source.start()?;
    if let Some(name) = other::name(&start) {
        return Err(SoundError::OtherFormat { name: Some(name) });
    }
    let stream = MediaSourceStream::new(Box::new(source), Default::default());
    let mut hint = Hint::new();
    if let Some(extension) = extension {
        hint.with_extension(extension);
    }
    // Pictures of the cover and the like are nothing to us: a few bytes are enough for what decoding needs.
    let metadata = MetadataOptions::default()
        .limit_tag_bytes(Limit::Maximum(METADATA_BYTES))
        .limit_visual_bytes(Limit::Maximum(METADATA_BYTES));
    let mut format =
        symphonia::default::get_probe().probe(&hint, stream, FormatOptions::default(), metadata).map_err(|error| {
            match error {
                Error::Unsupported(_) => SoundError::OtherFormat { name: None },
                error => SoundError::unreadable(error),
            }
        })?;
    let (track, mut decoder) = open(format.as_ref())?;
    let mut decoded = Decoded::default();
    let mut interleaved: Vec<f32> = Vec::new();
    let mut taken = 0;
    let mut mono = Vec::new();
    let mut rate_hz = None;
    loop {
        let packet = match format.next_packet() {
            Ok(Some(packet)) => packet,
            Ok(None) => break,
            Err(Error::IoError(error)) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
                decoded.truncated = !is_streamed(&start);
                break;
            }
            Err(Error::IoError(error)) => return Err(SoundError::Io(error)),
            Err(_) => {
                decoded.damaged_packets += 1;
                break;
            }
        };
        if packet.track_id != track {
            continue;
        }
        let buffer = match decoder.decode(&packet) {
            Ok(buffer) => buffer,
            Err(Error::IoError(_) | Error::DecodeError(_)) => {
                decoded.damaged_packets += 1;
                continue;
            }
            Err(error) => return Err(SoundError::unreadable(error)),
        };
        let rate = buffer.spec().rate();
        if !RATES_HZ.contains(&rate) {
            return Err(SoundError::Rate { rate_hz: rate });
        }
        if *rate_hz.get_or_insert(rate) != rate {
            return Err(SoundError::RateChanges);
        }
        let channels = buffer.num_planes().max(1);
        buffer.copy_to_vec_interleaved::<f32>(&mut interleaved);
        decoded.clipping.push(&interleaved, channels, taken, rate);
        mono.clear();
        mono.extend(interleaved.chunks_exact(channels).map(mean));
        taken += mono.len() as u64;
        take(rate, &mono)?;
    }
    Ok(decoded)
}

/// Whether this is the start of a WAV file whose writer did not know its length, and so wrote the greatest (ffmpeg) or the
/// half of it (sox): it ends where its bytes end.
fn is_streamed(start: &[u8]) -> bool {
    let length = start.strip_prefix(b"RIFF").and_then(|rest| rest.first_chunk());
    length.is_some_and(|length| u32::from_le_bytes(*length) >= 0x7fff_f000)
}

/// How many bytes of metadata are read.
const METADATA_BYTES: usize = 1 << 20;

/// What decoding met.
#[derive(Clone, Debug, Default)]
pub(crate) struct Decoded {
    /// Where the samples are cut off.
    pub(super) clipping: ClippingFinder,
    /// The file ends in the middle of its data.
    pub(super) truncated: bool,
    /// How many packets could not be decoded.
    pub(super) damaged_packets: u64,
}

/// The first track of sound, and its decoder.
fn open(format: &dyn FormatReader) -> Result<(u32, Box<dyn AudioDecoder>), SoundError> {
    let track = format.default_track(TrackType::Audio).ok_or(SoundError::NoSound)?;
    let parameters = track.codec_params.as_ref().and_then(|parameters| parameters.audio());
    let parameters = parameters.ok_or(SoundError::NoSound)?;
    let decoder = symphonia::default::get_codecs().make_audio_decoder(parameters, &AudioDecoderOptions::default());
    Ok((track.id, decoder.map_err(SoundError::unreadable)?))
}

/// The mean of the samples of all channels. A number that is none counts as silence: floats in files can be anything.
fn mean(frame: &[f32]) -> f32 {
    let sum: f32 = frame.iter().map(|&sample| if sample.is_finite() { sample.clamp(-1.0, 1.0) } else { 0.0 }).sum();
    let channels = frame.len() as f32;
    sum / channels
}

/// A source that knows its length, as the decoder wants it.
struct Source<S> {
    inner: S,
    length: u64,
}

impl<S: Read + Seek> Source<S> {
    fn new(mut inner: S) -> Result<Source<S>, SoundError> {
        let length = inner.seek(std::io::SeekFrom::End(0)).map_err(SoundError::Io)?;
        inner.rewind().map_err(SoundError::Io)?;
        Ok(Source { inner, length })
    }

    /// Its first bytes.
    fn start(&mut self) -> Result<Vec<u8>, SoundError> {
        let mut start = Vec::new();
        self.inner.by_ref().take(other::LOOKED_AT as u64).read_to_end(&mut start).map_err(SoundError::Io)?;
        self.inner.rewind().map_err(SoundError::Io)?;
        Ok(start)
    }
}

impl<S: Read> Read for Source<S> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        self.inner.read(buffer)
    }
}

impl<S: Seek> Seek for Source<S> {
    fn seek(&mut self, position: std::io::SeekFrom) -> std::io::Result<u64> {
        self.inner.seek(position)
    }
}

impl<S: Read + Seek + Send + Sync> MediaSource for Source<S> {
    fn is_seekable(&self) -> bool {
        true
    }

    fn byte_len(&self) -> Option<u64> {
        Some(self.length)
    }
}
