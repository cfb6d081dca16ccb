//! The current format of the author of Lipz, `.lipz.txt`, at 24 frames per second. `phoneme.` starts a phoneme on a
//! frame, a space holds the current one for a frame, and `-.` rests (sl-web-face, `lipzFileUtil.ts`).

use super::Format;
use crate::source::{self, Line};
use crate::{DEFAULT_RATE, ImportOptions, Shape, Time, Track};
use lipz_diagnostics::Diagnostic;

/// The character that ends a phoneme.
const END: char = '.';

pub(super) const FORMAT: Format = Format {
    name: "lipz-txt",
    about: "the Lipz author's phonemes, .lipz.txt",
    extension: "lipz.txt",
    maps: &["arpabet-blair"],
    is_binary: false,
    is_legacy: true,
    keeps_texts: false,
    read: Some(read),
    write: None,
};

fn read(bytes: &[u8], _: &ImportOptions<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Track> {
    let Some(text) = source::text(bytes, diagnostics) else { return Vec::new() };
    let mut track = Track { rate: Some(DEFAULT_RATE), ..Track::default() };
    let mut frame = 0;
    let mut start = None;
    // Editors add line ends at the end, which are not frames.
    let text = text.trim_end_matches(['\r', '\n']);
    for (at, c) in text.char_indices() {
        match c {
            END => {
                let from = start.take().unwrap_or(at);
                let phoneme = Line { text: text.get(from..at).unwrap_or_default(), at: from };
                if phoneme.text.is_empty() {
                    diagnostics.push(Line { text: ".", at }.not("a phoneme and its dot"));
                }
                track.shapes.push(Shape::at(phoneme.span(), Time::of_frame(frame, DEFAULT_RATE), phoneme.text));
                frame += 1;
            }
            // A space inside a phoneme also holds a frame, but does not occur in practice.
            ' ' if start.is_none() => frame += 1,
            c if c.is_whitespace() => {
                let from = start.take().unwrap_or(at);
                let place = Line { text: text.get(from..at + c.len_utf8()).unwrap_or_default(), at: from };
                diagnostics.push(
                    place.not("a phoneme and its dot").help("separate phonemes only by spaces, which hold a frame"),
                );
            }
            _ => start = start.or(Some(at)),
        }
    }
    if start.is_some() {
        diagnostics.push(source::cut_off(text, "the last phoneme has no dot"));
    }
    track.end = Some(Time::of_frame(frame, DEFAULT_RATE));
    vec![track]
}
