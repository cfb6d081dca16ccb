//! Moho (and Anime Studio) switch data, `.dat`: `MohoSwitch1`, then a frame and the name of a layer per line. Frames
//! count from 1 by convention, and the file does not state the frame rate. Papagayo and Rhubarb write this format, both
//! with a rest at the end; readers such as Adventure Game Studio count from 0.

use super::Format;
use crate::{DEFAULT_RATE, ImportOptions, Shape, Time, Track, source};
use lipz_diagnostics::{Code, Diagnostic};
use std::fmt::Write;

/// The first line.
const HEADER: &str = "MohoSwitch1";
const REST: &str = "rest";
/// The names of rest in the sets of mouth shapes.
const RESTS: [&str; 3] = [REST, "X", "None"];

pub(super) const FORMAT: Format = Format {
    name: "moho",
    about: "Moho switch layer, of Moho, Papagayo or Rhubarb (-f dat)",
    extension: "dat",
    maps: &["papagayo", "rhubarb", "rhubarb-toonboom", "fleming-dobbs", "cmu"],
    is_binary: false,
    is_legacy: true,
    keeps_texts: false,
    read: Some(read),
    write: Some(write),
};

fn read(bytes: &[u8], options: &ImportOptions<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Track> {
    let Some(text) = source::text(bytes, diagnostics) else { return Vec::new() };
    let rate = options.file_rate.unwrap_or(DEFAULT_RATE);
    let mut track = Track { rate: Some(rate), ..Track::default() };
    let mut lines = source::lines(text).filter(|line| !line.text.trim().is_empty()).peekable();
    match lines.peek().copied() {
        Some(first) if first.text.trim() == HEADER => {
            lines.next();
        }
        Some(first) if first.text.trim_start().starts_with(|c: char| c.is_ascii_digit()) => diagnostics.push(
            first
                .diagnostic(Code::ForeignOddity, format!("the first line is not `{HEADER}`"))
                .note("the file is read as if it had this line"),
        ),
        Some(first) => {
            diagnostics.push(first.not("`MohoSwitch1`, the first line").help("check whether this is a file of Moho"));
            return Vec::new();
        }
        None => {}
    }
    for line in lines {
        let Some((frame, symbol)) = line.trimmed().split_once(' ') else {
            diagnostics.push(line.not("a frame and the name of a layer"));
            continue;
        };
        let Some(number) = frame.number("a frame number", diagnostics) else { continue };
        let Some(frame) = number.checked_sub(options.dat_base) else {
            let message = format!("frame {number} is before the first frame, {}", options.dat_base);
            diagnostics.push(
                frame.diagnostic(Code::ForeignValue, message).help("set `dat-base` to 0 if the file counts from 0"),
            );
            continue;
        };
        track.shapes.push(Shape::at(symbol.span(), Time::of_frame(frame, rate), symbol.text));
    }
    end_at_rest(&mut track);
    vec![track]
}

/// Uses the rest that writers put at the end as the end of the recording.
fn end_at_rest(track: &mut Track) {
    if let [.., _, last] = track.shapes.as_slice()
        && RESTS.contains(&last.symbol.as_str())
    {
        track.end = Some(last.start);
        track.shapes.pop();
    }
}

fn write(track: &Track, _: &mut Vec<Diagnostic>) -> Vec<u8> {
    let rate = track.rate.unwrap_or(DEFAULT_RATE);
    let mut text = format!("{HEADER}\n");
    for shape in &track.shapes {
        let _ = writeln!(text, "{} {}", shape.start.nearest_frame(rate) + track.first_frame, shape.symbol);
    }
    let end = track.end.unwrap_or(Time::ZERO);
    // A rig has a layer for the rest of its own set only.
    let rest = track.rest.as_deref().unwrap_or(REST);
    let _ = writeln!(text, "{} {rest}", end.nearest_frame(rate) + track.first_frame);
    text.into_bytes()
}
