//! Coverage of voices: the dubbed lines of a bank.

use crate::bank::dialogue::clips_by_key;
use crate::project::Voices;
use lipz_bank::{Clip, Dialogue, Recording, Voice, VoiceSource};
use std::collections::BTreeMap;

/// The lines of a bank that have or lack a dub in one voice. Lines are clips with visemes that are not dubs.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
#[non_exhaustive]
pub struct VoiceCoverage {
    /// The locale of the voice, `de-de`.
    #[cfg_attr(feature = "json", serde(rename = "voice"))]
    pub tag: String,
    /// Whether it is the voice of the originals.
    pub is_original: bool,
    /// The number of lines in the bank.
    pub lines: usize,
    /// The number of lines with a clip in this voice.
    pub dubbed: usize,
    /// The total duration of those clips in microseconds, without clips that have no frame rate.
    pub dubbed_us: u64,
    /// The total length of their recordings in microseconds, as far as the bank contains it.
    pub recordings_us: u64,
    /// Keys of the originals of lines that play the dub of another voice, by the locale of that voice.
    pub other_voices: BTreeMap<String, Vec<String>>,
    /// Keys of the lines that play the original.
    pub missing: Vec<String>,
    /// The total duration in microseconds of the originals of all lines without a clip in this voice, as an estimate of
    /// the recordings to make.
    pub to_record_us: u64,
}

impl VoiceCoverage {
    /// Returns the percentage of lines with a clip in this voice; 100 if there is nothing to record.
    pub fn percent(&self) -> f64 {
        if self.lines == 0 { 100.0 } else { self.dubbed as f64 * 100.0 / self.lines as f64 }
    }
}

/// Returns the coverage of each voice of a dialogue, with that of the originals first; empty without dubs.
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
                VoiceSource::OtherDub => {
                    let other = voiced.clip.voice().map_or("", |voice| dialogue.voice_tag(voice));
                    found.other_voices.entry(other.to_owned()).or_default().push(line.key().to_owned());
                }
                VoiceSource::Original if !found.is_original => found.missing.push(line.key().to_owned()),
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

/// Returns the coverage including the voices that a project plans, which a bank without dubs does not contain: all of
/// their lines are missing.
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

/// Returns the clips with visemes that are not dubs.
fn lines<'d>(dialogue: &'d Dialogue<'d>) -> Vec<Clip<'d>> {
    let clips = clips_by_key(dialogue).into_iter();
    clips.filter(|clip| clip.frame_count() > 0 && clip.original().is_none()).collect()
}
