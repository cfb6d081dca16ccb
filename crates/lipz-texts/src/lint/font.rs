//! Fonts, and the widths of texts in them.

use read_fonts::tables::cmap::CmapSubtable;
use read_fonts::tables::hmtx::Hmtx;
use read_fonts::types::GlyphId;
use read_fonts::{FontRef, TableProvider};
use std::fmt;

/// A TrueType or OpenType font, from which the widths of texts are read.
///
/// ```
/// use lipz_texts::{Font, FontError};
/// assert_eq!(Font::read("game.ttf", b"GIF89a".to_vec()).err(), Some(FontError::Format));
/// ```
#[derive(Clone, Debug)]
pub struct Font {
    name: String,
    bytes: Vec<u8>,
}

/// Why a font cannot be used.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum FontError {
    /// The file is not a TrueType or OpenType font, or a collection of them.
    Format,
    /// A table of the font is damaged or missing.
    Table(&'static str),
}

impl fmt::Display for FontError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FontError::Format => f.write_str("is not a TrueType or OpenType font"),
            FontError::Table(name) => write!(f, "is a damaged font: its table `{name}` cannot be read"),
        }
    }
}

impl std::error::Error for FontError {}

impl Font {
    /// Reads a font, or the first one of a collection. `name` stands for the font in messages.
    ///
    /// # Errors
    /// If the bytes are not a font, or one of the tables with characters and widths cannot be read.
    pub fn read(name: impl Into<String>, bytes: Vec<u8>) -> Result<Font, FontError> {
        Glyphs::read(&bytes)?;
        Ok(Font { name: name.into(), bytes })
    }

    /// Returns the name of the font in messages.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the bytes of the font.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Returns the glyphs of the font. [`Font::read`] has read them before.
    pub(super) fn glyphs(&self) -> Option<Glyphs<'_>> {
        Glyphs::read(&self.bytes).ok()
    }
}

/// The glyphs of the characters of a font.
pub(super) struct Glyphs<'f> {
    characters: CmapSubtable<'f>,
    widths: Hmtx<'f>,
    units_per_em: u16,
}

impl<'f> Glyphs<'f> {
    fn read(bytes: &'f [u8]) -> Result<Glyphs<'f>, FontError> {
        let font = FontRef::from_index(bytes, 0).map_err(|_| FontError::Format)?;
        let units_per_em = font.head().map(|head| head.units_per_em()).ok().filter(|units| *units > 0);
        let characters = font.cmap().ok().and_then(|table| table.best_subtable());
        Ok(Glyphs {
            characters: characters.map(|(_, _, table)| table).ok_or(FontError::Table("cmap"))?,
            widths: font.hmtx().map_err(|_| FontError::Table("hmtx"))?,
            units_per_em: units_per_em.ok_or(FontError::Table("head"))?,
        })
    }

    fn glyph(&self, character: char) -> Option<GlyphId> {
        let own = self.characters.map_codepoint(character).filter(|glyph| *glyph != GlyphId::NOTDEF);
        // Text engines show other spaces as a space.
        own.or_else(|| if character != ' ' && character.is_whitespace() { self.glyph(' ') } else { None })
    }

    /// Whether the font lacks a glyph for this character. Invisible characters do not need one.
    pub(super) fn lacks(&self, character: char) -> bool {
        is_visible(character) && self.glyph(character).is_none()
    }

    /// Returns the width of a line in pixels, if an em has this many. Each character counts as its glyph, without
    /// kerning and ligatures, and a missing one as the glyph that fonts show instead.
    pub(super) fn line_pixels(&self, line: &str, em_pixels: f64) -> f64 {
        let glyphs = line.chars().filter(|character| is_visible(*character));
        let width = |character| {
            let glyph = self.glyph(character).unwrap_or(GlyphId::NOTDEF);
            u64::from(self.widths.advance(glyph).unwrap_or_default())
        };
        let units: u64 = glyphs.map(width).sum();
        units as f64 * em_pixels / f64::from(self.units_per_em)
    }
}

/// Whether a character may be visible or wide: no control character, and none of the characters that Unicode lists as
/// `Default_Ignorable_Code_Point` in `DerivedCoreProperties.txt`.
fn is_visible(character: char) -> bool {
    !character.is_control()
        && !matches!(
            character,
            '\u{ad}' | '\u{34f}' | '\u{61c}' | '\u{115f}'..='\u{1160}' | '\u{17b4}'..='\u{17b5}'
                | '\u{180b}'..='\u{180f}' | '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}'
                | '\u{2060}'..='\u{206f}' | '\u{3164}' | '\u{fe00}'..='\u{fe0f}' | '\u{feff}' | '\u{ffa0}'
                | '\u{fff0}'..='\u{fff8}' | '\u{1bca0}'..='\u{1bca3}' | '\u{1d173}'..='\u{1d17a}'
                | '\u{e0000}'..='\u{e0fff}'
        )
}

#[cfg(test)]
mod tests {
    use super::*;
    use lipz_testkit::font::font;

    const CHARACTERS: [(char, u16); 4] = [('A', 500), ('é', 250), (' ', 100), ('灯', 1000)];

    #[test]
    fn widths_are_the_sums_of_glyphs() {
        let font = Font::read("a.ttf", font(700, &CHARACTERS)).unwrap();
        let glyphs = font.glyphs().unwrap();
        for (line, pixels) in [("", 0.0), ("A", 10.0), ("A é", 17.0), ("灯\u{200b}\u{ad}A\r", 30.0), ("A\u{a0}A", 22.0)]
        {
            assert_eq!(glyphs.line_pixels(line, 20.0), pixels, "{line}");
            assert!(!line.chars().any(|character| glyphs.lacks(character)), "{line}");
        }
        assert_eq!(glyphs.line_pixels("x", 20.0), 14.0);
        assert!(glyphs.lacks('x') && glyphs.lacks('😀'));
    }

    #[test]
    fn damaged_fonts_are_refused_or_read() {
        let bytes = font(700, &CHARACTERS);
        let read = |bytes: &[u8]| {
            let font = Font::read("a.ttf", bytes.to_vec());
            font.iter()
                .filter_map(Font::glyphs)
                .for_each(|glyphs| assert!(glyphs.line_pixels("A é灯x", 20.0).is_finite()));
            font.err()
        };
        assert_eq!(read(&bytes), None);
        assert_eq!(read(b""), Some(FontError::Format));
        assert_eq!(read(b"wOF2 of a web page"), Some(FontError::Format));
        for length in 0..bytes.len() {
            read(&bytes[..length]);
        }
        for at in 0..bytes.len() {
            for value in [0, 1, 0x7F, 0x80, 0xFF] {
                let mut damaged = bytes.clone();
                damaged[at] = value;
                read(&damaged);
            }
        }
        let without = |tag: &[u8]| {
            let at = bytes.windows(4).position(|window| window == tag).unwrap();
            [&bytes[..at], b"none", &bytes[at + 4..]].concat()
        };
        for tag in ["cmap", "head", "hmtx"] {
            assert_eq!(read(&without(tag.as_bytes())), Some(FontError::Table(tag)));
        }
    }
}
