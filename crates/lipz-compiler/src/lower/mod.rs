//! From clips to the sections of a bank.

mod assemble;
mod events;
mod index;
mod records;
mod strings;

use crate::clip::Clip;
use crate::localise::Localised;
use crate::{Options, Report};
use assemble::Section;
use lipz::Code;
use lipz_bank::ClipId;
use lipz_bank::layout::Tag;
use zerocopy::IntoBytes;

/// The bank of `clips`, which are in the order of their keys.
pub(crate) fn lower(clips: &[Clip<'_>], localised: &Localised, options: &Options) -> Result<Vec<u8>, Report> {
    let ids = unique_ids(clips)?;
    let (index, (texts, events)) = rayon::join(
        || index::build(&ids),
        || rayon::join(|| strings::texts(clips, localised), || events::events(clips)),
    );
    let events = events?;
    let names = strings::names(clips, localised)?;
    let text_index = texts.index(localised, &index.slots)?;
    let records = records::clips(clips, &ids, &index.slots, &names, &events)?;
    let locales = records::locales(localised, &names);
    let mut sections = vec![
        Section::required(Tag::CLIPS, records.clips.as_bytes()),
        Section::required(Tag::PILOTS, index.pilots.as_bytes()),
        Section::required(Tag::KEY_ORDER, index.slots_le.as_bytes()),
        Section::required(Tag::NAMES, names.pool.as_bytes()),
        Section::of_pieces(Tag::FRAMES, clips.iter().map(Clip::frames).collect()),
        Section::required(Tag::STARTS, records.far_starts.as_bytes()),
        Section::required(Tag::LOCALES, locales.as_bytes()),
        Section::required(Tag::TEXT_INDEX, text_index.as_bytes()),
        Section::of_pieces(Tag::TEXTS, texts.pieces()),
        Section::required(Tag::EVENT_REFS, events.references.as_bytes()),
        Section::required(Tag::EVENTS, events.records.as_bytes()),
        Section::required(Tag::EVENT_STRINGS, events.pool.as_bytes()),
    ];
    let sources;
    if !options.strip {
        sources = strings::sources(clips, &index.slots)?;
        sections.push(Section::of_pieces(Tag::SOURCE_INDEX, vec![sources.index.as_bytes()]));
        sections.push(Section::of_pieces(Tag::SOURCES, sources.pieces));
    }
    assemble::assemble(&sections, index.seed, records.fingerprint)
}

/// The ids of `clips`, if no two are the same. The report has the key of a clip for a path.
fn unique_ids(clips: &[Clip<'_>]) -> Result<Vec<u64>, Report> {
    let ids: Vec<u64> = clips.iter().map(|clip| ClipId::of(clip.key()).get()).collect();
    let mut sorted = ids.clone();
    sorted.sort_unstable();
    let Some([id, _]) = sorted.array_windows().find(|[id, next]| id == next) else { return Ok(ids) };
    let mut same = std::iter::zip(&ids, clips).filter(|(other, _)| *other == id).map(|(_, clip)| clip.key());
    let (key, next_key) = (same.next().unwrap_or_default(), same.next().unwrap_or_default());
    Err(Report::failure(
        next_key,
        Code::IdCollision,
        format!("the keys `{key}` and `{next_key}` have the same clip id, {id:016x}"),
        "rename one of the two: it happens about once in 10^9 banks of 100,000 clips",
    ))
}

/// A number that a 32-bit field of the bank holds, or the finding that it does not.
fn fit(number: usize, what: &str) -> Result<u32, Report> {
    u32::try_from(number).map_err(|_| too_large(what))
}

fn too_large(what: &str) -> Report {
    Report::failure(
        "",
        Code::BankTooLarge,
        format!("{what} of the bank do not fit 32-bit offsets"),
        "make several banks, one per act or one per language",
    )
}
