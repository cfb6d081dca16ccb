//! The summary of a dialogue.

use crate::bank::dialogue::{TaggedLocale, banks, clips_by_key, length_bytes, locales_by_tag, patches, sections};
use crate::project::articulation::numbers;
use lipz_bank::articulation::ArticulationProfile;
use lipz_bank::babble::Babble;
use lipz_bank::face::FaceProfile;
use lipz_bank::{Bank, Clip, Dialogue, Voice};
use lipz_layout::Tag;

/// The contents of a bank, or of a dialogue of several files.
///
/// ```
/// use lipz_bank::Dialogue;
/// use lipz_bank::files::DialogueFile;
/// use lipz_compiler::{Compiler, Input, inspect::BankSummary};
/// let file = r#"{ "fps": 10, "visemes": "AA|M", "text_en-us": "Aye.|Aye!" }"#;
/// let bytes = Compiler::default().compile(&[Input::from_bytes("aye", file)]).into_bank()?;
/// let mut files = [DialogueFile::ABSENT];
/// let dialogue = Dialogue::open(&mut files, [bytes.as_slice()])?;
/// let summary = BankSummary::from_dialogue(&dialogue);
/// assert_eq!((summary.clips, summary.frames, summary.segments, summary.seconds), (1, 3, 2, 0.3));
/// assert_eq!((summary.locales[0].tag, summary.locales[0].texts), ("en-us", 1));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, PartialEq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
#[non_exhaustive]
pub struct BankSummary<'d> {
    /// The version of the format, `1.0`. With patches, this and all other data of a single file are those of the
    /// topmost one.
    pub format: String,
    /// The length of all banks in bytes, without text banks.
    #[cfg_attr(feature = "json", serde(rename = "bytes"))]
    pub length_bytes: usize,
    /// [`Bank::fingerprint`] in hexadecimal digits.
    pub fingerprint: String,
    /// [`Bank::checksum`] in hexadecimal digits, with which layers identify the banks below them.
    pub checksum: String,
    /// The statements of a layer about the banks below it; `None` if the bank is not a layer.
    pub layer: Option<LayerSummary<'d>>,
    /// The number of clips.
    pub clips: usize,
    /// The number of clips without a frame rate.
    pub clips_without_fps: usize,
    /// The number of frames of all clips.
    pub frames: usize,
    /// The number of segments of all clips.
    pub segments: usize,
    /// The number of curves of all clips.
    pub curves: usize,
    /// The total duration of all clips with a frame rate, in seconds.
    pub seconds: f64,
    /// Whether it contains the source records from which unpacking restores the source files exactly.
    pub has_sources: bool,
    /// The locales, sorted by tag.
    pub locales: Vec<LocaleSummary<'d>>,
    /// The voices, with that of the originals first; none in a bank without dubs.
    pub voices: Vec<VoiceSummary<'d>>,
    /// The length of each section in bytes, in the order of the bank.
    #[cfg_attr(feature = "json", serde(serialize_with = "crate::views::json::sections"))]
    pub sections: Vec<(Tag, usize)>,
    /// The babble profiles.
    #[cfg_attr(feature = "json", serde(serialize_with = "babbles"))]
    pub babble: Vec<Babble<'d>>,
    /// The face profiles.
    #[cfg_attr(feature = "json", serde(serialize_with = "faces"))]
    pub faces: Vec<FaceProfile<'d>>,
    /// The articulation profiles.
    pub articulation: Vec<ArticulationSummary<'d>>,
    /// The rigs.
    pub rigs: Vec<RigSummary<'d>>,
}

/// An articulation profile of a bank.
#[derive(Clone, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
#[non_exhaustive]
pub struct ArticulationSummary<'d> {
    /// Its name.
    pub name: &'d str,
    /// How wide the mouth opens, in percent of the targets.
    pub gain_percent: u16,
    /// How far the jaw moves, in percent of the targets.
    pub jaw_percent: u16,
    /// How many milliseconds the mouth is ahead of the audio.
    pub lead_ms: i16,
    /// The level of speech at which the mouth opens as the targets state, in decibels relative to full scale.
    pub level_db: i16,
}

/// A rig of a bank.
#[derive(Clone, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
#[non_exhaustive]
pub struct RigSummary<'d> {
    /// Its name.
    pub name: &'d str,
    /// The names of its weights.
    pub weights: Vec<&'d str>,
}

impl<'d> ArticulationSummary<'d> {
    fn new(profile: &ArticulationProfile<'d>) -> Self {
        let [.., lead_ms, level_db] = numbers(profile);
        ArticulationSummary {
            name: profile.name(),
            gain_percent: profile.gain_percent(),
            jaw_percent: profile.jaw_percent(),
            lead_ms,
            level_db,
        }
    }
}

/// The statements of a layer about the banks below it.
#[derive(Clone, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
#[non_exhaustive]
pub struct LayerSummary<'d> {
    /// The checksums of the banks that it was made for, from the lowest up.
    pub over: Vec<String>,
    /// The ids of the clips that it removes.
    pub removed_clips: Vec<String>,
    /// The locales that it removes.
    pub removed_locales: Vec<&'d str>,
}

/// The numbers of clips with texts in a locale.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
#[non_exhaustive]
pub struct LocaleSummary<'d> {
    /// The locale, `de-de`.
    pub tag: &'d str,
    /// Whether it is the default one.
    pub is_default: bool,
    /// The number of clips with a text of their own.
    pub texts: usize,
    /// The number of clips that show the text of another locale.
    pub fallbacks: usize,
    /// The number of clips without any text.
    pub missing: usize,
}

/// The number of dubs in a voice.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
#[non_exhaustive]
pub struct VoiceSummary<'d> {
    /// The locale of the voice, `de-de`.
    pub tag: &'d str,
    /// Whether it is that of the originals.
    pub is_original: bool,
    /// The number of dubs in it.
    pub dubs: usize,
}

impl<'d> BankSummary<'d> {
    /// Summarises a verified dialogue, which reads every clip.
    pub fn from_dialogue(dialogue: &'d Dialogue<'d>) -> BankSummary<'d> {
        let clips = clips_by_key(dialogue);
        let last = patches(dialogue).chain(banks(dialogue)).map(|(_, bank)| bank).next();
        let index = dialogue.set_index().filter(|_| patches(dialogue).next().is_none());
        let fingerprint = index.map(|index| index.fingerprint()).or(last.map(Bank::fingerprint));
        let checksum = index.map(|index| index.checksum()).or(last.map(Bank::checksum));
        let (major, minor) = last.map_or((0, 0), Bank::format_version);
        BankSummary {
            format: format!("{major}.{minor}"),
            length_bytes: length_bytes(dialogue),
            fingerprint: hexadecimal(fingerprint.unwrap_or_default()),
            checksum: hexadecimal(checksum.unwrap_or_default()),
            layer: last.and_then(LayerSummary::new),
            clips: clips.len(),
            clips_without_fps: clips.iter().filter(|clip| clip.fps().is_none()).count(),
            frames: clips.iter().map(|clip| clip.frame_count() as usize).sum(),
            segments: clips.iter().map(|clip| clip.segment_count() as usize).sum(),
            curves: clips.iter().map(|clip| clip.curves().count()).sum(),
            seconds: clips.iter().filter_map(Clip::duration_us).fold(0.0, |sum, us| sum + us as f64 / 1e6),
            has_sources: banks(dialogue).all(|(_, bank)| bank.sections().any(|(tag, _)| tag == Tag::SOURCES.0)),
            locales: locales_by_tag(dialogue).into_iter().map(|locale| LocaleSummary::new(&clips, locale)).collect(),
            voices: dialogue.voices().map(|voice| VoiceSummary::new(dialogue, &clips, voice)).collect(),
            sections: sections(dialogue),
            babble: dialogue.babbles().collect(),
            faces: dialogue.face_profiles().collect(),
            articulation: dialogue.articulations().map(|profile| ArticulationSummary::new(&profile)).collect(),
            rigs: dialogue
                .rigs()
                .map(|rig| RigSummary { name: rig.name(), weights: rig.weight_names().collect() })
                .collect(),
        }
    }
}

impl<'d> LayerSummary<'d> {
    fn new(bank: &Bank<'d>) -> Option<LayerSummary<'d>> {
        let layer = bank.layer()?;
        Some(LayerSummary {
            over: layer.made_over().map(hexadecimal).collect(),
            removed_clips: layer.removed_clips().map(|id| hexadecimal(id.get())).collect(),
            removed_locales: layer.removed_locales().collect(),
        })
    }
}

/// Returns a checksum or an id in the usual notation.
fn hexadecimal(number: u64) -> String {
    format!("{number:016x}")
}

impl<'d> LocaleSummary<'d> {
    fn new(clips: &[Clip<'_>], TaggedLocale { tag, locale, is_default }: TaggedLocale<'d>) -> Self {
        let mut summary = LocaleSummary { tag, is_default, texts: 0, fallbacks: 0, missing: 0 };
        for clip in clips {
            match clip.segment(0).and_then(|segment| segment.text(locale)) {
                Some(text) if text.is_fallback() => summary.fallbacks += 1,
                Some(_) => summary.texts += 1,
                None => summary.missing += 1,
            }
        }
        summary
    }
}

impl<'d> VoiceSummary<'d> {
    fn new(dialogue: &Dialogue<'d>, clips: &[Clip<'_>], voice: Voice) -> Self {
        let is_dub = |clip: &&Clip<'_>| clip.original().is_some() && clip.voice() == Some(voice);
        let dubs = clips.iter().filter(is_dub).count();
        VoiceSummary { tag: dialogue.voice_tag(voice), is_original: voice.is_original(), dubs }
    }
}

#[cfg(feature = "json")]
fn babbles<S: serde::Serializer>(babbles: &[Babble<'_>], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(babbles.iter().map(|babble| crate::views::json::Profile::from(*babble)))
}

#[cfg(feature = "json")]
fn faces<S: serde::Serializer>(faces: &[FaceProfile<'_>], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(faces.iter().map(|profile| crate::views::json::Face::from(*profile)))
}
