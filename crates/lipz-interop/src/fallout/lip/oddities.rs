//! The irregularities of a LIP file: those that the game's own loader logs, and mistakes of its tools.

use super::{Lip, Marker, offset};
use crate::fallout::{LAST_PHONEME, list, place};
use lipz_diagnostics::{Code, Diagnostic, escape};

/// The bits of the flag word, and their meaning while the game runs.
const FLAGS: [(u32, &str); 2] =
    [(1, "bit 0: start again at the last marker instead of stopping"), (2, "bit 1: it is being played")];

impl Lip {
    /// Returns all irregularities of the file, ordered by position. `file_stem` is its name without extension.
    /// [`Lip::write`] preserves all of them.
    pub fn oddities(&self, file_stem: &str) -> Vec<Diagnostic> {
        let mut found = Vec::new();
        self.header(&mut found);
        self.length_word(&mut found);
        self.counts(&mut found);
        self.names(file_stem, &mut found);
        self.phoneme_codes(&mut found);
        self.marker_types(&mut found);
        self.marker_order(&mut found);
        self.trailing(&mut found);
        found
    }

    fn header(&self, found: &mut Vec<Diagnostic>) {
        let words = [
            (offset::CONSTANT, self.constant, Lip::CONSTANT),
            (offset::UNKNOWN_0C, self.unknown_0c, 0),
            (offset::UNKNOWN_18, self.unknown_18, 0),
        ];
        let unusual = words.into_iter().filter(|(_, value, usual)| value != usual);
        found.extend(unusual.map(|(range, value, usual)| {
            let message = format!("the word at {:#04x} is {value:#x}, but {usual:#x} in other files", range.start);
            place(Code::LipHeader, range, message).note("the game reads this word but does not use it")
        }));
        if self.flags != 0 {
            let message = format!("the flags are {:#x}, but 0 in other files", self.flags);
            let diagnostic = place(Code::LipHeader, offset::FLAGS, message);
            let set = FLAGS.iter().filter(|(bit, _)| self.flags & bit != 0);
            found.push(set.fold(diagnostic, |diagnostic, (_, meaning)| diagnostic.note(*meaning)));
        }
        if self.extension != Lip::EXTENSION {
            let shown = String::from_utf8_lossy(&self.extension);
            let message =
                format!("the extension of the sound file is {}, but `VOC` in other files", escape::quoted(&shown));
            found.push(place(Code::LipHeader, offset::EXTENSION, message).note("the game does not use it"));
        }
    }

    fn length_word(&self, found: &mut Vec<Diagnostic>) {
        let length = self.length();
        let end = self.markers.last().map_or(0, |marker| marker.position);
        if length.bytes != end {
            let message = format!("the sound file is {} bytes long, but the last marker is at {end}", length.bytes);
            found.push(place(Code::LipLength, offset::LENGTH, message).note("lipz uses the markers"));
        }
    }

    fn counts(&self, found: &mut Vec<Diagnostic>) {
        let (phonemes, markers) = (self.phonemes.len(), self.markers.len());
        if markers == phonemes + 1 {
            return;
        }
        let message = format!("{phonemes} phonemes have {markers} markers, not {}", phonemes + 1);
        let diagnostic = place(Code::LipCounts, offset::PHONEME_COUNT.start..offset::MARKER_COUNT.end, message);
        found.push(diagnostic.note(if markers <= phonemes {
            "the last marker ends the speech; phonemes without a marker before it are not shown"
        } else {
            "the last marker ends the speech; the mouth rests from the first marker without a phoneme"
        }));
    }

    fn names(&self, file_stem: &str, found: &mut Vec<Diagnostic>) {
        let sound = self.sound();
        let mut add = |message: String| {
            found.push(
                place(Code::LipName, offset::NAME, message)
                    .note("the game plays the sound file with this name; the key comes from the name of the LIP file"),
            );
        };
        if !self.name.is_ascii() {
            add(format!("the name of the sound file is not ASCII: {}", escape::quoted(&sound)));
        } else if !sound.eq_ignore_ascii_case(file_stem) {
            let (sound, file) = (escape::quoted(&sound), escape::quoted(file_stem));
            add(format!("the sound file is called {sound}, but the LIP file {file}"));
        }
        let behind = self.name.iter().skip(sound.chars().count());
        if behind.copied().any(|byte| byte != 0) {
            add(format!("bytes follow the name of the sound file, {}", escape::quoted(&sound)));
        }
    }

    fn phoneme_codes(&self, found: &mut Vec<Diagnostic>) {
        let unknown = self.phonemes.iter().copied().enumerate().filter(|&(_, code)| code > LAST_PHONEME);
        let diagnostics = unknown.map(|(index, code)| {
            let message = format!("phoneme {index} is {code:#04x}, but the codes end at {LAST_PHONEME:#04x}");
            place(Code::LipPhoneme, Lip::phoneme_place(index), message).note("it is shown as rest")
        });
        list(found, diagnostics);
    }

    fn marker_types(&self, found: &mut Vec<Diagnostic>) {
        let diagnostics = self.markers.iter().enumerate().filter_map(|(index, marker)| {
            let message = match (index, marker.kind) {
                (0, 0) => "the type of the first marker is 0, but 1 in other files".to_owned(),
                (_, 0 | 1) => return None,
                (_, kind) => format!("the type of marker {index} is {kind:#x}, neither 0 nor 1"),
            };
            let diagnostic = place(Code::LipMarkerType, self.marker_place(index), message);
            Some(diagnostic.note("the game does not use the types of markers"))
        });
        list(found, diagnostics);
    }

    fn marker_order(&self, found: &mut Vec<Diagnostic>) {
        if let Some(first) = self.markers.first().filter(|first| first.position != 0) {
            let message = format!("the first marker is at {}, not at 0", first.position);
            let diagnostic = place(Code::LipMarkerOrder, self.marker_place(0), message);
            found.push(diagnostic.note("the mouth rests before it"));
        }
        let pairs = self.markers.windows(2).enumerate();
        let diagnostics = pairs.filter_map(|(index, pair)| {
            let [Marker { position: before, .. }, Marker { position, .. }] = pair else { return None };
            let message = format!("marker {} moves backwards from {before} to {position}", index + 1);
            let diagnostic = place(Code::LipMarkerOrder, self.marker_place(index + 1), message);
            let note = "as in the game, its phoneme starts at the latest earlier position and hides the phoneme at \
                that position";
            (position < before).then(|| diagnostic.note(note))
        });
        list(found, diagnostics);
    }

    fn trailing(&self, found: &mut Vec<Diagnostic>) {
        if !self.trailing.is_empty() {
            let start = self.marker_place(self.markers.len()).start;
            let length = self.trailing.len();
            let plural = if length == 1 { "byte follows" } else { "bytes follow" };
            let diagnostic =
                place(Code::LipTrailing, start..start + length, format!("{length} {plural} the last marker"));
            found.push(diagnostic.note("the game does not read them"));
        }
    }
}
