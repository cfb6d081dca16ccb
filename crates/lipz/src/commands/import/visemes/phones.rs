//! TextGrids with phones and shapes, as `lipz sync` writes them. Corrected phones take precedence over the shapes.

use super::options::Settings;
use crate::shared::existing_file::ExistingFile;
use crate::shared::formats::ToolFile;
use lipz_diagnostics::Diagnostic;
use lipz_interop::{Format, ImportOptions, ImportResult, Mouth, import};
use lipz_sync::codes_of_phones;

const BY_PHONES: &str = "visemes made from the phones, by the rules of [sync]";
const OTHER_SHAPES: &str = "shapes that differ from their phones are ignored";

/// Returns the import with visemes made from the file's phones, or `None` if the file has these or contains only
/// shapes.
pub(super) fn by_phones(
    format: &Format,
    source: &ToolFile,
    settings: &Settings<'_>,
    options: &ImportOptions<'_>,
    (imported, existing): (&ImportResult, &[Option<ExistingFile>]),
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<ImportResult> {
    let ([clip], [existing]) = (imported.clips.as_slice(), existing) else { return None };
    if format.name != "textgrid" || options.map.is_some() {
        return None;
    }
    let before = existing.as_ref().and_then(|existing| mouth(existing, &clip.mouth));
    let (found, odd) = codes_of_phones(&source.bytes, &settings.sync, &clip.mouth, before.as_ref());
    diagnostics.extend(odd);
    let found = found.filter(|found| found.codes != clip.mouth.codes)?;
    let mut imported = import(format, &source.bytes, &options.clone().codes(found.codes.as_str()));
    let has_others = found.frames_of_other_shapes > 0;
    let remarks = [BY_PHONES].into_iter().chain(has_others.then_some(OTHER_SHAPES)).map(str::to_owned);
    imported.clips.iter_mut().take(1).for_each(|clip| clip.remarks.extend(remarks.clone()));
    Some(imported)
}

/// Returns the visemes of an existing clip, with the rate and viseme type of the new ones if it sets none.
fn mouth(existing: &ExistingFile, new: &Mouth) -> Option<Mouth> {
    let (rate, viseme_type) = existing.rate_and_type().ok()?;
    let document = existing.document().ok()?;
    let codes = document.string("visemes")?;
    Some(Mouth::new(codes, rate.unwrap_or(new.rate), viseme_type.unwrap_or(new.viseme_type)))
}
