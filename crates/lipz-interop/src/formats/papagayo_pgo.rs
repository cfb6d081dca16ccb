//! Papagayo project, `.pgo` version 1: lines whose indentation is ignored. A voice has phrases, a phrase has words, and
//! a word has phonemes, each on a frame counted from 0. Line breaks in a voice's text are stored as `|`.

use super::Format;
use super::papagayo::{MAPS, PapagayoVoice, with_table};
use crate::source::{self, Line};
use crate::{ImportOptions, Shape, Time, TimedText, Track};
use lipz_diagnostics::Diagnostic;
use lipz_file::rate::Rate;

const HEADER: &str = "lipsync version 1";

pub(super) const FORMAT: Format = Format {
    name: "papagayo",
    about: "Papagayo project, .pgo",
    extension: "pgo",
    maps: MAPS,
    is_binary: false,
    is_legacy: true,
    keeps_texts: false,
    read: Some(read),
    write: None,
};

fn read(bytes: &[u8], options: &ImportOptions<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Track> {
    let Some(text) = source::text(bytes, diagnostics) else { return Vec::new() };
    let mut lines = Lines { text, lines: source::lines(text).collect::<Vec<_>>().into_iter(), diagnostics };
    with_table(lines.project().unwrap_or_default(), None, options)
}

struct Lines<'s, 'f> {
    text: &'s str,
    lines: std::vec::IntoIter<Line<'s>>,
    diagnostics: &'f mut Vec<Diagnostic>,
}

impl<'s> Lines<'s, '_> {
    /// Returns the next line. `what` describes its expected content.
    fn next(&mut self, what: &str) -> Option<Line<'s>> {
        let line = self.lines.next().map(Line::trimmed);
        if line.is_none() {
            self.diagnostics.push(source::cut_off(self.text, &format!("{what} is missing")));
        }
        line
    }

    fn number(&mut self, what: &str) -> Option<u64> {
        self.next(what)?.number(what, self.diagnostics)
    }

    fn project(&mut self) -> Option<Vec<Track>> {
        let header = self.next("the first line")?;
        if header.text != HEADER {
            let is_start = HEADER.starts_with(header.text) && self.lines.len() == 0;
            self.diagnostics.push(match is_start {
                true => source::cut_off(self.text, "the first line is not complete"),
                false => header
                    .not("`lipsync version 1`")
                    .help("check whether this is a project of Papagayo; .pg2 is a different format"),
            });
            return None;
        }
        self.next("the path of the recording")?;
        let fps = self.next("the frame rate")?;
        let Some(rate) = lipz_file::rate::parse(fps.text) else {
            self.diagnostics.push(fps.not("a frame rate from 1 to 1000"));
            return None;
        };
        let duration = self.number("the duration in frames")?;
        let mut tracks = Vec::new();
        for _ in 0..self.number("the number of voices")? {
            let mut voice = self.voice(rate)?;
            voice.end(duration);
            tracks.push(voice.track);
        }
        Some(tracks)
    }

    fn voice(&mut self, rate: Rate) -> Option<PapagayoVoice> {
        let name = self.next("the name of a voice")?.text.to_owned();
        let text = self.next("the text of a voice")?.text;
        let mut voice = PapagayoVoice::new(name, text, rate);
        for _ in 0..self.number("the number of phrases")? {
            let text = self.next("the text of a phrase")?.text.to_owned();
            let start = self.number("the start of a phrase")?;
            self.number("the end of a phrase")?;
            voice.track.phrases.push(TimedText { start: Time::of_frame(start, rate), text });
            for _ in 0..self.number("the number of words")? {
                self.word(&mut voice)?;
            }
        }
        Some(voice)
    }

    fn word(&mut self, voice: &mut PapagayoVoice) -> Option<()> {
        let line = self.next("a word")?;
        let fields: Vec<Line<'s>> = line.fields().collect();
        let [word, start, end, phonemes] = fields.as_slice() else {
            self.diagnostics.push(line.not("a word, its start, its end and the number of its phonemes"));
            return None;
        };
        let start = start.number("the start of a word", self.diagnostics)?;
        let end = end.number("the end of a word", self.diagnostics)?;
        let phonemes = phonemes.number("the number of phonemes", self.diagnostics)?;
        voice.word(word.text, start);
        for _ in 0..phonemes {
            let line = self.next("a phoneme")?;
            let Some((frame, name)) = line.split_once(' ') else {
                self.diagnostics.push(line.not("a frame and a phoneme"));
                return None;
            };
            let frame = frame.number("the frame of a phoneme", self.diagnostics)?;
            voice.phoneme(frame, |start| Shape::at(name.span(), start, name.text));
        }
        voice.end_word(end);
        Some(())
    }
}
