//! Face shapes of ARKit as recorded by Live Link Face, CSV: a line per frame with its timecode and 52 weights. The
//! strongest shape that concerns the lips becomes the viseme of the frame; for loudness (rms), the opening of the jaw
//! is used.

use super::Format;
use crate::source::{self, Line};
use crate::{ImportOptions, Map, Shape, Time, Track, find_map};
use lipz_diagnostics::{Code, Diagnostic};
use lipz_file::rate::Rate;
use lipz_types::VisemeType;

const TIMECODE: &str = "Timecode";
const JAW: &str = "JawOpen";
const TABLE: &str = "arkit";
/// The table's name for rest.
const REST: &str = "rest";
/// Weaker shapes are ignored, because a tracked face never lies still.
const FLOOR: f64 = 0.15;
/// The usual recording rates.
const RATES: [u32; 4] = [24, 25, 30, 60];
const SECONDS_OF_A_DAY: u64 = 24 * 60 * 60;
/// The parts of a frame. Timecodes have three digits of them.
const PARTS: u32 = 1000;

pub(super) const FORMAT: Format = Format {
    name: "live-link",
    about: "Live Link Face (ARKit) recordings, CSV",
    extension: "csv",
    maps: &[TABLE, "rms"],
    is_binary: false,
    is_legacy: false,
    keeps_texts: false,
    read: Some(read),
    write: None,
};

fn read(bytes: &[u8], options: &ImportOptions<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Track> {
    let Some(text) = source::text(bytes, diagnostics) else { return Vec::new() };
    let mut lines = source::lines(text).filter(|line| !line.text.trim().is_empty());
    let Some(header) = lines.next() else { return vec![Track::default()] };
    let names: Vec<Line<'_>> = fields(header).collect();
    let place = |name: &str| names.iter().position(|field| field.text.eq_ignore_ascii_case(name));
    let (Some(timecode), Some(jaw)) = (place(TIMECODE), place(JAW)) else {
        diagnostics.push(
            header
                .not("a line of names with `Timecode` and `JawOpen`")
                .help("check whether this is a CSV file of Live Link Face"),
        );
        return Vec::new();
    };
    let Some(map) = options.map.or_else(|| find_map(TABLE)) else { return Vec::new() };
    let is_loudness = options.map.is_none() && options.viseme_type == Some(VisemeType::Rms);
    let rows: Vec<Vec<Line<'_>>> = lines.map(|line| fields(line).collect()).collect();
    let codes: Vec<Option<Timecode>> =
        rows.iter().map(|row| row.get(timecode).and_then(|field| Timecode::parse(field.text))).collect();
    let rate = options.file_rate.unwrap_or_else(|| rate(&codes));
    let mut track = Track { rate: Some(rate), map: Some(if is_loudness { "rms" } else { TABLE }), ..Track::default() };
    if options.file_rate.is_none() {
        track.remarks.push(format!("{} frames per second, from the timecodes", rate.numerator));
    }
    let origin = codes.iter().flatten().next().copied();
    for (row, code) in rows.iter().zip(codes) {
        let Some(first) = row.first() else { continue };
        if row.len() != names.len() {
            let message = format!("a frame has {} columns, not {}", row.len(), names.len());
            diagnostics.push(first.diagnostic(Code::ForeignSyntax, message));
            continue;
        }
        let (Some(code), Some(origin)) = (code, origin) else {
            diagnostics.push(row.get(timecode).unwrap_or(first).not("a timecode, hours:minutes:seconds:frames"));
            continue;
        };
        let start = code.since(origin, rate);
        let symbol = match is_loudness {
            true => row.get(jaw).and_then(|field| weight(*field, diagnostics)).map(loudness),
            false => strongest(&names, row, map, diagnostics),
        };
        let Some(symbol) = symbol else { continue };
        track.shapes.push(Shape::at(first.span(), start, symbol));
        track.end = Some(Time::of_frame(start.nearest_frame(rate).saturating_add(1), rate));
    }
    vec![track]
}

/// Returns the shape with the largest weight among those in the table.
fn strongest(names: &[Line<'_>], row: &[Line<'_>], map: &Map, diagnostics: &mut Vec<Diagnostic>) -> Option<String> {
    let mut strongest = (REST, FLOOR);
    for (name, field) in names.iter().zip(row).filter(|(name, _)| map.code(name.text).is_some()) {
        let weight = weight(*field, diagnostics)?;
        if weight > strongest.1 {
            strongest = (name.text, weight);
        }
    }
    Some(strongest.0.to_owned())
}

fn weight(field: Line<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<f64> {
    let weight = field.text.parse().ok().filter(|weight: &f64| weight.is_finite());
    if weight.is_none() {
        diagnostics.push(field.not("a weight from 0 to 1"));
    }
    weight
}

/// Returns the digit for an opening from 0 to 1.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 9")]
fn loudness(opening: f64) -> String {
    ((opening * 10.0).clamp(0.0, 9.0) as u32).to_string()
}

/// A timecode `HH:MM:SS:FF.PPP`, with frames and thousandths of a frame.
#[derive(Clone, Copy)]
struct Timecode {
    seconds: u64,
    frame: u32,
    part: u32,
}

impl Timecode {
    fn parse(text: &str) -> Option<Timecode> {
        let parts: Vec<&str> = text.split([':', ';']).collect();
        let &[hours, minutes, seconds, frames] = parts.as_slice() else { return None };
        let (frame, part) = frames.split_once('.').unwrap_or((frames, "0"));
        let number = |digits: &str| digits.parse::<u32>().ok().filter(|number| *number < 1000);
        let part = number(format!("{part:0<3}").get(..3)?)?;
        let seconds = (u64::from(number(hours)?) * 60 + u64::from(number(minutes)?)) * 60 + u64::from(number(seconds)?);
        Some(Timecode { seconds, frame: number(frame)?, part })
    }

    /// Returns the time since `origin`, which may be on the previous day.
    fn since(self, origin: Timecode, rate: Rate) -> Time {
        let parts_of_a_second = u64::from(rate.numerator) * u64::from(PARTS) / u64::from(rate.denominator.max(1));
        let parts = |code: Timecode, days: u64| {
            let seconds = code.seconds + days * SECONDS_OF_A_DAY;
            seconds * parts_of_a_second + u64::from(code.frame) * u64::from(PARTS) + u64::from(code.part)
        };
        let passed = parts(self, 0).checked_sub(parts(origin, 0));
        let passed = passed.unwrap_or_else(|| parts(self, 1).saturating_sub(parts(origin, 0)));
        Time::new(passed, u32::try_from(parts_of_a_second).unwrap_or(u32::MAX))
    }
}

/// Returns the rate of the timecodes: the first one above all their frames, if they count through whole seconds.
fn rate(codes: &[Option<Timecode>]) -> Rate {
    let highest = codes.iter().flatten().map(|code| code.frame).max().unwrap_or(0);
    let above = RATES.into_iter().find(|rate| *rate > highest && codes.len() > *rate as usize);
    let fastest = RATES.into_iter().max().unwrap_or(60);
    Rate { numerator: above.unwrap_or(fastest), denominator: 1, is_exact: true }
}

fn fields(line: Line<'_>) -> impl Iterator<Item = Line<'_>> {
    let mut at = line.at;
    line.text.split(',').map(move |text| {
        let field = Line { text, at };
        at += text.len() + 1;
        field.trimmed()
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn timecodes_of_recordings() {
        let code = |text: &str| Timecode::parse(text).unwrap();
        let rate = |rate| Rate { numerator: rate, denominator: 1, is_exact: true };
        let since = |one, other, fps| code(one).since(code(other), rate(fps)).in_units(1000);
        assert_eq!(since("14:48:33:00.000", "14:48:32:30.000", 60), 500);
        assert_eq!(since("14:48:32:12.500", "14:48:32:12", 30), 17);
        assert_eq!(since("00:00:00:00", "23:59:59:00.0", 60), 1000, "midnight");
        for text in ["", "1:2:3", "a:b:c:d", "1:2:3:4:5", "1:2:3:-4"] {
            assert!(Timecode::parse(text).is_none(), "{text}");
        }
        let through = |highest: u32| {
            super::rate(
                &(0..90).map(|frame| Some(code(&format!("0:0:0:{}", frame % (highest + 1))))).collect::<Vec<_>>(),
            )
        };
        assert_eq!([23, 24, 29, 59].map(|highest| through(highest).numerator), [24, 25, 30, 60]);
        assert_eq!(super::rate(&[Some(code("0:0:0:1"))]).numerator, 60, "too short to tell");
    }

    #[test]
    fn jaws_are_loud() {
        assert_eq!([-0.1, 0.0, 0.55, 1.0, 7.0].map(loudness), ["0", "0", "5", "9", "9"]);
    }
}
