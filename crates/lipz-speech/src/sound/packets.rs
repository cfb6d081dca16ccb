//! The packets of an audio file, and the missing parts between them.

use super::mpeg::Frames;
use super::ogg::Hole;
use std::collections::VecDeque;
use symphonia::core::errors::{Error, Result};
use symphonia::core::formats::FormatReader;
use symphonia::core::io::MediaSourceStream;
use symphonia::core::packet::Packet;

/// Shorter gaps between packets do not count: a fraction of a second.
const LEAST_GAP: u32 = 200;

/// The most packets that end in one page.
const MOST_PACKETS: usize = 255;

/// A packet, and the number of samples that are missing before it, if any: 0 if the number is unknown.
pub(super) type NextPacket = (Packet, Option<u64>);

/// The source of packets.
pub(super) enum Packets<'s> {
    /// A format whose packets have times.
    Timed(TimedPackets<'s>),
    /// A format whose packets have no times.
    Untimed(Box<dyn FormatReader + 's>),
    Mpeg(Frames<MediaSourceStream<'s>>),
}

impl<'s> Packets<'s> {
    /// Returns the packets of a file with this rate that has just been opened. `holes` are the missing pages.
    pub(super) fn new(format: Box<dyn FormatReader + 's>, rate_hz: u32, holes: VecDeque<Hole>) -> Result<Packets<'s>> {
        let expected = match format.format_info().short_name {
            "mp3" => {
                let track = format.tracks().first().cloned();
                let mut stream = format.into_inner();
                std::io::Seek::rewind(&mut stream)?;
                let frames = track.map(|track| Frames::new(stream, &track)).transpose()?.flatten();
                return frames.map(Packets::Mpeg).ok_or(Error::DecodeError("no frame of audio"));
            }
            "flac" => Some(0),
            "ogg" => None,
            _ => return Ok(Packets::Untimed(format)),
        };
        let least_gap = i64::from(rate_hz / LEAST_GAP);
        let held = VecDeque::new();
        Ok(Packets::Timed(TimedPackets { format, expected, least_gap, holes, held, ahead: None }))
    }

    /// Returns the next packet.
    pub(super) fn next(&mut self) -> Result<Option<NextPacket>> {
        match self {
            Packets::Mpeg(frames) => Ok(frames.next()?),
            Packets::Untimed(format) => Ok(format.next_packet()?.map(|packet| (packet, None))),
            Packets::Timed(timed) => timed.next(),
        }
    }

    /// Whether the file ended too early without an error.
    pub(super) fn is_cut(&self) -> bool {
        matches!(self, Packets::Mpeg(frames) if frames.is_cut)
    }
}

/// A format whose packets have times.
pub(super) struct TimedPackets<'s> {
    format: Box<dyn FormatReader + 's>,
    /// The expected start of the next packet. That of the first is known for FLAC only.
    expected: Option<i64>,
    least_gap: i64,
    /// The missing pages. The packets of the first page after each have the times of the missing packets.
    holes: VecDeque<Hole>,
    /// These packets, until the next one determines how much is missing before them.
    held: VecDeque<Packet>,
    /// The packet after those.
    ahead: Option<NextPacket>,
}

impl TimedPackets<'_> {
    fn next(&mut self) -> Result<Option<NextPacket>> {
        if let Some(packet) = self.held.pop_front() {
            return Ok(Some((packet, None)));
        }
        let Some(next) = self.ahead.take().map_or_else(|| self.read(), |next| Ok(Some(next)))? else { return Ok(None) };
        let is_behind = |packet: &Packet, hole: &Hole| packet.pts.get() >= hole.start;
        let Some(hole) = self.holes.pop_front_if(|hole| is_behind(&next.0, hole)) else { return Ok(Some(next)) };
        let mut end_of_page = end(&next.0);
        // An error occurs again after the held packets.
        while self.held.len() < MOST_PACKETS
            && let Ok(Some(next)) = self.read()
        {
            if next.0.pts.get() >= hole.next_end {
                self.ahead = Some((next.0, None));
                break;
            }
            end_of_page = end(&next.0);
            self.held.push_back(next.0);
        }
        let gap = u64::try_from(hole.next_end.saturating_sub(end_of_page)).unwrap_or(0);
        Ok(Some((next.0, Some(gap))))
    }

    /// Returns the next packet of the file.
    fn read(&mut self) -> Result<Option<NextPacket>> {
        let Some(packet) = self.format.next_packet()? else { return Ok(None) };
        let start = packet.pts.get();
        let gap = self.expected.map_or(0, |expected| start.saturating_sub(expected));
        self.expected = Some(end(&packet));
        let gap = u64::try_from(gap).ok().filter(|_| gap >= self.least_gap);
        Ok(Some((packet, gap)))
    }
}

/// Returns the end of a packet in samples, including those that are trimmed.
fn end(packet: &Packet) -> i64 {
    let trimmed = packet.trim_start.get().saturating_add(packet.trim_end.get());
    packet.pts.get().saturating_add_unsigned(packet.dur.get().saturating_add(trimmed))
}
