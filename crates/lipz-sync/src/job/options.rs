//! The options of lip sync.

use crate::job::{Job, model_file};
use crate::recordings::file_facts::unreadable;
use crate::recordings::paths::shown;
use crate::recordings::transcript::spoken;
use lipz_compiler::Options;
use lipz_compiler::settings::{Settings, Sync};
use lipz_diagnostics::{Code, Diagnostic, Report, Source, Span};
use lipz_file::{Document, JsonString};
use lipz_speech::{
    AlignOptions, Language, Lexicon, Model, Pronouncer, Recogniser, RenderRules, RmsRules, TrainedModel,
};
use lipz_types::{Fps, VisemeType};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// The frame rate of clips without any setting.
const DEFAULT_FPS: Fps = Fps::whole(24);

/// The options of lip sync.
#[derive(Debug)]
#[non_exhaustive]
pub struct SyncOptions {
    /// The project's options for its Lipz files.
    pub options: Options,
    /// The spoken locale. The default is that of the first text of a clip.
    pub locale: Option<String>,
    /// The viseme type of all clips, which overrides that of their files.
    pub viseme_type: Option<VisemeType>,
    /// The frame rate of all clips, which overrides that of their files.
    pub fps: Option<Fps>,
    /// Whether to replace visemes that were made or edited by hand as well.
    pub force: bool,
    /// The assumptions of the alignment.
    pub(crate) align: AlignOptions,
    /// The rules for converting phones to frames.
    pub(crate) rules: RenderRules,
    /// Whether Lipz files get the phones.
    pub(crate) phones: bool,
    /// The rules for converting loudness to frames.
    pub(crate) rms: RmsRules,
    /// The folder of TextGrids.
    pub(crate) textgrids: Option<PathBuf>,
    lexicon: Lexicon,
    warnings: Option<Report>,
    trained: Option<HashedModel>,
    /// The project's recogniser of phones, which replaces the built-in one, and also compares texts with recordings.
    pub(crate) recogniser: Option<Recogniser>,
    pronouncers: Mutex<BTreeMap<&'static str, Arc<Pronouncer>>>,
}

/// A model of the project's own voices.
#[derive(Debug)]
pub(crate) struct HashedModel {
    model: TrainedModel,
    /// The hash of its file.
    pub(crate) hash: u64,
}

impl SyncOptions {
    /// Returns the recogniser for recordings without a text: the project's, or the built-in one.
    pub(crate) fn recogniser_without_text(&self) -> &Recogniser {
        self.recogniser.as_ref().unwrap_or(Recogniser::built_in())
    }

    /// Returns the options of a project, with its lexicon, model and recogniser, and the
    /// [warnings](SyncOptions::warnings) about the lexicon.
    ///
    /// # Errors
    /// If one of these files cannot be read, or the project treats a problem of the lexicon as an error.
    pub fn new(settings: &Settings) -> Result<SyncOptions, Report> {
        let (mut options, report) = SyncOptions::new_with_report(settings)?;
        if let Some(report) = report.as_ref().filter(|report| report.has_errors()) {
            return Err(report.clone());
        }
        options.warnings = report;
        Ok(options)
    }

    /// Returns the warnings about unused lines of the lexicon.
    pub fn warnings(&self) -> &[Report] {
        self.warnings.as_slice()
    }

    /// Returns the options of a project, and the problems of its lexicon at any level.
    ///
    /// For tools that report everything at once and continue, such as the command `lipz`. All other programs call
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
            phones: sync.phones,
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

    /// Checks that the model at `path`, if there is one, is for a language of these jobs.
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

    /// Uses this model for its language.
    pub fn set_model(&mut self, model: TrainedModel) {
        let hash = model_file::hash(&model);
        self.trained = Some(HashedModel { model, hash });
    }

    /// Returns the trained model for a locale, if there is one.
    pub(crate) fn trained_for(&self, locale: Option<&str>) -> Option<&HashedModel> {
        let language = locale.and_then(Language::from_locale).unwrap_or(Language::ENGLISH);
        self.trained.as_ref().filter(|trained| trained.model.language == language)
    }

    /// Returns the model for a locale: the trained one, or else the built-in one.
    pub(crate) fn model_of(&self, locale: Option<&str>) -> &Model {
        self.trained_for(locale).map_or(Model::english(), |trained| &trained.model.model)
    }

    /// Returns the pronouncer of a locale. The default is English.
    pub(crate) fn pronouncer(&self, locale: Option<&str>) -> Arc<Pronouncer> {
        let language = locale.and_then(Language::from_locale).unwrap_or(Language::ENGLISH);
        let mut pronouncers = self.pronouncers.lock().unwrap_or_else(PoisonError::into_inner);
        let new = || Arc::new(Pronouncer::new(language).with_lexicon(self.lexicon.clone()));
        pronouncers.entry(language.code()).or_insert_with(new).clone()
    }

    /// Returns the spoken text and its locale: in the project's spoken locale, or the first text.
    pub(crate) fn spoken<'d>(
        &self,
        job: &Job,
        document: &'d Document<'d>,
    ) -> Option<(Option<String>, &'d JsonString<'d>)> {
        spoken(document, self.locale_of(job), self.options.get_default_locale())
    }

    /// Returns the spoken text in this locale, or in the project's, and its locale.
    pub(crate) fn spoken_in<'d>(
        &self,
        locale: Option<&str>,
        document: &'d Document<'d>,
    ) -> Option<(Option<String>, &'d JsonString<'d>)> {
        spoken(document, locale.or(self.locale.as_deref()), self.options.get_default_locale())
    }

    /// Returns the spoken locale of a recording.
    pub(crate) fn locale_of<'a>(&'a self, job: &'a Job) -> Option<&'a str> {
        job.locale.as_deref().or(self.locale.as_deref())
    }

    /// Returns the frame rate of visemes whose file has this rate.
    pub(crate) fn fps_of(&self, own: Option<Fps>) -> Fps {
        self.fps.or(own).or(self.options.get_default_fps()).unwrap_or(DEFAULT_FPS)
    }

    /// Returns the viseme type of visemes whose file has this type.
    pub(crate) fn viseme_type_of(&self, own: Option<VisemeType>) -> VisemeType {
        self.viseme_type.or(own).or(self.options.get_default_viseme_type()).unwrap_or(VisemeType::Blair)
    }
}

/// Returns a project's rules for frames, and the assumptions of its alignment.
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
