//! Texts on a screen: lines that are too wide in the font of their locale, and characters that the font lacks.

use super::font::{Font, Glyphs};
use super::{FewDiagnostics, LocaleText, texts};
use lipz_diagnostics::{Code, Diagnostic, bound, escape};
use lipz_file::{Document, text};
use std::borrow::Cow;

/// The most missing characters that a message lists.
const LISTED: usize = 5;

/// The font of texts, and the most pixels of a line in it.
#[derive(Clone, Copy, Debug)]
pub struct FontLimit<'f> {
    /// The font.
    pub font: &'f Font,
    /// The pixels of an em and of a line; `None` if lines may have any width.
    pub pixels: Option<LinePixels>,
}

/// A size of a font, and the most pixels of a line in this size.
#[derive(Clone, Copy, Debug)]
pub struct LinePixels {
    /// The size of the font: the pixels of an em.
    pub em: f64,
    /// The most pixels of a line.
    pub line: u32,
}

/// Reports the lines of a clip that are too wide in the font of their locale, and the characters that the font lacks.
/// `default_locale` is the locale of `text` without a locale. If braces are not literal, text in braces is not shown.
pub fn check_glyphs<'f>(
    clip: &Document<'_>,
    default_locale: Option<&str>,
    has_literal_braces: bool,
    limit_of: impl Fn(&str) -> Option<FontLimit<'f>>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let before = diagnostics.len();
    for text in texts(clip, default_locale) {
        if let Some(limit) = limit_of(&text.locale) {
            check(&text, has_literal_braces, limit, diagnostics);
            bound::limit_many(diagnostics);
        }
    }
    if diagnostics.len() > before {
        bound::limit(diagnostics);
    }
}

fn check(text: &LocaleText<'_>, has_literal_braces: bool, limit: FontLimit<'_>, diagnostics: &mut Vec<Diagnostic>) {
    let Some(glyphs) = limit.font.glyphs() else { return };
    let [mut wide, mut missing]: [FewDiagnostics; 2] = Default::default();
    for (at, segment) in text.segments.iter().enumerate() {
        let shown = if has_literal_braces { Cow::Borrowed(segment.as_str()) } else { text::display(segment).text };
        if let Some((message, note)) = limit.pixels.and_then(|pixels| too_wide(&shown, &glyphs, pixels, limit.font)) {
            wide.add(|| {
                let diagnostic = Diagnostic::at(Code::TextTooWide, text.span(at, None), message);
                diagnostic.note(note).help("shorten it, or break it with \\n")
            });
        }
        if let Some(message) = lacks(&shown, &glyphs, limit.font) {
            missing.add(|| {
                let diagnostic = Diagnostic::at(Code::MissingGlyph, text.span(at, None), message);
                diagnostic.help("write the text without it, or add the character to the font")
            });
        }
    }
    wide.report(diagnostics);
    missing.report(diagnostics);
}

/// Returns a message about the widest line, and a note about its measurement.
fn too_wide(shown: &str, glyphs: &Glyphs<'_>, pixels: LinePixels, font: &Font) -> Option<(String, String)> {
    let LinePixels { em, line: limit } = pixels;
    let widest = shown.lines().map(|line| glyphs.line_pixels(line, em)).max_by(f64::total_cmp)?;
    let is_wider = widest > f64::from(limit);
    is_wider.then(|| {
        // A line that is wider by a part of a pixel does not show the limit as its width.
        let widest = widest.ceil();
        let message = format!("a line of this text is {widest} pixels wide, but the limit is {limit}");
        (message, format!("measured with {} at {em} pixels, without kerning", escape::quoted(font.name())))
    })
}

/// Returns a message about the characters that a font lacks.
fn lacks(shown: &str, glyphs: &Glyphs<'_>, font: &Font) -> Option<String> {
    let mut missing: Vec<char> = Vec::new();
    for character in shown.chars().filter(|character| glyphs.lacks(*character)) {
        if !missing.contains(&character) {
            missing.push(character);
        }
    }
    let name = |character: &char| {
        format!("{} (U+{:04X})", escape::quoted(character.encode_utf8(&mut [0; 4])), u32::from(*character))
    };
    let listed: Vec<String> = missing.iter().take(LISTED).map(name).collect();
    let font = escape::quoted(font.name());
    match (listed.as_slice(), missing.len() - listed.len()) {
        ([], _) => None,
        (listed, 0) => Some(format!("{font} lacks {}", listed.join(", "))),
        (listed, more) => Some(format!("{font} lacks {} and {more} more characters", listed.join(", "))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lipz_testkit::font::font;

    /// Returns the messages about a clip whose font has `A` to `D`, each half an em wide.
    fn found(clip: &str, has_literal_braces: bool) -> Vec<String> {
        let font = Font::read("game.ttf", font(1000, &['A', 'B', 'C', 'D'].map(|letter| (letter, 500)))).unwrap();
        let document = lipz_file::parse(clip.as_bytes()).document.unwrap();
        let mut diagnostics = Vec::new();
        let limit = |locale: &str| {
            let pixels = Some(LinePixels { em: 20.0, line: 30 });
            (locale != "fr-fr").then_some(FontLimit { font: &font, pixels })
        };
        check_glyphs(&document, Some("en-us"), has_literal_braces, limit, &mut diagnostics);
        diagnostics.into_iter().map(|found| found.message).collect()
    }

    #[test]
    fn lines_are_measured_and_missing_characters_are_listed() {
        for fine in [
            r#"{ "text": "ABC" }"#,
            r#"{ "text": "ABC\nDAB|{speaker: Mara} CBA" }"#,
            r#"{ "text_fr-fr": "ABCDABCD xyz" }"#,
            r#"{ "text_en-us": "", "text_de-de": 4 }"#,
        ] {
            assert_eq!(found(fine, false), [""; 0], "{fine}");
        }
        let wide = "a line of this text is 40 pixels wide, but the limit is 30";
        assert_eq!(found(r#"{ "text": "A|ABC\nABCD" }"#, false), [wide]);
        assert_eq!(
            found(r#"{ "text_de-de": "ABxC" }"#, false),
            ["a line of this text is 50 pixels wide, but the limit is 30", "`game.ttf` lacks `x` (U+0078)"]
        );
        assert_eq!(found(r#"{ "text": "{A" }"#, true), ["`game.ttf` lacks `{` (U+007B)"]);
        let many = found(r#"{ "text": "s|t\nu\nv\nw\nx\ny\nz\ny\nz" }"#, false);
        assert_eq!(
            many,
            [
                "`game.ttf` lacks `s` (U+0073)",
                "`game.ttf` lacks `t` (U+0074), `u` (U+0075), `v` (U+0076), `w` (U+0077), `x` (U+0078) \
             and 2 more characters"
            ]
        );
    }
}
