//! The sections that only some banks have, and their records.

use super::{I16, I32, Tag, U16, U32, U64};
use crate::records::records;
use core::mem::size_of;

/// An optional section. Writing, verifying and splitting banks follow this description.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct OptionalSection {
    /// The tag of the section.
    pub tag: Tag,
    /// The length of an entry in bytes: a power of two.
    pub entry_bytes: usize,
    /// Whether the section has exactly one entry per clip, in slot order.
    pub is_per_clip: bool,
    /// The tag of the first section of its group. A bank has all sections of a group or none.
    pub group: Tag,
    /// Whether the base bank of a split bank keeps the section. The others are for tools, or describe a whole bank.
    pub is_in_base: bool,
}

impl OptionalSection {
    /// Returns a section of entries of any number, which programs read.
    const fn new(tag: Tag, entry_bytes: usize) -> OptionalSection {
        OptionalSection { tag, entry_bytes, is_per_clip: false, group: tag, is_in_base: true }
    }

    /// Returns a section with one entry per clip.
    const fn per_clip(self) -> OptionalSection {
        OptionalSection { is_per_clip: true, ..self }
    }

    /// Returns a section that banks have only together with `first` and the others of its group.
    const fn with(self, first: Tag) -> OptionalSection {
        OptionalSection { group: first, ..self }
    }

    /// Returns a section that the base bank of a split bank lacks.
    const fn not_in_base(self) -> OptionalSection {
        OptionalSection { is_in_base: false, ..self }
    }
}

// Every length of an entry is a power of two, so that no division is needed to check whether entries fill a section.
#[allow(clippy::indexing_slicing)]
const _: () = {
    let mut place = 0;
    while place < Tag::OPTIONAL.len() {
        assert!(Tag::OPTIONAL[place].entry_bytes.is_power_of_two());
        place += 1;
    }
};

impl Tag {
    /// [`BabbleRecord`]s, ordered by name (bytewise), each with its strings.
    pub const BABBLE: Tag = Tag(*b"BABL");
    /// [`FaceRecord`]s, ordered by name (bytewise), each with its name.
    pub const FACES: Tag = Tag(*b"FACE");
    /// [`RecordingRecord`]s in slot order.
    pub const RECORDINGS: Tag = Tag(*b"RCRD");
    /// [`CurveClipRecord`]s of the clips with curves, in slot order.
    pub const CURVE_CLIPS: Tag = Tag(*b"CRVC");
    /// [`CurveRecord`]s, ordered by name in each clip.
    pub const CURVES: Tag = Tag(*b"CURV");
    /// [`CurveKeyRecord`]s or [`WideCurveKeyRecord`]s of
    /// each curve in turn.
    pub const CURVE_KEYS: Tag = Tag(*b"CRVK");
    /// The locales of the voices, each followed by a zero byte. The original's comes first, then those of the
    /// dubs, ordered bytewise.
    pub const VOICES: Tag = Tag(*b"VOIC");
    /// For each voice except the original in turn, the replacement of the clip in each slot, one `u32` each:
    /// [`NO_DUB`](super::NO_DUB), or a slot with [`DUB_OF`](super::DUB_OF), [`OTHER_DUB`](super::OTHER_DUB) or neither.
    pub const DUBS: Tag = Tag(*b"DUBS");
    /// The offset of each clip's source record in `SRCE`, one `u32` per slot.
    pub const SOURCE_INDEX: Tag = Tag(*b"SRCX");
    /// The parts of each Lipz file that the display form omits. Only the compiler reads it.
    pub const SOURCES: Tag = Tag(*b"SRCE");
    /// A [`LayerRecord`] and its tables. The bank is a layer on top of others.
    pub const LAYER: Tag = Tag(*b"LAYR");
    /// [`PhoneClipRecord`]s of the clips with phones, in slot order.
    pub const PHONE_CLIPS: Tag = Tag(*b"PHNC");
    /// The phones of these clips in turn: the level, then number and time of each phone.
    pub const PHONES: Tag = Tag(*b"PHON");
    /// [`ArticulationRecord`]s, ordered by name (bytewise), each with its name and its [`PhoneTargetRecord`]s.
    pub const ARTICULATION: Tag = Tag(*b"ARTC");

    /// [`RigRecord`]s, ordered by name (bytewise), each with its name, weights, terms and names of weights.
    pub const RIGS: Tag = Tag(*b"RIGS");

    /// The optional sections of a bank of format 1, in file order.
    pub const OPTIONAL: [OptionalSection; 15] = [
        OptionalSection::new(Tag::BABBLE, 1),
        OptionalSection::new(Tag::FACES, 1),
        OptionalSection::new(Tag::RECORDINGS, size_of::<RecordingRecord>()).per_clip(),
        OptionalSection::new(Tag::CURVE_CLIPS, size_of::<CurveClipRecord>()),
        OptionalSection::new(Tag::CURVES, size_of::<CurveRecord>()).with(Tag::CURVE_CLIPS),
        OptionalSection::new(Tag::CURVE_KEYS, size_of::<CurveKeyRecord>()).with(Tag::CURVE_CLIPS),
        OptionalSection::new(Tag::PHONE_CLIPS, size_of::<PhoneClipRecord>()),
        OptionalSection::new(Tag::PHONES, 1).with(Tag::PHONE_CLIPS),
        OptionalSection::new(Tag::ARTICULATION, 1),
        OptionalSection::new(Tag::RIGS, 1),
        OptionalSection::new(Tag::VOICES, 1),
        OptionalSection::new(Tag::DUBS, 4).with(Tag::VOICES),
        OptionalSection::new(Tag::SOURCE_INDEX, 4).per_clip().not_in_base(),
        OptionalSection::new(Tag::SOURCES, 1).with(Tag::SOURCE_INDEX).not_in_base(),
        OptionalSection::new(Tag::LAYER, 1).not_in_base(),
    ];
}

/// The `length_us` of a clip without a recording.
pub const NO_RECORDING: u64 = u64::MAX;
/// Bit of a curve's `name_and_width`: its keys are [`WideCurveKeyRecord`]s.
pub const CURVE_WIDE: u32 = 1 << 31;
/// Bits of [`PhoneClipRecord::offset_and_flags`]: where the data of the clip starts in `PHON`.
pub const PHONES_OFFSET: u32 = (1 << 30) - 1;
/// Bit of [`PhoneClipRecord::offset_and_flags`]: the phones come from the text of the recording.
pub const PHONES_ARE_CERTAIN: u32 = 1 << 30;
/// Bit of [`PhoneClipRecord::offset_and_flags`]: times have four bytes instead of two.
pub const PHONES_ARE_WIDE: u32 = 1 << 31;
/// The second input of a term with only one.
pub const NO_INPUT: u8 = u8::MAX;
/// Class of a phone: closed lips, as in p, b and m.
pub const CLASS_CLOSED_LIPS: u8 = 1;
/// Class of a phone: the lower lip on the upper teeth, as in f and v.
pub const CLASS_LIP_ON_TEETH: u8 = 2;
/// Class of a phone: a narrow jaw, as in s and sh.
pub const CLASS_NARROW_JAW: u8 = 4;
/// Entry of a voice's table for a clip without a dub in it.
pub const NO_DUB: u32 = u32::MAX;
/// Bit of an entry of a voice's table: the clip in this slot is a dub in this voice, and the rest is the slot of its
/// original.
pub const DUB_OF: u32 = 1 << 31;
/// Bit of an entry of a voice's table: there is no dub in this voice, and the rest is the slot of the dub in another
/// voice, which this one falls back to.
pub const OTHER_DUB: u32 = 1 << 30;
/// Flag of a layer: its babble profiles, even if empty, replace those below it.
pub const LAYER_BABBLE: u32 = 1;
/// Flag of a layer: its default locale, even if unset, replaces the one below it.
pub const LAYER_DEFAULT_LOCALE: u32 = 2;
/// Flag of a layer: its face profiles, even if empty, replace those below it.
pub const LAYER_FACES: u32 = 4;
/// Flag of a layer: its list of voices, even if empty, replaces those below it.
pub const LAYER_VOICES: u32 = 8;
/// Flag of a layer: its articulation profiles, even if empty, replace those below it.
pub const LAYER_ARTICULATION: u32 = 16;
/// Flag of a layer: its rigs, even if empty, replace those below it.
pub const LAYER_RIGS: u32 = 32;
/// All flags of a layer.
pub const LAYER_FLAGS: u32 =
    LAYER_BABBLE | LAYER_DEFAULT_LOCALE | LAYER_FACES | LAYER_VOICES | LAYER_ARTICULATION | LAYER_RIGS;
/// No other clip is played for the clip in this voice, and it is not a dub.
pub const LAYER_NO_DUB: u16 = 0;
/// The other clip is the dub of this one.
pub const LAYER_DUB: u16 = 1;
/// The other clip is a dub of this one in another voice, and is played if this voice has no dub.
pub const LAYER_OTHER_DUB: u16 = 2;
/// The clip is the dub of the other one.
pub const LAYER_DUB_OF: u16 = 3;
/// Part of a clip in a layer: everything except its texts.
pub const PART_CLIP: u8 = 1;
/// Part of a clip in a layer: its texts.
pub const PART_TEXTS: u8 = 2;
/// Part of a dub in a layer, instead of its texts: the dub uses the texts of its original in the stack.
pub const PART_ORIGINAL: u8 = 4;
/// The stand-in of a locale without one.
pub const NO_STAND_IN: u32 = u32::MAX;

records! {
    /// One babble profile; its name, loops and power transfers follow it in this order.
    BabbleRecord: 32 {
        /// ⌈2⁶⁴ · digits per microsecond⌉.
        frames_per_micro_q64: U64,
        /// Digits of the loops per `rate_denominator` seconds, in lowest terms.
        rate_numerator: U32,
        /// Seconds in which that many digits pass.
        rate_denominator: U32,
        /// Length of the name.
        name_length_bytes: U16,
        /// Length of the loop for the lips.
        ooh_length_bytes: U16,
        /// Length of the loop for the jaw.
        aah_length_bytes: U16,
        /// Length of the power transfer of the lips.
        ooh_power_transfer_length_bytes: U16,
        /// Length of the power transfer of the jaw.
        aah_power_transfer_length_bytes: U16,
        /// Zero.
        reserved: [u8; 6],
    }

    /// One face profile; its name follows it.
    FaceRecord: 40 {
        /// Average milliseconds between blinks on a calm face, then while each of the twelve attributes of emotion is the
        /// strongest; 0 for no blinks.
        blink_interval_ms: [U16; 13],
        /// Length of a blink in milliseconds.
        blink_length_ms: U16,
        /// Percentage of blinks that are double.
        double_blink_percent: u8,
        /// Percentage of the time in which the eyes glance at hands and body.
        glance_percent: u8,
        /// How far the head turns while the mouth moves, in thousandths of a degree.
        head_motion: U16,
        /// How far the eyes turn before the head follows them, in thousandths of a degree.
        head_follows: U16,
        /// Average milliseconds between poses of the head.
        pose_ms: U16,
        /// Average milliseconds between fixations of the eyes.
        fixation_ms: U16,
        /// Length of the name.
        name_length_bytes: U16,
    }

    /// The recording for which the visemes of a clip were made.
    RecordingRecord: 16 {
        /// Length in microseconds, rounded to the nearest; [`NO_RECORDING`] if the clip has none.
        length_us: U64,
        /// XXH3-64 with seed 0 of all bytes of the file; 0 if the clip has none.
        content_hash: U64,
    }

    /// One clip with curves.
    CurveClipRecord: 8 {
        /// Slot of the clip.
        slot: U32,
        /// Index in `CURV` of its first curve.
        curves_first: U32,
    }

    /// One curve of a clip.
    CurveRecord: 8 {
        /// Offset of its keys in `CRVK`, in units of four bytes.
        keys_first: U32,
        /// Number of its name in `EVNM`, possibly with the bit [`CURVE_WIDE`].
        name_and_width: U32,
    }

    /// One key of a curve, if all of the curve's keys fit this form.
    CurveKeyRecord: 4 {
        /// The frame. The curve has the value at its start.
        frame: U16,
        /// The value in thousandths.
        thousandths: I16,
    }

    /// One key of a curve with at least one key that is late or large.
    WideCurveKeyRecord: 8 {
        /// The frame. The curve has the value at its start.
        frame: U32,
        /// The value in thousandths.
        thousandths: I32,
    }

    /// One clip with phones.
    PhoneClipRecord: 8 {
        /// Slot of the clip.
        slot: U32,
        /// [`PHONES_OFFSET`], [`PHONES_ARE_CERTAIN`] and [`PHONES_ARE_WIDE`].
        offset_and_flags: U32,
    }

    /// One articulation profile; its name and the targets of its phones follow it.
    ArticulationRecord: 16 {
        /// Length of the name.
        name_length_bytes: U16,
        /// Number of phones with targets, from number 0 on.
        target_count: U16,
        /// How wide the mouth opens, in percent of the targets.
        gain_percent: U16,
        /// How far the jaw moves, in percent of the targets.
        jaw_percent: U16,
        /// Milliseconds by which the mouth is ahead of the audio.
        lead_ms: I16,
        /// Level of speech at which the mouth opens as the targets state, in decibels relative to full scale.
        level_db: I16,
        /// Zero.
        reserved: [u8; 4],
    }

    /// The targets of a phone.
    PhoneTargetRecord: 12 {
        /// Jaw, opening, rounding, spreading, tip, protrusion and back of the tongue, from 0 to 100.
        percent: [u8; 7],
        /// How much the phone prevails over its neighbours, in tenths: jaw, lips, rounding.
        strength_tenths: [u8; 3],
        /// [`CLASS_CLOSED_LIPS`], [`CLASS_LIP_ON_TEETH`] and [`CLASS_NARROW_JAW`].
        class: u8,
        /// Number of the second sound of a diphthong; the phone's own number for others.
        second: u8,
    }

    /// One rig; its name, weights, terms, and the names of the weights follow it.
    RigRecord: 8 {
        /// Length of the name.
        name_length_bytes: U16,
        /// Number of weights.
        weight_count: U16,
        /// Number of terms.
        term_count: U16,
        /// Length of the names of all weights.
        names_length_bytes: U16,
    }

    /// One weight of a rig.
    RigWeightRecord: 8 {
        /// Index after its last term. The first term follows those of the weight before it.
        terms_end: U16,
        /// Offset after its name. The name follows that of the weight before it.
        names_end: U16,
        /// Lowest value, in thousandths.
        least: I16,
        /// Highest value, in thousandths.
        most: I16,
    }

    /// One term of a weight: a factor times one input, or the product of two.
    RigTermRecord: 4 {
        /// The factor, in thousandths.
        factor_thousandths: I16,
        /// Number of the input: an articulator, an emotion after these, or blink, brows and shrug after those.
        first: u8,
        /// Number of the second input, or [`NO_INPUT`].
        second: u8,
    }

    /// The description of the banks below a layer: the start of the `LAYR` section.
    LayerRecord: 40 {
        /// Number of banks that it was packed over, at least 1. As many checksums follow the record.
        base_count: U32,
        /// Number of clips of those banks that it removes. As many ids follow the checksums and the filter.
        removed_count: U32,
        /// Number of locale entries, 0 or one for each locale. They follow the ids.
        stand_in_count: U32,
        /// Number of clip entries, 0 or one for each slot. They follow the locale entries.
        part_count: U32,
        /// Number of locales of those banks that it removes. Their tags are the rest of the section.
        removed_locale_count: U32,
        /// Bits of [`LAYER_FLAGS`].
        flags: U32,
        /// Number of words of the filter of ids, 0 or a power of two. They follow the checksums.
        filter_count: U32,
        /// Number of changes to dubs. As many [`LayerDubRecord`]s follow the ids of removed clips.
        dub_count: U32,
        /// Number of texts of partly dubbed clips that come from their originals. As many places follow the changes to
        /// dubs.
        borrowed_count: U32,
        /// Number of voices that it adds, or of all voices of the stack with [`LAYER_VOICES`], including that of the
        /// originals; 0, or at least 2. Their tags follow the clip entries.
        voice_count: U32,
    }

    /// A layer's entry for a clip in a voice: like an entry of `DUBS`, with ids instead of slots.
    LayerDubRecord: 24 {
        /// The id of the clip.
        clip_id: U64,
        /// The id of the clip that is played for it, or of its original if it is a dub; otherwise 0.
        other_id: U64,
        /// Index of the voice in the layer's list.
        voice: U16,
        /// [`LAYER_NO_DUB`], [`LAYER_DUB`], [`LAYER_OTHER_DUB`] or [`LAYER_DUB_OF`].
        kind: U16,
        /// Zero.
        reserved: [u8; 4],
    }
}

/// Returns the word of a filter with this number of words, and the bit in it, that stand for an id.
#[inline]
pub const fn filter_place(id: u64, filter_count: usize) -> (usize, u32) {
    // Ids are hashes, so their bits serve as the filter's hash. The count is a power of two.
    ((id >> 6) as usize & filter_count.wrapping_sub(1), id as u32 & 63)
}
