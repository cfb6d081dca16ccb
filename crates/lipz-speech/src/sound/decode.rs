//! Decoding: a sound file of any format becomes blocks of samples of one channel.

use super::clipping::ClippingFinder;
use super::damage::Damage;
use super::error::SoundError;
use super::output::Output;
use super::packets::Packets;
use super::source::Source;
use super::{lengths, ogg, other};
use std::collections::VecDeque;
use std::io::{Read, Seek};
use symphonia::core::codecs::audio::{AudioDecoder, AudioDecoderOptions};
use symphonia::core::common::Limit;
use symphonia::core::errors::Error;
use symphonia::core::formats::probe::Hint;
use symphonia::core::formats::{FormatOptions, FormatReader, TrackType};
use symphonia::core::io::MediaSourceStream;
use symphonia::core::meta::MetadataOptions;

/// The rates that are read, in samples per second: beyond them there is no speech, or no sense.
pub(super) const RATES_HZ: std::ops::RangeInclusive<u32> = 4_000..=768_000;

/// Decodes `source` and gives its samples, as the mean of all channels from -1 to 1, to `take` in order, block by block,
/// each with the rate in samples per second.
///
/// A file that ends too early, or is damaged in the middle, gives what can be read of it, with silence where something is
/// missing, and what [`Decoded`] tells.
pub(crate) fn decode<S>(
    source: S,
    extension: Option<&str>,
    take: impl FnMut(u32, &[f32]) -> Result<(), SoundError>,
) -> Result<Decoded, SoundError>
where
    S: Read + Seek + Send + Sync,
{
    let mut source = Source::new(source).map_err(SoundError::Io)?;
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
    let format = probe(source, extension)?;
    let (track, mut decoder) = open(format.as_ref())?;
    let rate_hz = decoder.codec_params().sample_rate.unwrap_or(0);
    let mut packets = Packets::new(format, rate_hz, holes).map_err(SoundError::unreadable)?;
    let mut output = Output::new(take);
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

/// What reads a file of this format.
fn probe<'s, S>(source: Source<S>, extension: Option<&str>) -> Result<Box<dyn FormatReader + 's>, SoundError>
where
    S: Read + Seek + Send + Sync + 's,
{
    let stream = MediaSourceStream::new(Box::new(source), Default::default());
    let mut hint = Hint::new();
    if let Some(extension) = extension {
        hint.with_extension(extension);
    }
    // Pictures of the cover and the like are nothing to us: a few bytes are enough for what decoding needs.
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

/// How many bytes of metadata are read.
const METADATA_BYTES: usize = 1 << 20;

/// What decoding met.
#[derive(Clone, Debug, Default)]
pub(crate) struct Decoded {
    /// Where the samples are cut off.
    pub(super) clipping: ClippingFinder,
    /// The file ends in the middle of its data.
    pub(super) truncated: bool,
    /// The checksum of all samples is another one.
    pub(super) is_altered: bool,
    /// What is missing in the middle.
    pub(super) damage: Damage,
}

/// The first track of sound, and its decoder.
fn open(format: &dyn FormatReader) -> Result<(u32, Box<dyn AudioDecoder>), SoundError> {
    let track = format.default_track(TrackType::Audio).ok_or(SoundError::NoSound)?;
    let parameters = track.codec_params.as_ref().and_then(|parameters| parameters.audio());
    let parameters = parameters.ok_or(SoundError::NoSound)?;
    let decoder =
        symphonia::default::get_codecs().make_audio_decoder(parameters, &AudioDecoderOptions::default().verify(true));
    Ok((track.id, decoder.map_err(SoundError::unreadable)?))
}
