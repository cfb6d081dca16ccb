//! The elements that a clean file can have.

use super::members::Unclean;
use crate::clip::Locales;
use std::ops::Range;

/// An element of a clean file.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    Fps,
    VisemeType,
    Visemes,
    Events,
    /// The text of the locale with this number.
    Text(u32),
}

/// An element, and where its value stands, without quotes.
pub(super) struct Element {
    pub(super) role: Role,
    pub(super) place: Range<usize>,
    /// Bytes of it that the clip has.
    pub(super) held: usize,
}

/// The role of the element with this name; that of a text only if its locale is known to be clean.
pub(super) fn role(name: &str, locales: &Locales) -> Result<Role, Unclean> {
    if let Some(locale) = name.strip_prefix("text_").and_then(|tag| locales.clean(tag)) {
        return Ok(Role::Text(locale));
    }
    match name {
        "fps" => Ok(Role::Fps),
        "viseme_type" => Ok(Role::VisemeType),
        "visemes" => Ok(Role::Visemes),
        "events" => Ok(Role::Events),
        _ => Err(Unclean),
    }
}
