//! Lip sync of a recording and its text in one call.

use crate::{
    AlignOptions, AlignedWord, Aligner, Alignment, Language, Lexicon, Model, Mouth, Problem, Pronouncer, Reading,
    Recogniser, RenderRules, RmsRules, Script, Sound, SoundError, Word, render, rms,
};
use lipz_types::{Fps, VisemeType};
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

/// Makes visemes from recordings and their texts.
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
/// By default, the lip-sync track uses [`VisemeType::Blair`] at 24 frames per second, with the rules and the model of
/// the command `lipz sync`. To change a step in between, call [`Pronouncer`], [`Aligner`] and [`render`] yourself. The
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

/// A recorded line with its lip-sync track.
#[derive(Clone, PartialEq, Debug)]
#[non_exhaustive]
pub struct SyncedLine {
    /// The lip-sync track, with a viseme for every frame.
    pub mouth: Mouth,
    /// The times of all phones and words of the script, and the differences between recording and text.
    pub alignment: Alignment,
    /// The words of the text with their pronunciations. Without a text, the phones that a recogniser found, in the IPA.
    pub script: Script,
    /// Parts of the text that could not be used, such as an unknown phone in `{say: …}`. Ranges are bytes of the text.
    pub problems: Vec<Problem>,
}

impl SyncedLine {
    /// Returns the words of the line, each with its time.
    pub fn words(&self) -> impl Iterator<Item = (&Word, &AlignedWord)> {
        self.script.words.iter().zip(&self.alignment.words)
    }
}

impl LipSync<'static> {
    /// Returns a lip sync for texts in this language.
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

    /// Sets the viseme type. [`VisemeType::Rms`] follows the loudness, like [`rms`], instead of the words.
    #[must_use]
    pub fn viseme_type(self, viseme_type: VisemeType) -> LipSync<'m> {
        LipSync { viseme_type, ..self }
    }

    /// Sets the rules that turn phones into frames.
    #[must_use]
    pub fn rules(self, rules: RenderRules) -> LipSync<'m> {
        LipSync { rules, ..self }
    }

    /// Adds a project's own pronunciations.
    #[must_use]
    pub fn lexicon(self, lexicon: Lexicon) -> LipSync<'m> {
        LipSync { pronouncer: self.pronouncer.with_lexicon(lexicon), ..self }
    }

    /// Aligns with this model, such as a [`TrainedModel`](crate::TrainedModel), instead of the built-in English one.
    #[must_use]
    pub fn model(self, model: &'m Model) -> LipSync<'m> {
        LipSync { model, ..self }
    }

    /// Lets [`file`](LipSync::file) use this recogniser in place of the built-in one, and compare every recording with its
    /// text. The built-in one compares only those for which the aligner is [uncertain](Alignment::is_uncertain).
    #[must_use]
    pub fn recogniser(self, recogniser: &'m Recogniser) -> LipSync<'m> {
        LipSync { recogniser: Some(recogniser), ..self }
    }

    /// Returns the visemes of a WAV, AIFF, FLAC, Ogg Vorbis or MP3 file in which `text` is spoken.
    ///
    /// The text has the form used in Lipz files, with `|` between segments and `{meta}`. If it has no words, the built-in
    /// recogniser finds phones, which is less exact.
    ///
    /// # Errors
    /// If the file cannot be read as a recording. A recording that does not match the text is not an error: see
    /// [`Alignment::mismatches`].
    pub fn file(&self, recording: impl AsRef<Path>, text: &str) -> Result<SyncedLine, SoundError> {
        let path = recording.as_ref();
        let extension = path.extension().and_then(|extension| extension.to_str());
        let open = || File::open(path).map(BufReader::new).map_err(SoundError::Io);
        let sound = Sound::read(open()?, extension)?;
        let reading = self.pronouncer.read(text);
        let hear = |recogniser: &Recogniser| recogniser.hear(open()?, extension);
        if reading.script.words.is_empty() && !sound.is_silent() {
            let heard = hear(self.recogniser.unwrap_or(Recogniser::built_in()))?;
            let line = self.line(&sound, Reading { script: heard.script(), ..reading });
            return sound.intact(line);
        }
        let mut line = self.line(&sound, reading);
        let built_in = || line.alignment.is_uncertain().then(Recogniser::built_in);
        let is_compared = !line.script.words.is_empty() && !sound.is_silent();
        if let Some(recogniser) = self.recogniser.or_else(built_in).filter(|_| is_compared) {
            line.alignment.mismatches = hear(recogniser)?.mismatches(&line.script, &line.alignment);
        }
        sound.intact(line)
    }

    /// Returns the visemes of audio in which `text` is spoken, like [`file`](LipSync::file), but
    /// without a recogniser.
    ///
    /// ```
    /// use lipz_speech::{Language, LipSync, Sound};
    /// let samples = vec![0.0; 16_000]; // one second
    /// let line = LipSync::new(Language::ENGLISH).sound(&Sound::from_samples(&samples, 16_000)?, "Aye.");
    /// assert_eq!(line.mouth.frames.len(), 24);
    /// # Ok::<(), lipz_speech::SoundError>(())
    /// ```
    pub fn sound(&self, sound: &Sound, text: &str) -> SyncedLine {
        self.line(sound, self.pronouncer.read(text))
    }

    fn line(&self, sound: &Sound, Reading { script, problems }: Reading) -> SyncedLine {
        let aligner = Aligner::new(self.model, AlignOptions::default());
        let alignment = match script.words.is_empty() {
            true => aligner.listen(sound),
            false => aligner.align(sound, &script),
        };
        let mut mouth = render(&alignment, self.fps, self.viseme_type, &self.rules);
        if self.viseme_type == VisemeType::Rms {
            let rules = RmsRules { lead_us: self.rules.lead_us, ..RmsRules::default() };
            mouth.frames = rms(sound, self.fps, &rules).frames;
        }
        SyncedLine { mouth, alignment, script, problems }
    }
}
