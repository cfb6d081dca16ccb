//! Decoding: turns an audio file of any format into blocks of mono samples.

use super::clipping::ClippingFinder;
use super::damage::Damage;
use super::error::SoundError;
use super::output::Output;
use super::packets::Packets;
use super::source::SizedSource;
use super::{flac, lengths, ogg, other};
use std::collections::VecDeque;
use std::io::{Read, Seek};
use symphonia::core::codecs::audio::{AudioDecoder, AudioDecoderOptions};
use symphonia::core::common::Limit;
use symphonia::core::errors::Error;
use symphonia::core::formats::probe::Hint;
use symphonia::core::formats::{FormatOptions, FormatReader, TrackType};
use symphonia::core::io::MediaSourceStream;
use symphonia::core::meta::MetadataOptions;

/// The supported rates, in samples per second. Rates outside are too low for speech, or invalid.
pub(super) const RATES_HZ: std::ops::RangeInclusive<u32> = 4_000..=768_000;

/// Decodes `source` and passes its samples to `take` in order, block by block, each with the rate in samples per
/// second. A sample is the mean of all channels, from -1 to 1.
///
/// A file that ends too early, or is damaged in the middle, is decoded as far as possible, with silence for the missing
/// parts. [`DecodingReport`] describes the damage.
pub(crate) fn decode<S>(
    source: S,
    extension: Option<&str>,
    take: impl FnMut(u32, &[f32]) -> Result<(), SoundError>,
) -> Result<DecodingReport, SoundError>
where
    S: Read + Seek + Send + Sync,
{
    let mut source = SizedSource::new(source).map_err(SoundError::Io)?;
    if source.length == 0 {
        return Err(SoundError::Empty);
    }
    if let Some(name) = other::name(&source.peek(0, other::LOOKED_AT).map_err(SoundError::Io)?) {
        return Err(SoundError::OtherFormat { name: Some(name) });
    }
    let holes = match source.peek(0, 4).map_err(SoundError::Io)?.as_slice() {
        b"OggS" => source.rewound(|bytes| ogg::holes(bytes)).map_err(SoundError::Io)?,
        _ => VecDeque::new(),
    };
    let told = lengths::mend(&mut source).map_err(SoundError::Io)?;
    flac::mend(&mut source).map_err(SoundError::Io)?;
    let format = probe(source, extension)?;
    let (track, mut decoder) = open(format.as_ref())?;
    let rate_hz = decoder.codec_params().sample_rate.unwrap_or(0);
    let mut packets = Packets::new(format, rate_hz, holes).map_err(SoundError::unreadable)?;
    let mut output = Output::new(take, told.samples);
    output.decoded.truncated = told.is_cut;
    loop {
        let (packet, missing) = match packets.next() {
            Ok(Some(next)) => next,
            Ok(None) => {
                output.decoded.truncated |= packets.is_cut();
                break;
            }
            Err(Error::IoError(error)) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
                output.decoded.truncated |= !told.is_streamed;
                break;
            }
            Err(Error::IoError(error)) => return Err(SoundError::Io(error)),
            Err(_) => {
                output.leave_out(0)?;
                break;
            }
        };
        if packet.track_id != track {
            continue;
        }
        if let Some(samples) = missing {
            output.leave_out(samples)?;
        }
        match decoder.decode(&packet) {
            Ok(buffer) => output.push(&buffer)?,
            Err(Error::IoError(_) | Error::DecodeError(_)) => output.leave_out(packet.dur.get())?,
            Err(error) => return Err(SoundError::unreadable(error)),
        }
    }
    output.decoded.is_altered = decoder.finalize().verify_ok == Some(false);
    Ok(output.decoded)
}

/// Returns the reader for the format of the file.
fn probe<'s, S>(source: SizedSource<S>, extension: Option<&str>) -> Result<Box<dyn FormatReader + 's>, SoundError>
where
    S: Read + Seek + Send + Sync + 's,
{
    let stream = MediaSourceStream::new(Box::new(source), Default::default());
    let mut hint = Hint::new();
    if let Some(extension) = extension {
        hint.with_extension(extension);
    }
    // Cover art and similar metadata are not used. Decoding needs only a few bytes.
    let metadata = MetadataOptions::default()
        .limit_tag_bytes(Limit::Maximum(METADATA_BYTES))
        .limit_visual_bytes(Limit::Maximum(METADATA_BYTES));
    symphonia::default::get_probe().probe(&hint, stream, FormatOptions::default(), metadata).map_err(
        |error| match error {
            Error::Unsupported(_) => SoundError::OtherFormat { name: None },
            error => SoundError::unreadable(error),
        },
    )
}

/// The most bytes of metadata that are read.
const METADATA_BYTES: usize = 1 << 20;

/// The irregularities found during decoding.
#[derive(Clone, Debug, Default)]
pub(crate) struct DecodingReport {
    /// The clipped places.
    pub(super) clipping: ClippingFinder,
    /// Whether the file ends in the middle of its data.
    pub(super) truncated: bool,
    /// Whether the checksum of all samples is wrong.
    pub(super) is_altered: bool,
    /// The missing parts in the middle.
    pub(super) damage: Damage,
}

/// Returns the first audio track and its decoder.
fn open(format: &dyn FormatReader) -> Result<(u32, Box<dyn AudioDecoder>), SoundError> {
    let track = format.default_track(TrackType::Audio).ok_or(SoundError::NoSound)?;
    let parameters = track.codec_params.as_ref().and_then(|parameters| parameters.audio());
    let parameters = parameters.ok_or(SoundError::NoSound)?;
    let decoder =
        symphonia::default::get_codecs().make_audio_decoder(parameters, &AudioDecoderOptions::default().verify(true));
    Ok((track.id, decoder.map_err(SoundError::unreadable)?))
}
