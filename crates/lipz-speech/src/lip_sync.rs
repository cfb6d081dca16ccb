//! From a recording and its text to mouth frames, in one call.

use crate::{
    AlignOptions, AlignedWord, Aligner, Alignment, Heard, Language, Lexicon, Model, Mouth, Problem, Pronouncer,
    Recogniser, RenderRules, RmsRules, Script, Sound, SoundError, Word, render, rms,
};
use lipz_types::{Fps, VisemeType};
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

/// Makes mouth frames from recordings and their texts.
///
/// ```no_run
/// use lipz_speech::{Fps, Language, LipSync, VisemeType};
/// let lip_sync = LipSync::new(Language::ENGLISH).fps(Fps::whole(30)).viseme_type(VisemeType::Blair);
/// let line = lip_sync.file("mara-hello.wav", "Good evening, Mara.")?;
/// println!("{}", line.mouth.frames);
/// for (word, time) in line.words() {
///     println!("{:8} {:8} {}", time.start_us, time.end_us, word.text);
/// }
/// # Ok::<(), lipz_speech::SoundError>(())
/// ```
///
/// Without further calls, the mouth has [`VisemeType::Blair`] and 24 frames per second, and the rules and the model are those
/// of the command `lipz sync`. To change a step in between, call [`Pronouncer`], [`Aligner`] and [`render`] yourself: the
/// fields of [`SyncedLine`] are their results.
#[derive(Clone, Debug)]
pub struct LipSync<'m> {
    pronouncer: Pronouncer,
    model: &'m Model,
    recogniser: Option<&'m Recogniser>,
    fps: Fps,
    viseme_type: VisemeType,
    rules: RenderRules,
}

/// A recorded line with its mouth.
#[derive(Clone, PartialEq, Debug)]
#[non_exhaustive]
pub struct SyncedLine {
    /// The mouth: a viseme for every frame.
    pub mouth: Mouth,
    /// When each phone and word of the script is said, and where the recording and the text differ.
    pub alignment: Alignment,
    /// The words of the text with their pronunciations; without a text, what a recogniser hears, in the IPA.
    pub script: Script,
    /// Parts of the text that could not be used, such as an unknown phone in `{say: …}`. Ranges are bytes of the text.
    pub problems: Vec<Problem>,
}

impl SyncedLine {
    /// The words of the line, each with its time.
    pub fn words(&self) -> impl Iterator<Item = (&Word, &AlignedWord)> {
        self.script.words.iter().zip(&self.alignment.words)
    }
}

impl LipSync<'static> {
    /// Lip sync of texts in this language.
    #[must_use]
    pub fn new(language: Language) -> LipSync<'static> {
        LipSync {
            pronouncer: Pronouncer::new(language),
            model: Model::english(),
            recogniser: None,
            fps: Fps::whole(24),
            viseme_type: VisemeType::Blair,
            rules: RenderRules::default(),
        }
    }
}

impl<'m> LipSync<'m> {
    /// Sets the frames per second.
    #[must_use]
    pub fn fps(self, fps: Fps) -> LipSync<'m> {
        LipSync { fps, ..self }
    }

    /// Sets the viseme type. [`VisemeType::Rms`] follows the loudness, as [`rms`] does, and not the words.
    #[must_use]
    pub fn viseme_type(self, viseme_type: VisemeType) -> LipSync<'m> {
        LipSync { viseme_type, ..self }
    }

    /// Sets how phones become frames.
    #[must_use]
    pub fn rules(self, rules: RenderRules) -> LipSync<'m> {
        LipSync { rules, ..self }
    }

    /// Adds pronunciations of a project's own words.
    #[must_use]
    pub fn lexicon(self, lexicon: Lexicon) -> LipSync<'m> {
        LipSync { pronouncer: self.pronouncer.with_lexicon(lexicon), ..self }
    }

    /// Aligns with this model in place of the English one that is built in, such as a [`TrainedModel`](crate::TrainedModel).
    #[must_use]
    pub fn model(self, model: &'m Model) -> LipSync<'m> {
        LipSync { model, ..self }
    }

    /// Lets [`file`](LipSync::file) find phones with this recogniser where there is no text, and compare the recording with the
    /// text where there is one.
    #[must_use]
    pub fn recogniser(self, recogniser: &'m Recogniser) -> LipSync<'m> {
        LipSync { recogniser: Some(recogniser), ..self }
    }

    /// The mouth of a WAV, AIFF, FLAC, Ogg Vorbis or MP3 file in which `text` is said.
    ///
    /// The text is that of a Lipz file, with `|` between segments and `{meta}`. If it has no words, phones are found without it,
    /// which is less exact.
    ///
    /// # Errors
    /// If the file cannot be read as a recording. That it does not belong to the text is no error: see
    /// [`Alignment::mismatches`].
    pub fn file(&self, recording: impl AsRef<Path>, text: &str) -> Result<SyncedLine, SoundError> {
        let path = recording.as_ref();
        let extension = path.extension().and_then(|extension| extension.to_str());
        let open = || File::open(path).map(BufReader::new).map_err(SoundError::Io);
        let sound = Sound::read(open()?, extension)?;
        let heard = self.recogniser.map(|recogniser| recogniser.hear(open()?, extension)).transpose()?;
        Ok(self.line(&sound, text, heard.as_ref()))
    }

    /// The mouth of a sound in which `text` is said, as [`file`](LipSync::file) makes it without a recogniser.
    ///
    /// ```
    /// use lipz_speech::{Language, LipSync, Sound};
    /// let samples = vec![0.0; 16_000]; // one second
    /// let line = LipSync::new(Language::ENGLISH).sound(&Sound::from_samples(&samples, 16_000)?, "Aye.");
    /// assert_eq!(line.mouth.frames.len(), 24);
    /// # Ok::<(), lipz_speech::SoundError>(())
    /// ```
    pub fn sound(&self, sound: &Sound, text: &str) -> SyncedLine {
        self.line(sound, text, None)
    }

    fn line(&self, sound: &Sound, text: &str, heard: Option<&Heard>) -> SyncedLine {
        let reading = self.pronouncer.read(text);
        let has_text = !reading.script.words.is_empty();
        let script = heard.filter(|_| !has_text).map_or(reading.script, Heard::script);
        let aligner = Aligner::new(self.model, AlignOptions::default());
        let mut alignment = match script.words.is_empty() {
            true => aligner.listen(sound),
            false => aligner.align(sound, &script),
        };
        if let Some(heard) = heard.filter(|_| has_text) {
            alignment.mismatches = heard.mismatches(&script, &alignment);
        }
        let mut mouth = render(&alignment, self.fps, self.viseme_type, &self.rules);
        if self.viseme_type == VisemeType::Rms {
            let rules = RmsRules { lead_us: self.rules.lead_us, ..RmsRules::default() };
            mouth.frames = rms(sound, self.fps, &rules).frames;
        }
        SyncedLine { mouth, alignment, script, problems: reading.problems }
    }
}
