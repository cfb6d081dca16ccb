//! The source texts of clips without translations, as lines of the record.

use super::line::{escaped, no_marks};
use crate::exchange::model::joined;
use std::collections::BTreeSet;
use std::fmt;

/// The source locale of a clip and the texts of its segments. Branches may have different ones, which are all true.
pub(super) type Sources = BTreeSet<(String, Vec<String>)>;

/// Writes a line for the source texts of a clip, without the mark of a translation into `locale`. Versions of lipz that
/// do not know such lines skip them.
pub(super) fn write(
    f: &mut fmt::Formatter<'_>,
    file: &str,
    (source_locale, sources): &(String, Vec<String>),
    locale: &str,
) -> fmt::Result {
    escaped(f, file)?;
    write!(f, "\t{source_locale}\t{locale}:{}\t", no_marks(sources.len()))?;
    escaped(f, &joined(sources))?;
    f.write_str("\n")
}
