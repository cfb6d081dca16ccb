//! The definition of a check: its function, and the files on which it may report something.
//!
//! Most files become clips in [`clean`](super::clean), which does not make a document or run checks. So each check
//! defines when it may have something to report. `clean` then leaves such files to the full parser and to
//! [`check`](super::check()).

use super::elements::Roles;
use crate::clip::{ClipData, Locales};
use crate::project::Options;
use crate::util::strings::Strings;
use lipz_diagnostics::Diagnostic;
use lipz_file::JsonString;

/// A check that only reports, without changing the clip.
pub(super) struct Check {
    /// The files on which it may report something.
    pub(super) trigger: Trigger,
    /// The function, by its argument.
    pub(super) run: Run,
}

/// The files on which a check may report something. Too many files only cost time, but too few are an error, because
/// files that `clean` accepts do not get diagnostics.
pub(super) enum Trigger {
    /// Only files that `clean` never accepts: those with escapes, unknown elements, values of wrong types, different
    /// numbers of segments, or unpaired braces.
    Unclean,
    /// All files of projects with such options, and no files of other projects.
    Options(fn(&Options) -> bool),
    /// Files for which the function returns true.
    File(fn(&CleanFile<'_>) -> bool),
}

/// The function of a check, by its argument.
pub(super) enum Run {
    /// Each text element, once its display texts are known.
    Text(fn(&CheckedText<'_>, &mut Vec<Diagnostic>)),
    /// The file, once its clip is complete.
    Clip(fn(&CheckedClip<'_>, &mut Vec<Diagnostic>)),
}

/// A file without escapes, unknown elements and values of wrong types, whose elements all have the same number of
/// segments.
pub(super) struct CleanFile<'f> {
    pub(super) clip: &'f ClipData,
    pub(super) locales: &'f Locales,
    pub(super) options: &'f Options,
    /// Whether a segment of a text displays nothing.
    pub(super) has_blank: bool,
}

/// A text element.
pub(super) struct CheckedText<'t> {
    pub(super) string: &'t JsonString<'t>,
    /// The tag of its locale.
    pub(super) locale: &'t str,
    /// Its display texts, one per segment.
    pub(super) displays: &'t Strings,
    /// The unfinished clip, with its visemes, the curves of the file, and the texts before this one.
    pub(super) clip: &'t ClipData,
    /// Whether it has as many segments as the clip.
    pub(super) is_divided: bool,
    pub(super) options: &'t Options,
}

/// The elements of a file, and their clip.
pub(super) struct CheckedClip<'c> {
    pub(super) roles: &'c Roles<'c>,
    pub(super) clip: &'c ClipData,
    pub(super) locales: &'c Locales,
    pub(super) options: &'c Options,
}
