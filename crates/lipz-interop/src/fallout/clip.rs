//! LIP files as a format of `lipz import` and `lipz export`: converts phonemes to shapes with times, and back.

use super::lip::{Lip, Marker, NAME_BYTES};
use super::{LAST_PHONEME, units};
use crate::{Format, ImportOptions, Shape, Time, Track};
use lipz_diagnostics::{Code, Diagnostic, escape};

pub(crate) const FORMAT: Format = Format {
    name: "fallout",
    about: "Fallout 2 talking heads (LIP version 2)",
    extension: "lip",
    maps: &["fallout"],
    is_binary: true,
    is_legacy: false,
    keeps_texts: false,
    read: Some(read),
    write: Some(write),
};

/// The code of silence.
const SILENCE: u8 = 0x00;

/// The bytes of a sample of decoded audio.
const SAMPLE_BYTES: u32 = 2;

fn read(bytes: &[u8], options: &ImportOptions<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Track> {
    let lip = match Lip::read(bytes) {
        Ok(lip) => lip,
        Err(refused) => {
            diagnostics.push(*refused);
            return Vec::new();
        }
    };
    diagnostics.extend(lip.oddities(options.name.unwrap_or(&lip.sound())));
    let (units_per_second, why) = match (options.units_per_second, options.sound_length) {
        (Some(named), _) => (named, "as set"),
        (None, Some(length)) => {
            let (nearest, warning) = units::nearest(lip.end(), length);
            diagnostics.extend(warning);
            (nearest, "the closest to the end of the sound file")
        }
        (None, None) => (units::USUAL, "as in the game"),
    };
    let remark = format!("{units_per_second} units per second, {why}");
    vec![Track { remarks: vec![remark], ..track(&lip, units_per_second) }]
}

/// Returns the shapes as the game shows them: a marker takes effect when the audio has passed all markers before it.
fn track(lip: &Lip, units_per_second: u32) -> Track {
    let mut passed = 0;
    let mut starts = lip.markers.iter().map(|marker| {
        passed = marker.position.max(passed);
        Time::new(u64::from(passed), units_per_second)
    });
    let phonemes = lip.phonemes.iter().map(|&code| if code > LAST_PHONEME { SILENCE } else { code });
    let before_the_end = lip.markers.len().saturating_sub(1);
    let shapes = starts.by_ref().take(before_the_end).zip(phonemes.chain(std::iter::repeat(SILENCE)));
    let shapes = shapes.map(|(start, code)| Shape::new(start, symbol(code))).collect();
    Track { shapes, end: starts.next(), ..Track::default() }
}

/// Returns the spelling of a code in the mapping table.
fn symbol(code: u8) -> String {
    format!("0x{code:02X}")
}

/// Returns the code with this spelling in a mapping table.
fn code(symbol: &str) -> Option<u8> {
    let digits = symbol.strip_prefix("0x").or_else(|| symbol.strip_prefix("0X"))?;
    u8::from_str_radix(digits, 16).ok().filter(|&code| code <= LAST_PHONEME)
}

/// Writes a track whose name is that of the recording. Without one, the name in the file is empty.
fn write(track: &Track, diagnostics: &mut Vec<Diagnostic>) -> Vec<u8> {
    let name = track.name.as_deref().map_or(Some([0; NAME_BYTES]), |name| name_field(name, diagnostics));
    let Some(name) = name else { return Vec::new() };
    let (mut phonemes, mut markers) = (Vec::new(), Vec::new());
    let mut is_after_silence = true;
    for shape in &track.shapes {
        let Some(code) = code(&shape.symbol) else {
            let message = format!("{} is not a phoneme code of Fallout", escape::quoted(&shape.symbol));
            diagnostics.push(Diagnostic::new(Code::LipPhoneme, message).help("write a code from 0x00 to 0x29"));
            continue;
        };
        let starts_segment = track.phrases.iter().any(|segment| segment.start == shape.start);
        let is_start = code == SILENCE || is_after_silence || starts_segment;
        is_after_silence = code == SILENCE;
        phonemes.push(code);
        markers.push(Marker { kind: u32::from(is_start), position: position(shape.start) });
    }
    let end = track.end.or_else(|| track.shapes.last().map(|shape| shape.start)).unwrap_or(Time::ZERO);
    markers.push(Marker { kind: 1, position: position(end) });
    diagnostics.extend(few_markers(markers.len()));
    Lip::new(name, phonemes, markers).write()
}

/// Returns the diagnostic for a file whose speech the game never stops.
fn few_markers(count: usize) -> Option<Diagnostic> {
    let markers = if count == 1 { "marker" } else { "markers" };
    let message = format!("the LIP file has {count} {markers}, but the game needs {FEWEST_MARKERS} to stop the speech");
    (count < FEWEST_MARKERS).then(|| {
        Diagnostic::new(Code::LipFewMarkers, message).help("change the mouth shape of the clip at least five times")
    })
}

/// The fewest markers with which the game stops a speech (the engine's reimplementation fallout2-ce, `lips.cc`).
const FEWEST_MARKERS: usize = 6;

/// Returns the position of the sample that is nearest to a time.
fn position(time: Time) -> u32 {
    let samples = time.in_units(units::USUAL / SAMPLE_BYTES);
    u32::try_from(samples).unwrap_or(u32::MAX).saturating_mul(SAMPLE_BYTES)
}

/// Returns the name of a recording in the form of the header, or reports why it cannot be stored.
fn name_field(name: &str, diagnostics: &mut Vec<Diagnostic>) -> Option<[u8; NAME_BYTES]> {
    let is_allowed = |byte: u8| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'-');
    let why = match name.len() {
        0 => "it is empty".to_owned(),
        _ if !name.bytes().all(is_allowed) => "only ASCII letters, digits, `_` and `-` are allowed".to_owned(),
        length if length > NAME_BYTES => format!("it has {length} characters, more than {NAME_BYTES}"),
        length => {
            let mut field = [0; NAME_BYTES];
            field.get_mut(..length)?.copy_from_slice(name.as_bytes());
            return Some(field);
        }
    };
    let message = format!("{} cannot be the name of a LIP file: {why}", escape::quoted(name));
    diagnostics.push(
        Diagnostic::new(Code::LipExportName, message)
            .help("rename the Lipz file to the name of its sound file in the game"),
    );
    None
}
