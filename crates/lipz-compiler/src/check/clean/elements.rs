//! The elements that a clean file can have.

use super::members::UncleanFile;
use crate::clip::Locales;
use std::ops::Range;

/// An element of a clean file.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum CleanRole {
    Fps,
    VisemeType,
    Visemes,
    Events,
    /// The text of the locale with this number.
    Text(u32),
}

/// An element with the byte range of its value, without quotes.
pub(super) struct Element {
    pub(super) role: CleanRole,
    pub(super) place: Range<usize>,
    /// Bytes of the value that the clip contains.
    pub(super) held: usize,
}

/// Returns the role of the element with this name. A text has a role only if its locale is already known to be clean.
pub(super) fn role(name: &str, locales: &Locales) -> Result<CleanRole, UncleanFile> {
    if let Some(locale) = name.strip_prefix("text_").and_then(|tag| locales.clean(tag)) {
        return Ok(CleanRole::Text(locale));
    }
    match name {
        "fps" => Ok(CleanRole::Fps),
        "viseme_type" => Ok(CleanRole::VisemeType),
        "visemes" => Ok(CleanRole::Visemes),
        "events" => Ok(CleanRole::Events),
        _ => Err(UncleanFile),
    }
}
