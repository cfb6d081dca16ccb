//! Subtitle files: conversion of SubRip (`.srt`) and WebVTT (`.vtt`) to and from the texts and segments of clips.
//!
//! A segment with a text in a locale corresponds to a [`Cue`], which is the term of both formats.
//! `docs/guides/other-tools.md` lists the losses in each direction.

mod body;
mod clip;
mod join;
mod markup;
mod outside;
mod srt;
mod timing;
mod vtt;

pub(crate) use clip::bounds;
pub use clip::{SubtitleOptions, cues};
pub use join::{clip, join};

use body::Body;
use lipz_diagnostics::{Code, Diagnostic, Span};
use lipz_file::text::{DELIMITER, display};
use markup::PlainText;

/// A cue: a text that is shown for some time.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Cue {
    /// The start, in milliseconds.
    pub start_ms: u64,
    /// The end, in milliseconds.
    pub end_ms: u64,
    /// The text in the syntax of Lipz files. `{speaker: Mara}` names the speaker; other meta is not written.
    pub text: String,
    /// The position of the times in the file.
    pub span: Span,
}

/// A format of subtitle files.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum SubtitleFormat {
    /// SubRip. It cannot store speakers, nor texts that look like markup.
    Srt,
    /// WebVTT (W3C). Speakers are voice spans, `<v Mara>`.
    Vtt,
}

impl SubtitleFormat {
    /// Both formats.
    pub const ALL: [SubtitleFormat; 2] = [SubtitleFormat::Srt, SubtitleFormat::Vtt];

    /// Returns the extension of its files, without the dot.
    pub fn extension(self) -> &'static str {
        match self {
            SubtitleFormat::Srt => "srt",
            SubtitleFormat::Vtt => "vtt",
        }
    }

    /// Returns the format of files with this extension, in either case.
    pub fn of_extension(extension: &str) -> Option<SubtitleFormat> {
        SubtitleFormat::ALL.into_iter().find(|format| format.extension().eq_ignore_ascii_case(extension))
    }

    /// Reads the cues of a file, sorted by time, and reports its problems. Spans count from the first byte after a byte
    /// order mark.
    ///
    /// ```
    /// use lipz_interop::subtitles::SubtitleFormat;
    /// let file = "WEBVTT\n\n00:01.500 --> 00:02.000\n<v Mara>Good evening &amp; welcome.\n";
    /// let mut diagnostics = Vec::new();
    /// let cues = SubtitleFormat::Vtt.read(file.as_bytes(), &mut diagnostics);
    /// assert!(diagnostics.is_empty());
    /// assert_eq!((cues[0].start_ms, cues[0].text.as_str()), (1500, "{speaker: Mara} Good evening & welcome."));
    /// ```
    pub fn read(self, bytes: &[u8], diagnostics: &mut Vec<Diagnostic>) -> Vec<Cue> {
        let Some(text) = crate::source::text(bytes, diagnostics) else { return Vec::new() };
        let mut cues = match self {
            SubtitleFormat::Srt => srt::read(text, diagnostics),
            SubtitleFormat::Vtt => vtt::read(text, diagnostics),
        };
        timing::sort(&mut cues, diagnostics);
        cues
    }

    /// Returns a file with these cues. Diagnostics report losses.
    pub fn write(self, cues: &[Cue], diagnostics: &mut Vec<Diagnostic>) -> String {
        match self {
            SubtitleFormat::Srt => srt::write(cues, diagnostics),
            SubtitleFormat::Vtt => vtt::write(cues, diagnostics),
        }
    }
}

/// Returns the diagnostic for a text that changes in a round trip. `written` is the text in the format, and `plain`
/// removes its markup.
fn changed(cue: &Cue, written: &str, plain: impl Fn(&str) -> PlainText) -> Option<Diagnostic> {
    let (before, after) = (display(&cue.text).text, plain(written).text);
    (display(&after).text != before).then(|| {
        Diagnostic::at(Code::SubtitleLoss, cue.span, "the text changes in a subtitle file")
            .note("a cue cannot have empty lines, nor line breaks other than LF")
            .help("remove empty lines and unusual line breaks from the text")
    })
}

/// The replacement for `|` in a text, where it would divide segments.
const BAR_IN_TEXT: &str = "\u{a6}";

/// Returns the text of a cue without its markup, which `plain` removes. Reports parts that a Lipz text cannot store.
fn read_text(body: &Body<'_>, plain: impl Fn(&str) -> PlainText, diagnostics: &mut Vec<Diagnostic>) -> String {
    let marked_up = body.text();
    let PlainText { text, lost_tag } = plain(&marked_up);
    if let Some(tag) = lost_tag {
        diagnostics.push(
            Diagnostic::at(Code::SubtitleText, body.span(tag), "the tags of the subtitle are left out")
                .note("texts of Lipz files have no markup; a game may define its own as {meta}"),
        );
    }
    if text.contains(DELIMITER) {
        let at = marked_up.find(DELIMITER).unwrap_or_default();
        let message = format!("`{DELIMITER}` in the subtitle becomes `{BAR_IN_TEXT}`");
        diagnostics.push(
            Diagnostic::at(Code::SubtitleText, body.span(at..at + DELIMITER.len_utf8()), message)
                .note("in Lipz files, `|` separates segments")
                .help("rephrase the text if the difference matters"),
        );
    }
    text.replace(DELIMITER, BAR_IN_TEXT)
}
