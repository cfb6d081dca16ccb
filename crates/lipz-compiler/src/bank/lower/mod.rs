//! Conversion of clips to the sections of a bank.

pub(crate) mod assemble;
mod curves;
mod events;
mod fill;
mod index;
pub(crate) mod layer;
mod limits;
pub(crate) mod numbering;
mod phones;
mod recordings;
mod records;
mod repeated_hashes;
pub(crate) mod stream;
mod strings;
mod text_placement;
pub(crate) mod texts;
mod voices;

pub(crate) use limits::too_large;

use crate::clip::{Clip, Clips};
use crate::locales::dubs::Dubs;
use crate::locales::localise::LocalisedTexts;
use crate::project::{Options, rigs};
use crate::util::parallel;
use assemble::Section;
use curves::CurveSections;
use events::Events;
use index::Index;
use layer::LayerDraft;
use lipz_bank::{ClipId, Recording};
use lipz_diagnostics::{Code, Report};
use lipz_layout::{LocaleRecord, RecordingRecord, Tag};
use numbering::Numbering;
use phones::PhoneSections;
use records::ClipRecords;
use std::borrow::Cow;
use std::collections::BTreeMap;
use strings::{NamePool, Sources};
use texts::TextOffsets;
use voices::Voices;
use zerocopy::IntoBytes;

/// The content of a bank that belongs to no clip, or comes from no Lipz file.
pub(crate) struct BankExtras<'o> {
    /// Whether source records are left out.
    pub(crate) strip: bool,
    /// The section of babble profiles; empty without any.
    pub(crate) babble: Vec<u8>,
    /// The section of face profiles; empty without any.
    pub(crate) faces: Vec<u8>,
    /// The section of articulation profiles, for banks with phones.
    pub(crate) articulation: Vec<u8>,
    /// The section of rigs; empty without any.
    pub(crate) rigs: Vec<u8>,
    /// Recordings by key.
    pub(crate) recordings: Cow<'o, BTreeMap<String, Recording>>,
    /// The layer, if the bank is one.
    pub(crate) layer: Option<LayerDraft>,
    /// The section of an object; empty for other banks.
    pub(crate) export: Vec<u8>,
}

impl<'o> BankExtras<'o> {
    /// Creates it from the options of a project.
    pub(crate) fn of(options: &'o Options) -> BankExtras<'o> {
        BankExtras {
            strip: options.strip,
            babble: options.babble.section(),
            faces: options.faces.section(),
            articulation: options.articulation.section(),
            rigs: rigs::section(&options.rigs),
            recordings: Cow::Borrowed(&options.recordings),
            layer: None,
            export: Vec::new(),
        }
    }
}

/// Everything in a bank except the data copied directly from the clips, with the positions of these.
pub(crate) struct Layout {
    records: ClipRecords,
    index: Index,
    names: NamePool,
    locales: Vec<LocaleRecord>,
    texts: TextOffsets,
    /// The number of segments of all clips.
    segment_count: usize,
    events: Events,
    sources: Sources,
    babble: Vec<u8>,
    faces: Vec<u8>,
    curves: CurveSections,
    phones: PhoneSections,
    /// The section of articulation profiles.
    articulation: Vec<u8>,
    rigs: Vec<u8>,
    /// One record per slot; empty if no recordings are known.
    recordings: Vec<RecordingRecord>,
    voices: Voices,
    is_stripped: bool,
    /// The section of a layer; empty for other banks.
    layer: Vec<u8>,
    /// The section of an object; empty for other banks.
    export: Vec<u8>,
    /// The clips in the order of their segments' numbers.
    order: Vec<ClipPlace>,
}

/// The batch and the index of a clip.
struct ClipPlace {
    batch: u32,
    /// Its number in the batch.
    index: u32,
    slot: u32,
}

impl Layout {
    /// Lays out the bank of `clips`, which are sorted by key.
    pub(crate) fn new(
        clips: &[Clip<'_>],
        localised: &LocalisedTexts,
        dubs: &Dubs,
        beside: BankExtras<'_>,
    ) -> Result<Layout, Report> {
        if clips.iter().any(Clip::lacks_texts) {
            return Err(too_large("texts"));
        }
        let numbering = Numbering::new(clips.iter().map(|clip| (clip.events().is_some(), clip.starts().len() as u32)));
        let (texts, layout) = parallel::join(
            || texts::texts(clips, localised, dubs, &numbering),
            || Layout::without_texts(clips, localised, dubs, &numbering, beside),
        );
        let mut layout = layout?;
        layout.texts = texts?;
        Ok(layout)
    }

    /// Lays out everything but the texts, which take half of the time.
    fn without_texts(
        clips: &[Clip<'_>],
        localised: &LocalisedTexts,
        dubs: &Dubs,
        numbering: &Numbering,
        beside: BankExtras<'_>,
    ) -> Result<Layout, Report> {
        let index_of_ids = || {
            let ids: Vec<u64> = clips.iter().map(|clip| ClipId::from_key(clip.key()).get()).collect();
            index::build(&ids).map(|index| (index, ids)).map_err(|id| same_id(clips, id))
        };
        let with_curves = curves::with_curves(clips);
        let small_parts =
            || (events::events(clips, &with_curves), strings::names(clips, localised), strings::own_sources(clips));
        let (index, (events, names, sources)) = parallel::join(index_of_ids, small_parts);
        let (index, ids) = index?;
        let (slots, (events, event_names), names) = (&index.slots, events?, names?);
        Ok(Layout {
            records: records::clips(clips, numbering, &ids, slots, &names)?,
            locales: records::locales(localised, &names),
            texts: TextOffsets::default(),
            segment_count: numbering.segment_count,
            sources: strings::sources(&sources, slots)?,
            babble: beside.babble,
            faces: beside.faces,
            curves: curves::curves(&with_curves, slots, &event_names)?,
            phones: phones::phones(clips, slots)?,
            articulation: beside.articulation,
            rigs: beside.rigs,
            recordings: recordings::recordings(clips, slots, &beside.recordings),
            voices: voices::voices(dubs, slots)?,
            is_stripped: beside.strip,
            layer: beside.layer.map_or(Ok(Vec::new()), |layer| layer.section(&ids, slots))?,
            export: beside.export,
            order: order(clips, numbering, slots),
            names,
            events,
            index,
        })
    }

    /// Returns the bank, filled from the clips of the layout.
    pub(crate) fn fill(&self, batches: Vec<Clips>) -> Result<Vec<u8>, Report> {
        assemble::assemble(&self.sections(), self.index.seed, self.records.fingerprint, |places| {
            fill::fill(self, batches, places);
        })
    }

    /// Returns the bank with its tables, and zeros in place of the clips' data and the checksum. On Linux, untouched
    /// pages take no memory.
    pub(crate) fn tables(&self) -> Result<Vec<u8>, Report> {
        let (bank, _) =
            assemble::without_checksum(&self.sections(), self.index.seed, self.records.fingerprint, |_| ())?;
        Ok(bank)
    }

    /// Returns the sections in their order.
    fn sections(&self) -> Vec<Section<'_>> {
        let mut sections = vec![
            Section::table(Tag::CLIPS, self.records.clips.as_bytes()),
            Section::table(Tag::KEYS, self.records.keys.as_bytes()),
            Section::table(Tag::RATES, self.records.rates.as_bytes()),
            Section::table(Tag::PILOTS, self.index.pilots.as_bytes()),
            Section::table(Tag::KEY_ORDER, self.index.slots_le.as_bytes()),
            Section::table(Tag::NAMES, self.names.pool.as_bytes()),
            Section::of_clips(Tag::FRAMES, self.records.frame_count),
            Section::table(Tag::STARTS, self.records.starts.as_bytes()),
            Section::table(Tag::LOCALES, self.locales.as_bytes()),
            Section::table(Tag::TEXT_STARTS, self.texts.starts.as_bytes()),
            Section::of_clips(Tag::TEXTS, self.texts.lengths.iter().sum()),
            Section::table(Tag::EVENT_REFS, self.events.references.as_bytes()),
            Section::table(Tag::EVENTS, self.events.records.as_bytes()),
            Section::table(Tag::TYPED_EVENTS, self.events.typed.as_bytes()),
            Section::table(Tag::EVENT_NAMES, self.events.names.as_bytes()),
            Section::table(Tag::EVENT_STRINGS, self.events.pool.as_bytes()),
        ];
        if !self.babble.is_empty() {
            sections.push(Section::table(Tag::BABBLE, &self.babble));
        }
        if !self.faces.is_empty() {
            sections.push(Section::table(Tag::FACES, &self.faces));
        }
        if !self.recordings.is_empty() {
            sections.push(Section::table(Tag::RECORDINGS, self.recordings.as_bytes()));
        }
        if !self.curves.clips.is_empty() {
            sections.push(Section::table(Tag::CURVE_CLIPS, self.curves.clips.as_bytes()));
            sections.push(Section::table(Tag::CURVES, self.curves.curves.as_bytes()));
            sections.push(Section::table(Tag::CURVE_KEYS, &self.curves.keys));
        }
        if !self.phones.clips.is_empty() {
            sections.push(Section::table(Tag::PHONE_CLIPS, self.phones.clips.as_bytes()));
            sections.push(Section::table(Tag::PHONES, &self.phones.phones));
        }
        // A layer replaces the profiles below it even if none of its clips has phones.
        if !self.articulation.is_empty() && (!self.phones.clips.is_empty() || !self.layer.is_empty()) {
            sections.push(Section::table(Tag::ARTICULATION, &self.articulation));
        }
        if !self.rigs.is_empty() {
            sections.push(Section::table(Tag::RIGS, &self.rigs));
        }
        if !self.voices.tags.is_empty() {
            sections.push(Section::table(Tag::VOICES, &self.voices.tags));
            sections.push(Section::table(Tag::DUBS, self.voices.dubs.as_bytes()));
        }
        if !self.is_stripped {
            sections.push(Section::table(Tag::SOURCE_INDEX, self.sources.index.as_bytes()));
            sections.push(Section::of_clips(Tag::SOURCES, self.sources.length));
        }
        if !self.layer.is_empty() {
            sections.push(Section::table(Tag::LAYER, &self.layer));
        }
        if !self.export.is_empty() {
            sections.push(Section::table(Tag::EXPORT, &self.export));
        }
        sections
    }
}

/// Returns the clips in the order of their segments' numbers.
fn order(clips: &[Clip<'_>], numbering: &Numbering, slots: &[u32]) -> Vec<ClipPlace> {
    let place = |at: usize| {
        let (batch, index) = clips[at].place();
        ClipPlace { batch: batch as u32, index: index as u32, slot: slots[at] }
    };
    numbering.order().map(place).collect()
}

/// Returns the diagnostic for two clips with this id. The path of the report is the key of a clip.
fn same_id(clips: &[Clip<'_>], id: u64) -> Report {
    let mut same = clips.iter().map(Clip::key).filter(|key| ClipId::from_key(key).get() == id);
    let (key, next_key) = (same.next().unwrap_or_default(), same.next().unwrap_or_default());
    Report::failure(
        next_key,
        Code::IdCollision,
        format!("the keys `{key}` and `{next_key}` have the same clip id, {id:016x}"),
        "rename one of the two; this happens about once in 10^9 banks of 100,000 clips",
    )
}
