//! Splitting a bank by voice: a base bank without dubs, and a layer over it for each voice.

use super::between::between;
use super::merge::merge_of;
use super::stack::MAX_LAYERS;
use crate::compile::verify;
use lipz_bank::{Bank, ClipId, LayeredClip, Layers};
use lipz_diagnostics::{Code, Report};
use std::collections::HashMap;

/// A bank, split by voice.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct VoiceBanks {
    /// The bank without dubs.
    pub base: Vec<u8>,
    /// Locale and bank of each voice that has dubs, in the order of the locales. Each is a layer over the base, whichever of
    /// the others are there.
    pub voices: Vec<(String, Vec<u8>)>,
}

impl VoiceBanks {
    /// Splits a bank of the [`Compiler`](crate::Compiler). The base and the banks of all voices are a stack that answers as
    /// the whole bank, and is merged into it. In a voice whose bank is not there, the original is played.
    ///
    /// ```
    /// use lipz_compiler::{Compiler, Input, Options, VoiceBanks, Voices};
    /// let file = r#"{ "visemes": "MAE", "text_en-us": "Aye." }"#;
    /// let options = Options::new().voices(Voices::new("en-us").dub("de-de", "de/{key}"));
    /// let inputs = ["aye", "de/aye"].map(|key| Input::from_bytes(key, file));
    /// let bank = Compiler::new(options).compile(&inputs).into_bank()?;
    /// let split = VoiceBanks::from_bytes(&bank).map_err(|report| report.to_string())?;
    /// let base = lipz_bank::Bank::open(&split.base)?.verify()?;
    /// let german = lipz_bank::Bank::open(&split.voices[0].1)?.verify()?;
    /// let layers = lipz_bank::Layers::new([base, german])?;
    /// let voice = layers.voice("de-de").ok_or("no German")?;
    /// let clip = layers.clip_by_key("aye").ok_or("no clip")?;
    /// assert_eq!(clip.in_voice(&voice).clip.key(), "de/aye");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// If `bytes` are not a bank, or if it is a layer or has its texts in text banks.
    pub fn from_bytes(bytes: &[u8]) -> Result<VoiceBanks, Report> {
        let failed = |message: &str| Report::failure("", Code::BankDamaged, message, "pack it again");
        let whole = Bank::open(bytes).and_then(Bank::verify).map_err(|error| failed(error.kind().message()))?;
        let layers =
            Layers::<MAX_LAYERS>::from_slice(&[whole]).map_err(|error| failed(error.error().kind().message()))?;
        let dubs = layers.clips().filter_map(|clip| {
            clip.original(&layers)?;
            Some((clip.id(), clip.voice(&layers)?.tag()))
        });
        let dubs: HashMap<ClipId, &str> = dubs.collect();
        let voice_of = |clip: &LayeredClip<'_, '_>| dubs.get(&clip.id()).copied();
        let base = merge_of(&layers, &[], &|clip| voice_of(clip).is_none())?;
        verify(&base)?;
        let opened = Bank::open(&base).map_err(|error| failed(error.kind().message()))?;
        let mut voices = Vec::new();
        for voice in layers.voices().skip(1) {
            if !dubs.values().any(|tag| *tag == voice.tag()) {
                continue;
            }
            let dubbed = merge_of(&layers, &[], &|clip| voice_of(clip).is_none_or(|tag| tag == voice.tag()))?;
            verify(&dubbed)?;
            let new = Bank::open(&dubbed).map_err(|error| failed(error.kind().message()))?;
            if let Some(layer) = between(&opened, &new, &[opened.checksum()])? {
                verify(&layer)?;
                voices.push((voice.tag().to_owned(), layer));
            }
        }
        Ok(VoiceBanks { base, voices })
    }
}
