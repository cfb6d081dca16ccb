//! Splitting a bank by voice: a base bank without dubs, and a layer on top of it for each voice.

use super::between::between;
use super::merge::merge_of;
use super::stack::refuse_part;
use crate::bank::verify::verify;
use lipz_bank::files::DialogueFile;
use lipz_bank::{Bank, Clip, ClipId, Dialogue};
use lipz_diagnostics::{Code, Report};
use std::collections::HashMap;

/// A bank, split by voice.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct VoiceBanks {
    /// The bank without dubs.
    pub base: Vec<u8>,
    /// Locale and bank of each voice that has dubs, sorted by locale. Each is a layer on top of the base, independent
    /// of the others.
    pub voices: Vec<(String, Vec<u8>)>,
}

impl VoiceBanks {
    /// Splits a bank of the [`Compiler`](crate::Compiler). The stack of the base and the banks of all voices returns
    /// the same answers as the whole bank, and can be merged into it. If the bank of a voice is missing, the original
    /// is played.
    ///
    /// ```
    /// use lipz_compiler::{Compiler, Input, Options, VoiceBanks, Voices};
    /// let file = r#"{ "visemes": "MAE", "text_en-us": "Aye." }"#;
    /// let options = Options::new().voices(Voices::new("en-us")?.dub("de-de", "de/{key}")?);
    /// let inputs = ["aye", "de/aye"].map(|key| Input::from_bytes(key, file));
    /// let bank = Compiler::new(options).compile(&inputs).into_bank()?;
    /// let split = VoiceBanks::from_bytes(&bank).map_err(|report| report.to_string())?;
    /// let mut files = [lipz_bank::files::DialogueFile::ABSENT; 2];
    /// let dialogue = lipz_bank::Dialogue::open(&mut files, [&split.base[..], &split.voices[0].1])?;
    /// let voice = dialogue.voice("de-de").ok_or("no German")?;
    /// let clip = dialogue.clip_by_key("aye").ok_or("no clip")?;
    /// assert_eq!(clip.in_voice(voice).clip.key(), "de/aye");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// If `bytes` are not a bank, or are a layer or a bank with separate text banks.
    pub fn from_bytes(bytes: &[u8]) -> Result<VoiceBanks, Report> {
        let failed = |message: &str| Report::failure("", Code::BankDamaged, message, "pack it again");
        let mut files = [DialogueFile::ABSENT];
        let dialogue = Dialogue::open(&mut files, [bytes]).map_err(|found| failed(found.error().kind().message()))?;
        refuse_part("", &dialogue)?;
        let dubs = dialogue.clips().filter_map(|clip| {
            clip.original()?;
            Some((clip.id(), dialogue.voice_tag(clip.voice()?)))
        });
        let dubs: HashMap<ClipId, &str> = dubs.collect();
        let voice_of = |clip: &Clip<'_>| dubs.get(&clip.id()).copied();
        let base = merge_of(&dialogue, &|clip| voice_of(clip).is_none())?;
        verify(&base)?;
        let opened = Bank::open(&base).map_err(|error| failed(error.kind().message()))?;
        let mut voices = Vec::new();
        for tag in dialogue.voices().skip(1).map(|voice| dialogue.voice_tag(voice)) {
            if !dubs.values().any(|of| *of == tag) {
                continue;
            }
            let dubbed = merge_of(&dialogue, &|clip| voice_of(clip).is_none_or(|of| of == tag))?;
            verify(&dubbed)?;
            let new = Bank::open(&dubbed).map_err(|error| failed(error.kind().message()))?;
            if let Some(layer) = between(&opened, &new, &[opened.checksum()])? {
                verify(&layer)?;
                voices.push((tag.to_owned(), layer));
            }
        }
        Ok(VoiceBanks { base, voices })
    }
}
