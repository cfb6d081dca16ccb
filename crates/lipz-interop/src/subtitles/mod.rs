//! Subtitle files: SubRip (`.srt`) and WebVTT (`.vtt`), to and from the texts and segments of clips.
//!
//! A segment with a text in a locale is a [`Cue`], as both formats call what shows from one time to another.
//! `docs/guides/other-tools.md` says what is kept in which direction.

mod clip;
mod join;
mod markup;
mod srt;
mod timing;
mod vtt;

pub(crate) use clip::bounds;
pub use clip::{SubtitleOptions, cues};
pub use join::{clip, join};

use lipz_diagnostics::{Code, Diagnostic, Span};
use lipz_file::text::{DELIMITER, display};
use markup::Plain;
use timing::Body;

/// A text that shows from one time to another.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Cue {
    /// When it appears, in milliseconds.
    pub start_ms: u64,
    /// When it vanishes, in milliseconds.
    pub end_ms: u64,
    /// What shows, in the words of Lipz files: `{speaker: Mara}` says who speaks, other meta is not written.
    pub text: String,
    /// Where a file says when it shows.
    pub span: Span,
}

/// A format of subtitle files.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum SubtitleFormat {
    /// SubRip. It has no way to say who speaks, and none to write a text that looks like markup.
    Srt,
    /// WebVTT (W3C). Speakers are voice spans, `<v Mara>`.
    Vtt,
}

impl SubtitleFormat {
    /// Both.
    pub const ALL: [SubtitleFormat; 2] = [SubtitleFormat::Srt, SubtitleFormat::Vtt];

    /// What files are called: their extension, without the dot.
    pub fn extension(self) -> &'static str {
        match self {
            SubtitleFormat::Srt => "srt",
            SubtitleFormat::Vtt => "vtt",
        }
    }

    /// The format of files with this extension, in any case.
    pub fn of_extension(extension: &str) -> Option<SubtitleFormat> {
        SubtitleFormat::ALL.into_iter().find(|format| format.extension().eq_ignore_ascii_case(extension))
    }

    /// The cues of a file in the order of their times, and what is wrong with it. Spans count from the first byte
    /// after a byte order mark.
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

    /// The file with these cues. Diagnostics say what the format cannot hold.
    pub fn write(self, cues: &[Cue], diagnostics: &mut Vec<Diagnostic>) -> String {
        match self {
            SubtitleFormat::Srt => srt::write(cues, diagnostics),
            SubtitleFormat::Vtt => vtt::write(cues, diagnostics),
        }
    }
}

/// The diagnostic for a text that comes back as another one, if it does: `written` is how the format has it, `plain` frees
/// it of markup.
fn changed(cue: &Cue, written: &str, plain: impl Fn(&str) -> Plain) -> Option<Diagnostic> {
    let (before, after) = (display(&cue.text).text, plain(written).text);
    (display(&after).text != before).then(|| {
        Diagnostic::at(Code::SubtitleLoss, cue.span, "the text is not quite the same in a subtitle file")
            .note("a cue cannot have empty lines, nor other line breaks than LF")
            .help("write its lines one below the other")
    })
}

/// What stands for `|` in a text: there it would divide segments.
const BAR_IN_TEXT: &str = "\u{a6}";

/// The text of a cue, which `plain` frees of markup; reports what a Lipz text cannot hold.
fn read_text(body: &Body<'_>, plain: impl Fn(&str) -> Plain, diagnostics: &mut Vec<Diagnostic>) -> String {
    let marked_up = body.text();
    let Plain { text, lost_tag } = plain(&marked_up);
    if let Some(tag) = lost_tag {
        diagnostics.push(
            Diagnostic::at(Code::SubtitleText, body.span(tag), "the subtitle has tags, which are left out")
                .note("texts of Lipz files have no markup; a game may have its own, as {meta}"),
        );
    }
    if text.contains(DELIMITER) {
        let at = marked_up.find(DELIMITER).unwrap_or_default();
        let message = format!("`{DELIMITER}` in the subtitle becomes `{BAR_IN_TEXT}`");
        diagnostics.push(
            Diagnostic::at(Code::SubtitleText, body.span(at..at + DELIMITER.len_utf8()), message)
                .note("in Lipz files, `|` separates segments")
                .help("write the text in another way if the difference matters"),
        );
    }
    text.replace(DELIMITER, BAR_IN_TEXT)
}
