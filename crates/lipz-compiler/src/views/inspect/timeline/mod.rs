//! One clip as a timeline for a terminal. Data from the bank cannot control the terminal.

mod bands;
mod events;
mod palette;
mod ruler;
mod texts;

use super::clip::phones_of;
use lipz_bank::curve::Curve;
use lipz_bank::{Clip, Dialogue, Fps, Locale, Recording, Segment};
use lipz_diagnostics::escape;
use palette::{Palette, painted};
use std::borrow::Cow;
use std::fmt::Write;
use unicode_width::UnicodeWidthStr;

/// The default number of columns.
const DEFAULT_WIDTH: usize = 100;

/// A clip as a timeline: bands with time ruler, openness of the mouth, visemes, segments, texts and events; then the
/// segments with all their texts; then the curves.
///
/// Control characters are escaped, so that no text of a bank controls the terminal. Keys and words that are longer than
/// a line extend it.
///
/// ```
/// use lipz_bank::files::DialogueFile;
/// use lipz_bank::{Dialogue, Locale};
/// use lipz_compiler::{Compiler, Input, inspect::Timeline};
/// let file = r#"{ "fps": 10, "viseme_type": "blair", "visemes": "AAAA|MM-", "text_en-us": "Aye.|Aye!" }"#;
/// let bytes = Compiler::default().compile(&[Input::from_bytes("aye", file)]).into_bank()?;
/// let mut files = [DialogueFile::ABSENT];
/// let dialogue = Dialogue::open(&mut files, [bytes.as_slice()])?;
/// let locales: Vec<Locale> = dialogue.locales().collect();
/// let clip = dialogue.clip_by_key("aye").ok_or("no clip")?;
/// let shown = Timeline::default().width(80).render(&dialogue, &clip, &locales);
/// assert!(shown.contains("  ████▁▁\n  AAAAMM-\n  |0--|1-\n  Ay… Ay…\n"));
/// assert!(shown.ends_with("segment 1  0.400 s to 0.700 s  frames 4 to 6\n  en-us  Aye!\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Timeline {
    width: usize,
    palette: Palette,
}

/// 100 columns, without colours.
impl Default for Timeline {
    fn default() -> Timeline {
        Timeline { width: DEFAULT_WIDTH, palette: Palette::default() }
    }
}

impl Timeline {
    /// Sets the width in columns.
    #[must_use]
    pub fn width(mut self, columns: usize) -> Timeline {
        self.width = columns;
        self
    }

    /// Sets whether to use terminal colours.
    #[must_use]
    pub fn styled(mut self, is_styled: bool) -> Timeline {
        self.palette = if is_styled { Palette::coloured() } else { Palette::default() };
        self
    }

    /// Returns the clip of a dialogue as text. The bands show its texts in the first of these locales, the list below
    /// in all.
    pub fn render(&self, dialogue: &Dialogue<'_>, clip: &Clip<'_>, locales: &[Locale]) -> String {
        let mut out = heading(dialogue, clip, self.palette);
        bands::bands(&mut out, clip, locales.first().copied(), self.width, self.palette);
        let tagged = locales.iter().map(|locale| (escape::text(dialogue.locale_tag(*locale)), *locale));
        let locales: Vec<(Cow<'_, str>, Locale)> = tagged.collect();
        let tag_width = locales.iter().map(|(tag, _)| tag.width()).max().unwrap_or(0);
        let columns = Columns { tag: tag_width.max("event".len()), whole: self.width, palette: self.palette };
        for segment in clip.segments() {
            details(&mut out, &segment, &locales, columns);
        }
        curves(&mut out, clip, columns);
        if let Some(phones) = phones_of(clip) {
            line(&mut out, "phones", &phones, Columns { tag: columns.tag.max("phones".len()), ..columns });
        }
        out
    }
}

fn heading(dialogue: &Dialogue<'_>, clip: &Clip<'_>, palette: Palette) -> String {
    let fps = clip.fps().map_or("unspecified frame rate".into(), |fps| format!("{} fps", short_fps(fps)));
    let viseme_type = clip.viseme_type().map_or("unspecified viseme type", lipz_bank::VisemeType::name);
    let frames = match clip.duration_us() {
        _ if !clip.has_visemes() => "no mouth shapes".into(),
        Some(us) => format!("{} frames, {:.3} s", clip.frame_count(), us as f64 / 1e6),
        None => format!("{} frames", clip.frame_count()),
    };
    let dub = clip.original().map_or(String::new(), |original| {
        let voice = clip.voice().map_or("", |voice| dialogue.voice_tag(voice));
        format!("  dub of {} in {}\n", escape::text(original.key()), escape::text(voice))
    });
    let recording = clip.recording().map_or(String::new(), |found| format!("  recording {}\n", short_recording(found)));
    let key = painted(&escape::text(clip.key()), palette.title);
    format!("{key}\n  {fps}, {viseme_type}, {frames}, id {}\n{dub}{recording}\n", clip.id())
}

/// Returns a frame rate in the usual notation, with at most three decimals.
///
/// ```
/// use lipz_bank::Fps;
/// assert_eq!(lipz_compiler::inspect::short_fps(Fps::whole(24)), "24");
/// assert_eq!(Fps::new(24_000, 1001).map(lipz_compiler::inspect::short_fps).as_deref(), Some("23.976"));
/// ```
pub fn short_fps(fps: Fps) -> String {
    let text = format!("{:.3}", fps.to_f64());
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Returns the length in seconds with three decimals, and the hash: `1.500 s, content 0123456789abcdef`.
pub fn short_recording(recording: Recording) -> String {
    let seconds = recording.length_us() as f64 / 1e6;
    format!("{seconds:.3} s, content {:016x}", recording.content_hash())
}

/// The widths in the list of texts.
#[derive(Clone, Copy)]
struct Columns {
    /// The width of the names before texts.
    tag: usize,
    /// The width of the terminal.
    whole: usize,
    palette: Palette,
}

/// Adds the segment with its times, event and texts.
fn details(out: &mut String, segment: &Segment<'_>, locales: &[(Cow<'_, str>, Locale)], columns: Columns) {
    out.push_str(&painted(&format!("segment {}", segment.index()), columns.palette.title));
    let frames = (segment.start_frame(), segment.end_frame());
    match (segment.start_us(), segment.end_us()) {
        _ if !segment.clip().has_visemes() => out.push('\n'),
        (Some(start), Some(end)) if frames.0 < frames.1 => {
            let (start, end) = (start as f64 / 1e6, end as f64 / 1e6);
            let _ = writeln!(out, "  {start:.3} s to {end:.3} s  frames {} to {}", frames.0, frames.1 - 1);
        }
        _ if frames.0 < frames.1 => {
            let _ = writeln!(out, "  frames {} to {}", frames.0, frames.1 - 1);
        }
        _ => out.push_str("  no frames\n"),
    }
    events(out, segment, columns);
    for (tag, locale) in locales {
        if let Some(text) = segment.text(*locale).filter(|text| !text.is_empty()) {
            let fallback = if text.is_fallback() { "  (fallback)" } else { "" };
            line(out, tag, &format!("{}{fallback}", text.as_str()), columns);
        }
    }
}

/// Adds the curves with their keys.
fn curves(out: &mut String, clip: &Clip<'_>, columns: Columns) {
    let name = |curve: &Curve<'_>| escape::text(curve.name().as_str()).into_owned();
    let tag = clip.curves().map(|curve| name(&curve).width()).max();
    let Some(tag) = tag else { return };
    out.push_str(&painted("curves", columns.palette.title));
    out.push('\n');
    for curve in clip.curves() {
        line(out, &name(&curve), &curve.to_string(), Columns { tag, ..columns });
    }
}

/// Adds a line for each event of Character Event Syntax, or a single one for other syntax.
fn events(out: &mut String, segment: &Segment<'_>, columns: Columns) {
    let mut events = segment.events().peekable();
    match segment.event() {
        Some(text) if !text.is_empty() && events.peek().is_none() => {
            line(out, "event", &format!("{text}  (other syntax)"), columns);
        }
        _ => events.for_each(|event| line(out, "event", &event.to_string(), columns)),
    }
}

/// Adds a name and its text, wrapped between words at the width of the terminal.
fn line(out: &mut String, name: &str, text: &str, columns: Columns) {
    if text.is_empty() {
        return;
    }
    let first = format!("  {name}{}  ", " ".repeat(columns.tag.saturating_sub(name.width())));
    let others = " ".repeat(first.width());
    let options =
        textwrap::Options::new(columns.whole.max(first.width() + 8)).initial_indent(&first).subsequent_indent(&others);
    for (index, line) in textwrap::wrap(&escape::text(text), options).iter().enumerate() {
        match line.strip_prefix(&first).filter(|_| index == 0) {
            Some(text) => {
                let _ = write!(out, "{}{}", painted(&first, columns.palette.name), text.trim_end());
            }
            None => out.push_str(line.trim_end()),
        }
        out.push('\n');
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::Options;
    use crate::run::Compiler;
    use crate::sources::Input;
    use lipz_testkit::dialogues::with;

    fn bank(json: &str) -> Vec<u8> {
        let options = Options::new().default_locale("en-us").unwrap();
        Compiler::new(options.clone()).compile(&[Input::from_bytes("a/clip", json)]).bank.unwrap()
    }

    fn shown(bytes: &[u8], width: usize) -> String {
        with(&[bytes], |dialogue| {
            let locales: Vec<_> = dialogue.locales().collect();
            Timeline::default().width(width).render(dialogue, &dialogue.clip_by_key("a/clip").unwrap(), &locales)
        })
    }

    #[test]
    fn a_clip_of_two_bands() {
        let visemes = format!("{}|{}", "A".repeat(30), "M".repeat(30));
        let json = format!(
            r#"{{"fps":24,"viseme_type":"blair","visemes":"{visemes}","events":"feels  sad,amy stops staring|ring(3, x)",
               "text_en-us":"One two three four five six seven|{{m}} eight","text_ja-jp":"一二三四五六七八九十一二三四五六七八九十|"}}"#
        );
        let expected = "\
a/clip
  24 fps, blair, 60 frames, 2.500 s, id 8497556c6a2fdffa

  '0.0s       '0.5s       '1.0s
  ██████████████████████████████▁▁▁▁▁▁▁▁
  AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAMMMMMMMM
  |0----------------------------|1------
  One two three four five six…  eight
  ▸feels sad, amy stops staring
                      ring(3, x)◂

  '1.58s    '2.0s
  ▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁
  MMMMMMMMMMMMMMMMMMMMMM
  ----------------------

segment 0  0.000 s to 1.250 s  frames 0 to 29
  event  feels sad
  event  amy stops staring
  en-us  One two three four five six
         seven
  ja-jp  一二三四五六七八九十一二三四五
         六七八九十
segment 1  1.250 s to 2.500 s  frames 30 to 59
  event  ring(3, x)  (other syntax)
  en-us  eight
curves
  sadness  0:5
";
        assert_eq!(shown(&bank(&json), 40), expected);
    }

    #[test]
    fn no_line_is_wider_than_the_terminal() {
        for fps in ["1", "12", "23.976", "30", "120", "1000"] {
            let visemes = "A".repeat(700);
            let text = "word ".repeat(40);
            let bank = bank(&format!(r#"{{"fps":{fps},"visemes":"{visemes}","text_en-us":"{text}"}}"#));
            for width in 24..=140 {
                let shown = shown(&bank, width);
                let timeline = shown.lines().skip(3);
                let widest = timeline.filter(|line| !line.starts_with("segment")).map(UnicodeWidthStr::width).max();
                assert!(widest <= Some(width), "{fps} fps at {width}: {shown}");
            }
        }
    }

    #[test]
    fn without_frame_rate_or_frames() {
        let bands = shown(&bank(r#"{"visemes":"AAAAAAAAAAAA"}"#), 40);
        assert!(bands.contains("\n  '0        '10\n  AAAAAAAAAAAA\n  |0----------\n"), "{bands}");
        let textless = shown(&bank(r#"{"events":"a|b"}"#), 40);
        let segments = "\n\nsegment 0\n  event  a  (other syntax)\nsegment 1\n  event  b  (other syntax)\n";
        assert!(textless.ends_with(&format!("no mouth shapes, id 8497556c6a2fdffa{segments}")), "{textless}");
    }
}
