//! The fixed-size records: clips, frame rates, segment starts, locales.

use super::limits::{fit, too_large};
use super::numbering::Numbering;
use super::strings::NamePool;
use crate::clip::Clip;
use crate::locales::localise::LocalisedTexts;
use foldhash::{HashMap, HashMapExt}; // seeded differently in each process; the order of entries is never used
use lipz_bank::{Fps, VisemeType};
use lipz_diagnostics::Report;
use lipz_layout::{
    ClipRecord, FLAG_VISEMES, KeyRecord, LOCALE_DEFAULT, LocaleRecord, MAX_INTEGER_FPS, NO_RATE, RateRecord, U32,
    fingerprint,
};
use zerocopy::FromZeros;

/// The records of clips and keys, sorted by slot, and the data that they refer to.
pub(super) struct ClipRecords {
    pub(super) clips: Vec<ClipRecord>,
    pub(super) keys: Vec<KeyRecord>,
    pub(super) rates: Vec<RateRecord>,
    /// First frames of all segments, and the end of the last.
    pub(super) starts: Vec<U32>,
    /// The number of frames of all clips.
    pub(super) frame_count: usize,
    pub(super) fingerprint: u64,
}

/// Returns the records of `clips`. Frames and segments are in the order of the segments' numbers.
pub(super) fn clips(
    clips: &[Clip<'_>],
    numbering: &Numbering,
    ids: &[u64],
    slots: &[u32],
    names: &NamePool,
) -> Result<ClipRecords, Report> {
    let mut keys = vec![KeyRecord::new_zeroed(); clips.len()];
    let mut records = vec![ClipRecord::new_zeroed(); clips.len()];
    let mut rates = Rates { records: Vec::new(), numbers: HashMap::new() };
    let mut starts = Vec::with_capacity(numbering.segment_count + 1);
    let mut frames_offset = 0;
    for at in numbering.order() {
        let (clip, key) = (&clips[at], names.keys[at]);
        let frames_start = fit(frames_offset, "frames")?;
        keys[slots[at] as usize] = KeyRecord {
            id: ids[at].into(),
            key_offset_bytes: key.offset_bytes.into(),
            key_length_bytes: key.length_bytes.into(),
            segment_count: (clip.starts().len() as u16).into(), // no clip that passes the check has more
        };
        records[slots[at] as usize] = ClipRecord {
            frames_offset_bytes: frames_start.into(),
            frame_count: fit(clip.frame_count(), "frames")?.into(),
            segments_first: fit(numbering.segments(at).start, "segments")?.into(),
            rate: clip.fps().map_or(Ok(NO_RATE), |fps| rates.number(fps))?.into(),
            viseme_type: clip.viseme_type().map_or(0, |viseme_type: VisemeType| viseme_type as u8),
            flags: if clip.has_visemes() { FLAG_VISEMES } else { 0 },
        };
        starts.extend(clip.starts().iter().map(|&start| U32::new(frames_start.wrapping_add(start)))); // overflow is detected below
        frames_offset += clip.frame_count();
    }
    starts.push(fit(frames_offset, "frames")?.into());
    let fingerprint = fingerprint(&keys, &records);
    Ok(ClipRecords { clips: records, keys, rates: rates.records, starts, frame_count: frames_offset, fingerprint })
}

/// The distinct fractional frame rates, in the order of their first use.
struct Rates {
    records: Vec<RateRecord>,
    numbers: HashMap<(u32, u32), u16>,
}

impl Rates {
    fn number(&mut self, fps: Fps) -> Result<u16, Report> {
        let (numerator, denominator) = (fps.numerator(), fps.denominator());
        if denominator == 1 {
            return Ok(numerator as u16); // at most 1000
        }
        if let Some(&number) = self.numbers.get(&(numerator, denominator)) {
            return Ok(number);
        }
        let next = usize::from(MAX_INTEGER_FPS) + 1 + self.records.len();
        let next = u16::try_from(next).ok().filter(|&next| next != NO_RATE);
        let next = next.ok_or_else(|| too_large("frame rates"))?;
        self.records.push(RateRecord {
            frames_per_micro_q64: fps.frames_per_micro_q64().into(),
            fps_numerator: numerator.into(),
            fps_denominator: denominator.into(),
        });
        self.numbers.insert((numerator, denominator), next);
        Ok(next)
    }
}

/// Returns the locale records, sorted by tag.
pub(super) fn locales(localised: &LocalisedTexts, names: &NamePool) -> Vec<LocaleRecord> {
    std::iter::zip(&localised.locales, &names.tags)
        .map(|(locale, tag)| LocaleRecord {
            tag_offset_bytes: tag.offset_bytes.into(),
            tag_length_bytes: tag.length_bytes.into(),
            flags: if locale.is_default { LOCALE_DEFAULT } else { 0 }.into(),
        })
        .collect()
}
