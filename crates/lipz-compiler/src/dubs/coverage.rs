//! Coverage of voices: which lines of a bank are dubbed.

use crate::Voices;
use crate::dialogue::clips_by_key;
use lipz_bank::{Clip, Dialogue, Recording, Spoken, Voice};
use std::collections::BTreeMap;

/// How the lines of a bank are covered by the dubs of one voice. Lines are clips with mouth shapes that are no dubs.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
#[non_exhaustive]
pub struct VoiceCoverage {
    /// The locale of the voice, `de-de`.
    #[cfg_attr(feature = "json", serde(rename = "voice"))]
    pub tag: String,
    /// Whether it is the voice of the originals: they are its clips.
    pub is_original: bool,
    /// Lines of the bank.
    pub lines: usize,
    /// Of these, lines that have a clip in this voice.
    pub dubbed: usize,
    /// The times of those clips, in microseconds; clips without a frame rate do not count.
    pub dubbed_us: u64,
    /// The lengths of their recordings, in microseconds, as far as the bank knows them.
    pub recordings_us: u64,
    /// Lines for which the dub in another voice is played, by the locale of that voice: the keys of the originals.
    pub other_voices: BTreeMap<String, Vec<String>>,
    /// Lines for which the original is played: their keys.
    pub missing: Vec<String>,
    /// The times of the originals of all lines without a clip in this voice, in microseconds: about what is to be recorded.
    pub to_record_us: u64,
}

impl VoiceCoverage {
    /// Lines with a clip in this voice, in percent; 100 if there is nothing to record.
    pub fn percent(&self) -> f64 {
        if self.lines == 0 { 100.0 } else { self.dubbed as f64 * 100.0 / self.lines as f64 }
    }
}

/// The coverage of each voice of a dialogue: that of the originals comes first. None without dubs.
///
/// ```
/// use lipz_compiler::{Compiler, Input, Options, Voices, voice_coverage};
/// let file = r#"{ "visemes": "MAE", "text_en-us": "Aye." }"#;
/// let inputs = ["aye", "de/aye", "no"].map(|key| Input::from_bytes(key, file));
/// let options = Options::new().voices(Voices::new("en-us")?.dub("de-de", "de/{key}")?);
/// let bytes = Compiler::new(options).compile(&inputs).bank.ok_or("no bank")?;
/// let mut files = [lipz_bank::files::DialogueFile::ABSENT];
/// let german = &voice_coverage(&lipz_bank::Dialogue::open(&mut files, [bytes.as_slice()])?)[1];
/// assert_eq!((german.tag.as_str(), german.percent()), ("de-de", 50.0));
/// assert_eq!(german.missing, ["no"]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn voice_coverage(dialogue: &Dialogue<'_>) -> Vec<VoiceCoverage> {
    let lines = lines(dialogue);
    let of_voice = |voice: Voice| {
        let mut found = VoiceCoverage {
            tag: dialogue.voice_tag(voice).to_owned(),
            is_original: voice.is_original(),
            lines: lines.len(),
            ..VoiceCoverage::default()
        };
        for line in &lines {
            let voiced = line.in_voice(voice);
            match voiced.spoken {
                Spoken::OtherDub => {
                    let other = voiced.clip.voice().map_or("", |voice| dialogue.voice_tag(voice));
                    found.other_voices.entry(other.to_owned()).or_default().push(line.key().to_owned());
                }
                Spoken::Original if !found.is_original => found.missing.push(line.key().to_owned()),
                _ => {
                    found.dubbed += 1;
                    found.dubbed_us = found.dubbed_us.saturating_add(voiced.clip.duration_us().unwrap_or(0));
                    let recording = voiced.clip.recording().map_or(0, Recording::length_us);
                    found.recordings_us = found.recordings_us.saturating_add(recording);
                    continue;
                }
            }
            found.to_record_us = found.to_record_us.saturating_add(line.duration_us().unwrap_or(0));
        }
        found
    };
    dialogue.voices().map(of_voice).collect()
}

/// The same for the voices that a project plans, of which a bank knows nothing while nobody has recorded a dub: the lines of all
/// but the original's are missing.
pub fn voice_coverage_of(dialogue: &Dialogue<'_>, planned: &Voices) -> Vec<VoiceCoverage> {
    let found = voice_coverage(dialogue);
    let Some(original) = planned.original.as_ref().filter(|_| found.is_empty()) else { return found };
    let lines = lines(dialogue);
    let length_us = |clip: &Clip<'_>| clip.duration_us().unwrap_or(0);
    let all_us = lines.iter().map(length_us).fold(0, u64::saturating_add);
    let recordings = lines.iter().map(|clip| clip.recording().map_or(0, Recording::length_us));
    let of_original = VoiceCoverage {
        tag: original.clone(),
        is_original: true,
        lines: lines.len(),
        dubbed: lines.len(),
        dubbed_us: all_us,
        recordings_us: recordings.fold(0, u64::saturating_add),
        ..VoiceCoverage::default()
    };
    let of_dub = |tag: &String| VoiceCoverage {
        tag: tag.clone(),
        lines: lines.len(),
        missing: lines.iter().map(|line| line.key().to_owned()).collect(),
        to_record_us: all_us,
        ..VoiceCoverage::default()
    };
    let dubs: Vec<VoiceCoverage> = planned.patterns.keys().filter(|tag| *tag != original).map(of_dub).collect();
    if dubs.is_empty() { dubs } else { std::iter::once(of_original).chain(dubs).collect() }
}

/// Clips with mouth shapes that are no dubs.
fn lines<'d>(dialogue: &'d Dialogue<'d>) -> Vec<Clip<'d>> {
    let clips = clips_by_key(dialogue).into_iter();
    clips.filter(|clip| clip.frame_count() > 0 && clip.original().is_none()).collect()
}
