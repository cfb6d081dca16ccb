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
    warnings: Option<Report>,
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
    /// The options of a project, with its lexicon, its model and its recogniser. They keep the
    /// [warnings](SyncOptions::warnings) about the lexicon.
    ///
    /// # Errors
    /// If one of these files cannot be read, or the project makes a problem of the lexicon an error.
    pub fn new(settings: &Settings) -> Result<SyncOptions, Report> {
        let (mut options, report) = SyncOptions::new_with_report(settings)?;
        if let Some(report) = report.as_ref().filter(|report| report.has_errors()) {
            return Err(report.clone());
        }
        options.warnings = report;
        Ok(options)
    }

    /// The warnings about the lexicon: lines that are not used.
    pub fn warnings(&self) -> &[Report] {
        self.warnings.as_slice()
    }

    /// The options of a project, and the problems of its lexicon, whatever level they have in the project.
    ///
    /// For tools that report everything at once and go on, such as the command `lipz`. All other programs call
    /// [`new`](SyncOptions::new).
    ///
    /// # Errors
    /// If the lexicon, the model or the recogniser cannot be read.
    pub fn new_with_report(settings: &Settings) -> Result<(SyncOptions, Option<Report>), Report> {
        let sync = &settings.sync;
        let (lexicon, report) = match &sync.lexicon {
            None => Default::default(),
            Some(path) => {
                let bytes = fs::read(path).map_err(|error| unreadable(path, &error))?;
                let mut diagnostics = Vec::new();
                let text = lipz_file::decode(lipz_file::without_byte_order_mark(&bytes), &mut diagnostics);
                let Some(text) = text else { return Err(Report::from_bytes(shown(path), &bytes, diagnostics)) };
                let lexicon = Lexicon::parse(text);
                diagnostics.extend(lexicon.problems().iter().map(|problem| {
                    let span = Span::new(problem.range.start, problem.range.end);
                    Diagnostic::at(Code::Pronunciation, span, problem.kind.to_string()).help(problem.kind.help())
                }));
                settings.options.get_levels().apply(&mut diagnostics);
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
            locale: settings.audio.locale.clone().or_else(|| settings.options.get_default_locale().map(str::to_owned)),
            viseme_type: settings.options.get_viseme_type(),
            fps: None,
            force: false,
            align,
            rules,
            rms,
            textgrids: sync.textgrids.clone(),
            lexicon,
            warnings: None,
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
        spoken(document, self.locale_of(job), self.options.get_default_locale())
    }

    /// The text that is spoken in this locale, or in the project's, and its locale.
    pub(crate) fn spoken_in<'d>(
        &self,
        locale: Option<&str>,
        document: &'d Document<'d>,
    ) -> Option<(Option<String>, &'d JsonString<'d>)> {
        spoken(document, locale.or(self.locale.as_deref()), self.options.get_default_locale())
    }

    /// The locale that is spoken in a recording.
    pub(crate) fn locale_of<'a>(&'a self, job: &'a Job) -> Option<&'a str> {
        job.locale.as_deref().or(self.locale.as_deref())
    }

    /// The frame rate of a mouth whose file says this.
    pub(crate) fn fps_of(&self, own: Option<Fps>) -> Fps {
        self.fps.or(own).or(self.options.get_default_fps()).unwrap_or(DEFAULT_FPS)
    }

    /// The viseme type of a mouth whose file says this.
    pub(crate) fn viseme_type_of(&self, own: Option<VisemeType>) -> VisemeType {
        self.viseme_type.or(own).or(self.options.get_default_viseme_type()).unwrap_or(VisemeType::Blair)
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
    let default_locale = settings.options.get_default_locale();
    let locale = voice.or(settings.audio.locale.as_deref()).or(default_locale);
    spoken(document, locale, default_locale).map(|(_, text)| text)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn problems_of_the_lexicon_are_warnings_or_errors_as_the_project_says() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("words.txt"), "mara  M AE QQ\n").unwrap();
        let settings = |lints: &str| {
            let text = format!("[sync]\nlexicon = \"words.txt\"\n[lints]\n{lints}");
            Settings::parse(text, "lipz.toml", folder.path()).unwrap()
        };
        let options = SyncOptions::new(&settings("")).unwrap();
        assert_eq!(options.warnings()[0].diagnostics[0].code, Code::Pronunciation);
        let denied = settings("pronunciation = \"deny\"\n");
        let error = SyncOptions::new(&denied).unwrap_err();
        assert_eq!(SyncOptions::new_with_report(&denied).unwrap().1, Some(error));
        fs::remove_file(folder.path().join("words.txt")).unwrap();
        assert!(SyncOptions::new(&settings("")).unwrap_err().to_string().contains("words.txt"));
    }
}
