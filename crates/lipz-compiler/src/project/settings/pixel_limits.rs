//! The fonts of texts, and the limits for the widths of their lines.

use super::NamedFile;
use lipz_file::locale::language;
use std::collections::BTreeMap;

/// The font of texts on the screen, and the most pixels of a line in it.
#[derive(Clone, PartialEq, Debug, Default)]
#[non_exhaustive]
pub struct PixelLimit {
    /// The font of the game; without one, texts are not measured.
    pub font: Option<NamedFile>,
    /// The size of the font: the pixels of an em.
    pub font_pixels: Option<f64>,
    /// The most pixels of a line, which the settings accept only with a font and its size.
    pub line_pixels: Option<u32>,
}

impl PixelLimit {
    /// Returns this limit, with the values of `other` where this one has none.
    fn or(self, other: &PixelLimit) -> PixelLimit {
        PixelLimit {
            font: self.font.or_else(|| other.font.clone()),
            font_pixels: self.font_pixels.or(other.font_pixels),
            line_pixels: self.line_pixels.or(other.line_pixels),
        }
    }
}

/// The limits of a project, and those of locales and languages, which replace these.
#[derive(Clone, PartialEq, Debug, Default)]
#[non_exhaustive]
pub struct PixelLimits {
    /// The limit of all other locales.
    pub project: PixelLimit,
    /// The limits of some locales and languages.
    pub locales: BTreeMap<String, PixelLimit>,
}

impl PixelLimits {
    /// Returns the limit of a locale or language.
    pub fn of(&self, locale: &str) -> PixelLimit {
        let of = |tag: &str| self.locales.get(tag).cloned().unwrap_or_default();
        of(locale).or(&of(language(locale))).or(&self.project)
    }
}
