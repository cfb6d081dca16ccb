//! Star Wars: Knights of the Old Republic, LIP V1.0: little-endian, a header of 16 bytes, then keys of five
//! bytes: the time in seconds as a 32-bit float, and the shape from 0 to 15.

use super::Format;
use crate::{ImportOptions, Shape, Time, Track};
use lipz_diagnostics::{Code, Diagnostic};

const MAGIC: &[u8; 8] = b"LIP V1.0";
const HEADER_BYTES: usize = 16;
const KEY_BYTES: usize = 5;
/// Shapes have numbers below this.
const SHAPES: u8 = 16;

pub(super) const FORMAT: Format = Format {
    name: "kotor",
    about: "Knights of the Old Republic, LIP V1.0",
    extension: "lip",
    examples: &["lipz import kotor lips/*.lip -o voices", "lipz export kotor voices -o lips"],
    maps: &["kotor"],
    is_binary: true,
    read: Some(read),
    write: Some(write),
};

fn read(bytes: &[u8], _: &ImportOptions<'_>, findings: &mut Vec<Diagnostic>) -> Vec<Track> {
    if bytes.len() < HEADER_BYTES && MAGIC.starts_with(bytes.get(..MAGIC.len().min(bytes.len())).unwrap_or_default()) {
        findings.push(cut_off(bytes.len(), "the header has 16 bytes"));
        return Vec::new();
    }
    if !bytes.starts_with(MAGIC) {
        let finding = Diagnostic::new(Code::ForeignSyntax, "the file does not start with `LIP V1.0`");
        findings.push(at(finding, 0).help("is it a LIP file of another game? lipz import --help lists the formats"));
        return Vec::new();
    }
    let (header, keys) = bytes.split_at(HEADER_BYTES);
    let length = float(header.get(8..12));
    let count = word(header.get(12..16)) as usize;
    let mut track = Track::default();
    if keys.len() / KEY_BYTES < count {
        let missing = format!("its header tells of {count} keys, and there are {}", keys.len() / KEY_BYTES);
        findings.push(cut_off(bytes.len(), &missing));
        return Vec::new();
    }
    if keys.len() > count * KEY_BYTES {
        let rest = keys.len() - count * KEY_BYTES;
        let finding = Diagnostic::new(Code::ForeignOddity, format!("{rest} bytes stand behind the last key"));
        findings.push(at(finding, HEADER_BYTES + count * KEY_BYTES).note("they are not read"));
    }
    for (index, key) in keys.chunks_exact(KEY_BYTES).take(count).enumerate() {
        let place = HEADER_BYTES + index * KEY_BYTES;
        let shape = key.last().copied().unwrap_or_default();
        match Time::from_f32(float(key.get(..4))) {
            None => findings.push(at(Diagnostic::new(Code::ForeignValue, "a key has no time"), place)),
            Some(_) if shape >= SHAPES => {
                let message = format!("the shape {shape} does not exist");
                let finding = at(Diagnostic::new(Code::ForeignValue, message), place + KEY_BYTES - 1);
                findings.push(finding.help("shapes have numbers from 0 to 15"));
            }
            Some(time) => track.shapes.push(Shape::new(time, shape.to_string())),
        }
    }
    track.end = Time::from_f32(length);
    if track.end.is_none() {
        findings.push(at(Diagnostic::new(Code::ForeignValue, "the length is no time"), 8));
    }
    vec![track]
}

fn at(finding: Diagnostic, byte: usize) -> Diagnostic {
    finding.note(format!("at byte 0x{byte:X}"))
}

fn cut_off(length: usize, missing: &str) -> Diagnostic {
    let finding = Diagnostic::new(Code::ForeignCutOff, format!("the file ends too early: {missing}"));
    at(finding, length).help("copy it again")
}

fn word(bytes: Option<&[u8]>) -> u32 {
    u32::from_le_bytes(bytes.and_then(|bytes| bytes.try_into().ok()).unwrap_or_default())
}

fn float(bytes: Option<&[u8]>) -> f32 {
    f32::from_bits(word(bytes))
}

fn write(track: &Track, findings: &mut Vec<Diagnostic>) -> Vec<u8> {
    let mut keys = Vec::new();
    let mut count: u32 = 0;
    for shape in &track.shapes {
        // A table of one's own may name anything; the engine has sixteen shapes.
        let Some(number) = shape.symbol.parse::<u8>().ok().filter(|number| *number < SHAPES) else {
            let message = format!("{} is no shape of the engine", lipz_diagnostics::escape::quoted(&shape.symbol));
            findings.push(Diagnostic::new(Code::ExportLoss, message).note("it is left out; shapes are 0 to 15"));
            continue;
        };
        keys.extend(seconds(shape.start).to_le_bytes());
        keys.push(number);
        count = count.saturating_add(1);
    }
    let length = seconds(track.end.unwrap_or(Time::ZERO));
    [MAGIC.as_slice(), &length.to_le_bytes(), &count.to_le_bytes(), &keys].concat()
}

#[allow(clippy::cast_possible_truncation, reason = "the nearest one is meant")]
fn seconds(time: Time) -> f32 {
    time.as_f64() as f32
}
