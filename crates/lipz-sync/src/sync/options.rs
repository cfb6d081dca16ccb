//! What a project and a person decide about mouths that are made of recordings.

use super::{Job, model_file};
use crate::facts::unreadable;
use crate::recordings::shown;
use lipz_compiler::Options;
use lipz_compiler::settings::{Settings, Sync};
use lipz_diagnostics::{Code, Diagnostic, Report, Source, Span};
use lipz_file::locale::{TextName, text_name};
use lipz_file::{Document, JsonString, Value};
use lipz_speech::{
    AlignOptions, Language, Lexicon, Model, Pronouncer, Recogniser, RenderRules, RmsRules, TrainedModel,
};
use lipz_types::{Fps, VisemeType};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// The frame rate of clips for which nobody names another.
const DEFAULT_FPS: Fps = Fps::whole(24);

/// How mouths are made.
#[derive(Debug)]
#[non_exhaustive]
pub struct SyncOptions {
    /// What the project decides about its Lipz files.
    pub options: Options,
    /// The locale that is spoken; without it, that of the first text of a clip.
    pub locale: Option<String>,
    /// The viseme type of all mouths, whatever their files say.
    pub viseme_type: Option<VisemeType>,
    /// The frame rate of all mouths, whatever their files say.
    pub fps: Option<Fps>,
    /// Also replace mouths that were made or changed by hand.
    pub force: bool,
    /// What an alignment takes for granted.
    pub(crate) align: AlignOptions,
    /// How shapes become frames.
    pub(crate) rules: RenderRules,
    /// How loudness becomes frames.
    pub(crate) rms: RmsRules,
    /// Where TextGrids of what is heard are.
    pub(crate) textgrids: Option<PathBuf>,
    lexicon: Lexicon,
    trained: Option<Trained>,
    /// What hears phones where there is no text.
    pub(crate) recogniser: Option<Recogniser>,
    pronouncers: Mutex<BTreeMap<&'static str, Arc<Pronouncer>>>,
}

/// A model of the project's own voices.
#[derive(Debug)]
pub(crate) struct Trained {
    model: TrainedModel,
    /// That of its file.
    pub(crate) hash: u64,
}

impl SyncOptions {
    /// What the settings of a project say, and what is wrong with its lexicon.
    ///
    /// # Errors
    /// If the lexicon, the model or the recogniser cannot be read.
    pub fn new(settings: &Settings) -> Result<(SyncOptions, Option<Report>), Report> {
        let sync = &settings.sync;
        let (lexicon, report) = match &sync.lexicon {
            None => Default::default(),
            Some(path) => {
                let bytes = fs::read(path).map_err(|error| unreadable(path, &error))?;
                let mut diagnostics = Vec::new();
                let text = lipz_file::decode(lipz_file::without_byte_order_mark(&bytes), &mut diagnostics);
                let Some(text) = text else { return Err(Report::from_bytes(shown(path), &bytes, diagnostics)) };
                let (lexicon, problems) = Lexicon::parse(text);
                diagnostics.extend(problems.iter().map(|problem| {
                    let span = Span::new(problem.range.start, problem.range.end);
                    Diagnostic::at(Code::Pronunciation, span, problem.kind.to_string()).help(problem.kind.help())
                }));
                settings.options.levels.apply(&mut diagnostics);
                let report =
                    (!diagnostics.is_empty()).then(|| Report::new(Source::new(shown(path), text), diagnostics));
                (lexicon, report)
            }
        };
        let (rules, align) = rules(sync);
        let mut rms = RmsRules::default();
        (rms.lead_us, rms.shortest_pause_us) = (rules.lead_us, align.shortest_pause_us);
        #[allow(clippy::cast_possible_truncation, reason = "a setting with few digits")]
        {
            rms.threshold_db = sync.rms_threshold_db.map_or(rms.threshold_db, |db| db as f32);
            rms.exponent = sync.rms_exponent.map_or(rms.exponent, |exponent| exponent as f32);
        }
        let trained = sync.model.as_deref().map(model_file::read).transpose()?;
        let recogniser = sync.recogniser.as_deref().map(model_file::read_recogniser).transpose()?;
        let mut options = SyncOptions {
            options: settings.options.clone(),
            locale: settings.audio.locale.clone().or_else(|| settings.options.default_locale.clone()),
            viseme_type: settings.options.viseme_type,
            fps: None,
            force: false,
            align,
            rules,
            rms,
            textgrids: sync.textgrids.clone(),
            lexicon,
            trained: None,
            recogniser,
            pronouncers: Mutex::default(),
        };
        trained.into_iter().for_each(|trained| options.set_model(trained));
        Ok((options, report))
    }

    /// Whether the model at `path`, if there is one, is for a language of these jobs.
    ///
    /// # Errors
    /// If no job has its language.
    pub fn check_model(&self, path: &Path, jobs: &[Job]) -> Result<(), Report> {
        let Some(trained) = &self.trained else { return Ok(()) };
        let spoken = |job| self.locale_of(job).and_then(Language::from_locale);
        match jobs.first().and_then(spoken) {
            Some(language) if jobs.iter().all(|job| spoken(job).is_some_and(|own| own != trained.model.language)) => {
                Err(model_file::other_language(path, &trained.model, language))
            }
            _ => Ok(()),
        }
    }

    /// Makes mouths with this model, where its language is spoken.
    pub fn set_model(&mut self, model: TrainedModel) {
        let hash = model_file::hash(&model);
        self.trained = Some(Trained { model, hash });
    }

    /// The trained model for a locale, if there is one.
    pub(crate) fn trained_for(&self, locale: Option<&str>) -> Option<&Trained> {
        let language = locale.and_then(Language::from_locale).unwrap_or(Language::ENGLISH);
        self.trained.as_ref().filter(|trained| trained.model.language == language)
    }

    /// The model for a locale: the trained one, or else the one that is built in.
    pub(crate) fn model_of(&self, locale: Option<&str>) -> &Model {
        self.trained_for(locale).map_or(Model::english(), |trained| &trained.model.model)
    }

    /// The pronouncer of a locale; of English, if none is named.
    pub(crate) fn pronouncer(&self, locale: Option<&str>) -> Arc<Pronouncer> {
        let language = locale.and_then(Language::from_locale).unwrap_or(Language::ENGLISH);
        let mut pronouncers = self.pronouncers.lock().unwrap_or_else(PoisonError::into_inner);
        let new = || Arc::new(Pronouncer::new(language).with_lexicon(self.lexicon.clone()));
        pronouncers.entry(language.code()).or_insert_with(new).clone()
    }

    /// The text that is spoken, and its locale: that in the project's spoken locale. Without one, the first text.
    pub(crate) fn spoken<'d>(
        &self,
        job: &Job,
        document: &'d Document<'d>,
    ) -> Option<(Option<String>, &'d JsonString<'d>)> {
        spoken(document, self.locale_of(job), self.options.default_locale.as_deref())
    }

    /// The text that is spoken in this locale, or in the project's, and its locale.
    pub(crate) fn spoken_in<'d>(
        &self,
        locale: Option<&str>,
        document: &'d Document<'d>,
    ) -> Option<(Option<String>, &'d JsonString<'d>)> {
        spoken(document, locale.or(self.locale.as_deref()), self.options.default_locale.as_deref())
    }

    /// The locale that is spoken in a recording.
    pub(crate) fn locale_of<'a>(&'a self, job: &'a Job) -> Option<&'a str> {
        job.locale.as_deref().or(self.locale.as_deref())
    }

    /// The frame rate of a mouth whose file says this.
    pub(crate) fn fps_of(&self, own: Option<Fps>) -> Fps {
        self.fps.or(own).or(self.options.default_fps).unwrap_or(DEFAULT_FPS)
    }

    /// The viseme type of a mouth whose file says this.
    pub(crate) fn viseme_type_of(&self, own: Option<VisemeType>) -> VisemeType {
        self.viseme_type.or(own).or(self.options.default_viseme_type).unwrap_or(VisemeType::Blair)
    }
}

/// How shapes become frames, and what an alignment takes for granted, as a project has it.
pub(super) fn rules(sync: &Sync) -> (RenderRules, AlignOptions) {
    let (mut rules, mut align) = (RenderRules::default(), AlignOptions::default());
    let us = |ms: Option<u32>, default: u64| ms.map_or(default, |ms| u64::from(ms) * 1000);
    rules.lead_us = us(sync.lead_ms, rules.lead_us);
    rules.hold_us = us(sync.hold_ms, rules.hold_us);
    rules.shortest_wide_us = us(sync.shortest_wide_ms, rules.shortest_wide_us);
    rules.hold_consonants = sync.hold_consonants;
    align.shortest_pause_us = us(sync.shortest_pause_ms, align.shortest_pause_us);
    (rules, align)
}

/// The text that is spoken in `locale`, and its locale. Without one, the first text.
fn spoken<'d>(
    document: &'d Document<'d>,
    locale: Option<&str>,
    default_locale: Option<&str>,
) -> Option<(Option<String>, &'d JsonString<'d>)> {
    let mut texts = document.elements.iter().filter_map(|element| {
        let Value::String(string) = &element.value else { return None };
        let tag = match text_name(&element.name.text)? {
            TextName::Canonical(tag) | TextName::Misspelt(tag) | TextName::OtherShape(_, Some(tag)) => Some(tag),
            TextName::OtherShape(_, None) => return None,
            TextName::NoLocale => default_locale.map(str::to_owned),
        };
        Some((tag, string))
    });
    match locale {
        Some(locale) => texts.find(|(tag, _)| tag.as_ref().is_none_or(|tag| tag == locale)),
        None => texts.next(),
    }
}

/// The text of a Lipz file that is spoken in its recording: in the locale of a voice, or that of the project.
pub(crate) fn spoken_text<'d>(settings: &Settings, voice: Option<&str>, document: &'d Document<'d>) -> Option<&'d str> {
    spoken_string(settings, voice, document).map(|text| &*text.text)
}

/// The same, with its place in the file.
pub(crate) fn spoken_string<'d>(
    settings: &Settings,
    voice: Option<&str>,
    document: &'d Document<'d>,
) -> Option<&'d JsonString<'d>> {
    let default_locale = settings.options.default_locale.as_deref();
    let locale = voice.or(settings.audio.locale.as_deref()).or(default_locale);
    spoken(document, locale, default_locale).map(|(_, text)| text)
}
