//! The packets of a sound file, and what is missing between them.

use super::mpeg::Frames;
use super::ogg::Hole;
use std::collections::VecDeque;
use symphonia::core::errors::{Error, Result};
use symphonia::core::formats::FormatReader;
use symphonia::core::io::MediaSourceStream;
use symphonia::core::packet::Packet;

/// Gaps between packets that are shorter are none: a part of a second.
const LEAST_GAP: u32 = 200;

/// Packets that end in a page at most.
const MOST_PACKETS: usize = 255;

/// A packet, and how many samples are missing before it, if something is: 0 if nobody knows how many.
pub(super) type Next = (Packet, Option<u64>);

/// Where packets come from.
pub(super) enum Packets<'s> {
    /// A format whose packets have times.
    Timed(Timed<'s>),
    /// A format in which packets follow each other, whatever happens.
    Untimed(Box<dyn FormatReader + 's>),
    Mpeg(Frames<MediaSourceStream<'s>>),
}

impl<'s> Packets<'s> {
    /// The packets of a file of this rate that has just been opened. If pages of it are missing, these are the `holes`.
    pub(super) fn new(format: Box<dyn FormatReader + 's>, rate_hz: u32, holes: VecDeque<Hole>) -> Result<Packets<'s>> {
        let expected = match format.format_info().short_name {
            "mp3" => {
                let track = format.tracks().first().cloned();
                let mut stream = format.into_inner();
                std::io::Seek::rewind(&mut stream)?;
                let frames = track.map(|track| Frames::new(stream, &track)).transpose()?.flatten();
                return frames.map(Packets::Mpeg).ok_or(Error::DecodeError("no frame of sound"));
            }
            "flac" => Some(0),
            "ogg" => None,
            _ => return Ok(Packets::Untimed(format)),
        };
        let least_gap = i64::from(rate_hz / LEAST_GAP);
        let held = VecDeque::new();
        Ok(Packets::Timed(Timed { format, expected, least_gap, holes, held, ahead: None }))
    }

    /// The next packet.
    pub(super) fn next(&mut self) -> Result<Option<Next>> {
        match self {
            Packets::Mpeg(frames) => Ok(frames.next()?),
            Packets::Untimed(format) => Ok(format.next_packet()?.map(|packet| (packet, None))),
            Packets::Timed(timed) => timed.next(),
        }
    }

    /// Whether the file turned out to end too early, although there was no error.
    pub(super) fn is_cut(&self) -> bool {
        matches!(self, Packets::Mpeg(frames) if frames.is_cut)
    }
}

/// A format whose packets have times.
pub(super) struct Timed<'s> {
    format: Box<dyn FormatReader + 's>,
    /// When the next packet should start; of the first, only FLAC knows.
    expected: Option<i64>,
    least_gap: i64,
    /// Where pages are missing: the packets of the first page behind have the times of those that are gone.
    holes: VecDeque<Hole>,
    /// These packets, until the next one tells how much is missing before them.
    held: VecDeque<Packet>,
    /// That next one.
    ahead: Option<Next>,
}

impl Timed<'_> {
    fn next(&mut self) -> Result<Option<Next>> {
        if let Some(packet) = self.held.pop_front() {
            return Ok(Some((packet, None)));
        }
        let Some(next) = self.ahead.take().map_or_else(|| self.read(), |next| Ok(Some(next)))? else { return Ok(None) };
        let is_behind = |packet: &Packet, hole: &Hole| packet.pts.get() >= hole.start;
        let Some(hole) = self.holes.pop_front_if(|hole| is_behind(&next.0, hole)) else { return Ok(Some(next)) };
        let mut end_of_page = end(&next.0);
        // What fails, fails again after the packets that are held.
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

    /// The next packet of the file.
    fn read(&mut self) -> Result<Option<Next>> {
        let Some(packet) = self.format.next_packet()? else { return Ok(None) };
        let start = packet.pts.get();
        let gap = self.expected.map_or(0, |expected| start.saturating_sub(expected));
        self.expected = Some(end(&packet));
        let gap = u64::try_from(gap).ok().filter(|_| gap >= self.least_gap);
        Ok(Some((packet, gap)))
    }
}

/// When a packet ends, in samples: those that are trimmed off count, too.
fn end(packet: &Packet) -> i64 {
    let trimmed = packet.trim_start.get().saturating_add(packet.trim_end.get());
    packet.pts.get().saturating_add_unsigned(packet.dur.get().saturating_add(trimmed))
}
