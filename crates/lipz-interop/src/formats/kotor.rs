//! Star Wars: Knights of the Old Republic, LIP V1.0: little-endian, a header of 16 bytes, then keys of five bytes: the
//! time in seconds as a 32-bit float, and the shape from 0 to 15.
//!
//! The engine blends linearly between keys, and so does reone, a reimplementation. Therefore the shape of a key
//! dominates from halfway after the previous key to halfway before the next, and two keys with the same shape hold it.
//! The last key is at the end of the recording, because there is nothing to blend to after it.

use super::Format;
use crate::{DEFAULT_RATE, ImportOptions, Shape, Time, Track};
use lipz_diagnostics::{Code, Diagnostic};

const MAGIC: &[u8; 8] = b"LIP V1.0";
const HEADER_BYTES: usize = 16;
const KEY_BYTES: usize = 5;
/// The number of shapes, which is above all shape numbers.
const SHAPES: u8 = 16;

pub(super) const FORMAT: Format = Format {
    name: "kotor",
    about: "Knights of the Old Republic, LIP V1.0",
    extension: "lip",
    maps: &["kotor"],
    is_binary: true,
    is_legacy: false,
    keeps_texts: false,
    read: Some(read),
    write: Some(write),
};

fn read(bytes: &[u8], _: &ImportOptions<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Track> {
    if bytes.len() < HEADER_BYTES && MAGIC.starts_with(bytes.get(..MAGIC.len().min(bytes.len())).unwrap_or_default()) {
        diagnostics.push(cut_off(bytes.len(), "the header has 16 bytes"));
        return Vec::new();
    }
    if !bytes.starts_with(MAGIC) {
        let diagnostic = Diagnostic::new(Code::ForeignSyntax, "the file does not start with `LIP V1.0`");
        diagnostics.push(at(diagnostic, 0).help("check whether it is a LIP file of a different game"));
        return Vec::new();
    }
    let (header, keys) = bytes.split_at(HEADER_BYTES);
    let length = float(header.get(8..12));
    let count = word(header.get(12..16)) as usize;
    let mut track = Track::default();
    let mut keys_read = Vec::new();
    if keys.len() / KEY_BYTES < count {
        let missing = format!("its header counts {count} keys, but it has {}", keys.len() / KEY_BYTES);
        diagnostics.push(cut_off(bytes.len(), &missing));
        return Vec::new();
    }
    if keys.len() > count * KEY_BYTES {
        let rest = keys.len() - count * KEY_BYTES;
        let diagnostic = Diagnostic::new(Code::ForeignOddity, format!("{rest} bytes follow the last key"));
        diagnostics.push(at(diagnostic, HEADER_BYTES + count * KEY_BYTES).note("they are not read"));
    }
    for (index, key) in keys.chunks_exact(KEY_BYTES).take(count).enumerate() {
        let place = HEADER_BYTES + index * KEY_BYTES;
        let shape = key.last().copied().unwrap_or_default();
        match Time::from_f32(float(key.get(..4))) {
            None => diagnostics.push(at(Diagnostic::new(Code::ForeignValue, "a key has no time"), place)),
            Some(_) if shape >= SHAPES => {
                let message = format!("the shape {shape} does not exist");
                let diagnostic = at(Diagnostic::new(Code::ForeignValue, message), place + KEY_BYTES - 1);
                diagnostics.push(diagnostic.help("write a number from 0 to 15"));
            }
            Some(time) => keys_read.push((time, shape)),
        }
    }
    track.shapes = dominant(&keys_read);
    track.end = Time::from_f32(length);
    if track.end.is_none() {
        diagnostics.push(at(Diagnostic::new(Code::ForeignValue, "the length is not a time"), 8));
    }
    vec![track]
}

fn at(diagnostic: Diagnostic, byte: usize) -> Diagnostic {
    diagnostic.note(format!("at byte 0x{byte:X}"))
}

fn cut_off(length: usize, missing: &str) -> Diagnostic {
    let diagnostic = Diagnostic::new(Code::ForeignCutOff, format!("the file ends too early: {missing}"));
    at(diagnostic, length).help("copy the file again")
}

fn word(bytes: Option<&[u8]>) -> u32 {
    u32::from_le_bytes(bytes.and_then(|bytes| bytes.try_into().ok()).unwrap_or_default())
}

fn float(bytes: Option<&[u8]>) -> f32 {
    f32::from_bits(word(bytes))
}

/// Returns each shape with the start of its dominance. Keys whose times run backwards keep their times, so that they
/// are reported.
fn dominant(keys: &[(Time, u8)]) -> Vec<Shape> {
    let mut before: Option<Time> = None;
    let shape = |&(time, shape): &(Time, u8)| {
        let start = before.map_or(time, |before| if before < time { before.midpoint(time) } else { time });
        before = Some(time);
        Shape::new(start, shape.to_string())
    };
    keys.iter().map(shape).collect()
}

/// Returns keys between which the engine blends for the length of a frame, centred on the change of shapes.
fn write(track: &Track, diagnostics: &mut Vec<Diagnostic>) -> Vec<u8> {
    let rate = track.rate.unwrap_or(DEFAULT_RATE);
    let half_a_frame = Time::of_frame(1, rate).as_f64() / 2.0;
    // Times that are equal by arithmetic differ by rounding, which is far less than this.
    let is_later = |last: f64, first: f64| last - first > half_a_frame / 2.0;
    let length = track.end.unwrap_or(Time::ZERO).as_f64();
    let mut keys: Vec<(f64, u8)> = Vec::new();
    let mut shapes = track.shapes.iter().peekable();
    while let Some(shape) = shapes.next() {
        // A custom table may name anything, but the engine has sixteen shapes.
        let Some(number) = shape.symbol.parse::<u8>().ok().filter(|number| *number < SHAPES) else {
            let message = format!("{} is not a shape of the engine", lipz_diagnostics::escape::quoted(&shape.symbol));
            diagnostics.push(
                Diagnostic::new(Code::ExportLoss, message).note("it is left out; shapes have numbers from 0 to 15"),
            );
            continue;
        };
        let end = shapes.peek().map(|next| next.start.as_f64());
        let first = if keys.is_empty() { 0.0 } else { shape.start.as_f64() + half_a_frame };
        let last = end.map_or(length, |end| end - half_a_frame);
        keys.push((first.min(last), number));
        // For a shape of one frame, both times are equal, unless it is the first or the last one.
        if is_later(last, first) {
            keys.push((last, number));
        }
    }
    let count = u32::try_from(keys.len()).unwrap_or(u32::MAX);
    let keys = keys.iter().flat_map(|(time, number)| seconds(*time).to_le_bytes().into_iter().chain([*number]));
    [MAGIC.as_slice(), &seconds(length).to_le_bytes(), &count.to_le_bytes(), &keys.collect::<Vec<u8>>()].concat()
}

#[allow(clippy::cast_possible_truncation, reason = "the nearest one is meant")]
fn seconds(time: f64) -> f32 {
    time as f32
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    fn track(starts: &[(u64, &str)], end: u64) -> Track {
        let at = |frame| Time::of_frame(frame, DEFAULT_RATE);
        let shapes = starts.iter().map(|&(frame, symbol)| Shape::new(at(frame), symbol)).collect();
        Track { shapes, end: Some(at(end)), rate: Some(DEFAULT_RATE), ..Track::default() }
    }

    #[test]
    fn shapes_are_held_and_the_last_key_is_at_the_length() {
        let bytes = write(&track(&[(0, "0"), (4, "2"), (5, "7")], 12), &mut Vec::new());
        let keys: Vec<(f32, u8)> =
            bytes[HEADER_BYTES..].chunks_exact(KEY_BYTES).map(|key| (float(key.get(..4)), key[4])).collect();
        let frame = |time: f32| time * 24.0;
        let expected = [(0.0, 0), (3.5, 0), (4.5, 2), (5.5, 7), (12.0, 7)];
        assert_eq!(keys.len(), expected.len(), "{keys:?}");
        for ((time, shape), (expected_frame, expected_shape)) in keys.into_iter().zip(expected) {
            assert!((frame(time) - expected_frame).abs() < 1e-4, "{time} is not frame {expected_frame}");
            assert_eq!(shape, expected_shape);
        }
    }

    /// Half of the clips whose last shape has one frame lacked the key, depending on the rounding of two equal times.
    #[test]
    fn last_keys_of_every_length_are_at_the_end() {
        for rate in ["24", "23.976", "25", "30", "60"].map(|rate| lipz_file::rate::parse(rate).unwrap()) {
            for frames in 1..400 {
                let at = |frame| Time::of_frame(frame, rate);
                let shapes = vec![Shape::new(Time::ZERO, "0"), Shape::new(at(frames), "2")];
                let clip = Track { shapes, end: Some(at(frames + 1)), rate: Some(rate), ..Track::default() };
                let bytes = write(&clip, &mut Vec::new());
                let key = |key: &[u8]| (float(key.get(..4)), key[4]);
                let keys: Vec<(f32, u8)> = bytes[HEADER_BYTES..].chunks_exact(KEY_BYTES).map(key).collect();
                let shapes: Vec<u8> = keys.iter().map(|(_, shape)| *shape).collect();
                assert_eq!(shapes, [0, 0, 2, 2], "{frames} frames");
                assert_eq!(keys[3].0.to_bits(), float(bytes.get(8..12)).to_bits(), "{frames} frames");
            }
        }
    }

    #[test]
    fn what_is_written_is_read_at_the_same_frames() {
        for starts in [&[(0, "0")][..], &[(0, "0"), (1, "2"), (2, "3"), (9, "0")], &[(0, "4"), (30, "0")]] {
            let written = write(&track(starts, 40), &mut Vec::new());
            let read = read(&written, &ImportOptions::default(), &mut Vec::new()).pop().unwrap();
            let mut frames: Vec<(u64, &str)> = read
                .shapes
                .iter()
                .map(|shape| (shape.start.nearest_frame(DEFAULT_RATE), shape.symbol.as_str()))
                .collect();
            frames.dedup_by_key(|(_, symbol)| *symbol);
            assert_eq!(frames, starts);
        }
    }
}
