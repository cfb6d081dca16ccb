//! The times of a Lipz file's segments, and the element at a position.

use lipz_file::text::{DELIMITER, is_white_space, segments};
use lipz_file::{Document, Element, JsonString, Value, rate};
use lipz_types::Fps;
use std::ops::Range;

/// The frames of a clip, and their rate.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Timing {
    /// The first frames of the segments, followed by the number of all frames.
    starts: Vec<u32>,
    fps: Option<Fps>,
}

impl Timing {
    /// Returns the timing of a Lipz file with visemes.
    pub(crate) fn of(document: &Document<'_>, default_fps: Option<Fps>) -> Option<Timing> {
        let visemes = document.string("visemes")?;
        let mut starts = vec![0];
        for segment in segments(visemes) {
            let frames = frames(visemes.get(segment).unwrap_or_default());
            starts.push(starts.last().copied().unwrap_or_default() + frames);
        }
        let fps = match document.get("fps").map(|element| &element.value) {
            Some(Value::Number(number)) => {
                rate::parse(&number.text).and_then(|rate| Fps::new(rate.numerator, rate.denominator))
            }
            _ => default_fps,
        };
        Some(Timing { starts, fps })
    }

    /// Returns the frames of consecutive segments, as far as the visemes contain them; `None` if they contain none.
    fn segments(&self, segments: Range<usize>) -> Option<Range<u32>> {
        let of_mouth = segments.start..segments.end.min(self.segment_count());
        if of_mouth.is_empty() {
            return None;
        }
        Some(*self.starts.get(of_mouth.start)?..*self.starts.get(of_mouth.end)?)
    }

    /// Returns the number of segments.
    pub(crate) fn segment_count(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// Returns the formatted start of a frame; `None` without a frame rate.
    pub(crate) fn time(&self, frame: u32) -> Option<String> {
        Some(format!("{:.3} s", self.fps?.start_of_frame_us(frame) as f64 / 1e6))
    }

    /// Returns the formatted time of segments: `frames 24–48, 1.000 s–2.000 s`.
    pub(crate) fn shown(&self, segments: Range<usize>) -> Option<String> {
        let frames = self.segments(segments)?;
        let shown = format!("frames {}–{}", frames.start, frames.end);
        Some(match (self.time(frames.start), self.time(frames.end)) {
            (Some(start), Some(end)) => format!("{shown}, {start}–{end}"),
            _ => shown,
        })
    }
}

/// Returns the number of frames in codes.
pub(crate) fn frames(codes: &str) -> u32 {
    let count = codes.chars().filter(|code| *code != DELIMITER && !is_white_space(*code)).count();
    u32::try_from(count).unwrap_or(u32::MAX)
}

/// Returns the segment that contains a byte of an element's text.
pub(crate) fn segment_at(text: &str, at: usize) -> (usize, Range<usize>) {
    let found = segments(text).enumerate().find(|(_, range)| at <= range.end);
    found.unwrap_or((0, 0..text.len()))
}

/// Returns the element at a byte of the file, either in its name or in its value.
pub(crate) fn element_at<'d, 's>(document: &'d Document<'s>, byte: usize) -> Option<&'d Element<'s>> {
    let is_in = |element: &&Element<'_>| {
        let (name, value) = (element.name.span(), element.value.span());
        name.range().contains(&byte) || value.range().contains(&byte)
    };
    document.elements.iter().find(is_in)
}

/// Returns the byte of the decoded text for `byte` of the file.
pub(crate) fn decoded(string: &JsonString<'_>, byte: usize) -> Option<usize> {
    string.span().range().contains(&byte).then_some(())?;
    let offset = byte.checked_sub(string.span().start as usize + 1)?;
    let text = &string.text;
    let place = |at: usize| string.span_of(at..at).start as usize;
    if string.span().range().len() == text.len() + 2 {
        return (offset <= text.len()).then_some(offset);
    }
    // Escapes are longer than their characters, so search for the last character that starts at or before the position.
    let (mut low, mut high) = (0, text.len());
    while low < high {
        let middle = (low + high).div_ceil(2);
        let middle = (middle..=high).find(|at| text.is_char_boundary(*at)).unwrap_or(high);
        if place(middle) <= byte {
            low = middle;
        } else {
            high = (low..middle).rev().find(|at| text.is_char_boundary(*at)).unwrap_or(low);
        }
    }
    Some(low)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn segments_have_frames_and_times() {
        let file = br#"{ "visemes": "MA EO-||SS", "fps": 25 }"#;
        let timing = Timing::of(&lipz_file::parse(file).document.unwrap(), None).unwrap();
        assert_eq!((timing.segment_count(), timing.segments(0..1), timing.segments(1..2)), (3, Some(0..5), Some(5..5)));
        assert_eq!(timing.shown(2..3).unwrap(), "frames 5–7, 0.200 s–0.280 s");
        assert_eq!((timing.segments(1..5), timing.segments(3..4)), (Some(5..7), None), "as far as there are frames");
        assert_eq!(Timing::of(&lipz_file::parse(b"{}").document.unwrap(), None), None);
    }

    #[test]
    fn places_behind_escapes() {
        let file = "{ \"events\": \"\\u00e9|\\\"𝄞|x\" }";
        let document = lipz_file::parse(file.as_bytes()).document.unwrap();
        let Value::String(string) = &document.get("events").unwrap().value else { unreachable!() };
        for (at, _) in string.text.char_indices() {
            let span = string.span_of(at..at);
            assert_eq!(decoded(string, span.start as usize), Some(at), "{at}");
        }
        assert_eq!(decoded(string, file.find("00e9").unwrap()), Some(0), "inside of an escape");
        assert_eq!(decoded(string, 3), None);
        assert_eq!(segment_at(&string.text, 3).0, 1);
    }
}
