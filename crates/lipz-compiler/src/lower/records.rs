//! The fixed-size records: clips, far segment starts, locales.

use super::events::Events;
use super::fit;
use super::strings::Names;
use crate::Report;
use crate::clip::Clip;
use crate::localise::Localised;
use lipz_bank::layout::{
    ClipRecord, FLAG_FAR_STARTS, FLAG_VISEMES, INLINE_STARTS, LOCALE_DEFAULT, LocaleRecord, U16, U32, fingerprint,
};
use lipz_bank::{Fps, VisemeType};
use zerocopy::FromZeros;

/// The clip records in slot order, and what they refer to.
pub(super) struct ClipRecords {
    pub(super) clips: Vec<ClipRecord>,
    pub(super) far_starts: Vec<U32>,
    /// Frames of all clips.
    pub(super) frame_count: usize,
    pub(super) fingerprint: u64,
}

/// The records of `clips`; frames and events lie in the order of the clips.
pub(super) fn clips(
    clips: &[Clip<'_>],
    ids: &[u64],
    slots: &[u32],
    names: &Names,
    events: &Events,
) -> Result<ClipRecords, Report> {
    let mut records = vec![ClipRecord::new_zeroed(); clips.len()];
    let mut far_starts = Vec::new();
    let mut frames_offset = 0;
    for (at, clip) in clips.iter().enumerate() {
        let segment_count = fit(clip.starts().len(), "segments")?;
        let (starts, flag) = starts(clip, &mut far_starts)?;
        let visemes = if clip.has_visemes() { FLAG_VISEMES } else { 0 };
        let key = names.keys[at];
        records[slots[at] as usize] = ClipRecord {
            id: ids[at].into(),
            frames_per_micro_q64: clip.fps().map_or(0, Fps::frames_per_micro_q64).into(),
            fps_numerator: clip.fps().map_or(0, Fps::numerator).into(),
            fps_denominator: clip.fps().map_or(0, Fps::denominator).into(),
            frames_offset_bytes: fit(frames_offset, "frames")?.into(),
            frame_count: fit(clip.frames().len(), "frames")?.into(),
            segment_count: segment_count.into(),
            events_first: events.first[at].into(),
            key_offset_bytes: key.offset_bytes.into(),
            key_length_bytes: key.length_bytes.into(),
            viseme_type: clip.viseme_type().map_or(0, |viseme_type: VisemeType| viseme_type as u8),
            flags: visemes | flag,
            starts,
        };
        frames_offset += clip.frames().len();
    }
    let fingerprint = fingerprint(&records);
    Ok(ClipRecords { clips: records, far_starts, frame_count: frames_offset, fingerprint })
}

/// The starts of segments 1 and up: in the record if they fit, otherwise where they stand.
fn starts(clip: &Clip<'_>, far_starts: &mut Vec<U32>) -> Result<([U16; INLINE_STARTS], u8), Report> {
    let mut inline = [U16::new(u16::MAX); INLINE_STARTS];
    let starts = clip.starts().get(1..).unwrap_or_default();
    if starts.len() <= INLINE_STARTS && clip.frames().len() <= usize::from(u16::MAX) {
        for (field, &start) in inline.iter_mut().zip(starts) {
            *field = U16::new(start as u16);
        }
        return Ok((inline, 0));
    }
    let first = fit(far_starts.len(), "segment starts")?;
    inline[0] = U16::new(first as u16);
    inline[1] = U16::new((first >> 16) as u16);
    far_starts.extend(starts.iter().map(|&start| U32::new(start)));
    Ok((inline, FLAG_FAR_STARTS))
}

/// The locale records, in the order of their tags.
pub(super) fn locales(localised: &Localised, names: &Names) -> Vec<LocaleRecord> {
    std::iter::zip(&localised.locales, &names.tags)
        .map(|(locale, tag)| LocaleRecord {
            tag_offset_bytes: tag.offset_bytes.into(),
            tag_length_bytes: tag.length_bytes.into(),
            flags: if locale.is_default { LOCALE_DEFAULT } else { 0 }.into(),
        })
        .collect()
}
