//! The fonts of a project, in which the check measures texts.

use crate::console;
use crate::shared::input_file;
use lipz_compiler::Options;
use lipz_compiler::settings::{NamedFile, PixelLimit, PixelLimits};
use lipz_diagnostics::{Code, Diagnostic, Report};
use lipz_file::Document;
use lipz_texts::{Font, FontLimit, LinePixels, check_glyphs};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// The fonts of a project, and the limits for lines in them.
pub(super) struct Fonts<'p> {
    limits: &'p PixelLimits,
    /// The fonts by path; `None` for those that cannot be read.
    fonts: BTreeMap<PathBuf, Option<Font>>,
    /// The problems of fonts, at their names in the settings.
    pub(super) reports: Vec<Report>,
}

impl<'p> Fonts<'p> {
    /// Reads the fonts. In a font that cannot be read, no text is measured, and all other checks still run.
    pub(super) fn open(limits: &'p PixelLimits) -> Fonts<'p> {
        let (mut fonts, mut reports) = (BTreeMap::new(), Vec::new());
        let named = std::iter::once(&limits.project).chain(limits.locales.values());
        for file in named.filter_map(|limit| limit.font.as_ref()) {
            fonts.entry(file.path().to_owned()).or_insert_with(|| match read(file) {
                Ok(font) => Some(font),
                Err(report) => {
                    reports.push(report);
                    None
                }
            });
        }
        Fonts { limits, fonts, reports }
    }

    /// Whether texts are measured in a font.
    pub(super) fn is_any(&self) -> bool {
        self.fonts.values().any(Option::is_some)
    }

    /// Reports lines of a clip that are too wide, and characters that are missing from their font.
    pub(super) fn check(&self, clip: &Document<'_>, options: &Options, diagnostics: &mut Vec<Diagnostic>) {
        if self.is_any() {
            let limit_of = |locale: &str| self.limit(&self.limits.of(locale));
            check_glyphs(clip, options.get_default_locale(), options.get_literal_braces(), limit_of, diagnostics);
        }
    }

    fn limit(&self, limit: &PixelLimit) -> Option<FontLimit<'_>> {
        let font = self.fonts.get(limit.font.as_ref()?.path())?.as_ref()?;
        let pixels = limit.font_pixels.zip(limit.line_pixels).map(|(em, line)| LinePixels { em, line });
        Some(FontLimit { font, pixels })
    }

    /// Returns the limits and the fonts, as bytes to compare.
    pub(super) fn beside(&self) -> Vec<u8> {
        let limits = std::iter::once((None, &self.limits.project))
            .chain(self.limits.locales.iter().map(|(locale, limit)| (Some(locale), limit)));
        let mut bytes = Vec::new();
        for (locale, PixelLimit { font, font_pixels, line_pixels, .. }) in limits {
            let path = font.as_ref().map(NamedFile::path);
            bytes.extend(format!("{:?}", (locale, path, font_pixels, line_pixels)).into_bytes());
        }
        for font in self.fonts.values() {
            let font = font.as_ref().map(Font::bytes).unwrap_or_default();
            bytes.extend(font.len().to_le_bytes());
            bytes.extend_from_slice(font);
        }
        bytes
    }
}

fn read(file: &NamedFile) -> Result<Font, Report> {
    let name = console::path(file.path());
    Font::read(name.as_str(), input_file::read_named(file)?).map_err(|error| {
        let diagnostic = Diagnostic::new(Code::SettingValue, format!("`{name}` {error}"));
        file.report(diagnostic.help("name a TrueType or OpenType file (.ttf, .otf, .ttc), or restore the file"))
    })
}
