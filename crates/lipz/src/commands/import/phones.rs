//! TextGrids with phones and shapes, as `lipz sync` writes them: where somebody has corrected phones, these count.

use super::options::Settings;
use crate::shared::existing::Existing;
use crate::shared::formats::Source;
use lipz_diagnostics::Diagnostic;
use lipz_interop::{Format, ImportOptions, Imported, Mouth, import};
use lipz_sync::codes_of_phones;

const BY_PHONES: &str = "shapes follow the phones, by the rules of [sync]";
const OTHER_SHAPES: &str = "shapes that are others than their phones do not count";

/// The import with the mouth that the phones of a file make; `None` if its shapes are the same, or all that it has.
pub(super) fn by_phones(
    format: &Format,
    source: &Source,
    settings: &Settings<'_>,
    options: &ImportOptions<'_>,
    (imported, existing): (&Imported, &[Option<Existing>]),
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Imported> {
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

/// The mouth of a clip that exists, which is of the same rate and type as the new one if it does not name others.
fn mouth(existing: &Existing, new: &Mouth) -> Option<Mouth> {
    let (rate, viseme_type) = existing.rate_and_type().ok()?;
    let document = existing.document().ok()?;
    let codes = document.string("visemes")?;
    Some(Mouth::new(codes, rate.unwrap_or(new.rate), viseme_type.unwrap_or(new.viseme_type)))
}
